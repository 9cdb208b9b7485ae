#pragma once
// What the tasks on curves share: every curve of a request in turn, what one may take, and where faults are.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/curves/piecewise.h"
#include "core/splines/arc_length.h"
#include "proto/curve_task.h"
#include "proto/prepare.h"
#include "server/tasks/reused_memory.h"

namespace subdivd::server::tasks {

// What one curve may take: a smooth one far less, one of many spans in proportion.
inline Count most_polyline_points(Count points) { return std::max(Count{1} << 16, 64 * points); }
inline Count most_length_pieces(Count points) { return std::max(LengthOptions{}.max_pieces, 16 * points); }

inline Count degree_of(const ControlCurves& curves, Count curve) {
  if (curves.basis == CurveBasis::bspline) return curves.degree;
  if (curves.basis != CurveBasis::nurbs || curves.orders.empty()) return 3;  // corner cutting's is 2
  return curves.orders[curves.orders.size() == 1 ? 0 : curve] - Count{1};
}

// Bytes while a curve is made into a spline, and while that is brought into coordinates of its own: copies of
// its points and knots, which grow. Curves that are closed or start at their first point get up to a degree
// more of points.
inline Count spline_bytes(const ControlCurves& curves, Count curve) {
  constexpr Count kCopies = 10;
  const Count degree = degree_of(curves, curve), width = curves.width;
  const Count points = curves.points_of_curve(curve) + 2 * (degree + 1);
  const bool by_pieces = curves.basis == CurveBasis::bezier || curves.basis == CurveBasis::catmull_rom ||
                         curves.basis == CurveBasis::hermite;
  const Count numbers = points * (width + 2) * (by_pieces ? 3 : 1);
  return numbers * kCopies * sizeof(double);
}

// An error about something beside the curves: its place is a member of the body. What was stopped has none.
inline Error at_member(Error error, const char* member, std::optional<std::uint64_t> index = {}) {
  if (is_stop(error)) return error;
  error.where = {member};
  if (index) error.where.emplace_back(*index);
  return error;
}

// Calls work(curve, set, ordinal) for what make(curves, ordinal, place, budget) makes of every curve, in the
// order of the body; what cannot be made is blamed on its set of curves. `memory` gives the budget for one
// curve.
template <class Make, class Work>
Result<void> for_each_curve(const proto::CurveRequest& request, ReusedMemory& memory, Make&& make,
                            Work&& work) {
  for (std::size_t i = 0; i < request.curves.curves.size(); ++i) {
    const ControlCurves& curves = request.curves.curves[i];
    CurvePlace place;
    for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
      if (auto stop = memory.budget().poll()) return *stop;
      memory.free_to(0);
      if (auto taken = memory.budget().take_memory(spline_bytes(curves, c)); !taken) return taken;
      auto curve = make(curves, c, place, memory.budget());
      if (!curve) return proto::blame_input(request.curves, std::move(curve).error(), "curves", i);
      if (auto done = work(*std::move(curve), i, c); !done) return done;
    }
  }
  return {};
}

}  // namespace subdivd::server::tasks
