#include "core/engine/plain/centroid_split.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace subdivd::plain {

CentroidNumbers::CentroidNumbers(const Level& level, const Pace& pace) {
  const Adjacency& faces = level.faces;
  pace.fill(crease, faces.edge_count(), static_cast<unsigned char>(0));
  pace.fill(edge_points, faces.edge_count(), kNoIndex);
  pace.fill(face_points, faces.face_count(), kNoIndex);
  pace.fill(face_creases, faces.face_count(), kNoIndex);
  vertex_count = faces.vertex_count();
  pace.for_each(faces.edge_count(), [&](Index e) {
    const auto along = faces.edge_half_edges(e);
    crease[e] = is_infinite(level.sharpness.edges[e]) || faces.mate(along[0]) == kNoIndex;
    if (crease[e] == 0 || !level.thirds_next) return;
    edge_points[e] = vertex_count;
    vertex_count += 2;
    pace.spend(along.size());
    for (const Index h : along) {
      assert(face_creases[faces.face_of(h)] == kNoIndex);  // a first step leaves one to a face
      face_creases[faces.face_of(h)] = h;
    }
  });
  pace.for_each(faces.face_count(), [&](Index f) {
    assert(faces.face_size(f) == 3);
    if (face_creases[f] == kNoIndex) face_points[f] = vertex_count++;
  });
}

namespace {

class Splitter {
 public:
  Splitter(const Level& level, const Pace& pace)
      : level_(level), old_(level.faces), pace_(pace), numbers_(level, pace) {}

  Level run() {
    number_edges();
    corners_.reserve(Count{3} * old_.half_edge_count());
    edges_.reserve(Count{3} * old_.half_edge_count());
    pace_.for_each(old_.half_edge_count(), [&](Index h) {
      pace_.spend(12);
      if (numbers_.crease[old_.half_edge_edge(h)] != 0)
        add_beside_crease(h);
      else
        add_across(h, old_.mate(h));
    });
    std::vector<Index> begins;
    pace_.fill(begins, Count{old_.half_edge_count()} + 1, Index{0});
    pace_.for_each(begins.size(), [&](Count f) { begins[f] = static_cast<Index>(3 * f); });
    Adjacency faces(numbers_.vertex_count, Polygons(std::move(begins), std::move(corners_), pace_),
                    std::move(edges_), std::move(ends_), pace_);
    Sharpness sharpness = next_sharpness(faces);
    Level next = first_level(std::move(faces), std::move(sharpness), CreaseMethod::uniform, pace_);
    next.linear = level_.linear;
    next.linear_borders = level_.linear_borders;
    next.thirds_next = !level_.thirds_next;
    return next;
  }

 private:
  bool is_second() const { return level_.thirds_next; }
  Index vertex(Index h) const { return old_.corner_vertex(h); }
  Index edge(Index h) const { return old_.half_edge_edge(h); }
  Index crease_of(Index h) const { return numbers_.face_creases[old_.face_of(h)]; }

  // The point that the edge of crossed half-edge h is flipped to, on h's side.
  Index point(Index h) const {
    const Index k = crease_of(h);
    if (k == kNoIndex) return numbers_.face_points[old_.face_of(h)];
    return numbers_.near(old_, edge(k), vertex(h == old_.next(k) ? h : k));
  }

  Index add_edge(Index a, Index b) {
    ends_.push_back({std::min(a, b), std::max(a, b)});
    return static_cast<Index>(ends_.size() - 1);
  }

