#pragma once
// The hash that welding looks rows of words up by. An attacker knows it, and a test attacks it.

#include <cstdint>

#include "core/base/index.h"

namespace subdivd::proto::gltf {

// word(k) for k = 0..width-1. Every bit of the row moves every bit of the upper half.
template <class Word>
std::uint64_t hash_of_row(std::uint64_t group, Count width, Word&& word) {
  constexpr std::uint64_t kSeed = 0x9E3779B97F4A7C15, kFactor = 0xD6E8FEB86659FD93;  // any odd ones
  std::uint64_t h = (group + kSeed) * kFactor;
  for (Count k = 0; k < width; ++k) {
    h ^= word(k);
    h ^= h >> 32;
    h *= kFactor;
  }
  h ^= h >> 29;
  return h * kFactor;
}

}  // namespace subdivd::proto::gltf
