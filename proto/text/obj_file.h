#pragma once
// An OBJ as it was read, before it is cut into meshes. Indices count from 0 and lie within their arrays.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/mesh/cage.h"
#include "proto/name_list.h"
#include "proto/text/labels.h"
#include "proto/wire.h"

namespace subdivd::proto::text {

inline constexpr double kNoColor = std::numeric_limits<double>::quiet_NaN();

// What stands behind one `o`, up to the next; the first has no name, and what stands before any.
struct ObjObject {
  std::string_view name;  // in the body
  Count first_face = 0, first_corner = 0, first_line = 0, first_line_point = 0;
};

// The faces from here on have this group, or this material; none where the name is empty.
struct ObjLabel {
  std::string_view name;  // a rest() of a line of the body
  Count first_face;
};

struct ObjCrease {
  Index a, b;
  float sharpness;
  Count line;
  std::size_t object;
};
struct ObjCorner {
  Index point;
  float sharpness;
  Count line;
  std::size_t object;
};
struct ObjHole {
  Index face;
  Count line;
  std::size_t object;
};

struct ObjFile {
  std::vector<double> points;     // x y z each
  std::vector<double> colors;     // r g b of every point, or kNoColor thrice; empty: no point has one
  std::vector<double> texcoords;  // u v each
  std::vector<Index> face_counts, corner_points;
  std::vector<Index> corner_texcoords;  // kNoIndex: the corner has none
  std::vector<Index> line_counts, line_points;
  std::vector<ObjObject> objects;                         // at least one
  std::array<std::vector<ObjLabel>, kLabelKinds> labels;  // in the order of the body
  NameList material_libraries;
  std::vector<ObjCrease> creases;  // tags in the order of the body, and so of objects
  std::vector<ObjCorner> corners;
  std::vector<ObjHole> holes;
  std::optional<BoundaryInterpolation> boundary;
  std::optional<FaceVaryingInterpolation> face_varying;
  std::optional<CreaseMethod> crease_method;
  std::optional<TriangleRule> triangle_rule;
  bool has_groups = false, has_others = false, has_other_tags = false;
};

// One mesh for each object with faces, one list of curves for each with lines. Of several meshes, and beside
// curves, each has the points that its faces use, in their order; a mesh alone has them all. Consumes the file.
Result<RefineRequest> make_meshes(ObjFile file, const Pace& pace);

}  // namespace subdivd::proto::text
