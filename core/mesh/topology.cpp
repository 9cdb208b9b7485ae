#include "core/mesh/topology.h"

#include <cstdint>
#include <utility>

#include "core/mesh/scan.h"

namespace subdivd {

template <class Faces>
Topology<Faces>::Topology(Index vertex_count, Faces faces, const Pace& pace)
    : Base(typename Base::WithoutEdges{}, vertex_count, std::move(faces)) {
  Buffer<Index> first_corners = count_corners(pace);
  edges_ = find_edges(vertex_count_, faces_, vertex_corner_offsets_, pace);
  connect(std::move(first_corners), pace);
}

template <class Faces>
Result<Topology<Faces>> Topology<Faces>::build(Index vertex_count, Faces faces, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return Topology(vertex_count, std::move(faces), pace); });
}

template <class Faces>
Topology<Faces>::Topology(Index vertex_count, Faces faces, Buffer<Index> half_edge_edges,
                          Buffer<std::array<Index, 2>> edge_vertices, const Pace& pace)
    : Base(typename Base::WithoutEdges{}, vertex_count, std::move(faces)) {
  Edges edges;
  edges.of_half_edges = std::move(half_edge_edges);
  edges.vertices = std::move(edge_vertices);
  pace.fill(edges.sides, edges.count(), std::array<Index, 2>{kNoIndex, kNoIndex});
  edges_ = std::move(edges);
  pace.for_each(static_cast<Index>(corner_vertices().size()),
                [&](Index h) { edges_.attach(h, corner_vertices()[h], edges_.of_half_edges[h]); });
  edges_.set_kinds(pace);
  connect(count_corners(pace), pace);
}

// Sets the lengths of the rows of corners; returns the lowest corner at every vertex, kNoIndex where there is
// none.
template <class Faces>
Buffer<Index> Topology<Faces>::count_corners(const Pace& pace) {
  Buffer<Index> first;
  pace.fill(first, vertex_count_, kNoIndex);
  pace.fill(vertex_corner_offsets_, Count{vertex_count_} + 1, 0);
  pace.in_blocks(corner_vertices().size(), [&](Count begin, Count end) {
    const Count size = corner_vertices().size();  // from the last half-edge to the first
    for (auto h = static_cast<Index>(size - begin); h-- > static_cast<Index>(size - end);) {
      const Index v = corner_vertices()[h];
      ++vertex_corner_offsets_[v + 1];
      first[v] = h;
    }
  });
  pace.for_each(Count{vertex_count_},
                [&](Count v) { vertex_corner_offsets_[v + 1] += vertex_corner_offsets_[v]; });
  return first;
}

template <class Faces>
void Topology<Faces>::connect(Buffer<Index> first_corners, const Pace& pace) {
  gather_non_manifold_half_edges(pace);
  count_edges(first_corners, pace);
  go_round_vertices(first_corners, pace);
  go_round_borders(pace);
  list_non_manifold(pace);
}

// The half-edges of the non-manifold edges, edge by edge, sorted by counting.
template <class Faces>
void Topology<Faces>::gather_non_manifold_half_edges(const Pace& pace) {
  const std::vector<Index>& edges = edges_.non_manifold;
  if (edges.empty()) return;
  Buffer<Index> row_of;  // of edges; set for the non-manifold ones
  row_of.resize(edge_count());
  pace.for_each(static_cast<Index>(edges.size()), [&](Index k) { row_of[edges[k]] = k; });
  pace.fill(non_manifold_offsets_, edges.size() + 1, 0);
  const auto half_edges = static_cast<Index>(corner_vertices().size());
  pace.for_each(half_edges, [&](Index h) {
    if (const Index e = edges_.of_half_edges[h]; is_non_manifold_edge(e))
      ++non_manifold_offsets_[row_of[e] + 1];
  });
  pace.for_each(edges.size(),
                [&](std::size_t k) { non_manifold_offsets_[k + 1] += non_manifold_offsets_[k]; });
  std::vector<Index> ends;
  pace.copy(non_manifold_offsets_, ends);
  pace.fill(non_manifold_half_edges_, non_manifold_offsets_.back(), 0);
  pace.for_each(half_edges, [&](Index h) {
    if (const Index e = edges_.of_half_edges[h]; is_non_manifold_edge(e))
      non_manifold_half_edges_[ends[row_of[e]]++] = h;
  });
}

template <class Faces>
std::span<const Index> Topology<Faces>::half_edges_of_non_manifold(Index e) const {
  const std::vector<Index>& edges = edges_.non_manifold;
  const auto k = static_cast<std::size_t>(std::ranges::lower_bound(edges, e) - edges.begin());
  return std::span(non_manifold_half_edges_)
      .subspan(non_manifold_offsets_[k], non_manifold_offsets_[k + 1] - non_manifold_offsets_[k]);
}

