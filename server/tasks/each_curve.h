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
