#pragma once
// Where numbers stand in a list that is not sorted, without a search along it for each.

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"

namespace subdivd {

class Positions {
 public:
  explicit Positions(std::span<const Index> list, const Pace& pace = {}) {
    sorted_.reserve(list.size());
    for (std::size_t k = 0; k < list.size(); ++k) sorted_.emplace_back(list[k], k);
    pace.sort(sorted_.begin(), sorted_.end(), std::less<>());
  }
  // `item` must be in the list.
  std::size_t operator()(Index item) const {
    return std::ranges::lower_bound(sorted_, item, {}, &std::pair<Index, std::size_t>::first)->second;
  }

 private:
  std::vector<std::pair<Index, std::size_t>> sorted_;
};

}  // namespace subdivd