  // New edges: from corners to the points of their faces (of a face with a crease that has points, from its tip to
  // those: under the half-edge along the crease the one to the point at its beginning, under the next half-edge
  // the other); then in the place of every old edge; then the outer thirds of creases.
  void number_edges() {
    pace_.fill(of_corner_, old_.half_edge_count(), kNoIndex);
    pace_.for_each(old_.half_edge_count(), [&](Index h) {
      const Index k = crease_of(h);
      if (k == kNoIndex)
        of_corner_[h] = add_edge(vertex(h), numbers_.face_points[old_.face_of(h)]);
      else if (h != old_.prev(k))
        of_corner_[h] = add_edge(vertex(old_.prev(k)), numbers_.near(old_, edge(k), vertex(h)));
    });
    of_edges_ = static_cast<Index>(ends_.size());
    pace_.for_each(old_.edge_count(), [&](Index e) {
      const auto along = old_.edge_half_edges(e);
      const Index points = numbers_.edge_points[e];
      if (numbers_.crease[e] == 0)
        add_edge(point(along[0]), point(along[1]));
      else if (points != kNoIndex)
        add_edge(points, points + 1);
      else
        add_edge(old_.edge_vertices(e)[0], old_.edge_vertices(e)[1]);
    });
    pace_.fill(outer_, is_second() ? old_.edge_count() : 0, kNoIndex);
    pace_.for_each(outer_.size(), [&](std::size_t k) {
      const auto e = static_cast<Index>(k);
      if (numbers_.crease[e] == 0) return;
      outer_[e] = add_edge(old_.edge_vertices(e)[0], numbers_.edge_points[e]);
      add_edge(old_.edge_vertices(e)[1], numbers_.edge_points[e] + 1);
    });
  }

  Index outer_third(Index e, Index v) const { return outer_[e] + (old_.edge_vertices(e)[0] == v ? 0 : 1); }

  // The edge between the point of crossed half-edge h and the vertex where h begins, or ends.
  Index edge_at_begin(Index h) const {
    const Index k = crease_of(h);
    if (k == kNoIndex) return of_corner_[h];
    return h == old_.next(k) ? outer_third(edge(k), vertex(h)) : of_corner_[k];
  }
  Index edge_at_end(Index h) const {
    const Index k = crease_of(h);
    if (k == kNoIndex) return of_corner_[old_.next(h)];
    return h == old_.next(k) ? of_corner_[h] : outer_third(edge(k), vertex(k));
  }

  void add_across(Index h, Index mate) {
    corners_.insert(corners_.end(), {vertex(h), point(mate), point(h)});
    edges_.insert(edges_.end(), {edge_at_end(mate), of_edges_ + edge(h), edge_at_begin(h)});
  }

  void add_beside_crease(Index h) {
    const Index next = old_.next(h), e = edge(h);
    if (is_second())
      corners_.insert(corners_.end(), {numbers_.near(old_, e, vertex(h)),
                                       numbers_.near(old_, e, vertex(next)), vertex(old_.prev(h))});
    else
      corners_.insert(corners_.end(), {vertex(h), vertex(next), numbers_.face_points[old_.face_of(h)]});
    edges_.insert(edges_.end(), {of_edges_ + e, of_corner_[next], of_corner_[h]});
  }

  Sharpness next_sharpness(const Adjacency& faces) const {
    Sharpness next;
    pace_.fill(next.edges, faces.edge_count(), 0.0f);
    pace_.fill(next.vertices, faces.vertex_count(), 0.0f);
    pace_.for_each(old_.vertex_count(), [&](Index v) { next.vertices[v] = level_.sharpness.vertices[v]; });
    pace_.for_each(old_.edge_count(), [&](Index e) {
      if (numbers_.crease[e] == 0) return;
      next.edges[of_edges_ + e] = kInfiniteSharpness;
      if (!is_second()) return;
      next.edges[outer_[e]] = next.edges[outer_[e] + 1] = kInfiniteSharpness;
      if (level_.linear_borders && old_.edge_half_edges(e).size() == 1)
        for (const Index end : {0u, 1u}) next.vertices[numbers_.edge_points[e] + end] = kInfiniteSharpness;
    });
    return next;
  }

  const Level& level_;
  const Adjacency& old_;
  const Pace& pace_;
  CentroidNumbers numbers_;
  std::vector<Index> of_corner_, outer_;
  Index of_edges_ = 0;
  std::vector<std::array<Index, 2>> ends_;
  std::vector<Index> corners_, edges_;
};

}  // namespace

Level next_level_by_centroids(const Level& level, const Pace& pace) { return Splitter(level, pace).run(); }

}  // namespace subdivd::plain
