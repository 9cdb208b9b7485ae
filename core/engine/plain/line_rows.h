#pragma once
// The masks of a scheme of quads that interpolates along the lines of the net, written as rows: of a step, and of
// tangents.
//
// Splits, sharpness and channels are those of Split::quads (split.h, level.h). Creases are borders, edges that are not
// manifold, and infinitely sharp ones; CreaseCurves says what a vertex is. A line that meets a vertex on a crease, or
// at the end of one, goes on behind it by 2 v - w, as a pinned curve does; what lies across a crease likewise. At a
// vertex inside of two edges, which has no source, a line goes on along the other one.

#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <vector>

#include "core/engine/plain/crease_curves.h"
#include "core/engine/plain/sectors.h"
#include "core/engine/plain/step_rows.h"
#include "core/schemes/scheme.h"

namespace subdivd::plain {

template <HasLineMasks Scheme>
class LineRows {
 public:
  LineRows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace)
      : scheme_(scheme),
        old_(level.faces),
        linear_(linear || level.linear),
        crossed_(crossed_edges(level.faces, level.sharpness, pace)),
        sectors_(level.faces, crossed_, pace),
        creases_(level, crossed_, pace),
        maker_(level.faces.vertex_count(), pace),
        pace_(pace) {
    if (!linear_) sum_rings();
  }

