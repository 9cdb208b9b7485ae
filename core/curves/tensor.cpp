#include "core/curves/tensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/curves/precision.h"

namespace subdivd {
namespace {

constexpr Count kPollInterval = 4096;  // scalars between two looks at the budget

// Counts work and polls the budget now and then.
class Pacer {
 public:
  explicit Pacer(const Budget& budget) : budget_(budget) {}

  std::optional<Error> spend(Count scalars) {
    spent_ += scalars;
    if (spent_ < kPollInterval) return std::nullopt;
    spent_ = 0;
    return budget_.poll();
  }

 private:
  const Budget& budget_;
  Count spent_ = kPollInterval;  // the first call polls: a dead caller costs nothing
};

// One of the two directions of a grid: n points, one after the other.
struct Direction {
  CurveWrap wrap;
  Index degree;
  Count n;

  bool open() const { return wrap != CurveWrap::periodic; }
  bool ends_at(Count i) const { return open() && (i == 0 || i + 1 == n); }
  bool pinned_quadratic() const { return wrap == CurveWrap::pinned && degree == 2; }
  Count before(Count i) const { return i == 0 ? n - 1 : i - 1; }
  Count after(Count i) const { return i + 1 == n ? 0 : i + 1; }
  Count segments() const { return open() ? n - 1 : n; }
};

Direction u_of(const ControlPatch& patch) { return {patch.u_wrap, patch.u_degree, patch.u_count}; }
Direction v_of(const ControlPatch& patch) { return {patch.v_wrap, patch.v_degree, patch.v_count}; }

Direction refined(Direction d, Index level) {
  return {d.wrap, d.degree, refined_grid_count(d.wrap, d.degree, d.n, level)};
}

// --- The door ---------------------------------------------------------------------------------------------

Index fewest_points(CurveWrap wrap, Index degree) {
  if (degree == 2 || wrap == CurveWrap::periodic) return 3;
  return wrap == CurveWrap::pinned ? 2 : 4;
}

Result<void> check_direction(Direction d, const std::string& letter) {
  if (d.degree != 2 && d.degree != 3)
    return Error{ErrorCode::out_of_range,
                 "the degree of a surface is 2 or 3 in each direction, not " + std::to_string(d.degree),
                 {letter + "Degree"},
                 0,
                 0};
  const Index needed = fewest_points(d.wrap, d.degree);
  if (d.n < needed)
    return Error{ErrorCode::too_few_points,
                 "direction " + letter + " needs at least " + std::to_string(needed) +
                     " points for its degree and wrap; it has " + std::to_string(d.n),
                 {letter + "Count"},
                 0,
                 0};
  return {};
}

// --- Rules along one direction ----------------------------------------------------------------------------

// A new value as a sum of three old ones. Ends before the middle, so that equal values give exactly
// themselves; a weight of 0 stands at an index that exists.
struct Taps {
  Count at[3];
  double weight[3];
};

Taps keep(Count i) { return {{i, i, i}, {0, 0, 1}}; }

// Point i of the next level: the rules of the header. Numbering:
//
//   cubic, pinned or periodic   [2j] = vertex point j      [2j+1] = edge point (j, j+1)
//   cubic, nonperiodic          [2j-1] = vertex point j    [2j]   = edge point (j, j+1)
//   quadratic, periodic         [2j], [2j+1] = a quarter of the way from point j to the one before, behind it
//   quadratic, open             the same less the first and the last one: [2j-1], [2j]
//
// Pinned quadratic: beside the border the phantom point 2 c_0 - c_1 makes (c_0 + c_1) / 2 of what would stand
// a quarter of the way from c_1 to it, and c_0 stays in the place of the point that has no part in the
// surface.
Taps step_taps(const Direction& d, Count i) {
  if (d.degree == 3) {
    const Count k = i + (d.wrap == CurveWrap::nonperiodic ? 1 : 0), j = k / 2;
    if (k % 2 == 1) return {{j, d.after(j), j}, {1.0 / 2, 1.0 / 2, 0}};
    if (d.ends_at(j)) return keep(j);
    return {{d.before(j), d.after(j), j}, {1.0 / 8, 1.0 / 8, 3.0 / 4}};
  }
  const Count k = i + (d.open() ? 1 : 0), near = k / 2;
  const Count far = k % 2 == 0 ? d.before(near) : d.after(near);
  if (d.wrap == CurveWrap::pinned) {
    if (d.ends_at(near)) return keep(near);
    if (d.ends_at(far)) return {{near, far, near}, {1.0 / 2, 1.0 / 2, 0}};
  }
  return {{near, far, near}, {3.0 / 4, 1.0 / 4, 0}};
}

// Limit of point i. At the ends of an open direction the point itself: of pinned ones the phantom point makes
// it so.   cubic (1, 4, 1) / 6   quadratic (1, 6, 1) / 8, and with the phantom point put in for d_{-1}, which
// is 2 c_0 - d_0, (2, 5, 1) / 8 beside a pinned border   [deBoor78]
Taps limit_taps(const Direction& d, Count i) {
  if (d.ends_at(i)) return keep(i);
  const Count before = d.before(i), after = d.after(i);
  if (d.degree == 3) return {{before, after, i}, {1.0 / 6, 1.0 / 6, 4.0 / 6}};
  const double b = d.pinned_quadratic() && d.ends_at(before) ? 2.0 / 8 : 1.0 / 8;
  const double a = d.pinned_quadratic() && d.ends_at(after) ? 2.0 / 8 : 1.0 / 8;
  return {{before, after, i}, {b, a, 1 - (b + a)}};
}

// Tangent at point i per unit of this level's parameter: (c_{i+1} - c_{i-1}) / 2; at the ends of an open
// direction the one-sided difference, over half a unit where a pinned quadratic border is no more away.
// Beside such a border (d_1 - (2 c_0 - d_0)) / 2.
Taps tangent_taps(const Direction& d, Count i) {
  if (d.ends_at(i)) {
    const Count inner = i == 0 ? 1 : i - 1;
    const double weight = (i == 0 ? 1 : -1) * (d.pinned_quadratic() ? 2.0 : 1.0);
    return {{inner, i, i}, {weight, -weight, 0}};
  }
  const Count before = d.before(i), after = d.after(i);
  const double b = d.pinned_quadratic() && d.ends_at(before) ? -1.0 : -1.0 / 2;
  const double a = d.pinned_quadratic() && d.ends_at(after) ? 1.0 : 1.0 / 2;
  return {{before, after, i}, {b, a, -(b + a)}};
}

// --- Grids ------------------------------------------------------------------------------------------------

template <class Real>
struct Grid {
  Direction u, v;
  Index width;
  Buffer<Real> points;

