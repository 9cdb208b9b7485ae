#pragma once
// Random numbers that are the same everywhere: std::distributions differ between libraries.

#include <cstdint>

#include "core/base/index.h"

namespace subdivd::shapes {

// splitmix64 [Steele, Lea, Flood 2014, doi:10.1145/2660193.2660195]
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // In [0, n), n > 0. The bias of the remainder is of no concern here.
  Index below(Count n) { return static_cast<Index>(bits() % n); }
  bool one_in(Count n) { return below(n) == 0; }
  // In [0, 1), 53 bits.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  // In [-1, 1).
  double centred() { return 2 * unit() - 1; }

 private:
  std::uint64_t state_;
};

}  // namespace subdivd::shapes
