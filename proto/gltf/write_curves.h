#pragma once
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/output.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// Fills the slot's primitive from the refined curves. `first_point`: unless kLines, the number of points of
// the curves before slot.ordinal in its element.
template <class Real>
Result<void> write_curves(const CurvesSlot& slot, const std::vector<RefinedCurves<Real>>& curves,
                          Count first_point, Output& output, Work& work);

}  // namespace subdivd::proto::gltf
