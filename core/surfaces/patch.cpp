#include "core/surfaces/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/surfaces/patch_rows.h"
#include "core/surfaces/patch_rules.h"

namespace subdivd {
namespace {

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
                 {letter + "Degree"}};
  const Index needed = fewest_points(d.wrap, d.degree);
  if (d.n < needed)
    return Error{ErrorCode::too_few_points,
                 "direction " + letter + " needs at least " + std::to_string(needed) +
                     " points for its degree and wrap; it has " + std::to_string(d.n),
                 {letter + "VertexCount"}};
  return {};
}

// --- Grids ------------------------------------------------------------------------------------------------

template <class Real>
struct Grid {
  Direction u, v;
  Index width;
  Buffer<Real> points;

  Count row_size() const { return u.n * width; }
};

// One step. Rows first, a new row at a time: no grid is ever half refined.
template <class Real>
void subdivide(const Grid<Real>& from, Grid<Real>& to, const Pace& pace) {
  to.points.resize(to.row_size() * to.v.n);
  Buffer<Real> row(from.row_size());
  for (Count j = 0; j < to.v.n; ++j) {
    combine_rows(from.points.data(), from.row_size(), step_taps(from.v, j), row.data(), pace);
    split_row(from.u, row.data(), to.width, &to.points[j * to.row_size()], pace);
  }
}

// --- Frames -----------------------------------------------------------------------------------------------

// What is known of one row, in the answer where it is asked for and in scratch rows where it is not.
template <class Real>
struct FrameRow {
  Real *point, *du, *dv;
};

template <class Real>
Result<void> append_normals(const FrameRow<Real>& row, Count count, Index level, Real* normals,
                            const Pace& pace) {
  // Tangents that nobody sees must exist as well: without them there would be a normal of no meaning.
  for (const Real* tangents : {row.du, row.dv})
    if (auto finite = check_finite(std::span(tangents, 3 * count), pace); !finite) return finite;
  for (Count i = 0; i < count; ++i) {
    pace.spend(3);
    const auto normal = normal_of<Real>(row.point + 3 * i, row.du + 3 * i, row.dv + 3 * i, level);
    std::copy_n(normal.data(), 3, normals + 3 * i);
  }
  return {};
}

// Limit points, tangents and normals, what is asked for of them.
template <class Real>
Result<void> append_frames(const Grid<Real>& grid, const PatchOptions& options, RefinedPatch<Real>& out,
                           const Pace& pace) {
  const Index width = grid.width;
  const Count points = grid.u.n * grid.v.n, size = grid.row_size();
  const Real scale = static_cast<Real>(Count{1} << options.level);
  const bool tangents = options.tangents || options.normals;
  if (options.limit) out.limit_points.resize(points * width);
  if (options.tangents) out.du.resize(points * width), out.dv.resize(points * width);
  if (options.normals) out.normals.resize(points * 3);
  Buffer<Real> limits(size), slopes(tangents ? size : 0);  // along v
  Buffer<Real> point(options.limit ? 0 : size), du(options.tangents ? 0 : slopes.size()), dv(du.size());
  for (Count j = 0; j < grid.v.n; ++j) {
    const FrameRow<Real> row = {options.limit ? &out.limit_points[j * size] : point.data(),
                                options.tangents ? &out.du[j * size] : du.data(),
                                options.tangents ? &out.dv[j * size] : dv.data()};
    const auto across = [&](const Taps& taps, Buffer<Real>& to) {
      combine_rows(grid.points.data(), size, taps, to.data(), pace);
    };
    const auto along = [&](const Buffer<Real>& from, RowRule rule, Real factor, Real* to) {
      combine_along(grid.u, from.data(), width, rule, factor, to, pace);
    };
    across(limit_taps(grid.v, j), limits);
    along(limits, limit_taps, Real(1), row.point);
    if (!tangents) continue;
    across(tangent_taps(grid.v, j), slopes);
    along(limits, tangent_taps, scale, row.du);
    along(slopes, limit_taps, scale, row.dv);
    if (!options.normals) continue;
    Real* normals = &out.normals[j * grid.u.n * 3];
    if (auto done = append_normals(row, grid.u.n, options.level, normals, pace); !done) return done;
  }
  return {};
}

// --- Faces ------------------------------------------------------------------------------------------------

Index corners_of(PatchFaces faces) {
  return faces == PatchFaces::quads ? 4 : faces == PatchFaces::triangles ? 3 : 0;
}

Count corner_count(Direction u, Direction v, PatchFaces faces) {
  const Count per_quad = faces == PatchFaces::quads ? 4 : faces == PatchFaces::triangles ? 6 : 0;
  return u.segments() * v.segments() * per_quad;
}

template <PatchFaces kFaces>
Index* add_quad(Index a, Index b, Index c, Index d, Index* to) {
  if constexpr (kFaces == PatchFaces::quads)
    to[0] = a, to[1] = b, to[2] = c, to[3] = d;
  else
    to[0] = a, to[1] = b, to[2] = c, to[3] = a, to[4] = c, to[5] = d;
  return to + (kFaces == PatchFaces::quads ? 4 : 6);
}

