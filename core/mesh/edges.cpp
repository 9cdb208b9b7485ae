#include "core/mesh/edges.h"

#include <algorithm>
#include <utility>

namespace subdivd {
namespace {

// Between two polls of the budget: a millisecond, or some where vertices have many edges.
constexpr Index kHalfEdgesPerPoll = 3 << 14;

// A vertex of more corners keeps no edges: a hub of a million edges must not cost a million steps for each.
constexpr Index kMostCorners = 64;

// Every edge is kept at one of its ends, its home: the lower-numbered one, unless that is a hub. A home has
// slots in one cache line, and the other end's number says in which to look first. There is no jump that
// depends on whether a half-edge is the first along its edge or the second: that is a coin toss.
template <class Faces>
class EdgeFinder {
 public:
  EdgeFinder(Index vertex_count, const Faces& faces, std::span<const Index> corner_offsets, const Pace& pace)
      : faces_(faces),
        corners_(faces.corners()),
        corner_offsets_(corner_offsets),
        pace_(pace),
        // A mesh of mostly unused points goes the slow way: its homes would be many times its size.
        homes_(vertex_count <= corners_.size() ? vertex_count : 0) {
    pace.for_each(homes_.size(), [&](std::size_t v) {
      for (Slot& slot : homes_[v].slots) slot = {kNoIndex, kNoIndex};
    });
    edges_.of_half_edges.resize(corners_.size());
    // Room for as many borders as most meshes have.
    make_room(corners_.size() / 2 + corners_.size() / 16 + kAtOnce);
  }

  Edges run() {
    mark_hubs();
    constexpr Index kStride = kHalfEdgesPerPoll / kAtOnce * kAtOnce;
    const auto end = static_cast<Index>(corners_.size());
    for (Index begin = 0; begin < end; begin += std::min(kStride, end - begin)) {
      pace_.spend(kStride);
      join_half_edges(begin, begin + std::min(kStride, end - begin));
    }
    edges_.vertices.resize(count_);
    edges_.sides.resize(count_);
    edges_.set_kinds(pace_);
    return std::move(edges_);
  }

 private:
  // Half-edges that need no look at the room that is left, nor for their ends: a whole face where all are of
  // one size.
  static constexpr Index kAtOnce = [] {
    if constexpr (requires { Faces::size; }) return Faces::size;
    return Index{1};
  }();
  static constexpr unsigned kSlots = 8;
  struct Slot {
    Index far, edge;  // far: the edge's other end; kNoIndex: free
  };
  struct alignas(64) Home {
    Slot slots[kSlots];
  };
  static constexpr Index kNowhere = kNoIndex - 1;

  static unsigned first_slot(Index far) { return far * 0x9e3779b1u >> 29; }

  void make_room(Count edges) {
    for (auto* array : {&edges_.vertices, &edges_.sides}) {
      Buffer<std::array<Index, 2>> larger(edges);
      pace_.in_blocks(array->size(), [&](Count begin, Count end) {
        std::copy_n(array->begin() + static_cast<std::ptrdiff_t>(begin), end - begin,
                    larger.begin() + static_cast<std::ptrdiff_t>(begin));
      });
      *array = std::move(larger);
    }
  }

  // Half-edges [begin, end).
  [[gnu::noinline]] void join_half_edges(Index begin, Index end) {
    if (homes_.empty()) {
      for (Index h = begin; h < end; ++h) {
        if (count_ == edges_.vertices.size()) make_room(edges_.vertices.size() * 3 / 2 + kAtOnce);
        const Index a = corners_[h], b = end_of(h);
        count_ = join_elsewhere(count_, h, a, std::min(a, b), std::max(a, b));
      }
      return;
    }
    for (Index h = begin; h < end;) {
      // Arrays by their addresses and the count in a register: the compiler cannot know that what is written
      // to the ones changes none of the others.
      const Fast fast{corners_.data(), homes_.data(), edges_.of_half_edges.data(), edges_.vertices.data(),
                      edges_.sides.data()};
      const Count room = edges_.vertices.size() - kAtOnce;
      Index count = count_;
      for (; h < end && count <= room; h += kAtOnce) count = join_at_once(fast, count, h);
      count_ = count;
      if (count > room) make_room(edges_.vertices.size() * 3 / 2 + kAtOnce);
    }
  }