  Count row_size() const { return u.n * width; }
  const Real* row(Count j) const { return points.data() + j * row_size(); }
};

// Three rows of the grid into one: `taps` along v.
template <class Real>
std::optional<Error> combine_rows(const Grid<Real>& grid, const Taps& taps, Buffer<Real>& out, Pacer& pacer) {
  const Real* a = grid.row(taps.at[0]);
  const Real* b = grid.row(taps.at[1]);
  const Real* c = grid.row(taps.at[2]);
  const Real x = Real(taps.weight[0]), y = Real(taps.weight[1]), z = Real(taps.weight[2]);
  for (Count begin = 0; begin < grid.row_size(); begin += kPollInterval) {
    const Count end = std::min(begin + kPollInterval, grid.row_size());
    if (auto stop = pacer.spend(end - begin)) return stop;
    for (Count k = begin; k < end; ++k) out[k] = (a[k] * x + b[k] * y) + c[k] * z;
  }
  return std::nullopt;
}

// Three points of a row into one, times `scale`: `taps` along u.
template <class Real>
void combine_points(const Buffer<Real>& row, Index width, const Taps& taps, Real scale, Real* out) {
  const Real* a = &row[taps.at[0] * width];
  const Real* b = &row[taps.at[1] * width];
  const Real* c = &row[taps.at[2] * width];
  const Real x = Real(taps.weight[0]), y = Real(taps.weight[1]), z = Real(taps.weight[2]);
  for (Index k = 0; k < width; ++k) out[k] = ((a[k] * x + b[k] * y) + c[k] * z) * scale;
}

// One step. Rows first, a new row at a time: no grid is ever half refined.
template <class Real>
std::optional<Error> subdivide(const Grid<Real>& from, Grid<Real>& to, Pacer& pacer) {
  to.points.resize(to.row_size() * to.v.n);
  Buffer<Real> row(from.row_size());
  for (Count j = 0; j < to.v.n; ++j) {
    if (auto stop = combine_rows(from, step_taps(from.v, j), row, pacer)) return stop;
    Real* out = &to.points[j * to.row_size()];
    for (Count i = 0; i < to.u.n; ++i) {
      if (auto stop = pacer.spend(to.width)) return stop;
      combine_points(row, to.width, step_taps(from.u, i), Real(1), out + i * to.width);
    }
  }
  return std::nullopt;
}

// --- Frames -----------------------------------------------------------------------------------------------

// (du x dv) / |du x dv|, or 0 where rounding alone could have made that product. A component of a tangent is
// off by no more than some units in the last place of the coordinates it is the difference of, and those are
// no larger than the point's and what the tangents lead to; `scale` parameters of the refined grid make one
// of the control grid, and multiply what is lost with them.
std::array<double, 3> normal_of(const std::array<double, 3>& at, const std::array<double, 3>& du,
                                const std::array<double, 3>& dv, double scale, double epsilon) {
  auto largest = [](const std::array<double, 3>& a) {
    return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  };
  const double u_size = largest(du), v_size = largest(dv);
  if (u_size == 0 || v_size == 0) return {0, 0, 0};
  std::array<double, 3> u, v, u_error, v_error, n;
  for (std::size_t k = 0; k < 3; ++k) {  // both of size 1: products neither overflow nor vanish
    u[k] = du[k] / u_size, v[k] = dv[k] / v_size;
    u_error[k] =
        16 * epsilon * (std::abs(at[k]) / u_size * scale + std::abs(u[k]) + std::abs(dv[k]) / u_size);
    v_error[k] =
        16 * epsilon * (std::abs(at[k]) / v_size * scale + std::abs(v[k]) + std::abs(du[k]) / v_size);
  }
  bool sound = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    n[k] = u[a] * v[b] - u[b] * v[a];
    const double error = std::abs(u[a]) * v_error[b] + u_error[a] * std::abs(v[b]) +
                         std::abs(u[b]) * v_error[a] + u_error[b] * std::abs(v[a]);
    if (std::abs(n[k]) > error) sound = true;
  }
  if (!sound) return {0, 0, 0};
  const double size = largest(n);
  for (double& x : n) x /= size;
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  return {n[0] / length, n[1] / length, n[2] / length};
}

template <class Real>
std::array<Real, 3> normal_of(const Real* at, const Real* du, const Real* dv, Index level) {
  const auto n =
      normal_of({double(at[0]), double(at[1]), double(at[2])}, {double(du[0]), double(du[1]), double(du[2])},
                {double(dv[0]), double(dv[1]), double(dv[2])}, static_cast<double>(Count{1} << level),
                std::numeric_limits<Real>::epsilon());
  return {static_cast<Real>(n[0]), static_cast<Real>(n[1]), static_cast<Real>(n[2])};
}

// Limit points, tangents and normals, what is asked for of them.
template <class Real>
std::optional<Error> append_frames(const Grid<Real>& grid, const PatchOptions& options,
                                   RefinedPatch<Real>& out, Pacer& pacer) {
  const Index width = grid.width;
  const Count points = grid.u.n * grid.v.n;
  const Real scale = static_cast<Real>(Count{1} << options.level);
  if (options.limit) out.limit_points.resize(points * width);
  if (options.tangents) out.du.resize(points * width), out.dv.resize(points * width);
  if (options.normals) out.normals.resize(points * 3);
  Buffer<Real> limits(grid.row_size()), slopes(grid.row_size());  // along v
  std::array<Real, kMaxPatchWidth> point, du, dv;
  for (Count j = 0; j < grid.v.n; ++j) {
    if (auto stop = combine_rows(grid, limit_taps(grid.v, j), limits, pacer)) return stop;
    if (auto stop = combine_rows(grid, tangent_taps(grid.v, j), slopes, pacer)) return stop;
    for (Count i = 0; i < grid.u.n; ++i) {
      if (auto stop = pacer.spend(width)) return stop;
      const Taps limit = limit_taps(grid.u, i);
      combine_points(limits, width, limit, Real(1), point.data());
      combine_points(limits, width, tangent_taps(grid.u, i), scale, du.data());
      combine_points(slopes, width, limit, scale, dv.data());
      const Count at = j * grid.u.n + i;
      if (options.limit) std::copy_n(point.data(), width, &out.limit_points[at * width]);
      if (options.tangents) std::copy_n(du.data(), width, &out.du[at * width]);
      if (options.tangents) std::copy_n(dv.data(), width, &out.dv[at * width]);
      if (!options.normals) continue;
      const auto normal = normal_of<Real>(point.data(), du.data(), dv.data(), options.level);
      std::copy_n(normal.data(), 3, &out.normals[at * 3]);
    }
  }
  return std::nullopt;
}

// --- Faces ------------------------------------------------------------------------------------------------

Index corners_of(PatchFaces faces) {
  return faces == PatchFaces::quads ? 4 : faces == PatchFaces::triangles ? 3 : 0;
}

Count corner_count(Direction u, Direction v, PatchFaces faces) {
  const Count per_quad = faces == PatchFaces::quads ? 4 : faces == PatchFaces::triangles ? 6 : 0;
  return u.segments() * v.segments() * per_quad;
}

std::optional<Error> append_faces(Direction u, Direction v, PatchFaces faces, Buffer<Index>& out,
                                  Pacer& pacer) {
  out.resize(corner_count(u, v, faces));
  Index* to = out.data();
  for (Count j = 0; j < v.segments(); ++j) {
    const Count row = j * u.n, next = v.after(j) * u.n;
    for (Count i = 0; i < u.segments(); ++i) {
      if (auto stop = pacer.spend(4)) return stop;
      const Index a = static_cast<Index>(row + i), b = static_cast<Index>(row + u.after(i));
      const Index c = static_cast<Index>(next + u.after(i)), d = static_cast<Index>(next + i);
      if (faces == PatchFaces::quads)
        for (const Index corner : {a, b, c, d}) *to++ = corner;
      else
        for (const Index corner : {a, b, c, a, c, d}) *to++ = corner;
    }
  }
  return std::nullopt;
}

// --- Everything together ----------------------------------------------------------------------------------

template <class Real>
Result<void> check_finite(const Buffer<Real>& values, Pacer& pacer) {
  for (Count begin = 0; begin < values.size(); begin += kPollInterval) {
    const Count end = std::min<Count>(begin + kPollInterval, values.size());
    if (auto stop = pacer.spend(end - begin)) return *stop;
    for (Count k = begin; k < end; ++k)
      if (!std::isfinite(values[k])) return does_not_fit();
  }
  return {};
}

template <class Real>
Result<Grid<Real>> grid_of(const ControlPatch& patch, Pacer& pacer) {
  Grid<Real> grid{u_of(patch), v_of(patch), patch.width, Buffer<Real>(patch.points.size())};
  for (Count k = 0; k < patch.points.size(); ++k) {
    if (auto stop = pacer.spend(1)) return *stop;
    if (std::abs(patch.points[k]) > static_cast<double>(std::numeric_limits<Real>::max()))
      return does_not_fit();
    grid.points[k] = static_cast<Real>(patch.points[k]);
  }
  return grid;
}

Result<Count> total_points(const ControlPatch& patch, Index level) {
  if (level > kMaxPatchLevel)
    return Error{ErrorCode::out_of_range,
                 "level " + std::to_string(level) + " is over the maximum of " +
                     std::to_string(kMaxPatchLevel) + " for surfaces",
                 {},
                 level,
                 kMaxPatchLevel};
  // Either factor is below 2^32 2^15, so one that is over 2^32 is noticed before their product wraps.
  const Count u = refined(u_of(patch), level).n, v = refined(v_of(patch), level).n;
  if (u > kMaxIndexCount || v > kMaxIndexCount || u * v > kMaxIndexCount)
    return Error{ErrorCode::too_large,
                 "the refined surface would have more points than 32-bit indices can number: choose a lower "
                 "level",
                 {},
                 u > kMaxIndexCount || v > kMaxIndexCount ? std::max(u, v) : u * v,
                 kMaxIndexCount};
  return u * v;
}

}  // namespace

