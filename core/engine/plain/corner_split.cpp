#include "core/engine/plain/corner_split.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "core/mesh/creases.h"

namespace subdivd::plain {
namespace {

class Splitter {
 public:
  Splitter(const Level& level, const Pace& pace) : level_(level), old_(level.faces), pace_(pace) {}

  CornerSplit run() {
    find_roles();
    find_sectors();
    place_corners();
    make_faces();
    return std::move(split_);
  }

 private:
  void find_roles() {
    pace_.fill(split_.roles, old_.edge_count(), EdgeRole::crossed);
    pace_.fill(split_.pinned, old_.vertex_count(), static_cast<unsigned char>(0));
    pace_.for_each(old_.edge_count(), [&](Index e) {
      if (is_infinite(level_.sharpness.edges[e]))
        split_.roles[e] = EdgeRole::curve;
      else if (old_.mate(old_.edge_half_edges(e)[0]) == kNoIndex)
        split_.roles[e] = EdgeRole::open;
    });
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      const auto edges = old_.vertex_edges(v);
      pace_.spend(edges.size());
      const auto curves =
          std::ranges::count_if(edges, [&](Index e) { return split_.roles[e] == EdgeRole::curve; });
      split_.pinned[v] = curves > 2 || is_infinite(level_.sharpness.vertices[v]);
    });
  }

  EdgeRole role(Index h) const { return split_.roles[old_.half_edge_edge(h)]; }

  void find_sectors() { split_.sectors = Sectors(old_, crossed_edges(old_, level_.sharpness, pace_), pace_); }

  // A sector's ends, which a closed one has not.
  bool begins_at_curve(Index s) const {
    return !split_.sectors.is_closed(s) && role(split_.sectors.corners(s).front()) == EdgeRole::curve;
  }
  bool ends_at_curve(Index s) const {
    return !split_.sectors.is_closed(s) &&
           role(old_.prev(split_.sectors.corners(s).back())) == EdgeRole::curve;
  }

  Index add_point(Index vertex, Index towards) {
    split_.more.push_back({vertex, towards});
    return old_.half_edge_count() + static_cast<Index>(split_.more.size() - 1);
  }

  void place_corners() {
    pace_.fill(split_.places, old_.half_edge_count(), CornerPlace::inside);
    leaving_.reserve(old_.half_edge_count());
    entering_.reserve(old_.half_edge_count());
    pace_.for_each(old_.half_edge_count(), [&](Index h) {
      leaving_.push_back(h);
      entering_.push_back(old_.next(h));
    });
    pace_.fill(pinned_point_, split_.sectors.count(), kNoIndex);
    pace_.for_each(split_.sectors.count(), [&](Index s) { place_sector(s); });
  }

  void place_sector(Index s) {
    const auto corners = split_.sectors.corners(s);
    const Index first = corners.front(), last = corners.back(), v = old_.corner_vertex(first);
    const bool closed = split_.sectors.is_closed(s), begins = begins_at_curve(s), ends = ends_at_curve(s);
    if (split_.pinned[v] != 0 && (closed || begins || ends)) {
      if (corners.size() == 1) {
        split_.places[first] = CornerPlace::at_vertex;
        return;
      }
      const Index point = pinned_point_[s] = add_point(v, kNoIndex);
      if (begins) leaving_[first] = point;
      if (ends) entering_[old_.prev(last)] = point;
    } else if (begins && ends && corners.size() == 1) {
      leaving_[first] = add_point(v, old_.corner_vertex(old_.next(first)));
      entering_[old_.prev(first)] = add_point(v, old_.corner_vertex(old_.prev(first)));
    } else {
      if (begins) split_.places[first] = CornerPlace::after;
      if (ends) split_.places[last] = CornerPlace::before;
    }
  }

  // Begins a face that comes from an old one.
  void begin_face(Index parent) {
    split_.face_parents.push_back(parent);
    pace_.spend(4);
  }
  // `curve`: whether the edge from this corner to the next one is.
  void add_corner(Index vertex, bool curve = false) {
    if (curve) curves_.push_back(static_cast<Index>(corners_.size()));
    corners_.push_back(vertex);
  }
  void end_face() { begins_.push_back(static_cast<Index>(corners_.size())); }
  void add_face(Index parent, std::initializer_list<Index> vertices) {
    begin_face(parent);
    for (const Index v : vertices) add_corner(v);
    end_face();
  }

  // Whether the corners of h and of the next are the points of the curve along h.
  bool is_on_curve(Index h) const {
    return role(h) == EdgeRole::curve && leaving_[h] == h && entering_[h] == old_.next(h);
  }
  // Two faces between curves: what would be a face between their corners is an edge of the curve.
  bool is_passed_by_curve(Index s) const {
    return split_.sectors.corners(s).size() == 2 && begins_at_curve(s) && ends_at_curve(s) &&
           pinned_point_[s] == kNoIndex;
  }