  struct Fast {
    const Index* corners;
    Home* homes;
    Index* of_half_edges;
    std::array<Index, 2>*vertices, *sides;
  };
  // Joins the kAtOnce half-edges from h on.
  [[gnu::always_inline]] inline Index join_at_once(const Fast& fast, Index count, Index h) {
    if constexpr (kAtOnce == 1) {
      return join(fast, count, h, fast.corners[h], end_of(h));
    } else {
      std::array<Index, kAtOnce> v;
      for (Index k = 0; k < kAtOnce; ++k) v[k] = fast.corners[h + k];
      return [&]<std::size_t... k>(std::index_sequence<k...>) {
        ((count = join(fast, count, h + k, v[k], v[(k + 1) % kAtOnce])), ...);
        return count;
      }
      (std::make_index_sequence<kAtOnce>());
    }
  }
  // Half-edge h runs from a to b; returns the number of edges after it. Choices are made by masks, for the
  // compiler would make them by jumps.
  [[gnu::always_inline]] inline Index join(const Fast& fast, Index count, Index h, Index a, Index b) {
    const Index low = std::min(a, b), high = std::max(a, b);
    Slot* slot = &fast.homes[low].slots[first_slot(high)];
    // One in eight or so is taken by another edge.
    if ((slot->far != high) & (slot->far != kNoIndex)) [[unlikely]] {
      slot = next_slot(fast.homes[low], high);
      if (slot == nullptr) return join_elsewhere(count, h, a, low, high);
    }
    const Index is_new = slot->far != high, found = is_new - 1;  // found: all bits or none
    // As if the edge were new; if it is not, the next new one overwrites this.
    fast.vertices[count] = {low, high};
    fast.sides[count] = {kNoIndex, kNoIndex};
    const Index e = (slot->edge & found) | (count & ~found);
    Index& side = fast.sides[e][a > b];
    fast.of_half_edges[h] = e;
    if (side != kNoIndex) [[unlikely]] {
      if (edges_.non_manifold.empty() || edges_.non_manifold.back() != e) edges_.non_manifold.push_back(e);
      return count;
    }
    side = h;
    *slot = {high, e};
    return count + is_new;
  }

  // The edge's slot, or a free one, or null when there is neither.
  static Slot* next_slot(Home& home, Index far) {
    unsigned at = first_slot(far);
    for (unsigned k = 0; k < kSlots; ++k, at = (at + 1) % kSlots)
      if (home.slots[at].far == far || home.slots[at].far == kNoIndex) return &home.slots[at];
    return nullptr;
  }

  // The home has no slot left, or is a hub.
  Index join_elsewhere(Index count, Index h, Index from, Index low, Index high) {
    count_ = count;
    const Index e = edge_elsewhere(h, low, high);
    if (e == count) {
      edges_.vertices[e] = {low, high};
      edges_.sides[e] = {kNoIndex, kNoIndex};
      ++count;
    }
    edges_.of_half_edges[h] = e;
    edges_.attach(h, from, e);
    return count;
  }
  Index edge_elsewhere(Index h, Index low, Index high) {
    if (!is_hub(low)) return edge_at(low, high);
    if (!is_hub(high)) return edge_at(high, low);
    const Index first = first_along_[next_between_hubs_++];  // half-edges come in ascending order
    return first == h ? count_ : edges_.of_half_edges[first];
  }
  Index edge_at(Index home, Index far) {
    if (Slot* slot = homes_.empty() ? nullptr : next_slot(homes_[home], far)) {
      if (slot->far == kNoIndex) *slot = {far, count_};
      return slot->edge;
    }
    if (chains_.empty()) pace_.fill(chains_, vertex_count(), kNoIndex);
    for (Index k = chains_[home]; k != kNoIndex; k = more_[k].next)
      if (more_[k].far == far) return more_[k].edge;
    more_.push_back({far, count_, chains_[home]});
    chains_[home] = static_cast<Index>(more_.size() - 1);
    return count_;
  }