Result<void> ControlPatch::check() const {
  if (width < 1 || width > kMaxPatchWidth)
    return Error{ErrorCode::out_of_range,
                 "points have " + std::to_string(width) + " components each; 1 to " +
                     std::to_string(kMaxPatchWidth) + " are allowed",
                 {"width"},
                 0,
                 0};
  if (auto u = check_direction(u_of(*this), "u"); !u) return u;
  if (auto v = check_direction(v_of(*this), "v"); !v) return v;
  const Count count = Count{u_count} * v_count;
  if (count > kMaxIndexCount)
    return Error{ErrorCode::too_large,
                 "there are more points than 32-bit indices can number",
                 {"points"},
                 count,
                 kMaxIndexCount};
  if (points.size() != count * width)
    return Error{ErrorCode::wrong_length,
                 std::to_string(u_count) + " by " + std::to_string(v_count) + " points of " +
                     std::to_string(width) + " components are " + std::to_string(count * width) +
                     " numbers; there are " + std::to_string(points.size()),
                 {"points"},
                 0,
                 0};
  for (Count k = 0; k < points.size(); ++k)
    if (!std::isfinite(points[k]))
      return Error{ErrorCode::not_finite,
                   "component " + std::to_string(k % width) + " of point " + std::to_string(k / width) +
                       " is not a finite number",
                   {"points", k},
                   0,
                   0};
  return {};
}

