#pragma once
// The masks of a scheme that splits into corners, written as rows: of a step, and of limits.

#include <cmath>
#include <numbers>
#include <vector>

#include "core/engine/plain/corner_split.h"
#include "core/engine/plain/step_rows.h"
#include "core/schemes/scheme.h"

namespace subdivd::plain {

template <HasCornerMasks Scheme>
class CornerRows {
 public:
  CornerRows(const Scheme& scheme, const Level& level, const CornerSplit& split, const Pace& pace)
      : scheme_(scheme), old_(level.faces), split_(split), maker_(old_.vertex_count(), pace), pace_(pace) {
    sum_faces();
  }

  StepRows step() {
    pace_.for_each(old_.half_edge_count(), [&](Index h) {
      add_corner(h, 1);
      maker_.end_row();
    });
    pace_.for_each(split_.more.size(), [&](std::size_t k) {
      add_curve_point(split_.more[k].vertex, split_.more[k].towards, 1);
      maker_.end_row();
    });
    return maker_.take();
  }

  StepRows limits() {
    list_closed_sectors();
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      add_limit(v);
      maker_.end_row();
    });
    return maker_.take();
  }

  StepRows tangents() {
    list_closed_sectors();
    pace_.for_each(old_.vertex_count(), [&](Index v) {
      add_tangent(v, [](double angle) { return std::cos(angle); });
      maker_.end_row();
      add_tangent(v, [](double angle) { return std::sin(angle); });
      maker_.end_row();
    });
    return maker_.take();
  }

 private:
  // Of every large face: its mean and its waves, the sums of cos(2 pi i / n) v_i / n and sin(2 pi i / n) v_i / n.
  void sum_faces() {
    pace_.fill(face_sums_, old_.face_count(), kNoIndex);
    pace_.for_each(old_.face_count(), [&](Index f) {
      const Index n = old_.face_size(f);
      if (n <= kShortRow) return;
      const auto sum = [&](auto&& weight) {
        for (Index k = 0; k < n; ++k)
          maker_.add_to_sum(old_.corner_vertex(old_.face_begin(f) + k), weight(k) / n);
        return maker_.end_sum();
      };
      face_sums_[f] = sum([](Index) { return 1.0; });
      if (scheme_.corner_mask(n).wave == 0) return;
      sum([&](Index k) { return std::cos(angle(k, n)); });
      sum([&](Index k) { return std::sin(angle(k, n)); });
    });
  }

  static double angle(Index k, Index n) { return 2 * std::numbers::pi * k / n; }

  // What the scheme makes of corner h where no curve is near.
  void add_plain(Index h, double weight) {
    const Index f = old_.face_of(h), n = old_.face_size(f), begin = old_.face_begin(f), k = h - begin;
    const CornerMask mask = scheme_.corner_mask(n);
    maker_.add(old_.corner_vertex(h), weight * mask.self);
    maker_.add(old_.corner_vertex(old_.next(h)), weight * mask.beside);
    maker_.add(old_.corner_vertex(old_.prev(h)), weight * mask.beside);
    if (const Index sum = face_sums_[f]; sum != kNoIndex) {
      maker_.add_sum(sum, weight * mask.mean);
      if (mask.wave == 0) return;
      maker_.add_sum(sum + 1, weight * mask.wave * std::cos(angle(k, n)));
      maker_.add_sum(sum + 2, weight * mask.wave * std::sin(angle(k, n)));
      return;
    }
    for (Index i = 0; i < n; ++i) {
      const Index steps = i >= k ? i - k : i + n - k;
      maker_.add(old_.corner_vertex(begin + i),
                 weight * (mask.mean + mask.wave * std::cos(angle(steps, n))) / n);
    }
  }

  bool is_curve(Index h) const { return split_.roles[old_.half_edge_edge(h)] == EdgeRole::curve; }

  // A corner inside: beside a curve, the mean with its neighbours on that curve.
  void add_inside(Index h, double weight) {
    const Index next = old_.next(h), prev = old_.prev(h);
    const bool own = is_curve(h) || is_curve(prev);
    const bool ahead = !own && is_curve(next), behind = !own && is_curve(old_.prev(prev));
    const bool opposite = ahead && behind && old_.face_size(old_.face_of(h)) == 4;
    const double each = weight / (1 + ahead + behind + opposite);
    add_plain(h, each);
    if (ahead) add_plain(next, each);
    if (behind) add_plain(prev, each);
    if (opposite) add_plain(old_.next(next), each);
  }

  void add_curve_point(Index v, Index towards, double weight) {
    if (towards == kNoIndex || split_.pinned[v] != 0) return maker_.add(v, weight);
    const double t = split_.pinned[towards] != 0 ? 1.0 / 2 : 1.0 / 4;
    maker_.add(v, weight * (1 - t));
    maker_.add(towards, weight * t);
  }

  void add_corner(Index h, double weight) {
    const Index v = old_.corner_vertex(h);
    switch (split_.places[h]) {
      case CornerPlace::inside:
        return add_inside(h, weight);
      case CornerPlace::after:
        return add_curve_point(v, old_.corner_vertex(old_.next(h)), weight);
      case CornerPlace::before:
        return add_curve_point(v, old_.corner_vertex(old_.prev(h)), weight);
      case CornerPlace::at_vertex:
        return maker_.add(v, weight);
    }
  }

  void list_closed_sectors() {
    pace_.fill(closed_, old_.vertex_count(), kNoIndex);
    pace_.for_each(split_.sectors.count(), [&](Index s) {
      if (split_.sectors.is_closed(s)) closed_[old_.corner_vertex(split_.sectors.corners(s).front())] = s;
    });
  }

  // The curve is (p + 6 v + q) / 8 at v. Beside a pinned end c it is as if 2 c - v stood there.
  void add_curve_limit(Index v, Index p, Index q) {
    maker_.add(v, 6.0 / 8);
    for (const Index end : {p, q}) {
      const bool pinned = split_.pinned[end] != 0;
      maker_.add(end, pinned ? 2.0 / 8 : 1.0 / 8);
      if (pinned) maker_.add(v, -1.0 / 8);
    }
  }

  void add_limit(Index v) {
    if (split_.pinned[v] != 0) return maker_.add(v, 1);
    Index ends[2] = {kNoIndex, kNoIndex}, count = 0;
    for (const Index e : old_.vertex_edges(v)) {
      pace_.spend(1);
      if (split_.roles[e] == EdgeRole::curve) ends[count++] = old_.other_end(e, v);
    }
    if (count > 0) return add_curve_limit(v, ends[0], ends[count - 1]);
    const Index s = closed_[v];
    if (s == kNoIndex) return maker_.add(v, 1);
    const auto corners = split_.sectors.corners(s);
    if (corners.size() == 2) return add_limit_between_two(corners);
    for (const Index h : corners) add_corner(h, 1.0 / static_cast<double>(corners.size()));
  }

  // A vertex with two faces leaves an edge and no face: the limit is the centroid of the face in the place of that
  // edge, which lies between the faces of the vertex's own two edges.
  void add_limit_between_two(std::span<const Index> corners) {
    for (const Index h : corners) {
      const Index far = old_.next(h), far_mate = old_.mate(h);  // the corners at the other end of h's edge
      const auto across = split_.sectors.corners(split_.sectors.of_corner(far_mate));
      const bool curve = !split_.sectors.is_closed(split_.sectors.of_corner(far_mate)) &&
                         across.size() == 2 && split_.places[across.front()] == CornerPlace::after &&
                         split_.places[across.back()] == CornerPlace::before;
      const double t = curve ? 1.0 / 2 : 1.0 / 4;
      for (const Index near : corners) add_corner(near, (1 - t) / 4);
      add_corner(far, t / 4);
      add_corner(far_mate, t / 4);
    }
  }

  template <class Wave>
  void add_tangent(Index v, Wave wave) {
    const Index s = closed_[v];
    if (s == kNoIndex || split_.pinned[v] != 0) return;
    const auto corners = split_.sectors.corners(s);
    const auto n = static_cast<Index>(corners.size());
    if (n < 3) return;
    for (Index i = 0; i < n; ++i) add_corner(corners[i], wave(angle(i, n)));
  }

  const Scheme& scheme_;
  const Adjacency& old_;
  const CornerSplit& split_;
  RowMaker maker_;
  const Pace& pace_;
  std::vector<Index> face_sums_;  // the first sum of a face; kNoIndex: it has none
  std::vector<Index> closed_;     // the closed sector of a vertex; kNoIndex: none
};

// The values of the split's vertices from those of `level`'s.
template <HasCornerMasks Scheme>
StepRows step_rows(const Scheme& scheme, const Level& level, const CornerSplit& split,
                   const Pace& pace = {}) {
  return CornerRows(scheme, level, split, pace).step();
}

// A row for every vertex of `level`: the point of the limit surface that belongs to it.
//   inside       the centroid of the face that comes to stand in its place, which is a limit point
//   on a curve   the curve's point there
//   pinned, or without faces: the vertex. At an open border the surface does not come near: the vertex as well.
template <HasCornerMasks Scheme>
StepRows limit_rows(const Scheme& scheme, const Level& level, const CornerSplit& split,
                    const Pace& pace = {}) {
  return CornerRows(scheme, level, split, pace).limits();
}

// Two rows for every vertex of `level`: tangents of the limit surface, whose cross product points outwards; they are
// halved by a step of Doo and Sabin's. Both are empty but for smooth vertices inside of three faces or more.
template <HasCornerMasks Scheme>
StepRows tangent_rows(const Scheme& scheme, const Level& level, const CornerSplit& split,
                      const Pace& pace = {}) {
  return CornerRows(scheme, level, split, pace).tangents();
}

}  // namespace subdivd::plain
