#pragma once
// The masks of a scheme of triangles that interpolates, written as rows: of a step, and of tangents.
//
// Splits, sharpness and channels are those of Split::triangles (split.h, level.h). Creases are borders, edges that are
// not manifold, and infinitely sharp ones; CreaseCurves says what a vertex is. For the choice of a mask a dart is a
// vertex inside; a corner has no rule of its own, as a regular vertex has none. A wing that would lie across a
// crease is where the parallelogram puts it: across (a, o) of the triangle (a, b, o) at a + o - b.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/engine/plain/crease_curves.h"
#include "core/engine/plain/sectors.h"
#include "core/engine/plain/step_rows.h"
#include "core/schemes/scheme.h"

namespace subdivd::plain {

template <HasRingMasks Scheme>
class RingRows {
 public:
  RingRows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace)
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
      add_edge_point(e);
      maker_.end_row();
    });
    return maker_.take();
  }

  StepRows tangents() {
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      const bool known = has_tangents(v);
      if (known) find_surroundings(v);
      for (const bool sine : {false, true}) {
        if (known) add_tangent(sine);
        maker_.end_row();
      }
    });
    return maker_.take();
  }

 private:
  // What a half-edge's vertex asks for.
  enum class Rule { none, ring, sector };
  Rule rule_at(Index h) const {
    const Index s = sectors_.of_corner(h), k = sectors_.size(s);
    switch (creases_.kind(old_.corner_vertex(h))) {
      case PointKind::inside:
      case PointKind::dart:
        return scheme_.is_regular(k) ? Rule::none : Rule::ring;
      case PointKind::crease:
        return scheme_.is_regular_sector(k) ? Rule::none : Rule::sector;
      case PointKind::corner:
        break;
    }
    return Rule::none;
  }

  // The other end of edge j of a sector, j being the number of corners for the last edge of an open one.
  Index end_of(Index s, Index j) const {
    const auto corners = sectors_.corners(s);
    return old_.corner_vertex(j < corners.size() ? old_.next(corners[j]) : old_.prev(corners.back()));
  }

  static double angle(Index j, Index n) { return 2 * std::numbers::pi * j / n; }

  // Of every large ring: the mean of its ends, and their first and second waves by cosine and sine, over n. Of every
  // large sector between creases: the sums of sin(pi j / k) e_j and of sin(2 pi j / k) e_j.
  void sum_rings() {
    pace_.fill(sums_, sectors_.count(), kNoIndex);
    pace_.for_each(sectors_.count(), [&](Index s) {
      const Index k = sectors_.size(s);
      if (k <= kShortRow) return;
      const Rule rule = rule_at(sectors_.corners(s)[0]);
      const auto sum = [&](Index first, auto&& weight) {
        for (Index j = first; j < k; ++j) maker_.add_to_sum(end_of(s, j), weight(j));
        return maker_.end_sum();
      };
      if (rule == Rule::ring) {
        sums_[s] = sum(0, [&](Index) { return 1.0 / k; });
        for (const Index wave : {1u, 2u}) {
          sum(0, [&](Index j) { return std::cos(wave * angle(j, k)) / k; });
          sum(0, [&](Index j) { return std::sin(wave * angle(j, k)) / k; });
        }
      } else if (rule == Rule::sector) {
        sums_[s] = sum(1, [&](Index j) { return std::sin(angle(j, k) / 2); });
        sum(1, [&](Index j) { return std::sin(angle(j, k)); });
      }
    });
  }

  // What the vertex of h makes of the edge of h.
  void add_by_ring(Index h, double weight) {
    const Index s = sectors_.of_corner(h), n = sectors_.size(s), i = sectors_.position(h);
    const WaveMask mask = scheme_.ring_mask(n);
    maker_.add(old_.corner_vertex(h), weight * mask.self);
    if (sums_[s] == kNoIndex) {
      for (Index j = 0; j < n; ++j) {
        const double a = angle(j >= i ? j - i : j + n - i, n);
        maker_.add(end_of(s, j),
                   weight * (mask.wave[0] + mask.wave[1] * std::cos(a) + mask.wave[2] * std::cos(2 * a)) / n);
      }
      return;
    }
    maker_.add_sum(sums_[s], weight * mask.wave[0]);
    for (const Index wave : {1u, 2u}) {
      maker_.add_sum(sums_[s] + 2 * wave - 1, weight * mask.wave[wave] * std::cos(wave * angle(i, n)));
      maker_.add_sum(sums_[s] + 2 * wave, weight * mask.wave[wave] * std::sin(wave * angle(i, n)));
    }
  }

  void add_by_sector(Index h, double weight) {
    const Index s = sectors_.of_corner(h), k = sectors_.size(s), i = sectors_.position(h);
    const SectorMask mask = scheme_.sector_mask(k, i);
    maker_.add(old_.corner_vertex(h), weight * mask.self);
    maker_.add(end_of(s, 0), weight * mask.first);
    maker_.add(end_of(s, k), weight * mask.last);
    if (sums_[s] != kNoIndex) {
      for (const Index wave : {0u, 1u}) maker_.add_sum(sums_[s] + wave, weight * mask.sine[wave]);
      return;
    }
    for (Index j = 1; j < k; ++j)
      maker_.add(end_of(s, j),
                 weight * (mask.sine[0] * std::sin(angle(j, k) / 2) + mask.sine[1] * std::sin(angle(j, k))));
  }

  void add_by(Rule rule, Index h, double weight) {
    if (rule == Rule::ring) add_by_ring(h, weight);
    if (rule == Rule::sector) add_by_sector(h, weight);
  }

  // The vertex across the edge of h, which is (a, o) or (o, b) of the face (a, b, o).
  void add_wing(Index h, double weight) {
    const Index e = old_.half_edge_edge(h);
    if (crossed_[e] != 0) return maker_.add(old_.corner_vertex(old_.prev(old_.mate(h))), weight);
    maker_.add(old_.corner_vertex(h), weight);
    maker_.add(old_.corner_vertex(old_.next(h)), weight);
    maker_.add(old_.corner_vertex(old_.prev(h)), -weight);
  }

  void add_regular(Index h, Index mate) {
    const WingMask mask = scheme_.wing_mask();
    for (const Index side : {h, mate}) {
      maker_.add(old_.corner_vertex(side), mask.end);
      maker_.add(old_.corner_vertex(old_.prev(side)), mask.opposite);
      add_wing(old_.next(side), mask.wing);
      add_wing(old_.prev(side), mask.wing);
    }
  }

  void add_edge_point(Index e) {
    const auto [a, b] = old_.edge_vertices(e);
    if (linear_) {
      maker_.add(a, 1.0 / 2);
      maker_.add(b, 1.0 / 2);
      return;
    }
    if (crossed_[e] == 0) return creases_.add_four_point(a, b, Scheme::tension, 1, maker_);
    const Index h = old_.edge_half_edges(e)[0], mate = old_.edge_half_edges(e)[1];
    const Rule here = rule_at(h), there = rule_at(mate);
    if (here == Rule::none && there == Rule::none) return add_regular(h, mate);
    const double share = here != Rule::none && there != Rule::none ? 1.0 / 2 : 1;
    add_by(here, h, share);
    add_by(there, mate, share);
  }

  // A ring that its own points alone decide about: extraordinary, with no neighbour that has a rule of its own; or
  // regular, among regular vertices inside.
  bool has_tangents(Index v) const {
    if (linear_ || creases_.kind(v) != PointKind::inside) return false;
    const auto corners = old_.vertex_corners(v);
    if (corners.size() < 3) return false;
    const bool regular = scheme_.is_regular(static_cast<Index>(corners.size()));
    for (const Index h : corners) {
      pace_.spend(4);
      const Index mate = old_.mate(h);
      if (rule_at(mate) != Rule::none) return false;
      if (regular && creases_.kind(old_.corner_vertex(mate)) != PointKind::inside) return false;
    }
    return true;
  }

  // An extraordinary ring's edge points lie on its own waves: sum of cos(angle_j) e_j. At a regular vertex, e_j being
  // the ring, f_j behind e_j and g_j between f_j and f_{j+1}, the left eigenvector for 1/2 is
  //   cos(angle_j) (e_j + f_j / 16) - sqrt(3)/6 cos(angle_j + pi/6) g_j.
  struct Around {
    Index end, behind = kNoIndex, between = kNoIndex;
  };
  void find_surroundings(Index v) {
    const Index s = sectors_.of_corner(old_.vertex_corners(v)[0]), n = sectors_.size(s);
    around_.clear();
    for (Index j = 0; j < n; ++j) {
      Around& here = around_.emplace_back(Around{end_of(s, j)});
      if (!scheme_.is_regular(n)) continue;
      // From the face (v, e_j, e_{j+1}): g_j across its outer edge; f_j behind, across (e_j, g_j).
      const Index outer = old_.mate(old_.next(sectors_.corners(s)[j]));
      here.between = old_.corner_vertex(old_.prev(outer));
      here.behind = old_.corner_vertex(old_.prev(old_.mate(old_.next(outer))));
    }
    if (waves_.size() == 2 * Count{n}) return;  // most vertices are regular
    waves_.clear();
    for (Index j = 0; j < n; ++j)
      for (const double turn : {0.0, -std::numbers::pi / 2})
        waves_.push_back({std::cos(angle(j, n) + turn), std::cos(angle(j, n) + turn + std::numbers::pi / 6)});
  }

  void add_tangent(bool sine) {
    for (std::size_t j = 0; j < around_.size(); ++j) {
      const auto [wave, between] = waves_[2 * j + (sine ? 1 : 0)];
      maker_.add(around_[j].end, wave);
      if (around_[j].between == kNoIndex) continue;
      maker_.add(around_[j].between, -std::sqrt(3.0) / 6 * between);
      maker_.add(around_[j].behind, wave / 16);
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
  std::vector<Index> sums_;  // the first sum of a sector; kNoIndex: it has none
  // Of the vertex whose tangents are written: its surroundings, and of every edge cosine and sine of its angle, each with
  // that a twelfth of a turn on.
  std::vector<Around> around_;
  std::vector<std::array<double, 2>> waves_;
};

// The values of the next level's vertices (split.h) from those of `level`'s. Vertices are their own limits.
template <HasRingMasks Scheme>
StepRows step_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return RingRows(scheme, level, linear, pace).step();
}

// Two rows for every vertex of `level`: tangents, halved by every step, whose cross product points outwards. Both are
// empty at creases and beside them, and where two extraordinary vertices are neighbours (one step on they are not).
template <HasRingMasks Scheme>
StepRows tangent_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return RingRows(scheme, level, linear, pace).tangents();
}

}  // namespace subdivd::plain
