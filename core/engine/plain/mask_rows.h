#pragma once
// The masks of a scheme at one level, written as rows: which of the level's values make each of the next one's. The
// point of a face is a sum that the rows around it share: of a face of n corners each edge and vertex would else have n
// weights of its own, n^2 together.

#include <span>
#include <vector>

#include "core/engine/plain/level.h"
#include "core/engine/plain/split.h"
#include "core/engine/plain/step_rows.h"
#include "core/mesh/rings.h"
#include "core/mesh/sharpness.h"
#include "core/schemes/mask.h"

namespace subdivd::plain {

template <class Scheme>
class MaskRows {
 public:
  MaskRows(const Scheme& scheme, CreaseMethod method, const Level& level, bool linear, const Pace& pace)
      : scheme_(scheme),
        method_(method),
        level_(level),
        linear_(linear || level.linear),
        pace_(pace),
        maker_(level.faces.vertex_count(), pace) {}

  StepRows run() {
    if (kHasFacePoints) sum_large_faces();
    pace_.for_each(level_.faces.vertex_count(), [&](Index v) { add_vertex_point(v); });
    pace_.for_each(level_.faces.edge_count(), [&](Index e) { add_edge_point(e); });
    if (kHasFacePoints)
      pace_.for_each(level_.faces.face_count(), [&](Index f) {
        add_face_point(f, 1);
        maker_.end_row();
      });
    return maker_.take();
  }

 private:
  static constexpr bool kHasFacePoints = Scheme::split == Split::quads;
  static constexpr Index kFewCorners = 4;  // of a face whose corners rows take one by one

  void sum_large_faces() {
    pace_.fill(sums_, level_.faces.face_count(), kNoIndex);
    pace_.for_each(level_.faces.face_count(), [&](Index f) {
      const Index begin = level_.faces.face_begin(f), size = level_.faces.face_size(f);
      if (size <= kFewCorners) return;
      for (Index k = 0; k < size; ++k) maker_.add_to_sum(level_.faces.corner_vertex(begin + k), 1.0 / size);
      sums_[f] = maker_.end_sum();
    });
  }

  VertexMask vertex_mask(Index v) {
    if (linear_) return {};  // v stays
    sharpness_.clear();
    child_sharpness_.clear();
    for (const Index e : level_.faces.vertex_edges(v)) {
      sharpness_.push_back(level_.sharpness.edges[e]);
      child_sharpness_.push_back(level_.halves[e][half_at(level_.faces, e, v)]);
    }
    const float own = level_.sharpness.vertices[v];
    return scheme_.vertex_mask({static_cast<Index>(level_.faces.vertex_corners(v).size()), method_, own,
                                decay(own), sharpness_, child_sharpness_});
  }

  void add_vertex_point(Index v) {
    const auto edges = level_.faces.vertex_edges(v);
    pace_.spend(edges.size());
    const VertexMask mask = vertex_mask(v);
    if (mask.each != 0)
      for (const Index e : edges) maker_.add(level_.faces.other_end(e, v), mask.each);
    if (mask.crease != 0)
      for (const Index end : mask.crease_ends) maker_.add(level_.faces.other_end(edges[end], v), mask.crease);
    maker_.add(v, mask.self);
    if (mask.face != 0)
      for (const Index h : level_.faces.vertex_corners(v)) add_face_point(level_.faces.face_of(h), mask.face);
    maker_.end_row();
  }

  EdgeMask edge_mask(Index e, std::span<const Index> along) const {
    if (linear_) return {};  // the midpoint
    EdgeRing ring{static_cast<Index>(along.size()),
                  level_.sharpness.edges[e],
                  {level_.halves[e][0], level_.halves[e][1]}};
    if (kHasFacePoints)
      for (const Index h : along) ring.triangle_count += level_.faces.face_size(level_.faces.face_of(h)) == 3;
    return scheme_.edge_mask(ring);
  }

  void add_edge_point(Index e) {
    const auto along = level_.faces.edge_half_edges(e);
    pace_.spend(along.size());
    const EdgeMask mask = edge_mask(e, along);
    if (mask.opposite != 0)
      for (const Index h : along) maker_.add(level_.faces.corner_vertex(level_.faces.prev(h)), mask.opposite);
    for (const Index v : level_.faces.edge_vertices(e)) maker_.add(v, mask.end);
    if (mask.face != 0)
      for (const Index h : along) add_face_point(level_.faces.face_of(h), mask.face);
    maker_.end_row();
  }

  // The mean of its vertices.
  void add_face_point(Index f, double weight) {
    if (sums_[f] != kNoIndex) return maker_.add_sum(sums_[f], weight);
    const Index begin = level_.faces.face_begin(f), size = level_.faces.face_size(f);
    for (Index k = 0; k < size; ++k) maker_.add(level_.faces.corner_vertex(begin + k), weight / size);
  }

  const Scheme& scheme_;
  CreaseMethod method_;
  const Level& level_;
  bool linear_;
  const Pace& pace_;
  RowMaker maker_;
  std::vector<Index> sums_;  // of faces, kNoIndex where there is none
  std::vector<float> sharpness_, child_sharpness_;
};

// As rows_of() of level.h, for a scheme that need not be on the list: HasSplit and HasMasks of scheme.h will do.
template <class Scheme>
StepRows rows_of(const Scheme& scheme, CreaseMethod method, const Level& level, bool linear,
                 const Pace& pace = {}) {
  return MaskRows(scheme, method, level, linear, pace).run();
}

}  // namespace subdivd::plain
