#pragma once
// The kinds of curves, each with its own parameters and with what it alone knows. Whoever needs more of a
// kind visits CurveBasis without a default, so that the compiler finds what a new kind still lacks.
//
// Every kind has kWord, its name on the wire, and kFamily, how it is refined. Beside these
//
//   subdivided   check()        the first fault of the parameters and its member
//                split()        what a step does to the numbering of points
//                limit_masks()  what leads to the limit
//                children()     2i into `first` and 2i+1 into `second` for consecutive points i: `scalars`
//                               scalars from `self` on, `width` per point, whose neighbours within reach
//                               can be read too; the three arrays must not overlap
//                description()  "cubic curve", for messages
//   by pieces    check_count()  how the points of one curve must be counted; `where` takes the blame
//                segments()     of a curve of so many points, which must have passed check_count()

#include <cassert>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

enum class CurveWrap {
  nonperiodic,  // no end rule: every step loses what would need points that do not exist
  periodic,     // closed
  pinned,       // the curve starts and ends at its first and last point
};

// How far apart in the parameter Catmull-Rom's neighbours are taken to be when tangents are made: 1, the root
// of their distance, their distance. Centripetal curves have neither cusps nor loops within a segment.
//   [BarryGoldman88; YukselSchaeferKeyser11]
enum class Spacing { uniform, centripetal, chordal };

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

enum class CurveFamily {
  subdivided,  // by a scheme's masks
  pieces,      // cubic Bezier pieces
  on_knots,
};

inline constexpr Index kMaxCurveDegree = 15;

struct UniformBSpline {  // lane_riesenfeld.h
  static constexpr std::string_view kWord = "bspline";
  static constexpr CurveFamily kFamily = CurveFamily::subdivided;

  Index degree = 3;  // 1..kMaxCurveDegree

  Result<void> check() const;
  CurveSplit split() const;
  LimitMasks limit_masks() const;
  std::string description() const;
  template <class Real>
  void children(Index width, const Real* self, Count scalars, Real* first, Real* second) const;
};

struct FourPoint {  // four_point.h
  static constexpr std::string_view kWord = "fourPoint";
  static constexpr CurveFamily kFamily = CurveFamily::subdivided;

  double tension = 1.0 / 16;  // w, from 0 (the polygon) to below 0.192729

  Result<void> check() const;
  CurveSplit split() const;
  LimitMasks limit_masks() const;
  std::string description() const;
  template <class Real>
  void children(Index width, const Real* self, Count scalars, Real* first, Real* second) const;
};

struct CornerCutting {  // corner_cutting.h
  static constexpr std::string_view kWord = "cornerCutting";
  static constexpr CurveFamily kFamily = CurveFamily::subdivided;

  double ratio = 1.0 / 4;  // above 0, below 1/2

  // At 1/4, Chaikin's, the curve is the quadratic B-spline; at others it has no formula.
  bool is_quadratic_bspline() const { return ratio == 0.25; }

  Result<void> check() const;
  CurveSplit split() const;
  LimitMasks limit_masks() const;
  std::string description() const;
  template <class Real>
  void children(Index width, const Real* self, Count scalars, Real* first, Real* second) const;
};

struct Bezier {
  static constexpr std::string_view kWord = "bezier";
  static constexpr CurveFamily kFamily = CurveFamily::pieces;

  Result<void> check_count(Count points, CurveWrap wrap, const Path& where) const;
  Count segments(Count points, CurveWrap wrap) const;
};

struct CatmullRom {
  static constexpr std::string_view kWord = "catmullRom";
  static constexpr CurveFamily kFamily = CurveFamily::pieces;

  Spacing spacing = Spacing::uniform;

  Result<void> check_count(Count points, CurveWrap wrap, const Path& where) const;
  Count segments(Count points, CurveWrap wrap) const;
};

struct Hermite {
  static constexpr std::string_view kWord = "hermite";
  static constexpr CurveFamily kFamily = CurveFamily::pieces;

  Result<void> check_count(Count points, CurveWrap wrap, const Path& where) const;
  Count segments(Count points, CurveWrap wrap) const;
};

// As UsdGeomNurbsCurves has them; a wrap means nothing here.
struct Nurbs {
  static constexpr std::string_view kWord = "nurbs";
  static constexpr CurveFamily kFamily = CurveFamily::on_knots;

  std::vector<Index> orders{};    // degree + 1, of every curve or one for all
  std::vector<double> knots{};    // points + order of every curve, one curve after the other
  std::vector<double> ranges{};   // first and last parameter of every curve; empty: the whole domain
  std::vector<double> weights{};  // of every point, not multiplied into it; empty: 1

  Index order_of(Count curve) const { return orders.size() == 1 ? orders[0] : orders[curve]; }
};

// In the order in which messages list them.
using CurveBasis = std::variant<UniformBSpline, FourPoint, CornerCutting, Bezier, CatmullRom, Hermite, Nurbs>;

template <class Kind>
concept SubdividedKind = Kind::kFamily == CurveFamily::subdivided;
template <class Kind>
concept PiecewiseKind = Kind::kFamily == CurveFamily::pieces;

inline CurveFamily family_of(const CurveBasis& basis) {
  return std::visit([]<class Kind>(const Kind&) { return Kind::kFamily; }, basis);
}
inline bool is_subdivided(const CurveBasis& basis) { return family_of(basis) == CurveFamily::subdivided; }
inline std::string_view word_of(const CurveBasis& basis) {
  return std::visit([]<class Kind>(const Kind&) { return Kind::kWord; }, basis);
}

// f(kind) of a curve that is subdivided, which is assumed.
template <class F>
auto visit_scheme(const CurveBasis& basis, F&& f) {
  using R = std::invoke_result_t<F, const UniformBSpline&>;
  assert(is_subdivided(basis));
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> R {
        if constexpr (SubdividedKind<Kind>)
          return f(kind);
        else
          __builtin_unreachable();
      },
      basis);
}

}  // namespace subdivd
