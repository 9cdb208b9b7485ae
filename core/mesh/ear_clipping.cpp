#include "core/mesh/ear_clipping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace subdivd {

// Moves the polygon to its first corner, scales it by a power of two and projects it along its Newell normal,
// which then points to the viewer. False when there is no normal to see it along.
bool PolygonCutter::flatten(std::span<const Index> corners, const Pace& pace) {
  const Count count = points_.size() / 3, size = corners.size();
  const auto k = static_cast<Index>(size);
  double largest = 0;
  bool sound = true;
  pace.for_each(k, [&](Index c) {
    sound = sound && corners[c] < count;
    if (!sound) return;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = std::fabs(points_[Count{3} * corners[c] + static_cast<Count>(axis)]);
      sound = sound && std::isfinite(x);
      largest = std::max(largest, x);
    }
  });
  if (!sound || largest == 0) return false;

  // Twice, so that differences of numbers of 1e308 do not overflow, and those of 1e-300 are not lost.
  scaled_.reserve(most_corners_);
  pace.fill(scaled_, size, Vector{});
  const int first_shift = -std::ilogb(largest) - 2;
  double extent = 0;
  pace.for_each(k, [&](Index c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = std::ldexp(points_[Count{3} * corners[c] + axis], first_shift) -
                       std::ldexp(points_[Count{3} * corners[0] + axis], first_shift);
      scaled_[c][axis] = x;
      extent = std::max(extent, std::fabs(x));
    }
  });
  if (extent == 0) return false;
  const int shift = -std::ilogb(extent) - 1;
  // Coordinates far from the origin are as wrong as their last digit. 2^-49 allows for some ten roundings.
  noise_ = std::ldexp(std::max(1.0, std::ldexp(0.5, shift)), -49);

  // n = sum over all sides of p_c x p_(c+1)   [Newell's method]
  Vector n{};
  pace.for_each(k, [&](Index c) {
    for (double& x : scaled_[c]) x = std::ldexp(x, shift);
    if (c == 0) return;
    const Vector &p = scaled_[c - 1], &q = scaled_[c];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
      n[axis] += p[y] * q[z] - p[z] * q[y];
    }
  });
  std::size_t z = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::fabs(n[axis]) > std::fabs(n[z])) z = axis;
  const double length = std::fabs(n[z]);
  if (!(length > 16 * noise_)) return false;

  // u and v are perpendicular to n, and u x v has its direction; seen in them the polygon is stretched, which
  // moves no point across a line. With n along an axis both are unit vectors, and nothing is rounded.
  const std::size_t x = (z + 1) % 3, y = (z + 2) % 3;
  const double nx = n[x] / length, ny = n[y] / length, nz = n[z] / length;
  flat_.reserve(most_corners_);
  flat_.clear();
  pace.for_each(k, [&](Index c) {
    const Vector& p = scaled_[c];
    flat_.push_back({.x = nz * p[x] - nx * p[z], .y = p[y] * (1 + nx * nx) - ny * (nx * p[x] + nz * p[z])});
  });
  return true;
}

