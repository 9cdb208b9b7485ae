#pragma once
// Meshes, curves and surfaces refined, or compared with OpenSubdiv: from a decoded request to the bytes of
// the answer. Not a word of HTTP, so that handlers, benches and tests call the same code.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/wire.h"
#include "server/tasks/phases.h"

namespace subdivd::server::tasks {

// Refines in the request's answer_format and precision; with a report when its options ask for one. All
// memory is predicted and taken from the budget before it is used. Ends the phases "plan", "refine", "verify"
// (if any), "write".
Result<proto::Payload> refine(const proto::RefineRequest& request, const proto::Limits& limits,
                              const Budget& budget, Phases& phases);

// What refine() encodes.
Result<proto::AnyAnswer> compute(const proto::RefineRequest& request, const proto::Limits& limits,
                                 const Budget& budget = {});

// The report alone. Ends the phases "plan", "verify", "write".
Result<proto::Payload> verify(const proto::RefineRequest& request, const proto::Limits& limits,
                              const Budget& budget, Phases& phases);

// Sends small meshes, of triangles, of quads and of polygons, through decoding, refinement and the oracle;
// false when anything is not as it must be.
bool self_test();

}  // namespace subdivd::server::tasks
