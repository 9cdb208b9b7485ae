#include "core/engine/plain/crease_curves.h"

namespace subdivd::plain {

CreaseCurves::CreaseCurves(const Level& level, std::span<const unsigned char> crossed, const Pace& pace) {
  const Adjacency& faces = level.faces;
  pace.fill(kinds_, faces.vertex_count(), PointKind::inside);
  pace.fill(ends_, faces.vertex_count(), {kNoIndex, kNoIndex});
  pace.for_each(faces.vertex_count(), [&](Index v) {
    Count creases = 0;
    for (const Index e : faces.vertex_edges(v)) {
      pace.spend(1);
      if (crossed[e] != 0) continue;
      if (creases < 2) ends_[v][creases] = faces.other_end(e, v);
      ++creases;
    }
    if (creases > 2 || is_infinite(level.sharpness.vertices[v]) || faces.vertex_corners(v).empty())
      kinds_[v] = PointKind::corner;
    else if (creases > 0)
      kinds_[v] = creases == 1 ? PointKind::dart : PointKind::crease;
  });
}

void CreaseCurves::add_four_point(Index v, Index w, double tension, double weight, RowMaker& maker) const {
  const double t = weight * tension;
  const auto add_end = [&](Index end, Index other) {
    maker.add(end, weight / 2 + t);
    if (const Index further = behind(end, other); further != kNoIndex) {
      maker.add(further, -t);
    } else {
      maker.add(end, -2 * t);
      maker.add(other, t);
    }
  };
  add_end(v, w);
  add_end(w, v);
}

}  // namespace subdivd::plain
