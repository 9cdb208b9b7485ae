#pragma once
// The words that enumerations of the core travel as.

#include <string_view>

#include "core/curves/control_curve.h"
#include "core/mesh/control_mesh.h"

namespace subdivd::proto::json {

std::string_view word_of(Interpolation interpolation);
std::string_view word_of(BoundaryInterpolation interpolation);
std::string_view word_of(FaceVaryingInterpolation interpolation);
std::string_view word_of(CurveWrap wrap);

}  // namespace subdivd::proto::json
