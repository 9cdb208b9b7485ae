#include "core/oracle/far_scheme.h"

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "core/refine/plan.h"

namespace subdivd::oracle {
namespace {

template <class Scheme>
constexpr std::optional<FarScheme> kFarScheme = std::is_same_v<Scheme, Loop> ? std::optional(FarScheme::loop)
                                                : std::is_same_v<Scheme, CatmullClark>
                                                    ? std::optional(FarScheme::catmull_clark)
                                                : std::is_same_v<Scheme, Bilinear>
                                                    ? std::optional(FarScheme::bilinear)
                                                    : std::nullopt;

}  // namespace

Result<FarScheme> far_scheme_of(const ControlMesh& mesh, const Pace& pace) {
  const auto scheme = scheme_of(mesh, {}, pace);
  if (!scheme) return scheme.error();
  const auto known = std::visit([]<class S>(const S&) { return kFarScheme<S>; }, *scheme);
  if (!known) return Error{ErrorCode::unsupported, "OpenSubdiv " + std::string(beyond_opensubdiv(*scheme))};
  return *known;
}

GridShape grid_shape_of(const ControlMesh& mesh, FarScheme scheme, const Pace& pace) {
  if (scheme == FarScheme::loop) return GridShape::triangles;
  const std::vector<Index>& sizes = mesh.face_vertex_counts;
  const bool all_quads = !sizes.empty() && pace.all_blocks(sizes.size(), [&](Count begin, Count end) {
    return std::all_of(sizes.begin() + static_cast<std::ptrdiff_t>(begin),
                       sizes.begin() + static_cast<std::ptrdiff_t>(end),
                       [](Index size) { return size == 4; });
  });
  return all_quads ? GridShape::quads : GridShape::corners;
}

FaceRows base_rows_of(const ControlMesh& mesh, const Pace& pace) {
  return mesh.face_vertex_counts.empty() ? FaceRows(3, mesh.face_count())
                                         : FaceRows(mesh.face_vertex_counts, pace);
}

bool makes_triangles(const ControlMesh& mesh) {
  const bool all_triangles =
      std::ranges::all_of(mesh.face_vertex_counts, [](Index size) { return size == 3; });
  const auto scheme =
      scheme_of_mesh(mesh.subdivision_scheme, all_triangles ? FaceSizes{3, 3} : FaceSizes{3, kNoIndex});
  return scheme && splits_into_triangles(*scheme);
}

}  // namespace subdivd::oracle
