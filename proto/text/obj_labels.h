#pragma once
// Groups and materials of an OBJ, as uniform primvars of numbers and the names that these stand for.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "proto/name_list.h"
#include "proto/text/obj_file.h"

namespace subdivd::proto::text {

class ObjLabels {
 public:
  struct Range {
    Count begin = 0, end = 0;  // faces
  };

  // Sorts the file's names (n log n for n lines). Refuses (too_large) more of them than single precision can
  // number.
  static Result<ObjLabels> make(const ObjFile& file, const Pace& pace);

  // What the names of all meshes take together: a mesh has those of its faces, each once. `meshes`: in the order
  // of the file, as those of add().
  Count name_bytes(std::span<const Range> meshes, const Pace& pace);

  // Adds "group" and "material" to the mesh, those that any of its faces has, and for each of its primvars a list
  // of names. Numbers count from 0 in the order of the faces; a face without a name has that of an empty one.
  // To be called for one mesh of the file after the other.
  void add(Range faces, ControlMesh& mesh, std::vector<NameList>& names, const Pace& pace);

 private:
  // Of groups, or of materials.
  struct Kind {
    std::span<const ObjLabel> labels;
    std::vector<Index> ids;  // for every label: of its name; kNoIndex: it has none
    std::vector<Index> owners,
        numbers;     // for every id, and one for no name: the last mesh that has it, and as what
    Count at = 0;    // the label that holds where the last walk ended
    Index mesh = 0;  // how many have been walked through
  };

  Result<void> sort(Kind& kind, const Pace& pace);
  template <class F>
  static Count walk(Kind& kind, Range faces, const Pace& pace, F&& f);

  std::array<Kind, kLabelKinds> kinds_;
};

}  // namespace subdivd::proto::text