  // The vertex that half-edge h enters.
  Index end_of(Index h) const { return corners_[faces_.next(h)]; }
  std::size_t vertex_count() const { return corner_offsets_.size() - 1; }
  bool is_hub(Index v) const { return corner_offsets_[v + 1] - corner_offsets_[v] > kMostCorners; }
  // A hub's slots are all taken, by edges to nowhere.
  void mark_hubs() {
    Count hubs = 0;
    pace_.for_each(static_cast<Index>(vertex_count()), [&](Index v) {
      if (!is_hub(v)) return;
      ++hubs;
      if (homes_.empty()) return;
      for (Slot& slot : homes_[v].slots) slot.far = kNowhere;
    });
    if (hubs > 1) match_between_hubs();
  }
  // Calls f(half-edge, lower end, higher end) for those between two hubs, ascending.
  template <class F>
  void for_each_between_hubs(F&& f) const {
    pace_.for_each(static_cast<Index>(corners_.size()), [&](Index h) {
      const Index a = corners_[h], b = end_of(h);
      if (is_hub(a) && is_hub(b)) f(h, std::min(a, b), std::max(a, b));
    });
  }
  // Sorts them by counting, by their higher ends and then by their lower ones.
  void match_between_hubs() {
    Buffer<Index> half_edges, order, by_end, ends;
    Count count = 0;
    for_each_between_hubs([&](Index, Index, Index) { ++count; });
    half_edges.reserve(count);
    for_each_between_hubs([&](Index h, Index, Index) { half_edges.push_back(h); });
    const auto low = [&](Index k) { return std::min(corners_[half_edges[k]], end_of(half_edges[k])); };
    const auto high = [&](Index k) { return std::max(corners_[half_edges[k]], end_of(half_edges[k])); };
    order.reserve(count);
    pace_.for_each(static_cast<Index>(count), [&](Index k) { order.push_back(k); });
    by_end.resize(count);
    const auto sort_by = [&](auto&& key) {
      pace_.fill(ends, vertex_count() + 1, 0);
      pace_.for_each(count, [&](Count k) { ++ends[key(order[k]) + 1]; });
      pace_.for_each(vertex_count(), [&](Count v) { ends[v + 1] += ends[v]; });
      pace_.for_each(count, [&](Count k) { by_end[ends[key(order[k])]++] = order[k]; });
      order.swap(by_end);
    };
    sort_by(high);
    sort_by(low);
    first_along_.resize(count);
    Index first = 0;  // of those along the same edge
    pace_.for_each(count, [&](Count at) {
      const Index k = order[at];
      if (at == 0 || low(k) != low(first) || high(k) != high(first)) first = k;
      first_along_[k] = half_edges[first];
    });
  }

  const Faces& faces_;
  std::span<const Index> corners_, corner_offsets_;
  const Pace& pace_;
  Edges edges_;
  Index count_ = 0;
  Buffer<Home> homes_;  // per vertex
  struct More {
    Index far, edge, next;
  };
  std::vector<Index> chains_;  // per vertex, once one has more edges than slots: the last of them in more_
  std::vector<More> more_;
  // Of every half-edge between two hubs, ascending: the lowest one along the same edge.
  Buffer<Index> first_along_;
  std::size_t next_between_hubs_ = 0;
};

}  // namespace

void Edges::attach(Index h, Index from, Index e) {
  Index& side = sides[e][from == vertices[e][0] ? 0 : 1];
  if (side == kNoIndex)
    side = h;
  else if (non_manifold.empty() || non_manifold.back() != e)
    non_manifold.push_back(e);
}

void Edges::set_kinds(const Pace& pace) {
  kinds.resize(sides.size());
  pace.for_each(kinds.size(), [&](std::size_t e) {
    // One comparison and no jump: kNoIndex is above all half-edges.
    kinds[e] = std::max(sides[e][0], sides[e][1]) == kNoIndex ? EdgeKind::border : EdgeKind::manifold;
  });
  if (non_manifold.empty()) return;
  pace.for_each(non_manifold.size(), [&](std::size_t k) { kinds[non_manifold[k]] = EdgeKind::non_manifold; });
  non_manifold.clear();
  pace.for_each(count(), [&](Index e) {
    if (kinds[e] == EdgeKind::non_manifold) non_manifold.push_back(e);
  });
}

template <class Faces>
Edges find_edges(Index vertex_count, const Faces& faces, std::span<const Index> corner_offsets,
                 const Pace& pace) {
  return EdgeFinder(vertex_count, faces, corner_offsets, pace).run();
}

template Edges find_edges(Index, const Triangles&, std::span<const Index>, const Pace&);
template Edges find_edges(Index, const Quads&, std::span<const Index>, const Pace&);
template Edges find_edges(Index, const Polygons&, std::span<const Index>, const Pace&);

}  // namespace subdivd
