#include "core/oracle/far_surfaces.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <array>

#include "core/base/pace.h"
#include "core/oracle/far_refiner.h"
#include "core/oracle/far_rows.h"

//   v                                  A quad for every cell; a closed direction goes on at its beginning.
//   ^   (i, j+1) -- 2 -- (i+1, j+1)    An open one ends at a border, whose points follow the cubic curve's
//   |     |                  |         rules; VTX_BOUNDARY_EDGE_AND_CORNER keeps the four corners.
//   |     3       face       1         Corners and edges of a face are numbered as Far numbers them: edge k
//   |     |                  |         runs from corner k to corner k + 1.
//   |   (i, j)  -- 0 --  (i+1, j)
//   +---> u

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// Point (i, j) of the grid; one past the end of a closed direction is its first.
Index at(const FarSurface& grid, Count i, Count j) {
  return static_cast<Index>(j % grid.v.points * grid.u.points + i % grid.u.points);
}

Result<FarRefiner> make_refiner(const FarSurface& grid, const Pace& pace) {
  Sdc::Options rules;  // Far's defaults may change: set all that concern points
  rules.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  rules.SetCreasingMethod(Sdc::Options::CREASE_UNIFORM);
  rules.SetTriangleSubdivision(Sdc::Options::TRI_SUB_CATMARK);
  std::vector<int> indices;
  indices.reserve(grid.u.segments() * grid.v.segments() * 4);
  for (Count j = 0; j < grid.v.segments(); ++j)
    for (Count i = 0; i < grid.u.segments(); ++i) {
      pace.spend(8);
      for (const Index corner :
           {at(grid, i, j), at(grid, i + 1, j), at(grid, i + 1, j + 1), at(grid, i, j + 1)})
        indices.push_back(static_cast<int>(corner));
    }
  const std::vector<int> counts(indices.size() / 4, 4);

  Far::TopologyDescriptor topology;
  topology.numVertices = static_cast<int>(grid.u.points * grid.v.points);
  topology.numFaces = static_cast<int>(counts.size());
  topology.numVertsPerFace = counts.data();
  topology.vertIndicesPerFace = indices.data();
  return create_refiner(topology, Sdc::SCHEME_CATMARK, rules);
}

