#include "tests/reference/ring.h"

#include <vector>

namespace subdivd::plain {
namespace {

// What decides how the ring's sharpness decays: the edges around the same point of the mesh, and, at the far
// ends of the ring's edges, those around theirs.
template <class Real>
void gather_decay(CreaseMethod method, const SharpTopology& own, const SharpTopology& mesh, Index v,
                  Ring<Real>& ring) {
  const Index h0 = own.topology.vertex_corners(v)[0];
  const Index mesh_vertex = mesh.topology.corner_vertex(h0);
  auto sharpness_around = [&](Index vertex) {
    std::vector<float> result;
    for (Index e : mesh.topology.vertex_edges(vertex)) result.push_back(mesh.sharpness.edges[e]);
    return result;
  };
  const bool together = method == CreaseMethod::chaikin;
  if (together) ring.around = decay_sums(sharpness_around(mesh_vertex));
  for (Index e : own.topology.vertex_edges(v)) {
    const float sharpness = own.sharpness.edges[e];
    DecaySum at_end;
    if (together && !is_infinite(sharpness)) {
      const Index in_mesh = mesh.topology.half_edge_edge(own.topology.edge_half_edges(e)[0]);
      const auto sums = decay_sums(sharpness_around(mesh.topology.other_end(in_mesh, mesh_vertex)));
      if (!sums.empty()) at_end = sums[0];
    }
    ring.far_child.push_back(decay_beside(sharpness, at_end));
  }
}

}  // namespace

template <class Real>
Ring<Real> ring_of(CreaseMethod method, const SharpTopology& own, const SharpTopology& mesh, Index v,
                   std::span<const Real> values, Index width) {
  Ring<Real> ring;
  ring.width = width;
  auto append = [&](std::vector<Real>& to, Index vertex) {
    const auto at = values.subspan(std::size_t{vertex} * width, width);
    to.insert(to.end(), at.begin(), at.end());
  };
  append(ring.center, v);
  ring.vertex_sharpness = own.sharpness.vertices[v];
  for (Index e : own.topology.vertex_edges(v)) {
    append(ring.neighbors, own.topology.other_end(e, v));
    ring.edge_sharpness.push_back(own.sharpness.edges[e]);
  }
  ring.set_faces(own.topology, v);
  if (!ring.wedges.empty()) gather_decay(method, own, mesh, v, ring);
  return ring;
}

template Ring<float> ring_of(CreaseMethod, const SharpTopology&, const SharpTopology&, Index,
                             std::span<const float>, Index);
template Ring<double> ring_of(CreaseMethod, const SharpTopology&, const SharpTopology&, Index,
                              std::span<const double>, Index);

}  // namespace subdivd::plain
