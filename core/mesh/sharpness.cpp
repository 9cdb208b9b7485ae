#include "core/mesh/sharpness.h"

#include <algorithm>

#include "core/mesh/scan.h"

namespace subdivd {
namespace {

float clamped(float s) { return std::min(s, kInfiniteSharpness); }

Index edge_between(const Topology& topology, Index a, Index b) {
  // From the end with fewer edges: a hub of a million edges must not make every crease at it cost a million.
  if (topology.vertex_edges(b).size() < topology.vertex_edges(a).size()) std::swap(a, b);
  for (Index e : topology.vertex_edges(a))
    if (topology.other_end(e, a) == b) return e;
  return kNoIndex;
}

// Sharpness given by the caller alone.
std::vector<float> tagged_edges(const ControlMesh& mesh, const Topology& topology) {
  std::vector<float> edges(topology.edge_count(), 0.0f);
  const bool per_crease = mesh.crease_sharpnesses.size() == mesh.crease_lengths.size();
  std::size_t point = 0, edge = 0;
  for (std::size_t crease = 0; crease < mesh.crease_lengths.size(); ++crease) {
    const Index length = mesh.crease_lengths[crease];
    for (Index k = 0; k + 1 < length; ++k, ++edge) {
      const Index e =
          edge_between(topology, mesh.crease_indices[point + k], mesh.crease_indices[point + k + 1]);
      if (e != kNoIndex) edges[e] = clamped(mesh.crease_sharpnesses[per_crease ? crease : edge]);
    }
    point += length;
  }
  return edges;
}

bool inside_non_manifold_crease(const Topology& topology, Index v) {
  Index non_manifold = 0, boundary = 0;
  for (Index e : topology.vertex_edges(v)) {
    non_manifold += topology.is_non_manifold_edge(e);
    boundary += topology.is_boundary(e);
  }
  return non_manifold == 2 && boundary == 0 &&
         topology.vertex_corners(v).size() > topology.vertex_edges(v).size();
}

}  // namespace

Rule rule_of(float vertex_sharpness, std::span<const float> edge_sharpness) {
  if (is_sharp(vertex_sharpness)) return Rule::corner;
  switch (std::ranges::count_if(edge_sharpness, is_sharp)) {
    case 0:
      return Rule::smooth;
    case 1:
      return Rule::dart;
    case 2:
      return Rule::crease;
    default:
      return Rule::corner;
  }
}

float decay(float s) {
  if (is_infinite(s)) return kInfiniteSharpness;
  return s > 1 ? s - 1 : 0;
}

void decay_around_vertex(CreaseMethod method, std::span<const float> parent, std::span<float> child) {
  float sum = 0;
  Index count = 0;
  if (method == CreaseMethod::chaikin)
    for (float s : parent)
      if (is_semi_sharp(s)) {
        sum += s;
        ++count;
      }
  for (std::size_t k = 0; k < parent.size(); ++k) {
    const float s = parent[k];
    if (count < 2 || !is_semi_sharp(s)) {
      child[k] = decay(s);
    } else {
      const float mean_of_others = (sum - s) / static_cast<float>(count - 1);
      child[k] = std::max(0.75f * s + 0.25f * mean_of_others - 1.0f, 0.0f);
    }
  }
}

float fractional_weight(CreaseMethod method, float parent_vertex, float child_vertex,
                        std::span<const float> parent_edges, std::span<const float> child_edges) {
  Index count = 0;
  float sum = 0;
  if (is_sharp(parent_vertex) && !is_sharp(child_vertex)) {
    count = 1;
    sum = parent_vertex;
  }
  for (std::size_t k = 0; k < parent_edges.size(); ++k) {
    const bool runs_out = method == CreaseMethod::uniform ? parent_edges[k] <= 1 : !is_sharp(child_edges[k]);
    if (is_sharp(parent_edges[k]) && runs_out) {
      sum += parent_edges[k];
      ++count;
    }
  }
  return count == 0 ? 0.0f : std::min(sum / static_cast<float>(count), 1.0f);
}

Sharpness control_sharpness(const ControlMesh& mesh, const Topology& topology) {
  Sharpness result{tagged_edges(mesh, topology), std::vector<float>(topology.vertex_count(), 0.0f)};
  const bool pin_corners = mesh.interpolate_boundary == BoundaryInterpolation::edge_and_corner;
  const auto is_border_corner = [&](Index v) {
    return topology.vertex_corners(v).size() == 1 && topology.vertex_edges(v).size() == 2;
  };
  for_each_set(topology.edge_kinds(), [&](std::size_t e) { result.edges[e] = kInfiniteSharpness; });
  for (std::size_t k = 0; k < mesh.corner_indices.size(); ++k)
    result.vertices[mesh.corner_indices[k]] = clamped(mesh.corner_sharpnesses[k]);
  if (pin_corners)
    for_each_set(topology.edge_kinds(), [&](std::size_t e) {
      for (const Index v : topology.edge_vertices(static_cast<Index>(e)))
        if (is_border_corner(v)) result.vertices[v] = kInfiniteSharpness;
    });
  for_each_set(topology.non_manifold_vertices(), [&](std::size_t k) {
    const auto v = static_cast<Index>(k);
    if (!is_border_corner(v) && !inside_non_manifold_crease(topology, v))
      result.vertices[v] = kInfiniteSharpness;
  });
  return result;
}

std::vector<unsigned char> hole_flags(const ControlMesh& mesh, const Topology& topology) {
  std::vector<unsigned char> holes(topology.face_count(), 0);
  for (Index f : mesh.hole_indices) holes[f] = 1;
  if (mesh.interpolate_boundary != BoundaryInterpolation::none) return holes;
  const std::vector<float> tagged = tagged_edges(mesh, topology);
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    const bool open = std::ranges::any_of(topology.vertex_edges(v), [&](Index e) {
      return topology.is_boundary(e) && !is_infinite(tagged[e]);
    });
    if (!open) continue;
    for (Index corner : topology.vertex_corners(v)) holes[corner / 3] = 1;
  }
  return holes;
}

}  // namespace subdivd
