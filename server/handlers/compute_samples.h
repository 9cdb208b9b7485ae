#pragma once
// From a decoded request for samples (/v1/evaluate) to the core and back.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/curve_task.h"

namespace subdivd::server {

// The curves at the parameters of the request. Subdivided curves without a formula have a point and a
// tangent, the others everything. Sizes are predicted by predict_curve_task (compute_curves.h).
Result<proto::CurveSamples> compute_samples(const proto::CurveRequest& request, const Budget& budget);
Result<proto::SurfaceSamples> compute_surface_samples(const proto::CurveRequest& request,
                                                      const Budget& budget);

}  // namespace subdivd::server