// Far's vertices by their points on the finer grid `to`, through parent relations alone. A vertex that no
// relation leads to, and one to which two lead that disagree, are kNoIndex.
std::vector<Index> child_places(const Far::TopologyLevel& base, const FarSurface& from, const FarSurface& to,
                                int children, const Pace& pace) {
  std::vector<Index> places(static_cast<std::size_t>(children), kNoIndex);
  std::vector<unsigned char> torn(places.size(), 0);
  const auto put = [&](int vertex, Count i, Count j) {
    const auto v = static_cast<std::size_t>(vertex);
    if (places[v] != kNoIndex && places[v] != at(to, i, j)) torn[v] = 1;
    places[v] = at(to, i, j);
  };
  for (Count j = 0; j < from.v.segments(); ++j)
    for (Count i = 0; i < from.u.segments(); ++i) {
      pace.spend(32);
      const int face = static_cast<int>(j * from.u.segments() + i);
      const Far::ConstIndexArray corners = base.GetFaceVertices(face), edges = base.GetFaceEdges(face);
      constexpr std::array<std::array<Count, 2>, 4> kCorners = {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
      constexpr std::array<std::array<Count, 2>, 4> kEdges = {{{1, 0}, {2, 1}, {1, 2}, {0, 1}}};
      for (int k = 0; k < 4; ++k) {
        const auto slot = static_cast<std::size_t>(k);
        put(base.GetVertexChildVertex(corners[k]), 2 * i + kCorners[slot][0], 2 * j + kCorners[slot][1]);
        put(base.GetEdgeChildVertex(edges[k]), 2 * i + kEdges[slot][0], 2 * j + kEdges[slot][1]);
      }
      put(base.GetFaceChildVertex(face), 2 * i + 1, 2 * j + 1);
    }
  for (std::size_t v = 0; v < places.size(); ++v) {
    pace.spend(1);
    if (torn[v] != 0) places[v] = kNoIndex;
  }
  return places;
}

// Every point of the grid has exactly one vertex.
bool one_to_one(const std::vector<Index>& places, Count points, const Pace& pace) {
  std::vector<unsigned char> taken(points, 0);
  for (const Index place : places) {
    pace.spend(1);
    if (place >= points || taken[place] != 0) return false;
    taken[place] = 1;
  }
  return places.size() == points;
}

Result<std::vector<Index>> places_of(const Far::TopologyRefiner& refiner, const FarSurface& from,
                                     const FarSurface& to, const Pace& pace) {
  const int vertices = refiner.GetLevel(refiner.GetMaxLevel()).GetNumVertices();
  std::vector<Index> places;
  if (refiner.GetMaxLevel() == 0)
    for (Index v = 0; v < static_cast<Index>(vertices); ++v) places.push_back(v);
  else
    places = child_places(refiner.GetLevel(0), from, to, vertices, pace);
  if (!one_to_one(places, to.u.points * to.v.points, pace))
    return Error{ErrorCode::internal, "OpenSubdiv's refined grid is no grid of the expected size"};
  return places;
}

// Far's values, `width` per vertex, in the order of the grid.
template <class Real>
Buffer<double> placed(const Buffer<Real>& values, const std::vector<Index>& places, Index width,
                      const Pace& pace) {
  Buffer<double> result(values.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    pace.spend(1 + width);
    std::copy_n(&values[v * width], width, &result[std::size_t{places[v]} * width]);
  }
  return result;
}

Buffer<Index> quads_of(const Far::TopologyLevel& level, const std::vector<Index>& places, const Pace& pace) {
  Buffer<Index> quads;
  quads.reserve(static_cast<std::size_t>(level.GetNumFaceVertices()));
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    pace.spend(8);
    const Far::ConstIndexArray vertices = level.GetFaceVertices(face);
    for (int k = 0; k < vertices.size(); ++k) quads.push_back(places[static_cast<std::size_t>(vertices[k])]);
  }
  return quads;
}

// Far's tangents inside the surface are (4 (e_0 - e_2) + f_0 - f_1 - f_2 + f_3) and the same turned, 12 times
// the derivative by the level's parameters; on borders and at corners they are derivatives.
template <class Real>
void scale_tangents(const Far::TopologyLevel& level, Buffer<Real>& tangents, const Pace& pace) {
  for (std::size_t v = 0; v < tangents.size() / 3; ++v) {
    pace.spend(4);
    if (!level.IsVertexBoundary(static_cast<int>(v)))
      for (std::size_t k = 0; k < 3; ++k) tangents[3 * v + k] /= 12;
  }
}

template <class Real>
void take_limits(const Far::TopologyRefiner& refiner, Buffer<Real>& points, const FarSurfaceOptions& options,
                 const std::vector<Index>& places, FarSurface& to, const Pace& pace) {
  const Far::PrimvarRefinerReal<Real> primvars(refiner);
  Buffer<Real> limits(points.size());
  Rows<Real> limit(limits, to.width, pace);
  if (!options.normals) {
    primvars.Limit(Rows<Real>(points, to.width, pace), limit);
  } else {
    Buffer<Real> u_tangents(points.size()), v_tangents(points.size());
    Rows<Real> u(u_tangents, to.width, pace), v(v_tangents, to.width, pace);
    primvars.Limit(Rows<Real>(points, to.width, pace), limit, u, v);
    for (Buffer<Real>* tangents : {&u_tangents, &v_tangents})
      scale_tangents(refiner.GetLevel(refiner.GetMaxLevel()), *tangents, pace);
    to.u_tangents = placed(u_tangents, places, to.width, pace);
    to.v_tangents = placed(v_tangents, places, to.width, pace);
  }
  to.limits = placed(limits, places, to.width, pace);
}

