#include "core/oracle/far_curves.h"

#include <algorithm>

#include "core/base/pace.h"
#include "core/curves/subdivision.h"
#include "core/lattice/split.h"
#include "core/oracle/far.h"
#include "core/oracle/far_cost.h"

//     B0 --- B1 --- B2 --- B3        The border A0 A1 A2 … of a strip of triangles follows the curve's rules
//     | \    | \    | \    |         whatever the row B is. Ends of open curves are made sharp corners. The
//     |   \  |   \  |   \  |         points ride along as a primvar of any width. A ring of triangles
//     A0 --- A1 --- A2 --- A3        closes a periodic curve.

namespace subdivd::oracle {
namespace {

Index segments_of(const FarCurves& curves, std::size_t curve) {
  return curves.counts[curve] - (curves.closed ? 0 : 1);
}

void append_strip(const FarCurves& curves, std::size_t curve, Index first_point, ControlMesh& mesh,
                  const Pace& pace) {
  const Index n = curves.counts[curve];
  const Index a = 2 * first_point, b = a + n;
  for (Index s = 0; s < segments_of(curves, curve); ++s) {
    const Index t = (s + 1) % n;
    pace.spend(8 + 2 * curves.width);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(),
                                    {a + s, a + t, b + s, b + s, a + t, b + t});
  }
  if (!curves.closed) {
    mesh.corner_indices.insert(mesh.corner_indices.end(), {a, a + n - 1});
    mesh.corner_sharpnesses.insert(mesh.corner_sharpnesses.end(), 2, kInfiniteSharpness);
  }
  Primvar& carried = mesh.primvars[0];
  const auto begin = curves.points.begin() + std::ptrdiff_t{first_point} * curves.width;
  for (int row = 0; row < 2; ++row)
    carried.values.insert(carried.values.end(), begin, begin + std::ptrdiff_t{n} * curves.width);
}

ControlMesh strips(const FarCurves& curves, const Pace& pace) {
  ControlMesh mesh;
  mesh.points.resize(curves.points.size() / curves.width * 2 * 3);
  mesh.primvars.resize(1);
  mesh.face_vertex_indices.reserve(mesh.points.size());
  mesh.primvars[0].values.reserve(2 * curves.points.size());
  mesh.primvars[0].name = "curve";
  mesh.primvars[0].interpolation = Interpolation::vertex;
  mesh.primvars[0].element_size = curves.width;
  Index first = 0;
  for (std::size_t c = 0; c < curves.counts.size(); ++c) {
    append_strip(curves, c, first, mesh, pace);
    first += curves.counts[c];
  }
  return mesh;
}

}  // namespace

// The last step makes 8 triangles of every segment of the level before, 4 of every point that comes out.
Count far_curve_bytes(const ControlCurves& curves, Index level) {
  Count points = 0;
  for (Count c = 0; c < curves.curve_count(); ++c)
    points += refined_point_count(curves.wrap, curves.points_of_curve(c), level);
  return points * 4 * (400 + Count{2} * curves.width * sizeof(double));
}

Result<void> check_far_curves(const ControlCurves& curves, Index level, const Budget& budget) {
  if (auto fits = check_far_bytes(far_curve_bytes(curves, level), budget); !fits) return fits;
  FarLoad step;  // the strips of the level before
  for (Count c = 0; c < curves.curve_count(); ++c) {
    const Count points =
        refined_point_count(curves.wrap, curves.points_of_curve(c), level == 0 ? 0 : level - 1);
    step.points += 2 * points;
    step.edges += 4 * points;
    step.faces += 2 * points;
  }
  return check_far_time(step, std::min<Index>(1, level));
}

FarCurves far_control(const ControlCurves& curves) {
  FarCurves far{curves.wrap == CurveWrap::periodic, curves.width, {}, {}, {}};
  far.points.assign(curves.points.begin(), curves.points.end());
  for (Count c = 0; c < curves.curve_count(); ++c)
    far.counts.push_back(static_cast<Index>(curves.points_of_curve(c)));
  return far;
}

namespace {

template <class Real>
Result<FarCurves> refine_strips(const FarCurves& from, Index level, bool limit, const Budget& budget,
                                const Pace& pace) {
  RefineOptions options;
  options.level = level;
  options.limit = limit;
  const ControlMesh mesh = strips(from, pace);
  const auto far = far_refine<Real>(mesh, options, budget);
  if (!far) return far.error();

  FarCurves to{from.closed, from.width, {}, {}, {}};
  const Index n = static_cast<Index>(segments(level));
  // Per base face: the curve's first refined point, its refined points, and the segment's first one.
  struct Segment {
    Count first, count, begin;
  };
  std::vector<Segment> of_face;
  Count first = 0;
  for (std::size_t c = 0; c < from.counts.size(); ++c) {
    const Index segments_here = segments_of(from, c);
    const Index count = segments_here * n + (from.closed ? 0 : 1);
    to.counts.push_back(count);
    pace.spend(1 + 2 * segments_here);
    for (Index s = 0; s < segments_here; ++s) of_face.insert(of_face.end(), 2, {first, count, Count{s} * n});
    first += count;
  }
  const std::size_t width = from.width;
  to.points.assign(first * width, 0);
  if (limit) to.limits.assign(first * width, 0);
  for (std::size_t corner = 0; corner < far->faces.size(); ++corner) {
    pace.spend(2);
    const Index face = far->base_faces[corner / 3];
    const GridPoint place = far->corners[corner];
    if (face % 2 != 0 || place.j != 0) continue;  // A_s A_{s+1} is edge 0 of every even face
    const Segment& segment = of_face[face];
    const Count point = segment.first + (segment.begin + place.i) % segment.count;
    pace.spend(2 * width);
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t source = std::size_t{far->faces[corner]} * width + k;
      to.points[point * width + k] = double{far->primvars[0].values[source]};
      if (limit) to.limits[point * width + k] = double{far->primvars[0].limit_values[source]};
    }
  }
  return to;
}

}  // namespace

template <class Real>
Result<FarCurves> far_refine_curves(const FarCurves& from, Index level, bool limit, const Budget& budget) {
  return stoppable(budget,
                   [&](const Pace& pace) { return refine_strips<Real>(from, level, limit, budget, pace); });
}

template Result<FarCurves> far_refine_curves<float>(const FarCurves&, Index, bool, const Budget&);
template Result<FarCurves> far_refine_curves<double>(const FarCurves&, Index, bool, const Budget&);

}  // namespace subdivd::oracle
