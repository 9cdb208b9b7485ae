#pragma once
// Bytes that are made while they are passed on, so that they never stand in memory all together.

#include <cstddef>
#include <span>

#include "core/base/index.h"

namespace subdivd {

class ByteMaker {
 public:
  virtual ~ByteMaker() = default;
  virtual Count size() const = 0;  // of all of them, whatever has been made
  // What it keeps in memory to make them, at most.
  virtual Count held_bytes() const = 0;
  // Those that follow, valid until the next call; none: that was all. Neither fails nor allocates.
  virtual std::span<const std::byte> next() noexcept = 0;
};

}  // namespace subdivd