// Without points. A border is where it ends in every direction that does not close.
FarSurface empty_grid(const ControlPatch& patch) {
  FarSurface grid;
  grid.u = {patch.u_count, patch.u_wrap == CurveWrap::periodic};
  grid.v = {patch.v_count, patch.v_wrap == CurveWrap::periodic};
  grid.width = patch.width;
  return grid;
}

Count far_points(FarDirection direction, Index level) {
  return (direction.segments() << level) + (direction.closed ? 0 : 1);
}

}  // namespace

// The last step has a quarter of its faces at the beginning; level 0 has no step.
Count far_surface_corners(const ControlPatch& patch, Index level) {
  const FarSurface grid = empty_grid(patch);
  const Count faces = (grid.u.segments() << level) * (grid.v.segments() << level);
  return (level == 0 ? faces : faces + faces / 4) * 4;
}

// predict_bytes has seen that there are at most 2^32 points of ours, and Far has at most 9 for each (of a
// nonperiodic 4 x 4): far from 2^64 bytes. Per point: Far's tables, quads in lists and sorted, and for every
// scalar the levels, limits and tangents in Real and as doubles.
Count far_surface_bytes(const ControlPatch& patch, Index level) {
  const FarSurface grid = empty_grid(patch);
  const Count points = far_points(grid.u, level) * far_points(grid.v, level);
  return points * (400 + Count{patch.width} * 8 * sizeof(double));
}

FarSurface far_control(const ControlPatch& patch) {
  FarSurface grid = empty_grid(patch);
  grid.points.assign(patch.points.begin(), patch.points.end());
  return grid;
}

namespace {

template <class Real>
Result<FarSurface> refine_grid(const FarSurface& from, const FarSurfaceOptions& options, const Budget& budget,
                               const Pace& pace) {
  auto points = convert_values<Real>(from.points, {"points"}, pace);
  if (!points) return points.error();
  Result<FarRefiner> made = make_refiner(from, pace);
  if (!made) return made.error();
  Far::TopologyRefiner& refiner = **made;
  if (auto stop = budget.poll()) return *stop;

  FarSurface to;
  to.u = from.u, to.v = from.v, to.width = from.width;
  if (options.level > 0) {
    Far::TopologyRefiner::UniformOptions uniform(1);
    uniform.fullTopologyInLastLevel = true;  // limits need the edges of the last level
    refiner.RefineUniform(uniform);
    if (auto stop = budget.poll()) return *stop;
    to.u.points = from.u.refined_points(), to.v.points = from.v.refined_points();
    Buffer<Real> next(to.u.points * to.v.points * to.width);
    Rows<Real> target(next, to.width, pace);
    Far::PrimvarRefinerReal<Real>(refiner).Interpolate(1, Rows<Real>(*points, to.width, pace), target);
    *points = std::move(next);
  }
  const Result<std::vector<Index>> places = places_of(refiner, from, to, pace);
  if (!places) return places.error();
  to.points = placed(*points, *places, to.width, pace);
  to.quads = quads_of(refiner.GetLevel(refiner.GetMaxLevel()), *places, pace);
  if (auto stop = budget.poll()) return *stop;
  if (options.limit || options.normals) take_limits(refiner, *points, options, *places, to, pace);
  if (far_has_complained()) return far_refusal();
  return to;
}

}  // namespace

template <class Real>
Result<FarSurface> far_refine_surface(const FarSurface& from, const FarSurfaceOptions& options,
                                      const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return refine_grid<Real>(from, options, budget, pace); });
}

template Result<FarSurface> far_refine_surface<float>(const FarSurface&, const FarSurfaceOptions&,
                                                      const Budget&);
template Result<FarSurface> far_refine_surface<double>(const FarSurface&, const FarSurfaceOptions&,
                                                       const Budget&);

}  // namespace subdivd::oracle
