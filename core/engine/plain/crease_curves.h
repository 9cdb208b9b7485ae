#pragma once
// Creases and borders as curves of their own points: which vertices lie on one, and where it goes on.

#include <array>
#include <span>
#include <vector>

#include "core/engine/plain/level.h"
#include "core/engine/plain/step_rows.h"

namespace subdivd::plain {

enum class PointKind : unsigned char {
  inside,  // no crease
  dart,    // one crease, which ends here
  crease,  // two
  corner,  // more; or infinitely sharp itself; or without faces
};

class CreaseCurves {
 public:
  // `crossed`: crossed_edges(); the others are creases.
  CreaseCurves(const Level& level, std::span<const unsigned char> crossed, const Pace& pace);

  PointKind kind(Index v) const { return kinds_[v]; }
  // The vertex behind v, which is next to w on a crease; kNoIndex where the crease ends at v.
  Index behind(Index v, Index w) const {
    if (kinds_[v] != PointKind::crease) return kNoIndex;
    return ends_[v][0] == w ? ends_[v][1] : ends_[v][0];
  }
  // Adds the new point between v and w by the four-point rule: (1/2 + t)(v + w) - t (the points behind either). Where
  // a crease ends it is continued by 2 v - w.     [core/curves/four_point.h, pinned]
  void add_four_point(Index v, Index w, double tension, double weight, RowMaker& maker) const;

 private:
  std::vector<PointKind> kinds_;
  std::vector<std::array<Index, 2>> ends_;  // of a crease's two edges
};

}  // namespace subdivd::plain
