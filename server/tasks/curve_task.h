#pragma once
// What is asked of curves beside refining them: from a decoded request to the bytes of the answer.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/curve_task.h"
#include "proto/wire.h"
#include "server/tasks/phases.h"

namespace subdivd::server::tasks {

// Evaluates, measures or edits. The answer's memory is predicted and taken from the budget before anything is
// computed. Ends the phases "compute" and "write".
Result<proto::Payload> answer_curves(const proto::CurveRequest& request, const proto::Limits& limits,
                                     const Budget& budget, Phases& phases);

}  // namespace subdivd::server::tasks
