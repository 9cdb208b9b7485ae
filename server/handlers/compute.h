#pragma once
// From a decoded request to the core and back. The only place where the server calls the core.

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/oracle/report.h"
#include "core/refine/plan.h"
#include "proto/wire.h"
#include "server/handlers/phases.h"

namespace subdivd::server {

// Refines every mesh (by its plan), curve and surface, in the precision of the answer; with the report when
// the options ask for it. Ends the phases "refine" and "verify".
Result<proto::AnyAnswer> compute_refinement(const proto::RefineRequest& request,
                                            const std::vector<Plan>& plans, const Budget& budget,
                                            Phases& phases);

// Bytes that OpenSubdiv and the comparison take beside our own refinement: many times the answer's. `request`
// is one whose refinement has been predicted.
Count oracle_bytes(const proto::RefineRequest& request);

// Our core against OpenSubdiv, for every mesh, curve and surface of the request.
Result<oracle::Report> compute_report(const proto::RefineRequest& request, const std::vector<Plan>& plans,
                                      const Budget& budget);

}  // namespace subdivd::server