Count refined_grid_count(CurveWrap wrap, Index degree, Count n, Index level) {
  const Count steps = Count{1} << level;
  if (wrap == CurveWrap::periodic) return n * steps;
  // Every step doubles the segments of the surface; the points beyond them stay: one at the end of a pinned
  // cubic, one more at each end of the others than a segment has.
  const Count beyond = degree == 2 ? 2 : wrap == CurveWrap::pinned ? 1 : 3;
  return (n - beyond) * steps + beyond;
}

// Level by level parameters are stretched about the one that keeps its number: of cubics i' = 2 i, or 2 i - 1
// where the first vertex point is left out; of quadratics, children being i -+ 1/4, i' = 2 t + 1/2, or
// 2 t - 1/2 where the first child is left out.
double patch_parameter(CurveWrap wrap, Index degree, Count n, Index level, Count index) {
  const double i = static_cast<double>(index);
  auto refined = [&](double steps) { return std::ldexp(steps, -static_cast<int>(level)); };
  if (wrap == CurveWrap::pinned && degree == 2) {
    if (index == 0) return 0;
    if (index + 1 == refined_grid_count(wrap, degree, n, level)) return static_cast<double>(n) - 2;
    return refined(i - 0.5);
  }
  const bool periodic = wrap == CurveWrap::periodic;
  const double fixed = degree == 2 ? (periodic ? -0.5 : 0.5) : wrap == CurveWrap::nonperiodic ? 1 : 0;
  return fixed + refined(i - fixed);
}

