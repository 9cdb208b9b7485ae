#include "core/mesh/topology.h"

#include <cstdint>

#include "core/mesh/scan.h"

namespace subdivd {
namespace {

// Between two polls of the budget.
constexpr Index kVerticesPerPoll = 1 << 15;

}  // namespace

Topology::Topology(Index vertex_count, std::vector<Index> triangles)
    : Topology(std::move(*build(vertex_count, std::move(triangles), {}))) {}

Result<Topology> Topology::build(Index vertex_count, std::vector<Index> triangles, const Budget& budget) {
  Topology topology;
  topology.vertex_count_ = vertex_count;
  topology.triangles_ = std::move(triangles);
  Buffer<Index> first_corners = topology.count_corners();
  auto edges = find_edges(vertex_count, topology.triangles_, topology.vertex_corner_offsets_, budget);
  if (!edges) return std::move(edges).error();
  topology.edges_ = std::move(*edges);
  if (auto done = topology.connect(std::move(first_corners), budget); !done) return std::move(done).error();
  return topology;
}

Topology::Topology(Index vertex_count, std::vector<Index> triangles, Buffer<Index> half_edge_edges,
                   Buffer<std::array<Index, 2>> edge_vertices)
    : vertex_count_(vertex_count), triangles_(std::move(triangles)) {
  edges_.of_half_edges = std::move(half_edge_edges);
  edges_.vertices = std::move(edge_vertices);
  edges_.sides.assign(edge_count(), {kNoIndex, kNoIndex});
  for (Index h = 0; h < triangles_.size(); ++h) edges_.attach(h, triangles_[h], edges_.of_half_edges[h]);
  edges_.set_kinds();
  (void)connect(count_corners(), {});  // an unlimited budget
}

// Sets the lengths of the rows of corners; returns the lowest corner at every vertex, kNoIndex where there is
// none, and once more behind the last vertex.
Buffer<Index> Topology::count_corners() {
  Buffer<Index> first(std::size_t{vertex_count_} + 1, kNoIndex);
  vertex_corner_offsets_.assign(std::size_t{vertex_count_} + 1, 0);
  for (auto h = static_cast<Index>(triangles_.size()); h-- > 0;) {
    const Index v = triangles_[h];
    ++vertex_corner_offsets_[v + 1];
    first[v] = h;
  }
  for (std::size_t v = 1; v < vertex_corner_offsets_.size(); ++v)
    vertex_corner_offsets_[v] += vertex_corner_offsets_[v - 1];
  return first;
}

Result<void> Topology::connect(Buffer<Index> first_corners, const Budget& budget) {
  gather_crowds();
  count_edges(first_corners);
  if (auto stop = budget.poll()) return *stop;
  if (auto done = go_round_vertices(first_corners, budget); !done) return done;
  go_round_borders();
  list_non_manifold();
  return {};
}

void Topology::gather_crowds() {
  const std::vector<Index>& crowded = edges_.non_manifold;
  if (crowded.empty()) return;
  std::vector<std::pair<Index, Index>> members;  // position among the crowded, half-edge
  for (Index h = 0; h < triangles_.size(); ++h)
    if (const Index e = edges_.of_half_edges[h]; is_non_manifold_edge(e))
      members.emplace_back(static_cast<Index>(std::ranges::lower_bound(crowded, e) - crowded.begin()), h);
  std::ranges::sort(members);
  crowd_offsets_.assign(crowded.size() + 1, 0);
  for (const auto& [position, h] : members) {
    crowd_half_edges_.push_back(h);
    crowd_offsets_[position + 1] = static_cast<Index>(crowd_half_edges_.size());
  }
}

std::span<const Index> Topology::crowd_of(Index e) const {
  const std::vector<Index>& crowded = edges_.non_manifold;
  const auto k = static_cast<std::size_t>(std::ranges::lower_bound(crowded, e) - crowded.begin());
  return std::span(crowd_half_edges_).subspan(crowd_offsets_[k], crowd_offsets_[k + 1] - crowd_offsets_[k]);
}

// Sets the lengths of the rows of edges from those of corners, finds the ends of non-manifold edges, and
// takes the first corners from the vertices that are not closed fans.
// Every corner is at two edges, and an edge is at as many of v's corners as it has faces: 2 for most, so v
// has as many edges as corners, and half of (2 - faces) more for each that has not two.
void Topology::count_edges(std::span<Index> first_corners) {
  non_manifold_vertices_.assign(vertex_count_, 0);
  vertex_edge_offsets_.assign(std::size_t{vertex_count_} + 1, 0);
  for_each_set(edge_kinds(), [&](std::size_t e) {
    const auto edge = static_cast<Index>(e);
    for (const Index v : edges_.vertices[e]) {
      vertex_edge_offsets_[v + 1] += 2 - static_cast<Index>(edge_half_edges(edge).size());  // modulo 2^32
      if (!is_boundary(edge)) non_manifold_vertices_[v] = 1;
      first_corners[v] = kNoIndex;
    }
  });
  std::int64_t more = 0;
  for (Index v = 0; v < vertex_count_; ++v) {
    more += static_cast<std::int32_t>(vertex_edge_offsets_[v + 1]);
    vertex_edge_offsets_[v + 1] = static_cast<Index>(vertex_corner_offsets_[v + 1] + more / 2);
  }
}

// Goes counter-clockwise round a vertex whose edges all have two faces, and writes corners and edges.
class Topology::Walk {
 public:
  Walk(Topology& topology, Index v, Index start)
      : edge_of_(topology.edges_.of_half_edges.data()),
        sides_(topology.edges_.sides.data()),
        corners_(topology.vertex_corners_.data() + topology.vertex_corner_offsets_[v]),
        edges_(topology.vertex_edges_.data() + topology.vertex_edge_offsets_[v]),
        all_(topology.vertex_corners(v).size()),
        start_(start),
        at_(start),
        edge_(edge_of_[start]) {}

