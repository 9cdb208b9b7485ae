#pragma once
// How much refine() would return, from a plan and closed forms.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/refine/plan.h"
#include "core/refine/refine.h"

namespace subdivd {

// Refuses levels over kMaxLevel.
Result<void> check_level(Index level);

// See predict_size. options.level has been checked; the plan's own max_level does not matter.
template <class Real>
Result<RefinedSize> size_of(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                            const Budget& budget);

}  // namespace subdivd
