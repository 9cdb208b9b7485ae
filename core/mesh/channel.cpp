#include "core/mesh/channel.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/mesh/positions.h"

namespace subdivd {
namespace {

// Channel vertices of the corners, and the value of each channel vertex.
template <class Faces>
void number_vertices(const Topology<Faces>& base, std::span<const Index> vertices,
                     std::span<const Index> corner_values, Index value_count, std::vector<Index>& corners,
                     std::vector<Index>& values, const Pace& pace) {
  // Per value: the first point that uses it; the last one that uses it as well, and its channel vertex there.
  std::vector<Index> owner, last, number_there;
  for (auto* array : {&owner, &last, &number_there}) pace.fill(*array, value_count, kNoIndex);
  values.reserve(value_count);
  pace.for_each(value_count, [&](Index k) { values.push_back(k); });
  pace.fill(corners, corner_values.size(), 0);
  for (const Index v : vertices) {
    for (const Index h : base.vertex_corners(v)) {
      pace.spend(1);
      const Index value = corner_values[h];
      if (owner[value] == kNoIndex) owner[value] = v;
      if (owner[value] == v) {
        corners[h] = value;
        continue;
      }
      if (last[value] != v) {
        last[value] = v;
        number_there[value] = static_cast<Index>(values.size());
        values.push_back(value);
      }
      corners[h] = number_there[value];
    }
  }
}

// What happens around one point that carries several values, or a seam, in one of its values' fans.
struct Span {
  Index faces = 0;
  Index semi_sharp = 0;   // semi-sharp edges inside
  bool disjoint = false;  // not one fan, or crossed by an infinitely sharp edge
};

template <class Faces>
class Rules {
 public:
  Rules(const Cage& cage, CreaseMethod crease_method, const Topology<Faces>& base,
        const Sharpness& base_sharpness, Channel<Faces>& channel, const Pace& pace)
      : cage_(cage),
        crease_method_(crease_method),
        base_(base),
        base_sharpness_(base_sharpness),
        channel_(channel),
        topology_(*channel.topology),
        mode_(cage.face_varying_linear_interpolation),
        pace_(pace) {}

  void apply(std::span<const Index> vertices) {
    inherit_edges();
    std::vector<Index> values;
    for (const Index v : vertices) {
      values.clear();
      for (Index h : base_.vertex_corners(v)) {
        pace_.spend(8);
        values.push_back(topology_.corner_vertex(h));
      }
      if (values.size() < 64)
        std::ranges::sort(values);
      else
        pace_.sort(values.begin(), values.end(), std::less<>());
      values.erase(std::unique(values.begin(), values.end()), values.end());
      sharpen_around(v, values);
    }
  }

 private:
  bool is_seam(Index h) const {  // base edge of h is a border of the channel but not of the mesh
    return topology_.is_boundary(topology_.half_edge_edge(h)) && !base_.is_boundary(base_.half_edge_edge(h));
  }

  void inherit_edges() {
    pace_.fill(channel_.sharpness.edges, topology_.edge_count(), 0.0f);
    pace_.for_each(static_cast<Index>(topology_.corner_vertices().size()), [&](Index h) {
      channel_.sharpness.edges[topology_.half_edge_edge(h)] = base_sharpness_.edges[base_.half_edge_edge(h)];
    });
    pace_.for_each(topology_.edge_count(), [&](Index e) {
      if (topology_.is_boundary(e) || topology_.is_non_manifold_edge(e))
        channel_.sharpness.edges[e] = kInfiniteSharpness;
    });
  }

