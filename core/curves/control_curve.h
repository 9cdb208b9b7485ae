#pragma once
// A control curve as the caller gave it. Names and meanings of width, counts and wraps are OpenUSD's
// UsdGeomBasisCurves; type "cubic", basis "bspline" is degree 3 here.

#include <string>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

enum class CurveWrap {
  nonperiodic,  // no end rule: every step loses what would need points that do not exist
  periodic,     // closed
  pinned,       // the curve starts and ends at its first and last point
};

enum class CurveBasis {
  // subdivision schemes; each has a header of its own name
  bspline,         // lane_riesenfeld.h, by `degree`
  four_point,      // four_point.h, by `tension`
  corner_cutting,  // corner_cutting.h, by `ratio`
  // pieces: bases.h
  bezier,
  catmull_rom,  // by `spacing`
  hermite,
  // on knots: spline.h
  nurbs,  // by `orders`, `knots`, `ranges`, `weights`
};
inline bool is_subdivided(CurveBasis basis) { return basis <= CurveBasis::corner_cutting; }

// How far apart in the parameter Catmull-Rom's neighbours are taken to be when tangents are made: 1, the root
// of their distance, their distance. Centripetal curves have neither cusps nor loops within a segment.
//   [BarryGoldman88; YukselSchaeferKeyser11]
enum class Spacing { uniform, centripetal, chordal };

inline constexpr Index kMaxCurveWidth = 4096;
inline constexpr Index kMaxCurveDegree = 15;

// One or more curves over one point array: curve c takes vertex_counts[c] consecutive points.
struct ControlCurves {
  std::string name;
  Index width = 3;                   // scalars per point: 1..kMaxCurveWidth
  std::vector<double> points;        // width scalars per point
  std::vector<Index> vertex_counts;  // empty: one curve of all points
  CurveWrap wrap = CurveWrap::pinned;
  CurveBasis basis = CurveBasis::bspline;
  Index degree = 3;                    // bspline: 1..kMaxCurveDegree
  double tension = 1.0 / 16;           // four_point: w from 0 (the polygon) to below 0.192729
  double ratio = 1.0 / 4;              // corner_cutting: above 0, below 1/2
  Spacing spacing = Spacing::uniform;  // catmull_rom
  // nurbs, as UsdGeomNurbsCurves has them; `wrap` means nothing there
  std::vector<Index> orders{};    // degree + 1, of every curve or one for all
  std::vector<double> knots{};    // points + order of every curve, one curve after the other
  std::vector<double> ranges{};   // first and last parameter of every curve; empty: the whole domain
  std::vector<double> weights{};  // of every point, not multiplied into it; empty: 1

  Count point_count() const { return width == 0 ? 0 : points.size() / width; }
  Count curve_count() const { return vertex_counts.empty() ? 1 : vertex_counts.size(); }
  Count points_of_curve(Count curve) const {
    return vertex_counts.empty() ? point_count() : vertex_counts[curve];
  }
  // First fault and its place (JSON names: degree, tension, ratio - only that of the basis in use is looked
  // at -, points, counted in scalars, curveVertexCounts). Needs least_points() per curve.
  Result<void> check(const Budget& budget = {}) const;
};

// What one step of a scheme does to the numbering of points.
//
//   primal   child 2i stands at point i, child 2i+1 between points i and i+1
//   dual     children 2i and 2i+1 stand before and behind point i, a quarter of the spacing away
//
// Open curves lose children at the ends that would need points that do not exist; pinned curves of a dual
// scheme have two points of another kind, their ends, which stand a half of the spacing outside the others.
struct CurveSplit {
  bool dual = false;
  Index reach = 1;  // children of point i take no points but i - reach .. i + reach
  Index lost = 3;   // nonperiodic: N -> 2N - lost; lost / 2 children are missing at the front
};

// Of subdivision schemes, whose parameter (degree) must be in range.
CurveSplit split_of(const ControlCurves& curves);

// The fewest points of one curve of a subdivision scheme: nonperiodic lost + 1 (degree + 1; 6 of four_point;
// 3 of corner_cutting), periodic 3, pinned 2, or 3 of a dual scheme (even degrees, corner_cutting).
Index least_points(const ControlCurves& curves);

// What leads from points of any level to the limit at once. Sums are symmetric in i-k and i+k.
struct LimitMasks {
  // limit = values[0] c_i + sum_{k>=1} values[k] (c_{i-k} + c_{i+k})
  std::vector<double> values;
  // tangent = sum_{k>=1} slopes[k] (c_{i+k} - c_{i-k}), per unit of the level's own parameter; slopes[0] is 0
  std::vector<double> slopes;
  // tangent at the first point e of a pinned curve = sum_{k>=1} end_slopes[k-1] (c_k - e); at the last
  // mirrored
  std::vector<double> end_slopes;
};

}  // namespace subdivd