template <class Real>
Result<Count> predict_bytes(const ControlPatch& patch, const PatchOptions& options) {
  const Result<Count> points = total_points(patch, options.level);
  if (!points) return points;
  if (options.normals && patch.width != 3)
    return Error{ErrorCode::unsupported,
                 "normals exist for points of 3 components only; these have " + std::to_string(patch.width),
                 {"normals"},
                 0,
                 0};
  const Count arrays = 1 + (options.limit ? 1 : 0) + (options.tangents ? 2 : 0);
  const Count scalars = patch.width * arrays + (options.normals ? 3 : 0);
  // At most 2^32 points of 2^7 scalars and 2^5 bytes of corners: no overflow.
  return *points * scalars * sizeof(Real) + corner_count(refined(u_of(patch), options.level),
                                                         refined(v_of(patch), options.level), options.faces) *
                                                sizeof(Index);
}

template <class Real>
Result<RefinedPatch<Real>> refine(const ControlPatch& patch, const PatchOptions& options,
                                  const Budget& budget) {
  const Result<Count> bytes = predict_bytes<Real>(patch, options);
  if (!bytes) return bytes.error();
  if (auto allowed = budget.check_bytes(*bytes); !allowed) return allowed.error();
  Pacer pacer(budget);
  Result<Grid<Real>> start = grid_of<Real>(patch, pacer);
  if (!start) return start.error();
  Grid<Real> grid = std::move(*start);
  for (Index l = 0; l < options.level; ++l) {
    Grid<Real> next{refined(grid.u, 1), refined(grid.v, 1), grid.width, {}};
    if (auto stop = subdivide(grid, next, pacer)) return *stop;
    grid = std::move(next);
  }

  RefinedPatch<Real> out;
  out.name = patch.name;
  out.level = options.level;
  out.width = patch.width;
  out.u_count = static_cast<Index>(grid.u.n);
  out.v_count = static_cast<Index>(grid.v.n);
  out.u_wrap = patch.u_wrap;
  out.v_wrap = patch.v_wrap;
  out.corners_per_face = corners_of(options.faces);
  if (options.limit || options.tangents || options.normals)
    if (auto stop = append_frames(grid, options, out, pacer)) return *stop;
  if (options.faces != PatchFaces::none)
    if (auto stop = append_faces(grid.u, grid.v, options.faces, out.faces, pacer)) return *stop;
  out.points = std::move(grid.points);
  for (const Buffer<Real>* values : {&out.points, &out.limit_points, &out.du, &out.dv, &out.normals})
    if (auto finite = check_finite(*values, pacer); !finite) return finite.error();
  return out;
}

