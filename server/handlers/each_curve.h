#pragma once
// What the tasks on curves share: every curve of a request in turn, what one may take, and where faults are.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/piecewise.h"
#include "core/splines/arc_length.h"
#include "proto/curve_task.h"
#include "proto/prepare.h"

namespace subdivd::server {

// What one curve may take: a smooth one far less, one of many spans in proportion.
inline Count most_polyline_points(Count points) { return std::max(Count{1} << 16, 64 * points); }
inline Count most_length_pieces(Count points) { return std::max(LengthOptions{}.max_pieces, 16 * points); }

// An error about something beside the curves: its place is a member of the body.
inline Error at_member(Error error, const char* member, std::optional<std::uint64_t> index = {}) {
  error.where = {member};
  if (index) error.where.emplace_back(*index);
  return error;
}

// Calls work(curve, set, ordinal) for what make(curves, ordinal, place) makes of every curve, in the order of
// the body; what cannot be made is blamed on its set of curves.
template <class Make, class Work>
Result<void> for_each_curve(const proto::CurveRequest& request, const Budget& budget, Make&& make,
                            Work&& work) {
  for (std::size_t i = 0; i < request.curves.curves.size(); ++i) {
    const ControlCurves& curves = request.curves.curves[i];
    CurvePlace place;
    for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
      if (auto stop = budget.poll()) return *stop;
      auto curve = make(curves, c, place);
      if (!curve) return proto::blame_input(request.curves, std::move(curve).error(), "curves", i);
      if (auto done = work(*std::move(curve), i, c); !done) return done;
    }
  }
  return {};
}

}  // namespace subdivd::server
