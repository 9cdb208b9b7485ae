#pragma once
// The masks of a scheme that puts points into triangles, written as rows: of a step, and of limits.
//
// Creases (borders, infinitely sharp edges) are cubic B-splines of their own points: a first step leaves their
// points, a second makes (4, 19, 4) / 27 of an old one with its neighbours on the crease and (1, 16, 10) / 27,
// (10, 16, 1) / 27 between. A vertex stays that is infinitely sharp itself, or has another number of crease edges than
// none or two; beyond it a crease is continued by 2 v - w.     [Kobbelt00, section 6]

#include <cmath>
#include <numbers>
#include <vector>

#include "core/engine/plain/centroid_split.h"
#include "core/engine/plain/step_rows.h"
#include "core/schemes/scheme.h"

namespace subdivd::plain {

template <HasCentroidMasks Scheme>
class CentroidRows {
 public:
  CentroidRows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace)
      : scheme_(scheme),
        level_(level),
        old_(level.faces),
        linear_(linear || level.linear),
        pace_(pace),
        numbers_(level, pace),
        maker_(level.faces.vertex_count(), pace) {
    find_crease_ends();
  }

  StepRows step() {
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      add_vertex_point(v, 1);
      maker_.end_row();
    });
    pace_.for_each(old_.edge_count(), [&](Index e) {
      if (numbers_.edge_points[e] == kNoIndex) return;
      for (const Index v : old_.edge_vertices(e)) {
        add_third(e, v, 1);
        maker_.end_row();
      }
    });
    pace_.for_each(old_.face_count(), [&](Index f) {
      if (numbers_.face_points[f] == kNoIndex) return;
      add_face_point(f, 1);
      maker_.end_row();
    });
    return maker_.take();
  }

  StepRows limits() {
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      add_limit(v);
      maker_.end_row();
    });
    return maker_.take();
  }

  StepRows tangents() {
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      for (const bool sine : {false, true}) {
        if (!linear_ && kind_[v] == Kind::smooth) add_tangent(v, sine);
        maker_.end_row();
      }
    });
    return maker_.take();
  }

 private:
  enum class Kind : unsigned char { smooth, crease, fixed };

  // What each vertex is, and the other ends of a crease's two edges.
  void find_crease_ends() {
    pace_.fill(kind_, old_.vertex_count(), Kind::smooth);
    pace_.fill(crease_ends_, old_.vertex_count(), {kNoIndex, kNoIndex});
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      Count creases = 0;
      for (const Index e : old_.vertex_edges(v)) {
        pace_.spend(1);
        if (numbers_.crease[e] == 0) continue;
        if (creases < 2) crease_ends_[v][creases] = old_.other_end(e, v);
        ++creases;
      }
      if (creases == 2) kind_[v] = Kind::crease;
      if ((creases != 0 && creases != 2) || is_infinite(level_.sharpness.vertices[v]) ||
          old_.vertex_corners(v).empty())
        kind_[v] = Kind::fixed;
    });
  }

  void add_ring(Index v, const VertexMask& mask, double weight) {
    maker_.add(v, weight * mask.self);
    for (const Index e : old_.vertex_edges(v)) maker_.add(old_.other_end(e, v), weight * mask.each);
  }
  void add_along_crease(Index v, double self, double end) {
    maker_.add(v, self);
    for (const Index other : crease_ends_[v]) maker_.add(other, end);
  }

  void add_vertex_point(Index v, double weight) {
    if (linear_ || kind_[v] == Kind::fixed || (kind_[v] == Kind::crease && !level_.thirds_next))
      maker_.add(v, weight);
    else if (kind_[v] == Kind::crease)
      add_along_crease(v, weight * 19 / 27, weight * 4 / 27);
    else
      add_ring(v, scheme_.vertex_mask(static_cast<Index>(old_.vertex_edges(v).size())), weight);
  }

  // The point of a crease near its end v.
  void add_third(Index e, Index v, double weight) {
    const Index w = old_.other_end(e, v);
    if (linear_ || kind_[v] != Kind::crease) {
      maker_.add(v, weight * 2 / 3);
      maker_.add(w, weight / 3);
      return;
    }
    const auto [a, b] = crease_ends_[v];
    maker_.add(a == w ? b : a, weight / 27);
    maker_.add(v, weight * 16 / 27);
    maker_.add(w, weight * 10 / 27);
  }

  void add_face_point(Index f, double weight) {
    for (Index k = 0; k < 3; ++k) maker_.add(old_.corner_vertex(old_.face_begin(f) + k), weight / 3);
  }

  // Calls f(add) counter-clockwise for every point of the next level's ring of a smooth vertex, add(weight) adding that
  // point to the row. The tip of a crease's face has both points of that crease in its ring.
  template <class F>
  void for_each_next(Index v, F&& f) {
    const Index first = old_.vertex_corners(v)[0];
    Index h = first;
    do {
      pace_.spend(4);
      const Index face = old_.face_of(h), k = numbers_.face_creases[face];
      if (k == kNoIndex) {
        f([&](double weight) { add_face_point(face, weight); });
      } else {
        const Index e = old_.half_edge_edge(k);
        for (const Index end : {k, old_.next(k)})
          f([&](double weight) { add_third(e, old_.corner_vertex(end), weight); });
      }
      h = old_.mate(old_.prev(h));
    } while (h != first);
  }
  bool is_tip(Index v) const {
    if (!level_.thirds_next) return false;
    for (const Index h : old_.vertex_corners(v)) {
      pace_.spend(1);
      if (numbers_.face_creases[old_.face_of(h)] != kNoIndex) return true;
    }
    return false;
  }

  void add_limit(Index v) {
    if (linear_ || kind_[v] == Kind::fixed) return maker_.add(v, 1);
    if (kind_[v] == Kind::crease) return add_along_crease(v, 4.0 / 6, 1.0 / 6);
    if (!is_tip(v))
      return add_ring(v, scheme_.limit_mask(static_cast<Index>(old_.vertex_edges(v).size())), 1);
    // Its ring changes once more: the limit of what the next step makes.
    Index n = 0;
    for_each_next(v, [&](auto&&) { ++n; });
    const VertexMask mask = scheme_.limit_mask(n);
    add_vertex_point(v, mask.self);
    for_each_next(v, [&](auto&& add) { add(mask.each); });
  }

  void add_tangent(Index v, bool sine) {
    const auto weight = [&](Index k, Index n) {
      const double angle = 2 * std::numbers::pi * k / n;
      return sine ? std::sin(angle) : std::cos(angle);
    };
    Index n = 0, k = 0;
    if (!is_tip(v)) {
      n = static_cast<Index>(old_.vertex_edges(v).size());
      for (const Index e : old_.vertex_edges(v)) maker_.add(old_.other_end(e, v), weight(k++, n));
      return;
    }
    for_each_next(v, [&](auto&&) { ++n; });
    for_each_next(v, [&](auto&& add) { add(weight(k++, n)); });
  }

  const Scheme& scheme_;
  const Level& level_;
  const Adjacency& old_;
  bool linear_;
  const Pace& pace_;
  CentroidNumbers numbers_;
  RowMaker maker_;
  std::vector<Kind> kind_;
  std::vector<std::array<Index, 2>> crease_ends_;
};

// The values of the next level's vertices from those of `level`'s. `linear`: points stay, creases are cut evenly.
template <HasCentroidMasks Scheme>
StepRows step_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return CentroidRows(scheme, level, linear, pace).step();
}

// A row for every vertex of `level`: its limit. On a crease (1, 4, 1) / 6.
template <HasCentroidMasks Scheme>
StepRows limit_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return CentroidRows(scheme, level, linear, pace).limits();
}

// Two rows for every vertex of `level`: tangents, whose cross product points outwards. They turn by half the angle
// between edges at every step. Both are empty but for smooth vertices inside.
template <HasCentroidMasks Scheme>
StepRows tangent_rows(const Scheme& scheme, const Level& level, bool linear, const Pace& pace = {}) {
  return CentroidRows(scheme, level, linear, pace).tangents();
}

}  // namespace subdivd::plain
