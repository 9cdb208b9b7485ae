#pragma once
// Whether many numbers are all of a size that is allowed.

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace subdivd {

// |x| < limit for all of them, and no NaN. Without their sign numbers are in the order of their bits, NaN
// behind infinity, which itself is behind all others: adding what the limit lacks to the sign bit carries
// into it from the limit on. In integers, because compilers spread these over lanes.
template <std::floating_point Real>
bool all_below(std::span<const Real> values, Real limit) {
  using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  constexpr Bits kSign = Bits{1} << (sizeof(Real) * 8 - 1);
  const Bits lacking = kSign - std::bit_cast<Bits>(limit);
  Bits carries = 0;
  for (const Real value : values) carries |= (std::bit_cast<Bits>(value) & (kSign - 1)) + lacking;
  return (carries & kSign) == 0;
}

// |x| <= largest for all of them, and no NaN. `largest` is finite.
template <std::floating_point Real>
bool all_up_to(std::span<const Real> values, Real largest) {
  return all_below(values, std::nextafter(largest, std::numeric_limits<Real>::infinity()));
}

// Neither NaN nor an infinity among them.
template <std::floating_point Real>
bool all_finite(std::span<const Real> values) {
  return all_below(values, std::numeric_limits<Real>::infinity());
}

}  // namespace subdivd
