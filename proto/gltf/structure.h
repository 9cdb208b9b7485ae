#pragma once
// tinygltf reads what describes the data of triangles and lines, from a document that has been checked.
//
// It is given reduced copies: a few hundred accessors or bufferViews at a time, with the members of the
// specification alone, so that it can be stopped between them. No buffers (their bytes would be decoded and
// copied again), no images (it would decode them), no extras.

#include <tiny_gltf.h>

#include <vector>

#include "core/base/result.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/layout.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

struct Structure {
  // By its number in the document; used by a primitive of triangles or lines.
  const tinygltf::Accessor& accessor(Index number) const { return model.accessors[accessor_places[number]]; }

  // Only what is used; the accessors refer to the bufferViews here, those to the document's buffers.
  tinygltf::Model model;
  std::vector<Index> accessor_places;  // of the document's accessors in the model; kNoIndex: not used
};

// The memory is kept with `work`.
Result<Structure> load_structure(const Json& document, const Layout& layout, Work& work);

}  // namespace subdivd::proto::gltf
