#pragma once
// Uniform B-spline surfaces on a grid of control points (tensor products), of degree 2 or 3 in each
// direction: subdivision, limits, frames, connectivity, evaluation.   [CatmullClark78; DooSabin78;
// LaneRiesenfeld80]
//
// Every rule is one of a curve, applied along one direction and then along the other:
//
//              step                                    limit                     tangent
//   cubic      (c_{i-1} + 6 c_i + c_{i+1}) / 8         (c_{i-1} + 4 c_i          (c_{i+1} - c_{i-1}) / 2
//              (c_i + c_{i+1}) / 2                      + c_{i+1}) / 6
//   quadratic  (3 c_i + c_{i+1}) / 4                   (c_{i-1} + 6 c_i          (c_{i+1} - c_{i-1}) / 2
//              (c_i + 3 c_{i+1}) / 4   [Chaikin74]      + c_{i+1}) / 8
//
// A pinned direction begins at its first row of points and ends at its last:
//   cubic      a phantom point c_{-1} = 2 c_0 - c_1 stands before the first.
//   quadratic  c_0 and c_{n-1} are points of the border; the others are control points, and a phantom point
//              2 c_0 - c_1 stands before them. It is the spline with triple knots at its ends.
// Likewise at the other end.
//
// Parameters count control points, as those of curves do (core/curves/subdivision.h): column i stands at u =
// i, but in a pinned quadratic direction at i - 1/2, its borders, half a unit from their neighbours, at 0 and
// n - 2.
//
//   degree  wrap         least n  n after l steps      domain
//   cubic   nonperiodic  4        (n - 3) 2^l + 3      [1, n - 2]
//   cubic   periodic     3        n 2^l                any, period n
//   cubic   pinned       2        (n - 1) 2^l + 1      [0, n - 1]
//   quadr.  nonperiodic  3        (n - 2) 2^l + 2      [1/2, n - 3/2]
//   quadr.  periodic     3        n 2^l                any, period n
//   quadr.  pinned       3        (n - 2) 2^l + 2      [0, n - 2]

#include <array>
#include <string>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"

namespace subdivd {

inline constexpr Index kMaxPatchLevel = 15;
inline constexpr Index kMaxPatchWidth = 16;

struct ControlPatch {
  std::string name;
  Index u_count = 0, v_count = 0;    // columns and rows of the grid
  Index u_degree = 3, v_degree = 3;  // 2 or 3
  CurveWrap u_wrap = CurveWrap::pinned, v_wrap = CurveWrap::pinned;
  Index width = 3;             // scalars per point: 1..kMaxPatchWidth
  std::vector<double> points;  // width scalars per point; point (i, j) is the (j u_count + i)-th

  // First fault and its place (uDegree, vDegree, width, uVertexCount, vVertexCount,
  // points).
  Result<void> check(const Budget& budget = {}) const;
};

enum class PatchFaces { none, triangles, quads };

struct PatchOptions {
  Index level = 2;        // 0..kMaxPatchLevel
  bool limit = false;     // fill limit_points
  bool tangents = false;  // fill du and dv
  bool normals = false;   // fill normals; points of width 3 only
  PatchFaces faces = PatchFaces::none;
};

template <class Real>
struct RefinedPatch {
  std::string name;
  Index level = 0, width = 3;
  Index u_count = 0, v_count = 0;
  CurveWrap u_wrap = CurveWrap::pinned, v_wrap = CurveWrap::pinned;
  Buffer<Real> points;  // width per point, u fastest
  // On request, per point. In a nonperiodic direction the surface does not reach the first and the last row:
  // those are their own limit along that direction, with the one-sided difference as tangent, as on curves.
  // Tangents are derivatives by the parameters of the *control* grid: they do not shrink with the level.
  Buffer<Real> limit_points, du, dv;
  // Unit vectors along du x dv, 3 per point; (0, 0, 0) where du and dv have no product that rounding could
  // not have made.
  Buffer<Real> normals;
  // corners_per_face numbers of points per face (4 or 3; 0 without faces), counter-clockwise seen from where
  // du x dv points to. The quad at (i, j) is (i, j), (i+1, j), (i+1, j+1), (i, j+1), the i fastest; its two
  // triangles are its corners 0 1 2 and 0 2 3. Periodic directions close.
  Buffer<Index> faces;
  Index corners_per_face = 0;
};

// Points along a direction of n points after `level` steps, by the table above. n at least as there, below
// 2^32; level at most kMaxPatchLevel.
Count refined_grid_count(CurveWrap wrap, Index degree, Count n, Index level);

// Parameter of the point `index` along a direction of n points refined to `level`: what evaluate() takes to
// arrive at its limit point. The first and last point of a nonperiodic direction get one outside the domain.
double patch_parameter(CurveWrap wrap, Index degree, Count n, Index level, Count index);

// Bytes of all arrays of RefinedPatch<Real>; refuses levels over the maximum (out_of_range), normals of
// points that are not of width 3 (unsupported) and more points than 32 bits number (too_large).
template <class Real>
Result<Count> predict_bytes(const ControlPatch& patch, const PatchOptions& options);

// The grid after `level` steps. `patch` must have passed check(). Fails for sizes (as predict_bytes, and
// too_large against budget.max_bytes), when the budget says stop, and with out_of_range when a number
// does not fit into Real: no NaN or infinity is ever returned. Beyond the answer it holds the level below, a
// quarter of the points. Depends on the arguments alone, to the bit.
template <class Real>
Result<RefinedPatch<Real>> refine(const ControlPatch& patch, const PatchOptions& options,
                                  const Budget& budget);

// A point of the surface and its derivatives by u and v, width scalars each.
template <class Real>
struct PatchSample {
  std::vector<Real> point, du, dv, duu, duv, dvv;
  std::array<Real, 3> normal{0, 0, 0};  // as RefinedPatch::normals; 0 for other widths than 3
};

// The surface at (u, v) in closed form, from the 9 to 16 control points that count there. Where second
// derivatives jump (at the knots of a quadratic direction) they are those of the piece behind, at the
// domain's end of the piece before. `patch` must have passed check(). Refuses parameters outside the domain
// (out_of_range) or not finite (not_finite), at {"u"} or {"v"}, and results that Real cannot hold.
template <class Real>
Result<PatchSample<Real>> evaluate(const ControlPatch& patch, double u, double v);

}  // namespace subdivd