  // Whether the channel around v looks like the mesh around v, so that v's own rule holds.
  bool matches(Index v, std::span<const Index> values) const {
    if (values.size() != 1) return false;
    bool border = false;
    for (Index h : base_.vertex_corners(v)) {
      pace_.spend(4);
      if (is_seam(h) || is_seam(base_.prev(h))) return false;
      border |= base_.is_boundary(base_.half_edge_edge(h)) ||
                base_.is_boundary(base_.half_edge_edge(base_.prev(h)));
    }
    if (!border) return true;
    if (channel_.linear_borders) return false;
    const bool corner_is_smooth = cage_.interpolate_boundary != BoundaryInterpolation::edge_and_corner;
    return !(base_.vertex_corners(v).size() == 1 && corner_is_smooth &&
             mode_ != FaceVaryingInterpolation::none);
  }

  Span span_of(Index c) const {
    Span span;
    span.faces = static_cast<Index>(topology_.vertex_corners(c).size());
    span.disjoint = topology_.is_non_manifold_vertex(c);
    for (Index e : topology_.vertex_edges(c)) {
      pace_.spend(2);
      if (topology_.is_boundary(e)) continue;
      span.disjoint |= is_infinite(channel_.sharpness.edges[e]);
      span.semi_sharp += is_semi_sharp(channel_.sharpness.edges[e]);
    }
    return span;
  }

  void sharpen_around(Index v, std::span<const Index> values) {
    auto& vertices = channel_.sharpness.vertices;
    if (matches(v, values)) {
      vertices[values[0]] = base_sharpness_.vertices[v];
      return;
    }
    using enum FaceVaryingInterpolation;
    const bool dependent = mode_ == corners_plus1 || mode_ == corners_plus2;
    const bool border = std::ranges::any_of(base_.vertex_edges(v), [&](Index e) {
      pace_.spend(1);
      return base_.is_boundary(e);
    });
    bool all_sharp = channel_.linear_borders || is_infinite(base_sharpness_.vertices[v]) ||
                     base_.is_non_manifold_vertex(v) || (dependent && values.size() > 2) ||
                     (mode_ == corners_plus2 && values.size() == 1 && !border);
    std::vector<Span> spans;
    for (Index c : values) spans.push_back(span_of(c));
    if (dependent && spans.size() == 2) {
      all_sharp |= spans[0].disjoint || spans[1].disjoint;
      all_sharp |= mode_ == corners_plus2 && (spans[0].faces == 1 || spans[1].faces == 1);
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      pace_.spend(1);
      const bool sharp_corner = spans[k].disjoint || (spans[k].faces == 1 && mode_ != none);
      vertices[values[k]] = all_sharp || sharp_corner ? kInfiniteSharpness : base_sharpness_.vertices[v];
    }
    // One of two values is held by semi-sharp edges inside its fan: the other stays a corner as long, unless
    // the point's own semi-sharpness holds both.
    if (dependent && !is_semi_sharp(base_sharpness_.vertices[v]) && !all_sharp && spans.size() == 2 &&
        spans[0].semi_sharp != spans[1].semi_sharp)
      for (std::size_t k = 0; k < 2; ++k)
        if (spans[k].semi_sharp == 0)
          vertices[values[k]] = std::max(vertices[values[k]], levels_held(v, values[1 - k]));
  }

  // For how long semi-sharp edges stand inside the fan of channel vertex c (at point v), as a vertex
  // sharpness: whole levels, and for the level at which the last runs out the fraction that Far would blend
  // with.
  float levels_held(Index v, Index c) const {
    const auto around = base_.vertex_edges(v);
    std::vector<float> edges, next(around.size()), own, own_next;
    for (Index e : around) {
      pace_.spend(1);
      edges.push_back(base_sharpness_.edges[e]);
    }
    const Positions in_around(around, pace_);
    std::vector<std::size_t> inside;  // of the fan, as positions around v
    for (Index h : topology_.vertex_corners(c)) {
      pace_.spend(16);
      if (!topology_.is_boundary(topology_.half_edge_edge(h)))
        inside.push_back(in_around(base_.half_edge_edge(h)));
    }
    float vertex = base_sharpness_.vertices[v];
    for (float levels = 0;; ++levels) {
      decay_around_vertex(crease_method_, edges, next, pace_);
      own.clear();
      own_next.clear();
      for (std::size_t k : inside) {
        pace_.spend(4);
        own.push_back(edges[k]);
        own_next.push_back(next[k]);
      }
      if (std::ranges::any_of(own_next, is_semi_sharp)) {
        edges.swap(next);
        vertex = decay(vertex);
        continue;
      }
      // While semi-sharp edges elsewhere at the point last, the value keeps its corner for this whole step.
      if (std::ranges::any_of(next, is_semi_sharp)) return levels + 1;
      return levels + fractional_weight(crease_method_, vertex, decay(vertex), own, own_next);
    }
  }

