#pragma once
// From a decoded request to the core and back. The only place where the server calls the core.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/oracle/report.h"
#include "proto/wire.h"

namespace subdivd::server {

// Milliseconds by phase, as far as they are known. No body carries them: equal requests have equal answers.
struct Timings {
  double read = 0, refine = 0, verify = 0;
};

// Refines every mesh, curve and surface, in the precision of the answer; with the report when the options ask
// for it. Sets timings.refine, and timings.verify when there is a report.
Result<proto::AnyAnswer> compute_refinement(const proto::RefineRequest& request, const Budget& budget,
                                            Timings& timings);

// Bytes that OpenSubdiv takes for the curves and surfaces of the request, which it refines as meshes: many
// times their own. `request` is one whose refinement has been predicted.
Count oracle_bytes(const proto::RefineRequest& request);

// Our core against OpenSubdiv, for every mesh, curve and surface of the request.
Result<oracle::Report> compute_report(const proto::RefineRequest& request, const Budget& budget);

}  // namespace subdivd::server
