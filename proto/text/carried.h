#pragma once
// What of a request's geometry an OBJ or OFF holds, decided before anything is refined.

#include <array>
#include <string>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "proto/text/labels.h"
#include "proto/wire.h"

namespace subdivd::proto::text {

// Of one mesh: places among ControlMesh::primvars, kNoIndex: none.
struct CarriedMesh {
  Index color = kNoIndex, color_size = 0;  // so many of its numbers
  Index texcoords = kNoIndex;
  std::array<Index, kLabelKinds> labels = {kNoIndex, kNoIndex};
};

struct Carried {
  std::vector<CarriedMesh> meshes;
  bool normals = false;               // of an OFF: of all its points
  bool face_colors = false;           // of an OFF: colours stand behind its faces, not behind its points
  std::vector<std::string> warnings;  // what is left out, one sentence each
};

// `format`: obj or off. An OFF is one mesh: it has what all its parts have.
Carried what_is_carried(const RefineRequest& request, Format format, const Pace& pace);

}  // namespace subdivd::proto::text
