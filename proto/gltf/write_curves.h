#pragma once
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/output.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// Fills the slot's primitive from the refined curves.
template <class Real>
Result<void> write_curves(const CurvesSlot& slot, const std::vector<RefinedCurves<Real>>& curves,
                          Output& output);

}  // namespace subdivd::proto::gltf