template Result<Count> predict_bytes<float>(const ControlPatch&, const PatchOptions&);
template Result<Count> predict_bytes<double>(const ControlPatch&, const PatchOptions&);
template Result<RefinedPatch<float>> refine<float>(const ControlPatch&, const PatchOptions&, const Budget&);
template Result<RefinedPatch<double>> refine<double>(const ControlPatch&, const PatchOptions&, const Budget&);

// --- Evaluation -------------------------------------------------------------------------------------------

namespace {

// Weights of up to four consecutive points, of their first and second derivatives, and where the points are.
struct Basis {
  std::array<double, 4> value, slope, bend;
  std::array<Count, 4> at;
};

Basis reversed(Basis b) {
  std::reverse(b.value.begin(), b.value.end());
  std::reverse(b.slope.begin(), b.slope.end());
  std::reverse(b.bend.begin(), b.bend.end());
  for (double& slope : b.slope) slope = -slope;
  return b;
}

// Cubic, 0 <= s <= 1 from c_i to c_{i+1}:  ( (1-s)^3, 3s^3 - 6s^2 + 4, -3s^3 + 3s^2 + 3s + 1, s^3 ) / 6
// and on the first span of a pinned direction, c_{-1} = 2 c_0 - c_1 put in,
//                                          ( 0, s^3 - 6s + 6, 6s - 2s^3, s^3 ) / 6     [deBoor78, chapter IX]
Basis cubic_inside(double s) {
  const double w = 1 - s;
  return {{w * w * w / 6, ((3 * s - 6) * s * s + 4) / 6, ((3 * w - 6) * w * w + 4) / 6, s * s * s / 6},
          {-w * w / 2, (3 * s - 4) * s / 2, -(3 * w - 4) * w / 2, s * s / 2},
          {w, 3 * s - 2, 3 * w - 2, s},
          {}};
}
Basis cubic_at_begin(double s) {
  const double cube = s * s * s, square = s * s;
  return {{0, 1 - s + cube / 6, s - cube / 3, cube / 6},
          {0, square / 2 - 1, 1 - square, square / 2},
          {0, s, -2 * s, s},
          {}};
}
Basis line(double s) { return {{0, 1 - s, s, 0}, {0, -1, 1, 0}, {0, 0, 0, 0}, {}}; }

// Quadratic, 0 <= s <= 1 from half a unit before c_i to half a unit behind it:
//   ( (1-s)^2, 1 + 2s - 2s^2, s^2 ) / 2                  for c_{i-1}, c_i, c_{i+1}
//   ( 2 (1-s)^2, 4s - 3s^2, s^2 ) / 2                    beside a pinned border: 2 c_0 - c_1 put in
//   ( (1-s)^2, 2 s (1-s), s^2 )                          between two of them, which is Bezier's
// The fourth weight is 0.
Basis quadratic_inside(double s) {
  const double w = 1 - s;
  return {{w * w / 2, 0.5 + s * w, s * s / 2, 0}, {-w, w - s, s, 0}, {1, -2, 1, 0}, {}};
}
Basis quadratic_at_begin(double s) {
  const double w = 1 - s;
  return {{w * w, (2 - 1.5 * s) * s, s * s / 2, 0}, {-2 * w, 2 - 3 * s, s, 0}, {2, -3, 1, 0}, {}};
}
Basis quadratic_at_end(double s) {
  Basis b = reversed(quadratic_at_begin(1 - s));  // its weight of 0 came to the front
  for (std::array<double, 4>* row : {&b.value, &b.slope, &b.bend})
    std::rotate(row->begin(), row->begin() + 1, row->end());
  return b;
}
Basis quadratic_between(double s) {
  const double w = 1 - s;
  return {{w * w, 2 * s * w, s * s, 0}, {-2 * w, 2 - 4 * s, 2 * s, 0}, {2, -4, 2, 0}, {}};
}

// t by the period n; exact for every finite t, and below n even when t is a hair under 0.
double wrapped(double t, Count n) {
  const double period = static_cast<double>(n);
  double rest = std::fmod(t, period);
  if (rest < 0) rest += period;
  return rest < period ? rest : 0;
}

Result<double> parameter_of(const Direction& d, double t, const char* name) {
  if (!std::isfinite(t))
    return Error{ErrorCode::not_finite,
                 std::string("the parameter ") + name + " is not a finite number",
                 {name},
                 0,
                 0};
  if (!d.open()) return wrapped(t, d.n);
  const double low = d.wrap == CurveWrap::pinned ? 0 : d.degree == 2 ? 0.5 : 1;
  const double high = static_cast<double>(d.n) - (d.pinned_quadratic() ? 2 : 1 + low);
  if (t >= low && t <= high) return t;
  return Error{ErrorCode::out_of_range,
               std::string("the parameter ") + name + " = " + std::to_string(t) +
                   " lies outside the surface's domain, " + std::to_string(low) + " to " +
                   std::to_string(high),
               {name},
               0,
               0};
}

Basis cubic_basis(const Direction& d, double t) {
  const Count last_span = d.open() ? d.n - (d.wrap == CurveWrap::pinned ? 2 : 3) : d.n - 1;
  const Count span = std::min(static_cast<Count>(t), last_span);
  const double s = t - static_cast<double>(span);
  const bool pinned = d.wrap == CurveWrap::pinned;
  const bool first = pinned && span == 0, last = pinned && span == last_span;
  Basis b = first && last ? line(s)
            : first       ? cubic_at_begin(s)
            : last        ? reversed(cubic_at_begin(1 - s))
                          : cubic_inside(s);
  // A neighbour that an open direction lacks has weight 0: any other stands for it.
  b.at = {d.before(span), span, d.after(span), d.after(d.after(span))};
  return b;
}

Basis quadratic_basis(const Direction& d, double t) {
  const double x = d.wrap == CurveWrap::pinned ? t + 1 : t + 0.5;  // span i begins at x = i
  Count i = static_cast<Count>(x);
  if (d.open()) i = std::min(i, d.n - 2);
  const double s = x - static_cast<double>(i);
  if (i == d.n) i = 0;
  const bool first = d.wrap == CurveWrap::pinned && i == 1,
             last = d.wrap == CurveWrap::pinned && i + 2 == d.n;
  Basis b = first && last ? quadratic_between(s)
            : first       ? quadratic_at_begin(s)
            : last        ? quadratic_at_end(s)
                          : quadratic_inside(s);
  b.at = {d.before(i), i, d.after(i), i};
  return b;
}

Basis basis_at(const Direction& d, double t) {
  return d.degree == 2 ? quadratic_basis(d, t) : cubic_basis(d, t);
}

// Component k of the point and of the five derivatives, in the order of PatchSample.
std::array<double, 6> component(const ControlPatch& patch, const Basis& u, const Basis& v, Index k) {
  std::array<double, 6> sum{};
  for (std::size_t b = 0; b < 4; ++b) {
    double value = 0, slope = 0, bend = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      const double c = patch.points[(v.at[b] * patch.u_count + u.at[a]) * patch.width + k];
      value += u.value[a] * c, slope += u.slope[a] * c, bend += u.bend[a] * c;
    }
    sum[0] += v.value[b] * value, sum[1] += v.value[b] * slope, sum[2] += v.slope[b] * value;
    sum[3] += v.value[b] * bend, sum[4] += v.slope[b] * slope, sum[5] += v.bend[b] * value;
  }
  return sum;
}

}  // namespace

