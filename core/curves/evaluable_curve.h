#pragma once
// A control curve as what can be evaluated and flattened.

#include <variant>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/local_subdivision.h"
#include "core/curves/piecewise.h"

namespace subdivd {

// On knots what has polynomial pieces, else the points and the rule.
using EvaluableCurve = std::variant<Spline, SubdividedCurve>;

// As spline_of(); `curves` must outlive it.
Result<EvaluableCurve> evaluable_curve(const ControlCurves& curves, Count curve, CurvePlace place,
                                       const Budget& budget);

}  // namespace subdivd