  StepRows step() {
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      maker_.add(v, 1);
      maker_.end_row();
    });
    pace_.for_each(old_.edge_count(), [&](Index e) {
      add_edge_point(e, 1);
      maker_.end_row();
    });
    pace_.for_each(old_.face_count(), [&](Index f) {
      add_face_point(f);
      maker_.end_row();
    });
    return maker_.take();
  }

  StepRows tangents() {
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      const bool known = has_tangents(v);
      for (const Index direction : {0u, 1u}) {
        if (known) add_tangent(v, direction);
        maker_.end_row();
      }
    });
    return maker_.take();
  }

 private:
  static constexpr double kTension = Scheme::tension;
  static constexpr Index kRegular = 4;

  // Corner j of a sector: the other end of its edge, and what lies opposite in its face.
  Index end_of(Index s, Index j) const { return old_.corner_vertex(old_.next(sectors_.corners(s)[j])); }
  Index opposite(Index s, Index j) const {
    return old_.corner_vertex(old_.next(old_.next(sectors_.corners(s)[j])));
  }

  // Of every large ring: the sum of its ends, and of its opposite corners.
  void sum_rings() {
    pace_.fill(sums_, sectors_.count(), kNoIndex);
    pace_.for_each(sectors_.count(), [&](Index s) {
      const Index n = sectors_.size(s);
      if (n <= kShortRow || !is_inside(sectors_.corners(s)[0])) return;
      for (Index j = 0; j < n; ++j) maker_.add_to_sum(end_of(s, j), 1);
      sums_[s] = maker_.end_sum();
      for (Index j = 0; j < n; ++j) maker_.add_to_sum(opposite(s, j), 1);
      maker_.end_sum();
    });
  }

  bool is_inside(Index h) const { return creases_.kind(old_.corner_vertex(h)) == PointKind::inside; }

  // Where the line along h, coming from its far end, goes on behind the vertex that h leaves.
  void add_extension(Index h, double weight) {
    const Index v = old_.corner_vertex(h);
    if (!is_inside(h)) {
      maker_.add(v, 2 * weight);
      maker_.add(old_.corner_vertex(old_.next(h)), -weight);
      return;
    }
    const Index s = sectors_.of_corner(h), n = sectors_.size(s), i = sectors_.position(h);
    if (n == 2 || n == kRegular) return maker_.add(end_of(s, (i + n / 2) % n), weight);
    const ExtensionMask mask = scheme_.extension_mask(n);
    // Steps forwards only, so that they stay in range.
    for (const Index steps : {n - 1, n, n + 1})
      maker_.add(end_of(s, (i + steps) % n), weight * mask.near_ends);
    for (const Index steps : {2 * n - 2, 2 * n - 1, 2 * n, 2 * n + 1})
      maker_.add(opposite(s, (i + steps) % n), weight * mask.near_faces);
    if (sums_[s] != kNoIndex) {
      maker_.add_sum(sums_[s], weight * mask.all_ends);
      maker_.add_sum(sums_[s] + 1, weight * mask.all_faces);
      return;
    }
    for (Index j = 0; j < n; ++j) {
      maker_.add(end_of(s, j), weight * mask.all_ends);
      maker_.add(opposite(s, j), weight * mask.all_faces);
    }
  }

  void add_edge_point(Index e, double weight) {
    const auto [a, b] = old_.edge_vertices(e);
    if (linear_) {
      maker_.add(a, weight / 2);
      maker_.add(b, weight / 2);
      return;
    }
    if (crossed_[e] == 0) return creases_.add_four_point(a, b, kTension, weight, maker_);
    for (const Index h : old_.edge_half_edges(e)) {
      maker_.add(old_.corner_vertex(h), weight * (1.0 / 2 + kTension));
      add_extension(h, -weight * kTension);
    }
  }

  // From the edge points of two opposite edges and those beyond, in both directions.
  void add_face_point(Index f) {
    assert(old_.face_size(f) == 4);
    const Index begin = old_.face_begin(f);
    if (linear_) {
      for (Index k = 0; k < 4; ++k) maker_.add(old_.corner_vertex(begin + k), 1.0 / 4);
      return;
    }
    constexpr double kNear = (1.0 / 2 + kTension) / 2, kFar = -kTension / 2;  // half of either direction
    for (Index k = 0; k < 4; ++k) {
      const Index h = begin + k, e = old_.half_edge_edge(h);
      add_edge_point(e, kNear);
      if (crossed_[e] != 0) {
        add_edge_point(old_.half_edge_edge(old_.next(old_.next(old_.mate(h)))), kFar);
      } else {
        add_edge_point(e, 2 * kFar);
        add_edge_point(old_.half_edge_edge(begin + (k + 2) % 4), -kFar);
      }
    }
  }

  bool is_regular(Index v) const {
    return creases_.kind(v) == PointKind::inside && old_.vertex_corners(v).size() == kRegular;
  }

  // Around corner h of a vertex v inside, the neighbours of whose face are regular: see TwoRingMask.
  struct Around {
    Index end, face, behind, beside, beyond, across;
  };
  // kNoIndex where a vertex of the first ring is not regular.
  Around around(Index h) const {
    const Index far = old_.mate(h), back = old_.next(old_.next(h));
    Around found{old_.corner_vertex(far), old_.corner_vertex(back), kNoIndex, kNoIndex, kNoIndex, kNoIndex};
    if (!is_regular(found.end) || !is_regular(found.face)) return found;
    const Index at_end = sectors_.of_corner(far), to_v = sectors_.position(far);
    found.behind = end_of(at_end, (to_v + 2) % 4);
    found.beside = opposite(at_end, (to_v + 2) % 4);
    const Index at_face = sectors_.of_corner(back), to_next = sectors_.position(back);
    found.beyond = opposite(at_face, (to_next + 2) % 4);
    found.across = end_of(at_face, (to_next + 3) % 4);
    return found;
  }

  // A regular vertex inside whose neighbours are; another one where all of the two rings is regular but that.
  bool has_tangents(Index v) const {
    if (linear_ || creases_.kind(v) != PointKind::inside) return false;
    if (is_regular(v)) {
      for (const Index e : old_.vertex_edges(v))
        if (!is_regular(old_.other_end(e, v))) return false;
      return true;
    }
    const auto corners = old_.vertex_corners(v);
    if (corners.size() < 3) return false;
    for (const Index h : corners) {
      pace_.spend(8);
      const Around ring = around(h);
      for (const Index u : {ring.behind, ring.beside, ring.across})
        if (u == kNoIndex || !is_regular(u)) return false;
    }
    return true;
  }

  // Of an extraordinary vertex: cosine, then sine.
  void add_wave_tangent(Index v, bool sine) {
    const Index s = sectors_.of_corner(old_.vertex_corners(v)[0]), n = sectors_.size(s);
    auto found = tangent_masks_.find(n);
    if (found == tangent_masks_.end()) found = tangent_masks_.emplace(n, scheme_.tangent_mask(n)).first;
    const TwoRingMask& mask = found->second;
    for (Index j = 0; j < n; ++j) {
      pace_.spend(16);
      const std::complex<double> turn = std::polar(1.0, -2 * std::numbers::pi * j / n);
      const Around ring = around(sectors_.corners(s)[j]);
      const auto add = [&](Index u, std::complex<double> weight) {
        maker_.add(u, sine ? -(weight * turn).imag() : (weight * turn).real());
      };
      add(ring.end, mask.end);
      add(ring.face, mask.face);
      add(ring.behind, mask.behind);
      add(ring.beside, mask.beside);
      add(ring.beyond, mask.beyond);
      add(ring.across, mask.across);
    }
  }

  // Along the lines: half of l_0 - l_2 less 2 w times half of m_0 - m_2, m being behind l.
  //   [DynGregoryLevin87; core/curves/four_point.h]
  void add_tangent(Index v, Index direction) {
    if (!is_regular(v)) return add_wave_tangent(v, direction == 1);
    const Index s = sectors_.of_corner(old_.vertex_corners(v)[0]);
    for (const Index side : {0u, 1u}) {
      const Index h = sectors_.corners(s)[direction + 2 * side];
      const double weight = (side == 0 ? 1.0 : -1.0) / (2 * (1 - 4 * kTension));
      maker_.add(old_.corner_vertex(old_.next(h)), weight);
      // m: from the far end of h, two corners on around that.
      const Index far = old_.mate(h), s_far = sectors_.of_corner(far);
      maker_.add(end_of(s_far, (sectors_.position(far) + 2) % 4), -2 * kTension * weight);
    }
  }

  const Scheme& scheme_;
  const Adjacency& old_;
  bool linear_;
  std::vector<unsigned char> crossed_;
  Sectors sectors_;
  CreaseCurves creases_;
  RowMaker maker_;
  const Pace& pace_;
  std::vector<Index> sums_;                     // the first sum of a sector; kNoIndex: it has none
  std::map<Index, TwoRingMask> tangent_masks_;  // by valence; each takes thousands of operations
};

// The values of the next level's vertices (split.h) from those of `level`'s, whose faces are quads. Vertices are their own
// limits.
template <HasLineMasks Scheme>
StepRows step_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return LineRows(scheme, level, linear, pace).step();
}

// Two rows for every vertex of `level`: tangents whose cross product points outwards. Of a regular vertex inside among such:
// derivatives along its lines, an edge being one long, halved by every step. Of another vertex inside, where its two
// rings are regular (from the second step on all are): waves, which a step makes shorter by the subdominant eigenvalue.
// Elsewhere both are empty.
template <HasLineMasks Scheme>
StepRows tangent_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return LineRows(scheme, level, linear, pace).tangents();
}

}  // namespace subdivd::plain
