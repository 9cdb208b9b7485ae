#pragma once
// The words that enumerations of the core travel as.

#include <span>
#include <string_view>

#include "core/curves/control_curve.h"
#include "core/mesh/control_mesh.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Of `interpolation`, `wrap`, `basis` (up to hermite: a curve on knots has a type instead) and `spacing`, in
// the order of the enumerations; the others stand in the table of options.
std::span<const std::string_view> interpolation_words();
std::span<const std::string_view> wrap_words();
std::span<const std::string_view> basis_words();  // of the kinds that `basis` names, in their order
std::span<const std::string_view> spacing_words();
std::span<const std::string_view> triangle_rule_words();  // of `triangleSubdivisionRule`
std::span<const std::string_view> orientation_words();    // of `orientation`

std::string_view word_of(Interpolation interpolation);
std::string_view word_of(BoundaryInterpolation interpolation);
std::string_view word_of(FaceVaryingInterpolation interpolation);
std::string_view word_of(TriangleRule rule);
std::string_view word_of(CurveWrap wrap);
std::string_view word_of(Orientation orientation);

}  // namespace subdivd::proto::json