// Sets the lengths of the rows of edges from those of corners, finds the ends of non-manifold edges, and
// takes the first corners from the vertices that are not closed fans.
// Every corner is at two edges, and an edge is at as many of v's corners as it has faces: 2 for most, so v
// has as many edges as corners, and half of (2 - faces) more for each that has not two.
template <class Faces>
void Topology<Faces>::count_edges(std::span<Index> first_corners, const Pace& pace) {
  pace.fill(non_manifold_vertices_, vertex_count_, 0);
  pace.fill(vertex_edge_offsets_, Count{vertex_count_} + 1, 0);
  for_each_set(
      edge_kinds(),
      [&](std::size_t e) {
        const auto edge = static_cast<Index>(e);
        for (const Index v : edges_.vertices[e]) {
          vertex_edge_offsets_[v + 1] += 2 - static_cast<Index>(edge_half_edges(edge).size());  // modulo 2^32
          if (!is_boundary(edge)) non_manifold_vertices_[v] = 1;
          first_corners[v] = kNoIndex;
        }
      },
      pace);
  std::int64_t more = 0;
  pace.for_each(vertex_count_, [&](Index v) {
    more += static_cast<std::int32_t>(vertex_edge_offsets_[v + 1]);
    vertex_edge_offsets_[v + 1] = static_cast<Index>(vertex_corner_offsets_[v + 1] + more / 2);
  });
}

// Goes counter-clockwise round a vertex whose edges all have two faces, and writes corners and edges.
template <class Faces>
class Topology<Faces>::Walk {
 public:
  Walk(Topology& topology, std::span<const Index> next_corners, Index v, Index start)
      : edge_of_(topology.edges_.of_half_edges.data()),
        next_corners_(next_corners.data()),
        corners_(topology.vertex_corners_.data() + topology.vertex_corner_offsets_[v]),
        edges_(topology.vertex_edges_.data() + topology.vertex_edge_offsets_[v]),
        all_(topology.vertex_corners(v).size()),
        start_(start),
        at_(start) {}

  // To the end; whether it comes back to the start there and not before. It ends by counting: where a
  // corner's other side leads to is known late, and meanwhile the processor goes on to the next vertex.
  [[gnu::always_inline]] bool go_on() {
    go_on_to(all_);
    return at_ == start_ && met_ == all_;
  }
  // The same for a vertex that may have millions of corners.
  bool go_on(const Pace& pace) {
    while (met_ < all_) {
      pace.spend(kStepsPerPoll);
      if (!go_on_to(std::min<std::size_t>(all_, met_ + kStepsPerPoll))) break;
    }
    return at_ == start_ && met_ == all_;
  }
  static constexpr std::size_t kStepsPerPoll = 1 << 12;  // each perhaps waits for memory
  bool is_short() const { return all_ <= kStepsPerPoll; }
  // All but the shorter one's last step, by turns: every step of a walk waits for the one before. False when
  // one comes back to its start.
  [[gnu::always_inline]] static bool go_together(Walk& one, Walk& other) {
    const std::size_t both = std::min(one.all_, other.all_);
    while (one.met_ + 1 < both) {
      one.step();
      other.step();
      if ((one.at_ == one.start_) | (other.at_ == other.start_)) [[unlikely]]
        return false;
    }
    return true;
  }

 private:
  // False when it comes back to the start.
  [[gnu::always_inline]] bool go_on_to(std::size_t end) {
    while (met_ < end) {
      step();
      if (at_ == start_) [[unlikely]]
        return false;
    }
    return true;
  }
  [[gnu::always_inline]] void step() {
    corners_[met_] = at_;
    edges_[met_++] = edge_of_[at_];
    at_ = next_corners_[at_];
  }

  const Index *edge_of_, *next_corners_;
  Index *corners_, *edges_;
  std::size_t all_, met_ = 0;
  Index start_, at_;
};

// Sets, for every corner of these faces, the one that follows it counter-clockwise round its vertex, across an
// edge of two faces; of no use where the edge has others. Found before any walk: here all look-ups are under
// way together, while those of a walk wait for one another.
template <class Faces>
void Topology<Faces>::find_next_corners(Range faces, std::span<Index> next_corners, const Pace& pace) const {
  const Index* const edge_of = edges_.of_half_edges.data();
  const std::array<Index, 2>* const sides = edges_.sides.data();
  pace.in_blocks(faces.end - faces.begin, [&](Count begin, Count end) {
    for (auto f = static_cast<Index>(faces.begin + begin); f < faces.begin + end; ++f) {
      const Index first = faces_.begin(f), last = faces_.begin(f + 1);
      Index before = last - 1;
      for (Index h = first; h < last; before = h++)
        next_corners[h] = sides[edge_of[before]][0] ^ sides[edge_of[before]][1] ^ before;
    }
  });
}

