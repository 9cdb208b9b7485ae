#pragma once
// From a decoded request under /v1/curves to the core and back.

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/curve_task.h"

namespace subdivd::server::tasks {

// Bytes that the answer and its text will take at most: to be reserved before anything is computed. What is
// needed to compute it, compute_...() take from their budget. too_large over `most`, the bytes of an answer,
// and for more than kMostListedRemovals.
Result<Count> predict_curve_task(const proto::CurveRequest& request, Count most, const Budget& budget = {});

// Of many curves, every listed knot is looked for in each: curves times knots, some microseconds each. (Of
// one curve there may be as many as the body holds.)
inline constexpr Count kMostListedRemovals = Count{1} << 23;

// The curves, or the surfaces, at the parameters of the request. Curves without a formula have a point and a
// tangent, the others everything.
Result<proto::CurveSamples> compute_samples(const proto::CurveRequest& request, const Budget& budget);
Result<proto::SurfaceSamples> compute_surface_samples(const proto::CurveRequest& request,
                                                      const Budget& budget);
Result<std::vector<proto::CurveMeasure>> compute_measures(const proto::CurveRequest& request,
                                                          const Budget& budget);
// Insertion, removal and conversion: every curve of the request for itself, or all joined into one.
Result<proto::EditedCurves> compute_edited(const proto::CurveRequest& request, const Budget& budget);

}  // namespace subdivd::server::tasks
