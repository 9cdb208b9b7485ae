#pragma once
// What deviations are measured by, and how large they may be. What takes a Pace throws Stopped.

#include <span>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/control_mesh.h"

namespace subdivd::oracle {

// Of a set of points.
struct PointScale {
  double diagonal = 1;  // of the control points' bounding box; largest magnitude, or 1, when that is 0
  // How much farther from the origin the points lie than they are spread, at least 1: coordinates round by
  // their magnitude, so the tolerance of positions grows by this factor.
  double remoteness = 1;
};
// `points`: width scalars each.
PointScale point_scale(std::span<const double> points, Index width, const Pace& pace);

// Sharpness is single precision in Far and here, and three or more semi-sharp edges at one point are added up
// in an order that is each side's own: the blended weights may differ in their eighth digit.
bool sharpness_rounds(const ControlMesh& mesh, const Pace& pace);
inline constexpr double kSharpnessRounding = 1e-7;  // tolerance of values, relative, where it does

// Tolerances of max_relative in the precision of Real.
template <class Real>
double value_tolerance();  // 1e-12 double, 2e-6 float
template <class Real>
double normal_tolerance();  // degrees: 0.01 double, 0.5 float
// Far's face-varying limit masks are written in single precision (1.0f / 6.0f), in its double refiner too.
template <class Real>
double face_varying_limit_tolerance();

}  // namespace subdivd::oracle