// Below this a helper is awake when the work is done.
constexpr Index kVerticesWorthHelp = Index{1} << 15;

// Writes the rows of all vertices whose faces are one closed fan, and finds those where several meet. Every
// vertex has rows of its own: they may be shared out.
template <class Faces>
void Topology<Faces>::go_round_vertices(std::span<const Index> first_corners, const Pace& pace) {
  vertex_corners_.resize(corner_vertices().size());
  vertex_edges_.resize(std::size_t{2} * edge_count());
  Buffer<Index> next_corners(corner_vertices().size());
  if (pace.threads() == 1 || vertex_count_ < kVerticesWorthHelp) {
    find_next_corners({0, faces_.count()}, next_corners, pace);
    return go_round_vertices({0, vertex_count_}, first_corners, next_corners, pace);
  }
  const auto done = Team::run(pace.threads(), pace.budget(), [&](Worker worker) {
    find_next_corners(worker.share(faces_.count()), next_corners, Pace(worker));
    if (!worker.meet()) return;
    go_round_vertices(worker.share(vertex_count_), first_corners, next_corners, Pace(worker));
  });
  if (!done) throw Stopped{done.error()};
}

template <class Faces>
void Topology<Faces>::go_round_vertices(Range vertices, std::span<const Index> first_corners,
                                        std::span<const Index> next_corners, const Pace& pace) {
  const auto begin = static_cast<Index>(vertices.begin), end = static_cast<Index>(vertices.end);
  const auto corners_before = [&](Index v) { return vertex_corner_offsets_[v]; };
  Index next_vertex = begin, next_corner = 0;  // at either of which the budget is polled again
  for (Index v = begin; v < end; ++v) {
    if (v >= next_vertex || corners_before(v) >= next_corner) {
      pace.spend(Pace::kBlock);
      next_vertex = v + static_cast<Index>(Pace::kBlock);
      next_corner = corners_before(v) + static_cast<Index>(4 * Pace::kBlock);
    }
    if (first_corners[v] == kNoIndex) continue;
    Walk one(*this, next_corners, v, first_corners[v]);
    if (corners_before(v + 1) - corners_before(v) > Walk::kStepsPerPoll) {
      if (!one.go_on(pace)) non_manifold_vertices_[v] = 1;
      continue;
    }
    if (v + 1 < end && first_corners[v + 1] != kNoIndex) {
      Walk other(*this, next_corners, v + 1, first_corners[v + 1]);
      if (other.is_short() && Walk::go_together(one, other) && one.go_on() && other.go_on()) {
        ++v;
        continue;
      }
      one = Walk(*this, next_corners, v, first_corners[v]);
    }
    if (!one.go_on()) non_manifold_vertices_[v] = 1;
  }
}

// Writes the rows of all vertices whose faces are one open fan: it starts at the border's half-edge that
// leaves the vertex.
template <class Faces>
void Topology<Faces>::go_round_borders(const Pace& pace) {
  for_each_set(
      edge_kinds(),
      [&](std::size_t e) {
        if (!is_boundary(static_cast<Index>(e))) return;
        const Index start = edge_half_edges(static_cast<Index>(e))[0], v = corner_vertices()[start];
        if (is_non_manifold_vertex(v)) return;
        Index* corner = vertex_corners_.data() + vertex_corner_offsets_[v];
        Index* edge = vertex_edges_.data() + vertex_edge_offsets_[v];
        for (Index h = start; h != kNoIndex; h = across(*edge, prev(h))) {
          pace.spend(4);
          *corner++ = h;
          *edge++ = edges_.of_half_edges[h];
          *edge = edges_.of_half_edges[prev(h)];
        }
        if (corner != vertex_corners_.data() + vertex_corner_offsets_[v + 1]) non_manifold_vertices_[v] = 1;
      },
      pace);
}

// Writes the corners and edges of the other vertices.
template <class Faces>
void Topology<Faces>::list_non_manifold(const Pace& pace) {
  bool any = false;
  pace.for_each(vertex_count_, [&](Index v) { any |= is_non_manifold_vertex(v); });
  if (!any) return;
  Buffer<Index> ends;
  pace.copy(vertex_corner_offsets_, ends);
  pace.for_each(static_cast<Index>(corner_vertices().size()), [&](Index h) {
    if (const Index v = corner_vertices()[h]; is_non_manifold_vertex(v)) vertex_corners_[ends[v]++] = h;
  });
  pace.copy(vertex_edge_offsets_, ends);
  pace.for_each(edge_count(), [&](Index e) {
    for (const Index v : edges_.vertices[e])
      if (is_non_manifold_vertex(v)) vertex_edges_[ends[v]++] = e;
  });
}

template class Topology<Triangles>;
template class Topology<Quads>;
template class Topology<Polygons>;

}  // namespace subdivd
