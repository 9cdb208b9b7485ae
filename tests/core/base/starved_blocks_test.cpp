// Large blocks where memory runs out.
#include <gtest/gtest.h>

#include <new>

#include "core/base/large_blocks.h"
#include "tests/support/allocations.h"

namespace subdivd::large_blocks {
namespace {

using subdivd::test::Allocations;

constexpr std::size_t kMiB = std::size_t{1} << 20;

TEST(StarvedBlocks, what_is_kept_is_given_back_before_there_is_no_memory) {
  keep({.freed = 100 * kMiB, .ceiling = 1000 * kMiB});
  {
    const Allocations allocations({.at = 1});
    deallocate(allocate(50 * kMiB), 50 * kMiB);
    void* const block = allocate(20 * kMiB);
    EXPECT_EQ(use().kept, 0u);
    EXPECT_EQ(use().in_use, 20 * kMiB);
    deallocate(block, 20 * kMiB);
    trim();
  }
  keep({});
}

TEST(StarvedBlocks, one_that_there_was_no_memory_for_is_not_in_use) {
  keep({.freed = 100 * kMiB, .ceiling = 1000 * kMiB});
  {
    const Allocations allocations({.beyond = std::int64_t{10 * kMiB}});
    EXPECT_THROW(allocate(20 * kMiB), std::bad_alloc);
    EXPECT_EQ(use().in_use, 0u);
  }
  keep({});
}

}  // namespace
}  // namespace subdivd::large_blocks
