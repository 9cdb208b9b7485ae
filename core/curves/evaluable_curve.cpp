#include "core/curves/evaluable_curve.h"

#include <utility>

namespace subdivd {

Result<EvaluableCurve> evaluable_curve(const ControlCurves& curves, Count curve, CurvePlace place,
                                       const Budget& budget) {
  auto spline = spline_of(curves, curve, place, budget);
  if (spline) return EvaluableCurve(*std::move(spline));
  if (spline.error().code != ErrorCode::unsupported) return std::move(spline).error();
  auto subdivided = subdivided_curve(curves, curve, place);
  if (!subdivided) return std::move(subdivided).error();
  return EvaluableCurve(*subdivided);
}

}  // namespace subdivd