  void make_faces() {
    pace_.for_each(old_.face_count(), [&](Index f) {
      begin_face(f);
      for (Index h = old_.face_begin(f); h < old_.face_begin(f) + old_.face_size(f); ++h) {
        pace_.spend(1);
        add_corner(h, is_on_curve(h));
      }
      end_face();
    });
    pace_.for_each(old_.edge_count(), [&](Index e) {
      if (split_.roles[e] != EdgeRole::crossed) return;
      const Index h = old_.edge_half_edges(e)[0], m = old_.edge_half_edges(e)[1];
      begin_face(std::min(old_.face_of(h), old_.face_of(m)));
      add_corner(old_.next(h));
      add_corner(h, is_passed_by_curve(split_.sectors.of_corner(h)));
      add_corner(old_.next(m));
      add_corner(m, is_passed_by_curve(split_.sectors.of_corner(m)));
      end_face();
    });
    pace_.for_each(split_.sectors.count(), [&](Index s) { add_face_of_sector(s); });
    pace_.for_each(old_.half_edge_count(), [&](Index h) { fill_up_to_curve(h); });
    const Index vertices = old_.half_edge_count() + static_cast<Index>(split_.more.size());
    split_.faces = Adjacency(vertices, Polygons(std::move(begins_), std::move(corners_), pace_), pace_);
    set_sharpness();
  }

  Index lowest_face(std::span<const Index> corners) const {
    pace_.spend(corners.size());
    Index lowest = kNoIndex;
    for (const Index h : corners) lowest = std::min(lowest, old_.face_of(h));
    return lowest;
  }

  void add_face_of_sector(Index s) {
    const auto corners = split_.sectors.corners(s);
    const Index k = static_cast<Index>(corners.size()), point = pinned_point_[s], first = corners.front();
    const bool between_curves = begins_at_curve(s) && ends_at_curve(s);
    if (split_.sectors.is_closed(s)) {
      if (point != kNoIndex)
        for (Index i = 0; i < k; ++i) {
          const Index here = corners[i], next = corners[(i + 1) % k];
          add_face(std::min(old_.face_of(here), old_.face_of(next)), {point, here, next});
        }
      if (point != kNoIndex || k < 3) return;
    } else if (!between_curves || (point == kNoIndex && k == 2) ||
               split_.places[first] == CornerPlace::at_vertex) {
      return;
    } else if (k == 1) {
      begin_face(old_.face_of(first));
      add_corner(leaving_[first]);
      add_corner(first);
      add_corner(entering_[old_.prev(first)], true);
      end_face();
      return;
    }
    begin_face(lowest_face(corners));
    if (point != kNoIndex) add_corner(point);
    for (Index i = 0; i < k; ++i) {
      pace_.spend(1);
      add_corner(corners[i], between_curves && point == kNoIndex && i + 1 == k);
    }
    end_face();
  }

  void fill_up_to_curve(Index h) {
    const Index next = old_.next(h);
    if (role(h) != EdgeRole::curve || is_on_curve(h)) return;
    begin_face(old_.face_of(h));
    add_corner(next);
    add_corner(h, leaving_[h] == h);
    if (leaving_[h] != h) add_corner(leaving_[h], true);
    if (entering_[h] != next) add_corner(entering_[h]);
    end_face();
  }

  void set_sharpness() {
    pace_.fill(split_.sharpness.edges, split_.faces.edge_count(), 0.0f);
    pace_.fill(split_.sharpness.vertices, split_.faces.vertex_count(), 0.0f);
    pace_.for_each(curves_.size(), [&](std::size_t k) {
      split_.sharpness.edges[split_.faces.half_edge_edge(curves_[k])] = kInfiniteSharpness;
    });
    pace_.for_each(old_.half_edge_count(), [&](Index h) {
      if (split_.places[h] == CornerPlace::at_vertex) split_.sharpness.vertices[h] = kInfiniteSharpness;
    });
    pace_.for_each(split_.more.size(), [&](std::size_t k) {
      if (split_.more[k].towards == kNoIndex)
        split_.sharpness.vertices[old_.half_edge_count() + k] = kInfiniteSharpness;
    });
  }

  const Level& level_;
  const Adjacency& old_;
  const Pace& pace_;
  CornerSplit split_;
  // Of every half-edge along a curve: the new vertices of that curve at its beginning and at its end.
  std::vector<Index> leaving_, entering_;
  std::vector<Index> pinned_point_;  // of a sector; kNoIndex: none
  std::vector<Index> begins_ = {0}, corners_;
  std::vector<Index> curves_;  // new half-edges along curves
};

}  // namespace

CornerSplit split_corners(const Level& level, const Pace& pace) { return Splitter(level, pace).run(); }

Level next_level(CornerSplit split, const Pace& pace) {
  return first_level(std::move(split.faces), std::move(split.sharpness), CreaseMethod::uniform, pace);
}

void open_borders(Level& level, const Cage& cage, const Pace& pace) {
  struct Tag {
    VertexPair ends;
    Count order;
    bool infinite;
  };
  std::vector<Tag> tags;
  for_each_crease_edge(cage, [&](Count, Index a, Index b, float sharpness) {
    pace.spend(1);
    tags.push_back({{std::min(a, b), std::max(a, b)}, tags.size(), is_infinite(sharpness)});
  });
  pace.sort(tags.begin(), tags.end(), [](const Tag& a, const Tag& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.order < b.order;
  });
  pace.for_each(level.faces.edge_count(), [&](Index e) {
    if (level.faces.edge_half_edges(e).size() != 1) return;
    const VertexPair ends = level.faces.edge_vertices(e);
    const auto behind = std::ranges::upper_bound(tags, ends, {}, &Tag::ends);  // the last tag given holds
    if (behind != tags.begin() && std::prev(behind)->ends == ends && std::prev(behind)->infinite) return;
    level.sharpness.edges[e] = 0;
    level.halves[e] = {0, 0};
  });
}

}  // namespace subdivd::plain