template <PatchFaces kFaces>
void append_quads(Direction u, Direction v, Index* to, const Pace& pace) {
  const Count last = u.n - 1;
  for (Count j = 0; j < v.segments(); ++j) {
    const Index row = static_cast<Index>(j * u.n), next = static_cast<Index>(v.after(j) * u.n);
    for (Count begin = 0; begin < last; begin += Pace::kBlock) {
      const auto end = static_cast<Index>(std::min(begin + Pace::kBlock, last));
      pace.spend(4 * (end - begin));
      for (auto i = static_cast<Index>(begin); i < end; ++i)
        to = add_quad<kFaces>(row + i, row + i + 1, next + i + 1, next + i, to);
    }
    const auto close = static_cast<Index>(last);
    if (!u.open()) to = add_quad<kFaces>(row + close, row, next, next + close, to);
  }
}

void append_faces(Direction u, Direction v, PatchFaces faces, Buffer<Index>& out, const Pace& pace) {
  out.resize(corner_count(u, v, faces));
  if (faces == PatchFaces::quads) return append_quads<PatchFaces::quads>(u, v, out.data(), pace);
  append_quads<PatchFaces::triangles>(u, v, out.data(), pace);
}

// --- Everything together ----------------------------------------------------------------------------------

template <class Real>
Result<Grid<Real>> grid_of(const ControlPatch& patch, const Pace& pace) {
  Grid<Real> grid{u_of(patch), v_of(patch), patch.width, Buffer<Real>(patch.points.size())};
  for (Count begin = 0; begin < patch.points.size(); begin += Pace::kBlock) {
    const Count count = std::min<Count>(Pace::kBlock, patch.points.size() - begin);
    pace.spend(count);
    const std::span<const double> from = std::span(patch.points).subspan(begin, count);
    for (const double x : from)
      if (!(std::abs(x) <= static_cast<double>(std::numeric_limits<Real>::max()))) return does_not_fit();
    for (Count k = 0; k < count; ++k) grid.points[begin + k] = static_cast<Real>(from[k]);
  }
  return grid;
}

Result<Count> total_points(const ControlPatch& patch, Index level) {
  if (level > kMaxPatchLevel)
    return Error{.code = ErrorCode::out_of_range,
                 .message = "level " + std::to_string(level) + " is over the maximum of " +
                            std::to_string(kMaxPatchLevel) + " for surfaces",
                 .predicted = level,
                 .allowed = kMaxPatchLevel};
  // Either factor is below 2^32 2^15, so one that is over 2^32 is noticed before their product wraps.
  const Count u = refined(u_of(patch), level).n, v = refined(v_of(patch), level).n;
  if (u > kMaxIndexCount || v > kMaxIndexCount || u * v > kMaxIndexCount)
    return Error{
        .code = ErrorCode::too_large,
        .message =
            "the refined surface would have more points than 32-bit indices can number: choose a lower "
            "level",
        .predicted = u > kMaxIndexCount || v > kMaxIndexCount ? std::max(u, v) : u * v,
        .allowed = kMaxIndexCount};
  return u * v;
}

}  // namespace

Result<void> ControlPatch::check(const Budget& budget) const {
  if (width < 1 || width > kMaxPatchWidth)
    return Error{ErrorCode::out_of_range,
                 "points have " + std::to_string(width) + " components each; 1 to " +
                     std::to_string(kMaxPatchWidth) + " are allowed",
                 {"width"}};
  if (auto u = check_direction(u_of(*this), "u"); !u) return u;
  if (auto v = check_direction(v_of(*this), "v"); !v) return v;
  const Count count = Count{u_count} * v_count;
  if (count > kMaxIndexCount)
    return Error{.code = ErrorCode::too_large,
                 .message = "there are more points than 32-bit indices can number",
                 .where = {"points"},
                 .predicted = count,
                 .allowed = kMaxIndexCount};
  if (points.size() != count * width)
    return Error{ErrorCode::wrong_length,
                 std::to_string(u_count) + " by " + std::to_string(v_count) + " points of " +
                     std::to_string(width) + " components are " + std::to_string(count * width) +
                     " numbers; there are " + std::to_string(points.size()),
                 {"points"}};
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (Count k = 0; k < points.size(); ++k) {
      if (k % Pace::kBlock == 0) pace.spend(Pace::kBlock);
      if (!std::isfinite(points[k]))
        return Error{ErrorCode::not_finite,
                     "component " + std::to_string(k % width) + " of point " + std::to_string(k / width) +
                         " is not a finite number",
                     {"points", k}};
    }
    return {};
  });
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
                 {"normals"}};
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
  return stoppable(budget, [&](const Pace& pace) -> Result<RefinedPatch<Real>> {
    Result<Grid<Real>> start = grid_of<Real>(patch, pace);
    if (!start) return start.error();
    Grid<Real> grid = std::move(*start);
    for (Index l = 0; l < options.level; ++l) {
      Grid<Real> next{refined(grid.u, 1), refined(grid.v, 1), grid.width, {}};
      subdivide(grid, next, pace);
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
      if (auto done = append_frames(grid, options, out, pace); !done) return std::move(done).error();
    if (options.faces != PatchFaces::none) append_faces(grid.u, grid.v, options.faces, out.faces, pace);
    out.points = std::move(grid.points);
    for (const Buffer<Real>* values : {&out.points, &out.limit_points, &out.du, &out.dv, &out.normals})
      if (auto finite = check_finite(std::span<const Real>(*values), pace); !finite) return finite.error();
    return out;
  });
}

template Result<Count> predict_bytes<float>(const ControlPatch&, const PatchOptions&);
template Result<Count> predict_bytes<double>(const ControlPatch&, const PatchOptions&);
template Result<RefinedPatch<float>> refine<float>(const ControlPatch&, const PatchOptions&, const Budget&);
template Result<RefinedPatch<double>> refine<double>(const ControlPatch&, const PatchOptions&, const Budget&);

}  // namespace subdivd
