#include "core/mesh/topology.h"

#include <tuple>

namespace subdivd {
namespace {

// Between two polls of the budget.
constexpr Index kFacesPerPoll = 1 << 18;

// A vertex of more corners is not searched along a chain: a hub of a million edges must not cost a million
// steps for each.
constexpr Index kLongestChain = 64;

// Turns counts[k + 1] per row k into offsets.
void accumulate(Buffer<Index>& counts) {
  for (std::size_t k = 1; k < counts.size(); ++k) counts[k] += counts[k - 1];
}

// Scatters item i to row key(i) for ascending i; offsets come back as they went in.
template <class Key, class Item>
void scatter(Count count, Key key, Item item, Buffer<Index>& offsets, Buffer<Index>& items) {
  items.resize(count);
  for (Count i = 0; i < count; ++i) items[offsets[key(i)]++] = item(i);
  // Every row's begin has moved to its end: the next row's begin.
  std::copy_backward(offsets.begin(), offsets.end() - 1, offsets.end());
  offsets[0] = 0;
}

}  // namespace

// Finds the edge of every half-edge. Edges hang in a chain at one of their ends, one of few corners; chains
// are short, and a mesh whose faces come in any natural order finds them in the cache.
class Topology::Numbering {
 public:
  explicit Numbering(Topology& topology)
      : t_(topology), chains_(topology.vertex_count_, kNoIndex), half_edges_(topology.triangles_.size()) {
    t_.half_edge_edges_.resize(half_edges_);
    t_.mates_.resize(half_edges_);
    const Count edges =
        half_edges_ / 2 + half_edges_ / 16 + 64;  // room for as many borders as most meshes have
    t_.edge_vertices_.reserve(edges);
    t_.edge_sides_.reserve(edges);
    t_.edge_kinds_.reserve(edges);
    next_.reserve(edges);
  }

  Result<void> run(const Budget& budget) {
    mark_heavy();
    for (Index face = 0; face < half_edges_ / 3; ++face) {
      if (face % kFacesPerPoll == 0)
        if (auto stop = budget.poll()) return *stop;
      const Index* v = &t_.triangles_[3 * std::size_t{face}];
      join(3 * face, v[0], v[1]);
      join(3 * face + 1, v[1], v[2]);
      join(3 * face + 2, v[2], v[0]);
    }
    return {};
  }

 private:
  static constexpr Index kHeavy = kNoIndex - 1;  // in chains_: too many corners for a chain

  void join(Index h, Index a, Index b) {
    const Index e = edge_of(h, a, b);
    t_.half_edge_edges_[h] = e;
    t_.join_edge(h, e);
  }

  Index edge_of(Index h, Index a, Index b) {
    const Index low = std::min(a, b), high = std::max(a, b);
    Index home = low, far = high;
    if (chains_[low] == kHeavy) {
      if (chains_[high] == kHeavy) return heavy_edge(h, low, high);
      home = high;
      far = low;
    }
    for (Index e = chains_[home]; e != kNoIndex; e = next_[e].edge)
      if (next_[e].far == far) return e;
    const Index e = add(low, high);
    next_.push_back({chains_[home], far});
    chains_[home] = e;
    return e;
  }

  Index add(Index low, Index high) {
    const Index e = t_.edge_count();
    t_.edge_vertices_.push_back({low, high});
    t_.edge_sides_.push_back({kNoIndex, kNoIndex});
    t_.edge_kinds_.push_back(EdgeKind::border);
    return e;
  }

  // Between two heavy vertices: the first half-edge along the edge, found beforehand by sorting, names it.
  struct Heavy {
    Index low, high, half_edge, first;
  };
  void mark_heavy() {
    Count heavy = 0;
    for (Index v = 0; v < t_.vertex_count_; ++v)
      if (t_.vertex_corner_offsets_[v + 1] - t_.vertex_corner_offsets_[v] > kLongestChain) {
        chains_[v] = kHeavy;
        ++heavy;
      }
    if (heavy > 1) sort_heavy();
  }
  void sort_heavy() {
    for (Index h = 0; h < half_edges_; ++h) {
      const Index a = t_.triangles_[h], b = t_.triangles_[next(h)];
      if (chains_[a] == kHeavy && chains_[b] == kHeavy)
        heavy_.push_back({std::min(a, b), std::max(a, b), h, h});
    }
    std::ranges::sort(heavy_, {}, [](const Heavy& x) { return std::tuple(x.low, x.high, x.half_edge); });
    for (std::size_t k = 1; k < heavy_.size(); ++k)
      if (heavy_[k].low == heavy_[k - 1].low && heavy_[k].high == heavy_[k - 1].high)
        heavy_[k].first = heavy_[k - 1].first;
    std::ranges::sort(heavy_, {}, &Heavy::half_edge);
  }
  Index heavy_edge(Index h, Index low, Index high) {
    const Heavy& heavy = heavy_[heavy_at_++];  // half-edges come in ascending order
    if (heavy.first != h) return t_.half_edge_edges_[heavy.first];
    next_.push_back({kNoIndex, kNoIndex});
    return add(low, high);
  }

