#include "core/refine/first_step.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/engine/grid/evaluated.h"

namespace subdivd {
namespace {

template <class Real>
void put_means(const Connectivity<Polygons>& polygons, const Real* from, Index width, Real* out,
               const Pace& pace) {
  const auto mean = [&](std::span<const Index> vertices) {
    pace.spend(vertices.size() * (1 + width / 4));
    std::fill_n(out, width, Real(0));
    const auto weight = static_cast<Real>(1.0 / static_cast<double>(vertices.size()));
    for (const Index v : vertices)
      for (Index c = 0; c < width; ++c) out[c] += weight * from[Count{v} * width + c];
    out += width;
  };
  for (const auto& ends : polygons.edge_vertices()) mean(ends);
  for (Index f = 0; f < polygons.face_count(); ++f) {
    const Index begin = polygons.faces().begin(f), end = polygons.faces().begin(f + 1);
    mean(polygons.corner_vertices().subspan(begin, end - begin));
  }
}

}  // namespace

std::shared_ptr<const Topology<Quads>> quads_of(const Connectivity<Polygons>& polygons, const Pace& pace) {
  const auto half_edges = static_cast<Index>(polygons.corner_vertices().size());
  const Index vertices = polygons.vertex_count(), edges = polygons.edge_count(), inside = 2 * edges;
  std::vector<Index> corners;
  corners.reserve(Count{4} * half_edges);
  Buffer<Index> edges_of;
  edges_of.resize(Count{4} * half_edges);
  Buffer<std::array<Index, 2>> ends;
  ends.resize(Count{inside} + half_edges);
  const auto half = [&](Index e, Index v) { return 2 * e + (polygons.edge_vertices(e)[0] == v ? 0 : 1); };
  pace.for_each(edges, [&](Index e) {
    for (const Index end : {0u, 1u}) ends[2 * e + end] = {polygons.edge_vertices(e)[end], vertices + e};
  });
  pace.for_each(half_edges, [&](Index h) {
    pace.spend(8);
    const Index before = polygons.prev(h), v = polygons.corner_vertex(h), e = polygons.half_edge_edge(h),
                e_before = polygons.half_edge_edge(before),
                face = vertices + edges + polygons.faces().face_of(h);
    corners.insert(corners.end(), {v, vertices + e, face, vertices + e_before});
    Index* const quad = &edges_of[Count{4} * h];
    quad[0] = half(e, v);
    quad[1] = inside + h;
    quad[2] = inside + before;
    quad[3] = half(e_before, v);
    ends[inside + h] = {vertices + e, face};
  });
  return std::make_shared<const Topology<Quads>>(vertices + edges + polygons.face_count(),
                                                 Quads(std::move(corners)), std::move(edges_of),
                                                 std::move(ends), pace);
}

MeshFirstStep first_step(const AnyGridScheme& scheme, CreaseMethod method,
                         std::shared_ptr<const Topology<Polygons>> polygons, Sharpness sharpness,
                         const Pace& pace) {
  MeshFirstStep made;
  made.level = plain::first_level(plain::adjacency_of(*polygons, pace), std::move(sharpness), method, pace);
  made.step.quads = quads_of(*polygons, pace);
  made.step.sharpness =
      plain::next_sharpness(made.level, made.step.quads->vertex_count(), made.step.quads->edge_count(), pace);
  made.step.rows = plain::rows_of(scheme, method, made.level, false, pace);
  made.step.polygons = std::move(polygons);
  return made;
}

FirstStep first_step(const AnyGridScheme& scheme, CreaseMethod method, Channel<Polygons> channel,
                     const plain::Level& mesh, const Pace& pace) {
  FirstStep step;
  const plain::Level level =
      plain::first_level(plain::adjacency_of(*channel.topology, pace), std::move(channel.sharpness),
                         channel.linear, channel.linear_borders, mesh, pace);
  step.quads = quads_of(*channel.topology, pace);
  step.sharpness = plain::next_sharpness(level, step.quads->vertex_count(), step.quads->edge_count(), pace);
  if (!channel.linear) step.rows = plain::rows_of(scheme, method, level, false, pace);
  step.polygons = std::move(channel.topology);
  step.values = std::move(channel.values);
  step.linear = channel.linear;
  return step;
}

template <class Real>
Buffer<Real> apply(const FirstStep& step, std::span<const Real> control, Index width, bool linear,
                   const Pace& pace) {
  const Count size = Count{step.quads->vertex_count()} * width;
  Buffer<Real> values;
  values.reserve(size + kSpareControl);
  values.resize(size);
  if (linear || step.linear) {
    pace.in_blocks(control.size(), [&](Count begin, Count end) {
      std::copy(control.begin() + static_cast<std::ptrdiff_t>(begin),
                control.begin() + static_cast<std::ptrdiff_t>(end),
                values.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    put_means(*step.polygons, control.data(), width, values.data() + control.size(), pace);
  } else {
    plain::apply(step.rows, control, width, values.data(), pace);
  }
  return values;
}

template Buffer<float> apply(const FirstStep&, std::span<const float>, Index, bool, const Pace&);
template Buffer<double> apply(const FirstStep&, std::span<const double>, Index, bool, const Pace&);

}  // namespace subdivd
