#include "core/oracle/grids.h"

#include <algorithm>

namespace subdivd::oracle {
namespace {

constexpr Count square(Count n) { return n * n; }

// The place (i, j) of a square on a face of n x n, as the quarter of h x h that it lies in and its place
// there: what quarter k has of its own runs from the face's corner k, first to the next corner, then to the
// one before.
struct InQuarter {
  Count quarter, i, j;
};
InQuarter in_quarter(Count n, Count i, Count j) {
  const Count h = n / 2;
  if (j < h) return i < h ? InQuarter{0, i, j} : InQuarter{1, j, n - 1 - i};
  return i < h ? InQuarter{3, n - 1 - j, i} : InQuarter{2, n - 1 - i, n - 1 - j};
}

}  // namespace

FaceRows::FaceRows(std::span<const Index> sizes, const Pace& pace) : faces_(sizes.size()) {
  begins_.resize(sizes.size() + 1);
  begins_[0] = 0;
  pace.for_each(sizes.size(), [&](std::size_t f) { begins_[f + 1] = begins_[f] + sizes[f]; });
}

Grids::Grids(GridShape shape, Index level, const FaceRows& base, const Pace& pace)
    : shape_(shape), level_(level), n_(segments(level)), half_(n_ / 2), base_(&base) {
  if (shape != GridShape::corners) {
    place_count_ = base.count() * places_on(0);
    return;
  }
  begins_.resize(base.count());
  pace.for_each(base.count(), [&](Count f) {
    begins_[f] = place_count_;
    place_count_ += places_on(f);
  });
}

Count Grids::places_on(Count base_face) const {
  if (shape_ == GridShape::triangles) return face_points(n_);
  return is_whole(base_face) ? square(n_ + 1) : base_->size(base_face) * square(half_ + 1);
}

Count Grids::place_number(const Provenance& place) const {
  if (place.face >= base_->count()) return kNowhere;
  const Count begin = begins_.empty() ? place.face * places_on(place.face) : begins_[place.face];
  const Count i = place.i, j = place.j;
  if (!is_whole(place.face)) {
    if (place.corner >= base_->size(place.face) || i % 2 != 0 || j % 2 != 0 || std::max(i, j) > 2 * half_)
      return kNowhere;
    return begin + place.corner * square(half_ + 1) + j / 2 * (half_ + 1) + i / 2;
  }
  if (place.corner != 0) return kNowhere;
  if (shape_ == GridShape::triangles) return i + j > n_ ? kNowhere : begin + face_point_index(n_, i, j);
  return std::max(i, j) > n_ ? kNowhere : begin + j * (n_ + 1) + i;
}

Count Grids::face_count(Count base_face) const {
  if (shape_ != GridShape::corners) return square(n_);
  return level_ == 0 ? 1 : base_->size(base_face) * square(half_);
}

Count Grids::face_number(Count base_face, Index base_corner, std::span<const GridPoint> corners) const {
  if (level_ == 0) return 0;
  if (shape_ == GridShape::triangles) return triangle_index(n_, corners.first<3>());
  Count i = corners[0].i, j = corners[0].j;
  for (const GridPoint& corner : corners) {
    i = std::min<Count>(i, corner.i);
    j = std::min<Count>(j, corner.j);
  }
  if (shape_ == GridShape::quads) return j * n_ + i;
  InQuarter at{base_corner, i / 2, j / 2};
  if (is_whole(base_face)) at = in_quarter(n_, i, j);
  return at.quarter * square(half_) + at.j * half_ + at.i;
}

}  // namespace subdivd::oracle
