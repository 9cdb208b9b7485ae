#include "core/mesh/sharpness.h"

#include <algorithm>

#include "core/mesh/creases.h"
#include "core/mesh/scan.h"

namespace subdivd {
namespace {

float clamped(float s) { return std::min(s, kInfiniteSharpness); }

// Sharpness given by the caller alone.
template <class Faces>
std::vector<float> tagged_edges(const Cage& cage, const Topology<Faces>& topology, const Pace& pace) {
  std::vector<float> edges;
  pace.fill(edges, topology.edge_count(), 0.0f);
  if (cage.crease_lengths.empty()) return edges;
  const std::vector<Index> along = edges_between(topology, crease_edges(cage, pace), pace);
  Count k = 0;
  for_each_crease_edge(cage, [&](Count, Index, Index, float sharpness) {
    pace.spend(1);
    if (const Index e = along[k++]; e != kNoIndex) edges[e] = clamped(sharpness);
  });
  return edges;
}

DecaySum sum_of(std::span<const float> around, const Pace& pace) {
  DecaySum all;
  pace.for_each(around.size(), [&](std::size_t k) {
    if (!is_semi_sharp(around[k])) return;
    all.sum += around[k];
    ++all.count;
  });
  return all;
}

template <class Faces>
bool inside_non_manifold_crease(const Topology<Faces>& topology, Index v, const Pace& pace) {
  Index non_manifold = 0, boundary = 0;
  for (Index e : topology.vertex_edges(v)) {
    pace.spend(1);
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

float decay_beside(float s, DecaySum all) {
  if (all.count < 2 || !is_semi_sharp(s)) return decay(s);
  const float mean_of_others = (all.sum - s) / static_cast<float>(all.count - 1);
  return std::max(0.75f * s + 0.25f * mean_of_others - 1.0f, 0.0f);
}

void decay_around_vertex(CreaseMethod method, std::span<const float> parent, std::span<float> child,
                         const Pace& pace) {
  DecaySum all;
  if (method == CreaseMethod::chaikin) all = sum_of(parent, pace);
  pace.for_each(parent.size(), [&](std::size_t k) { child[k] = decay_beside(parent[k], all); });
}

std::vector<DecaySum> decay_sums(std::vector<float> around, const Pace& pace) {
  std::vector<DecaySum> sums;
  for (DecaySum all = sum_of(around, pace); all.count > 0; all = sum_of(around, pace)) {
    sums.push_back(all);
    pace.for_each(around.size(), [&](std::size_t k) { around[k] = decay_beside(around[k], all); });
  }
  return sums;
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

template <class Faces>
Sharpness control_sharpness(const Cage& cage, const Topology<Faces>& topology, const Pace& pace) {
  Sharpness result{tagged_edges(cage, topology, pace), {}};
  pace.fill(result.vertices, topology.vertex_count(), 0.0f);
  const bool pin_corners = cage.interpolate_boundary == BoundaryInterpolation::edge_and_corner;
  const auto is_border_corner = [&](Index v) {
    return topology.vertex_corners(v).size() == 1 && topology.vertex_edges(v).size() == 2;
  };
  const auto kinds = topology.edge_kinds();
  for_each_set(
      kinds, [&](std::size_t e) { result.edges[e] = kInfiniteSharpness; }, pace);
  pace.for_each(cage.corner_indices.size(), [&](std::size_t k) {
    result.vertices[cage.corner_indices[k]] = clamped(cage.corner_sharpnesses[k]);
  });
  if (pin_corners)
    for_each_set(
        kinds,
        [&](std::size_t e) {
          for (const Index v : topology.edge_vertices(static_cast<Index>(e)))
            if (is_border_corner(v)) result.vertices[v] = kInfiniteSharpness;
        },
        pace);
  for_each_set(
      topology.non_manifold_vertices(),
      [&](std::size_t k) {
        const auto v = static_cast<Index>(k);
        if (!is_border_corner(v) && !inside_non_manifold_crease(topology, v, pace))
          result.vertices[v] = kInfiniteSharpness;
      },
      pace);
  return result;
}

template <class Faces>
std::vector<unsigned char> hole_flags(const Cage& cage, const Topology<Faces>& topology, const Pace& pace) {
  std::vector<unsigned char> holes;
  pace.fill(holes, topology.face_count(), 0);
  pace.for_each(cage.hole_indices.size(), [&](std::size_t k) { holes[cage.hole_indices[k]] = 1; });
  if (cage.interpolate_boundary != BoundaryInterpolation::none) return holes;
  const std::vector<float> tagged = tagged_edges(cage, topology, pace);
  std::vector<unsigned char> open;  // vertices
  pace.fill(open, topology.vertex_count(), 0);
  for_each_set(
      topology.edge_kinds(),
      [&](std::size_t k) {
        const auto e = static_cast<Index>(k);
        if (!topology.is_boundary(e) || is_infinite(tagged[e])) return;
        for (const Index v : topology.edge_vertices(e)) open[v] = 1;
      },
      pace);
  pace.for_each(topology.face_count(), [&](Index f) {
    const Faces& faces = topology.faces();
    for (Index h = faces.begin(f); h < faces.begin(f + 1); ++h) holes[f] |= open[topology.corner_vertex(h)];
  });
  return holes;
}

#define SUBDIVD_FOR_FACES(Faces)                                                          \
  template Sharpness control_sharpness(const Cage&, const Topology<Faces>&, const Pace&); \
  template std::vector<unsigned char> hole_flags(const Cage&, const Topology<Faces>&, const Pace&);
SUBDIVD_FOR_FACES(Triangles)
SUBDIVD_FOR_FACES(Quads)
SUBDIVD_FOR_FACES(Polygons)
#undef SUBDIVD_FOR_FACES

}  // namespace subdivd