  const Cage& cage_;
  CreaseMethod crease_method_;
  const Topology<Faces>& base_;
  const Sharpness& base_sharpness_;
  Channel<Faces>& channel_;
  const Topology<Faces>& topology_;  // the channel's
  FaceVaryingInterpolation mode_;
  const Pace& pace_;
};

}  // namespace

template <class Faces>
std::vector<Index> vertices_with_faces(const Topology<Faces>& topology, const Pace& pace) {
  std::vector<Index> vertices;
  pace.for_each(topology.vertex_count(), [&](Index v) {
    if (!topology.vertex_corners(v).empty()) vertices.push_back(v);
  });
  return vertices;
}

template <class Faces>
Channel<Faces> make_channel(const Cage& cage, CreaseMethod crease_method,
                            std::shared_ptr<const Topology<Faces>> base, const Sharpness& base_sharpness,
                            std::span<const Index> vertices, std::span<const Index> corner_values,
                            Index value_count, const Pace& pace) {
  Channel<Faces> channel;
  std::vector<Index> corners;
  number_vertices(*base, vertices, corner_values, value_count, corners, channel.values, pace);
  const Topology<Faces>& points = *base;
  if (channel.values.size() == base->vertex_count() && pace.equal(corners, base->corner_vertices()))
    channel.topology = std::move(base);
  else
    channel.topology = std::make_shared<const Topology<Faces>>(
        static_cast<Index>(channel.values.size()), points.faces().with_corners(std::move(corners)), pace);
  channel.linear = cage.face_varying_linear_interpolation == FaceVaryingInterpolation::all;
  channel.linear_borders = cage.face_varying_linear_interpolation == FaceVaryingInterpolation::boundaries;
  pace.fill(channel.sharpness.vertices, channel.topology->vertex_count(), 0.0f);
  Rules(cage, crease_method, points, base_sharpness, channel, pace).apply(vertices);
  return channel;
}

template <class Faces>
bool is_as_mesh(const Cage& cage, const Topology<Faces>& base, std::span<const Index> corner_values,
                Index value_count, const Pace& pace) {
  return cage.face_varying_linear_interpolation != FaceVaryingInterpolation::all &&
         value_count == base.vertex_count() && pace.equal(corner_values, base.corner_vertices()) &&
         pace.all_blocks(base.edge_count(), [&](Count begin, Count end) {
           const auto kinds = base.edge_kinds().subspan(begin, end - begin);
           return std::ranges::find(kinds, EdgeKind::border) == kinds.end();
         });
}

#define SUBDIVD_INSTANTIATE(Faces)                                                                        \
  template std::vector<Index> vertices_with_faces(const Topology<Faces>&, const Pace&);                   \
  template Channel<Faces> make_channel(const Cage&, CreaseMethod, std::shared_ptr<const Topology<Faces>>, \
                                       const Sharpness&, std::span<const Index>, std::span<const Index>,  \
                                       Index, const Pace&);                                               \
  template bool is_as_mesh(const Cage&, const Topology<Faces>&, std::span<const Index>, Index, const Pace&);
SUBDIVD_INSTANTIATE(Triangles)
SUBDIVD_INSTANTIATE(Quads)
SUBDIVD_INSTANTIATE(Polygons)
#undef SUBDIVD_INSTANTIATE

}  // namespace subdivd