  // To the end; whether it comes back to the start there and not before. It ends by counting: where a
  // corner's other side leads to is known late, and meanwhile the processor goes on to the next vertex.
  bool go_on() {
    while (met_ < all_) {
      step();
      if (at_ == start_) [[unlikely]]
        break;
    }
    return at_ == start_ && met_ == all_;
  }
  // All but the shorter one's last step, by turns: every step of a walk waits for the one before. False when
  // one comes back to its start.
  static bool go_together(Walk& one, Walk& other) {
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
  [[gnu::always_inline]] void step() {
    corners_[met_] = at_;
    edges_[met_++] = edge_;
    const Index before = prev(at_);
    edge_ = edge_of_[before];
    at_ = sides_[edge_][0] ^ sides_[edge_][1] ^ before;
  }

  const Index* edge_of_;
  const std::array<Index, 2>* sides_;
  Index *corners_, *edges_;
  std::size_t all_, met_ = 0;
  Index start_, at_, edge_;
};

// Writes the rows of all vertices whose faces are one closed fan, and finds those where several meet.
Result<void> Topology::go_round_vertices(std::span<const Index> first_corners, const Budget& budget) {
  vertex_corners_.resize(triangles_.size());
  vertex_edges_.resize(std::size_t{2} * edge_count());
  Index next_poll = 0;
  for (Index v = 0; v < vertex_count_; ++v) {
    if (v >= next_poll) {
      if (auto stop = budget.poll()) return *stop;
      next_poll = v + kVerticesPerPoll;
    }
    if (first_corners[v] == kNoIndex) continue;
    Walk one(*this, v, first_corners[v]);
    if (first_corners[v + 1] != kNoIndex) {
      Walk other(*this, v + 1, first_corners[v + 1]);
      if (Walk::go_together(one, other) && one.go_on() && other.go_on()) {
        ++v;
        continue;
      }
      one = Walk(*this, v, first_corners[v]);
    }
    if (!one.go_on()) non_manifold_vertices_[v] = 1;
  }
  return {};
}

// Writes the rows of all vertices whose faces are one open fan: it starts at the border's half-edge that
// leaves the vertex.
void Topology::go_round_borders() {
  for_each_set(edge_kinds(), [&](std::size_t e) {
    if (!is_boundary(static_cast<Index>(e))) return;
    const Index start = edge_half_edges(static_cast<Index>(e))[0], v = triangles_[start];
    if (is_non_manifold_vertex(v)) return;
    Index* corner = vertex_corners_.data() + vertex_corner_offsets_[v];
    Index* edge = vertex_edges_.data() + vertex_edge_offsets_[v];
    for (Index h = start; h != kNoIndex; h = across(*edge, prev(h))) {
      *corner++ = h;
      *edge++ = edges_.of_half_edges[h];
      *edge = edges_.of_half_edges[prev(h)];
    }
    if (corner != vertex_corners_.data() + vertex_corner_offsets_[v + 1]) non_manifold_vertices_[v] = 1;
  });
}

// Writes the corners and edges of the other vertices.
void Topology::list_non_manifold() {
  if (std::ranges::count(non_manifold_vertices_, 1) == 0) return;
  Buffer<Index> ends = vertex_corner_offsets_;
  for (Index h = 0; h < triangles_.size(); ++h)
    if (const Index v = triangles_[h]; is_non_manifold_vertex(v)) vertex_corners_[ends[v]++] = h;
  ends = vertex_edge_offsets_;
  for (Index e = 0; e < edge_count(); ++e)
    for (const Index v : edges_.vertices[e])
      if (is_non_manifold_vertex(v)) vertex_edges_[ends[v]++] = e;
}

}  // namespace subdivd