// Twice the area of the triangle, positive when it turns to the left.
double PolygonCutter::area(Index a, Index b, Index c) const {
  const Flat &p = flat_[a], &q = flat_[b], &r = flat_[c];
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// By how much that may be wrong.
double PolygonCutter::doubt(Index a, Index b, Index c) const {
  const Flat &p = flat_[a], &q = flat_[b], &r = flat_[c];
  return noise_ * (std::fabs(q.x - p.x) + std::fabs(q.y - p.y) + std::fabs(r.x - p.x) + std::fabs(r.y - p.y));
}

// Whether no corner is reflex, or all triangles of the fan turn as the polygon does.
bool PolygonCutter::may_be_fan(const Pace& pace) const {
  const auto k = static_cast<Index>(flat_.size());
  bool is_convex = true, folds = false;
  pace.for_each(k, [&](Index b) {
    const Index a = b == 0 ? k - 1 : b - 1, c = b + 1 == k ? 0 : b + 1;
    is_convex = is_convex && area(a, b, c) >= -doubt(a, b, c);
    folds = folds || (b != 0 && c != 0 && area(0, b, c) <= doubt(0, b, c));
  });
  return is_convex || !folds;
}

// Makes a ring of all corners.
void PolygonCutter::link(const Pace& pace) {
  const Count size = flat_.size();
  const auto k = static_cast<Index>(size);
  for (std::vector<Index>* array : {&before_, &after_, &place_}) array->reserve(most_corners_);
  reflex_.reserve(most_corners_);
  waiting_.reserve(3 * most_corners_);
  pace.fill(before_, size, 0);
  pace.fill(after_, size, 0);
  pace.fill(place_, size, kNoIndex);
  reflex_.clear();
  waiting_.clear();
  pace.for_each(k, [&](Index c) {
    before_[c] = c == 0 ? k - 1 : c - 1;
    after_[c] = c + 1 == k ? 0 : c + 1;
    waiting_.push_back(c);
  });
  pace.for_each(k, [&](Index c) { judge(c); });
}

// Enters a corner among those that are reflex, or strikes it out.
void PolygonCutter::judge(Index k) {
  const bool is_reflex = !convex(k);
  if (is_reflex == (place_[k] != kNoIndex)) return;
  if (!is_reflex) return strike_out(k);
  place_[k] = static_cast<Index>(reflex_.size());
  reflex_.push_back(k);
}

void PolygonCutter::strike_out(Index k) {
  const Index last = reflex_.back();
  reflex_[place_[k]] = last;
  place_[last] = place_[k];
  reflex_.pop_back();
  place_[k] = kNoIndex;
}

// Whether a side at r, which lies on `tip`, runs into the triangle that has `right` and `left` of it.
bool PolygonCutter::enters(Index r, Index tip, Index right, Index left) const {
  return std::ranges::any_of(std::array{before_[r], after_[r]}, [&](Index end) {
    return area(tip, right, end) > doubt(tip, right, end) && area(tip, end, left) > doubt(tip, end, left);
  });
}

// Whether the reflex corner r lies in the way of the ear. Where polygons with holes are cut open, corners
// lie on each other: such a one is in the way if a side goes on from there into the ear.
bool PolygonCutter::blocks(Index r, const std::array<Index, 3>& ear, Ears ears) const {
  const auto [a, b, c] = ear;
  if (r == a || r == b || r == c) return false;
  if (flat_[r] == flat_[a]) return enters(r, a, b, c);
  if (flat_[r] == flat_[b]) return enters(r, b, c, a);
  if (flat_[r] == flat_[c]) return enters(r, c, a, b);
  const double sign = ears == Ears::strict ? -1 : 1;
  return area(a, b, r) > sign * doubt(a, b, r) && area(b, c, r) > sign * doubt(b, c, r) &&
         area(c, a, r) > sign * doubt(c, a, r);
}

bool PolygonCutter::is_ear(Index k, Ears ears, const Pace& pace) const {
  const std::array<Index, 3> ear{before_[k], k, after_[k]};
  const double size = area(ear[0], k, ear[2]), unsure = doubt(ear[0], k, ear[2]);
  if (ears == Ears::strict ? size <= unsure : size < -unsure) return false;
  return pace.all_blocks(reflex_.size(), [&](Count begin, Count end) {
    for (Count r = begin; r < end; ++r)
      if (blocks(reflex_[r], ear, ears)) return false;
    return true;
  });
}

// Appends the triangles; false when there is no ear left, though there are corners.
bool PolygonCutter::clip(const Pace& pace, std::vector<Index>& out) {
  link(pace);
  if (flat_.size() * reflex_.size() > kMostSteps) return false;
  Index left = static_cast<Index>(flat_.size()), last = 0;
  for (const Ears ears : {Ears::strict, Ears::relaxed}) {
    if (ears == Ears::relaxed) {
      waiting_.clear();
      Index first = last;  // the smallest that is left, so that ears come in order again
      for (Index n = 0, c = last; n < left; ++n, c = after_[c]) {
        pace.spend(1);
        first = std::min(first, c);
      }
      for (Index n = 0, c = first; n < left; ++n, c = after_[c]) {
        pace.spend(1);
        waiting_.push_back(c);
      }
    }
    // Whether a corner is an ear changes only when one of its neighbours goes: it then waits again.
    for (Count next = 0; next < waiting_.size() && left > 3; ++next) {
      pace.spend(1);
      const Index k = waiting_[next];
      if (before_[k] == kNoIndex || !is_ear(k, ears, pace)) continue;
      const Index a = before_[k], c = after_[k];
      out.insert(out.end(), {a, k, c});
      after_[a] = c;
      before_[c] = a;
      if (place_[k] != kNoIndex) strike_out(k);  // an ear without an area
      before_[k] = kNoIndex;
      --left;
      last = c;
      for (const Index neighbour : {a, c}) {
        judge(neighbour);
        waiting_.push_back(neighbour);
      }
    }
    if (left == 3) break;
  }
  if (left != 3) return false;
  out.insert(out.end(), {before_[last], last, after_[last]});
  return true;
}

void PolygonCutter::cut(std::span<const Index> corners, const Pace& pace, std::vector<Index>& out) {
  assert(corners.size() >= 3 && corners.size() <= most_corners_);
  const auto k = static_cast<Index>(corners.size());
  const Count begin = out.size();
  if (k > 3 && flatten(corners, pace) && !may_be_fan(pace) && clip(pace, out)) {
    pace.for_each((out.size() - begin) / 3, [&](Count t) {
      const auto triangle = out.begin() + static_cast<std::ptrdiff_t>(begin + 3 * t);
      std::rotate(triangle, std::min_element(triangle, triangle + 3), triangle + 3);
    });
    return;
  }
  out.resize(begin);
  pace.for_each(k - 2, [&](Index t) { out.insert(out.end(), {0, t + 1, t + 2}); });
}

}  // namespace subdivd
