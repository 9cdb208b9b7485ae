#pragma once
// Work that must be linear, and must stop in its middle.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "core/base/budget.h"
#include "core/base/result.h"

namespace subdivd::testing {

// Far more than linear work takes on a busy machine, far less than the quadratic work did that it replaced.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::chrono::seconds kLinear{60};  // ten times slower
#else
inline constexpr std::chrono::seconds kLinear{8};
#endif

inline Budget within(std::chrono::milliseconds time) {
  Budget budget;
  budget.deadline = Budget::Clock::now() + time;
  return budget;
}

// work(budget), which takes long, is stopped by a deadline in its middle, whichever part of it that is.
template <class Work>
void expect_stops_midway(Work&& work) {
  auto whole = Budget::Clock::duration::max();
  for (int run = 0; run < 2; ++run) {  // the first may find no memory at hand, and take far longer
    const auto start = Budget::Clock::now();
    ASSERT_TRUE(work(Budget{}).ok());
    whole = std::min(whole, Budget::Clock::now() - start);
  }
  // Small parts: what was measured beside other work may take a quarter of that alone.
  for (const int part : {32, 8}) {
    Budget budget;
    budget.deadline = Budget::Clock::now() + whole / part;
    const auto result = work(budget);
    ASSERT_FALSE(result.ok()) << part;
    EXPECT_EQ(result.error().code, ErrorCode::deadline_exceeded) << part;
  }
}

}  // namespace subdivd::testing
