#include <algorithm>
#include <string>

#include "core/splines/spline.h"
#include "server/handlers/compute_curves.h"
#include "server/handlers/each_curve.h"

namespace subdivd::server {
namespace {

using proto::CurveForm;
using proto::CurveRequest;
using proto::CurveTask;
using proto::CurveTaskKind;

// Joined curves are lifted to the highest degree among them.
Count highest_degree(const CurveRequest& request) {
  Count degree = 0;
  for (const ControlCurves& curves : request.curves.curves) {
    const bool on_knots = curves.basis == CurveBasis::nurbs;
    degree = std::max<Count>(degree, curves.basis == CurveBasis::bspline ? curves.degree : 3);
    for (const Index order : curves.orders) degree = std::max<Count>(degree, on_knots ? order - 1 : 0);
  }
  return degree;
}

// Points that come out for one that goes in, at most: segments of Catmull-Rom and Hermite curves become
// Bezier pieces, spans become pieces, and at degree d a span has d points of its own.
Count growth(CurveBasis basis, const CurveTask& task, Count degree) {
  const bool drawn = basis == CurveBasis::catmull_rom || basis == CurveBasis::hermite;
  const Count pieces = task.to == CurveForm::nurbs ? 1 : 4;
  return (drawn ? 3 : 1) * std::max<Count>(pieces, degree == 0 ? 0 : degree + 1);
}

Count numbers_of(const CurveRequest& request) {
  const CurveTask& task = request.task;
  Count numbers = 0;
  const Count degree = std::max<Count>(task.to_degree.value_or(0), task.join ? highest_degree(request) : 0);
  // A point, five derivatives, a normal and what says where.
  for (const ControlPatch& surface : request.curves.surfaces)
    numbers = std::max(numbers, task.sample_us.size() * (Count{6} * surface.width + 6));
  for (const ControlCurves& curves : request.curves.curves) {
    const Count points = curves.point_count(), count = curves.curve_count();
    const Count width = curves.width + 2;  // weight and knot
    switch (task.kind) {
      case CurveTaskKind::evaluate:
        numbers = std::max(
            numbers, task.sample_ts.size() *
                         ((Count{task.frames ? 4u : task.derivatives} + task.derivatives + 1) * width + 12));
        break;
      case CurveTaskKind::measure:
        numbers += count * (Count{task.equal_lengths.value_or(0)} + Count{task.convergence.value_or(0)} * 2 +
                            4 * width + task.closest_to.size() * 3);
        if (task.flatten)
          for (Count c = 0; c < count; ++c)
            numbers += most_polyline_points(curves.points_of_curve(c)) * width;
        break;
      default:
        numbers += (points * growth(curves.basis, task, degree) +
                    count * (task.insert.size() + 2 * Count{kMaxDegree})) *
                   width;
        break;
    }
  }
  return numbers;
}

// Beside the numbers: what every curve has of its own, in vectors that grow, and every point to come close
// to.
Count bytes_beside(const CurveRequest& request) {
  constexpr Count kOfCurve = 1536, kOfClosestPoint = 160;
  Count curves = 0, bytes = 0;
  if (request.task.kind == CurveTaskKind::evaluate) return 0;  // takes what it keeps of curves when it does
  for (const ControlCurves& set : request.curves.curves) curves += set.curve_count();
  bytes += kOfCurve * curves;
  if (request.task.closest_width > 0)
    bytes += curves * (request.task.closest_to.size() / request.task.closest_width) * kOfClosestPoint;
  return bytes;
}

}  // namespace

Result<Count> predict_curve_task(const CurveRequest& request, Count most) {
  constexpr Count kTextOfNumber = 26, kBytesOfNumber = 64;
  const Count numbers = numbers_of(request);
  if (numbers * kTextOfNumber <= most) return numbers * kBytesOfNumber + bytes_beside(request);
  return Error{ErrorCode::too_large,
               "the answer would take up to " + std::to_string(numbers * kTextOfNumber) + " bytes; " +
                   std::to_string(most) + " are allowed: ask for less, or for fewer curves",
               {},
               numbers * kTextOfNumber,
               most};
}

}  // namespace subdivd::server
