#pragma once
// Cuts one polygon in space into triangles.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"

namespace subdivd {

// Cuts polygons of the same points, one after the other; keeps its working memory between them.
class PolygonCutter {
 public:
  // Corners times those that are not convex: a quarter of a second. 4,096 corners of any kind take no more.
  static constexpr Count kMostSteps = Count{1} << 24;

  // `points`: x y z per point, finite; must outlive the cutter. `most_corners`: of the largest polygon.
  PolygonCutter(std::span<const double> points, Count most_corners)
      : points_(points), most_corners_(most_corners) {}

  // Bytes of working memory for polygons of up to `most_corners`.
  static Count working_bytes(Count most_corners) {
    return most_corners * (sizeof(Vector) + sizeof(Flat) + 7 * sizeof(Index));
  }

  // Appends corners.size() - 2 triangles to `out`, three positions in `corners` each, turning as the polygon
  // does. corners.size() is at least 3; corners may repeat points, and name points that do not exist: such a
  // polygon becomes a fan.
  //
  // A polygon is seen along its Newell normal. It becomes the fan (0,1,2), (0,2,3), ... where it is convex
  // there or the fan does not fold; otherwise ears are clipped, in order, each triangle beginning with its
  // first corner. Where that finds no end (the polygon crosses itself, or has no area) or would take more than
  // kMostSteps, it becomes the fan.
  // All that is decided is the same for coordinates times a power of two. Time: the number of corners times 1
  // + those that are not convex, 10 to 20 ns each; paced.
  void cut(std::span<const Index> corners, const Pace& pace, std::vector<Index>& out);

 private:
  using Vector = std::array<double, 3>;
  struct Flat {
    double x, y;
    bool operator==(const Flat&) const = default;
  };
  // At first every ear has an area, and nothing but its own corners touches it; where there is none, ears
  // without an area do, and what lies on their sides.
  enum class Ears { strict, relaxed };

  bool flatten(std::span<const Index> corners, const Pace& pace);
  double area(Index a, Index b, Index c) const;
  double doubt(Index a, Index b, Index c) const;
  bool convex(Index k) const { return area(before_[k], k, after_[k]) > doubt(before_[k], k, after_[k]); }
  bool may_be_fan(const Pace& pace) const;
  bool clip(const Pace& pace, std::vector<Index>& out);
  void link(const Pace& pace);
  bool is_ear(Index k, Ears ears, const Pace& pace) const;
  bool blocks(Index r, const std::array<Index, 3>& ear, Ears ears) const;
  bool enters(Index r, Index tip, Index right, Index left) const;
  void judge(Index k);
  void strike_out(Index k);

  std::span<const double> points_;
  Count most_corners_;
  double noise_ = 0;                   // by which coordinates in flat_ may be wrong
  std::vector<Vector> scaled_;         // from the first corner, the largest coordinate between 1/2 and 1
  std::vector<Flat> flat_;             // the same, seen along the normal
  std::vector<Index> before_, after_;  // neighbours of each corner that is left
  std::vector<Index> reflex_;          // corners that are left and not convex
  std::vector<Index> place_;           // of each corner in reflex_, or kNoIndex
  std::vector<Index> waiting_;         // corners that may be ears
};

}  // namespace subdivd
