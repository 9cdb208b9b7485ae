#include "core/splines/chord.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/splines/measurement.h"

namespace subdivd {

double square_from_segment(std::span<const double> point, std::span<const double> a,
                           std::span<const double> b) {
  double along = 0, length = 0, square = 0;
  for (Count k = 0; k < a.size(); ++k) {
    along += (point[k] - a[k]) * (b[k] - a[k]);
    length += (b[k] - a[k]) * (b[k] - a[k]);
  }
  const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  for (Count k = 0; k < a.size(); ++k) {
    const double off = point[k] - (a[k] + share * (b[k] - a[k]));
    square += off * off;
  }
  return square;
}

Result<void> check_tolerance(const FlattenOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    return refusal(ErrorCode::out_of_range,
                   "the tolerance must be a finite number above 0, in the unit of the coordinates",
                   {"tolerance"});
  return {};
}

Error too_fine(const FlattenOptions& options, double least) {
  return refusal(ErrorCode::out_of_range,
                 "the tolerance " + brief(options.tolerance) +
                     " is less than what the rounding of the coordinates allows, " + brief(least) +
                     ": choose a larger one",
                 {"tolerance"});
}

Error too_many_corners(Count predicted, Count allowed) {
  return Error{.code = ErrorCode::too_large,
               .message = "the polyline would have at least " + std::to_string(predicted) + " points; " +
                          std::to_string(allowed) + " are allowed: choose a larger tolerance",
               .where = {"tolerance"},
               .predicted = predicted,
               .allowed = allowed};
}

}  // namespace subdivd