template <class Real>
Result<PatchSample<Real>> evaluate(const ControlPatch& patch, double u, double v) {
  const Direction across = u_of(patch), along = v_of(patch);
  const Result<double> s = parameter_of(across, u, "u"), t = parameter_of(along, v, "v");
  if (!s) return s.error();
  if (!t) return t.error();
  const Basis u_basis = basis_at(across, *s), v_basis = basis_at(along, *t);
  PatchSample<Real> sample;
  const std::array<std::vector<Real>*, 6> rows = {&sample.point, &sample.du,  &sample.dv,
                                                  &sample.duu,   &sample.duv, &sample.dvv};
  for (auto* row : rows) row->resize(patch.width);
  for (Index k = 0; k < patch.width; ++k) {
    const std::array<double, 6> sums = component(patch, u_basis, v_basis, k);
    for (std::size_t r = 0; r < 6; ++r) {
      // The sum is looked at before it is made narrower: a double too large for Real must not be converted.
      if (!(std::abs(sums[r]) <= static_cast<double>(std::numeric_limits<Real>::max())))
        return does_not_fit();
      (*rows[r])[k] = static_cast<Real>(sums[r]);
    }
  }
  if (patch.width == 3)
    sample.normal = normal_of<Real>(sample.point.data(), sample.du.data(), sample.dv.data(), 0);
  return sample;
}

template Result<PatchSample<float>> evaluate<float>(const ControlPatch&, double, double);
template Result<PatchSample<double>> evaluate<double>(const ControlPatch&, double, double);

}  // namespace subdivd
