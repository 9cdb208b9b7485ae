#pragma once
// Work that must be linear, and must stop in its middle.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>

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
    const std::clock_t clock = std::clock();
    ASSERT_TRUE(work(Budget{}).ok());
    // Of the processor, where that is less: a short piece of work may wait for one longer than it takes.
    const std::chrono::duration<double> busy(static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC);
    whole = std::min(
        {whole, Budget::Clock::now() - start, std::chrono::duration_cast<Budget::Clock::duration>(busy)});
  }
  // Small parts: what was measured beside other work may take a quarter of that alone.
  for (const int part : {32, 8}) {
    Budget budget;
    budget.deadline = Budget::Clock::now() + whole / part;
    const auto result = work(budget);
    ASSERT_FALSE(result.ok()) << part << " of " << whole.count() << " ns";
    EXPECT_EQ(result.error().code, ErrorCode::deadline_exceeded) << part;
  }
}

}  // namespace subdivd::testing
