// What Far is asked to take, judged before it is called.

#include <limits>
#include <string>

#include "core/lattice/split.h"
#include "core/oracle/far.h"
#include "core/oracle/far_cost.h"

namespace subdivd::oracle {

Result<void> check_far_corners(Count corners) {
  constexpr Count kMost = std::numeric_limits<int>::max();
  if (corners <= kMost) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "the refined mesh has more face corners than OpenSubdiv can number",
               .predicted = corners,
               .allowed = kMost};
}

Result<void> check_far_bytes(Count bytes, const Budget& budget) {
  if (bytes <= budget.max_bytes) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "verification would take about " + std::to_string(bytes) + " bytes; " +
                          std::to_string(budget.max_bytes) + " are allowed: choose a lower level",
               .predicted = bytes,
               .allowed = budget.max_bytes};
}

Result<void> check_far_size(const ControlMesh& mesh, Index level, const Budget& budget) {
  if (level > kMaxFarLevel)
    return Error{.code = ErrorCode::out_of_range,
                 .message = "verification reaches level " + std::to_string(kMaxFarLevel) + "; level " +
                            std::to_string(level) + " was asked for",
                 .predicted = level,
                 .allowed = kMaxFarLevel};
  if (mesh.face_count() == 0 || mesh.point_count() == 0)
    return Error{ErrorCode::unsupported, "OpenSubdiv takes no mesh without faces", {"faceVertexIndices"}};
  // Far sums face corners over all levels: a third more than the last level has.
  // (Any split makes as many corners of one, four a level.)
  const Count corners =
      mesh.face_vertex_indices.size() * triangles_per_face(level) * 4 / 3 + mesh.point_count();
  if (auto fits = check_far_corners(corners); !fits) return fits;
  if (auto fits = check_far_bytes(far_mesh_bytes(mesh, level), budget); !fits) return fits;
  const auto load = far_load(mesh, budget);
  if (!load) return load.error();
  return check_far_time(*load, level);
}

}  // namespace subdivd::oracle
