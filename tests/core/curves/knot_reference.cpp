#include "tests/core/curves/knot_reference.h"

namespace subdivd::testing {
namespace {

// N_{i,p}(t) on the integer knots: N_{i,0} = 1 on [i, i+1), and
// N_{i,p} = (t - i)/p N_{i,p-1} + (i+p+1 - t)/p N_{i+1,p-1}.   [Cox 72, deBoor 72]
double basis(double knot, int degree, double t) {
  if (degree == 0) return t >= knot && t < knot + 1 ? 1 : 0;
  return (t - knot) / degree * basis(knot, degree - 1, t) +
         (knot + degree + 1 - t) / degree * basis(knot + 1, degree - 1, t);
}

// All control points, the implied ones included, and the parameter at which the first of them has its peak.
struct Extended {
  std::vector<double> points;
  int first = 0;
};

Extended extended(const ControlCurves& curves) {
  const auto n = static_cast<int>(curves.point_count());
  const auto width = static_cast<int>(curves.width);
  Extended all;
  all.first = curves.wrap == CurveWrap::nonperiodic ? 0 : -1;
  const int end = curves.wrap == CurveWrap::pinned ? n + 1 : curves.wrap == CurveWrap::periodic ? n + 2 : n;
  const auto at = [&](int i, int k) { return curves.points[static_cast<std::size_t>(i * width + k)]; };
  for (int i = all.first; i < end; ++i)
    for (int k = 0; k < width; ++k) {
      if (curves.wrap == CurveWrap::periodic)
        all.points.push_back(at((i + n) % n, k));
      else if (i < 0)
        all.points.push_back(2 * at(0, k) - at(1, k));
      else if (i >= n)
        all.points.push_back(2 * at(n - 1, k) - at(n - 2, k));
      else
        all.points.push_back(at(i, k));
    }
  return all;
}

}  // namespace

std::vector<double> all_basis_point(const ControlCurves& curves, double t) {
  const Extended all = extended(curves);
  std::vector<double> point(curves.width, 0);
  for (std::size_t i = 0; i < all.points.size() / curves.width; ++i) {
    const double peak = all.first + static_cast<double>(i);  // the basis function of c_i spans [i-2, i+2]
    for (std::size_t k = 0; k < curves.width; ++k)
      point[k] += basis(peak - 2, 3, t) * all.points[i * curves.width + k];
  }
  return point;
}

}  // namespace subdivd::testing