  Topology& t_;
  std::vector<Index> chains_;  // per vertex: the last edge that hangs there
  struct Link {
    Index edge, far;  // the edge before it in its chain, and its own end that is not the chain's
  };
  Buffer<Link> next_;  // per edge
  std::vector<Heavy> heavy_;
  std::size_t heavy_at_ = 0;
  Count half_edges_;
};

Topology::Topology(Index vertex_count, std::vector<Index> triangles)
    : Topology(std::move(*build(vertex_count, std::move(triangles), {}))) {}

Result<Topology> Topology::build(Index vertex_count, std::vector<Index> triangles, const Budget& budget) {
  Topology topology;
  topology.vertex_count_ = vertex_count;
  topology.triangles_ = std::move(triangles);
  topology.group_corners();
  if (auto done = Numbering(topology).run(budget); !done) return std::move(done).error();
  if (auto done = topology.connect(budget); !done) return std::move(done).error();
  return topology;
}

Topology::Topology(Index vertex_count, std::vector<Index> triangles, Buffer<Index> half_edge_edges,
                   Buffer<std::array<Index, 2>> edge_vertices)
    : vertex_count_(vertex_count),
      triangles_(std::move(triangles)),
      half_edge_edges_(std::move(half_edge_edges)),
      edge_vertices_(std::move(edge_vertices)) {
  group_corners();
  mates_.resize(triangles_.size());
  edge_sides_.assign(edge_count(), {kNoIndex, kNoIndex});
  edge_kinds_.assign(edge_count(), EdgeKind::border);
  for (Index h = 0; h < triangles_.size(); ++h) join_edge(h, half_edge_edges_[h]);
  (void)connect({});  // an unlimited budget
}

Result<void> Topology::connect(const Budget& budget) {
  for (auto part :
       {&Topology::gather_crowds, &Topology::group_edges, &Topology::find_non_manifold_vertices}) {
    if (auto stop = budget.poll()) return *stop;
    (this->*part)();
  }
  return {};
}

// Half-edge h, the highest so far, runs along edge e.
void Topology::join_edge(Index h, Index e) {
  auto& sides = edge_sides_[e];
  mates_[h] = kNoIndex;
  if (sides[0] == kNoIndex) {
    sides[0] = h;
  } else if (sides[1] == kNoIndex) {
    sides[1] = h;
    const Index first = sides[0];
    if (triangles_[first] == triangles_[h]) {
      edge_kinds_[e] = EdgeKind::clash;
    } else {
      edge_kinds_[e] = EdgeKind::manifold;
      mates_[h] = first;
      mates_[first] = h;
    }
  } else {
    if (edge_kinds_[e] != EdgeKind::crowded) crowded_edges_.push_back(e);
    edge_kinds_[e] = EdgeKind::crowded;
    mates_[sides[0]] = mates_[sides[1]] = kNoIndex;
  }
}

void Topology::gather_crowds() {
  if (crowded_edges_.empty()) return;
  std::ranges::sort(crowded_edges_);
  std::vector<std::pair<Index, Index>> members;  // position in crowded_edges_, half-edge
  for (Index h = 0; h < triangles_.size(); ++h)
    if (const Index e = half_edge_edges_[h]; edge_kinds_[e] == EdgeKind::crowded)
      members.emplace_back(
          static_cast<Index>(std::ranges::lower_bound(crowded_edges_, e) - crowded_edges_.begin()), h);
  std::ranges::sort(members);
  crowd_offsets_.assign(crowded_edges_.size() + 1, 0);
  for (const auto& [position, h] : members) {
    crowd_half_edges_.push_back(h);
    crowd_offsets_[position + 1] = static_cast<Index>(crowd_half_edges_.size());
  }
}

std::span<const Index> Topology::crowd_of(Index e) const {
  const auto k =
      static_cast<std::size_t>(std::ranges::lower_bound(crowded_edges_, e) - crowded_edges_.begin());
  return std::span(crowd_half_edges_).subspan(crowd_offsets_[k], crowd_offsets_[k + 1] - crowd_offsets_[k]);
}

void Topology::group_corners() {
  vertex_corner_offsets_.assign(std::size_t{vertex_count_} + 1, 0);
  for (const Index v : triangles_) ++vertex_corner_offsets_[v + 1];
  accumulate(vertex_corner_offsets_);
  scatter(
      triangles_.size(), [&](Count h) { return triangles_[h]; },
      [](Count h) { return static_cast<Index>(h); }, vertex_corner_offsets_, vertex_corners_);
}

void Topology::group_edges() {
  vertex_edge_offsets_.assign(std::size_t{vertex_count_} + 1, 0);
  for (const auto& ends : edge_vertices_) {
    ++vertex_edge_offsets_[ends[0] + 1];
    ++vertex_edge_offsets_[ends[1] + 1];
  }
  accumulate(vertex_edge_offsets_);
  scatter(
      Count{2} * edge_count(), [&](Count k) { return edge_vertices_[k / 2][k % 2]; },
      [](Count k) { return static_cast<Index>(k / 2); }, vertex_edge_offsets_, vertex_edges_);
}

// Whether the walk from the first corner round the vertex, or to the border on both sides, meets them all.
bool Topology::is_one_fan(std::span<const Index> corners) const {
  const Index start = corners[0];
  std::size_t count = 0;
  Index h = start;
  do {
    ++count;
    h = mates_[prev(h)];
  } while (h != kNoIndex && h != start);
  if (h == kNoIndex)
    for (h = mates_[start]; h != kNoIndex; h = mates_[next(h)]) ++count;
  return count == corners.size();
}

void Topology::find_non_manifold_vertices() {
  non_manifold_vertices_.assign(vertex_count_, 0);
  for (Index e = 0; e < edge_count(); ++e)
    if (is_non_manifold_edge(e)) {
      non_manifold_vertices_[edge_vertices_[e][0]] = 1;
      non_manifold_vertices_[edge_vertices_[e][1]] = 1;
    }
  for (Index v = 0; v < vertex_count_; ++v) {
    const auto corners = vertex_corners(v);
    if (!corners.empty() && non_manifold_vertices_[v] == 0) non_manifold_vertices_[v] = !is_one_fan(corners);
  }
}

}  // namespace subdivd
