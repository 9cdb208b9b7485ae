#include "core/mesh/faces.h"

#include <algorithm>

namespace subdivd {

Polygons::Polygons(std::vector<Index> begins, std::vector<Index> corners, const Pace& pace)
    : begins_(std::move(begins)), corners_(std::move(corners)) {
  pace.fill(faces_, corners_.size(), 0);
  pace.for_each(count(), [&](Index f) {
    const Index size = begins_[f + 1] - begins_[f];
    pace.spend(size);
    std::fill_n(faces_.begin() + begins_[f], size, f);
  });
}

}  // namespace subdivd
