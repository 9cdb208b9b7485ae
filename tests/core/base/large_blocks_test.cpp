#include "core/base/large_blocks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace subdivd::large_blocks {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

class LargeBlocks : public testing::Test {
 protected:
  ~LargeBlocks() override {
    trim();
    keep({});
  }
};

TEST_F(LargeBlocks, are_aligned_and_given_back_at_once_as_long_as_nothing_may_be_kept) {
  void* const block = allocate(5 * kMiB);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % kHugePage, 0u);
  std::memset(block, 1, 5 * kMiB);
  deallocate(block, 5 * kMiB);
  EXPECT_EQ(use().kept, 0u);
}

TEST_F(LargeBlocks, freed_ones_serve_the_next_of_about_their_size) {
  keep({.freed = 100 * kMiB, .ceiling = 1000 * kMiB});
  void* const block = allocate(63 * kMiB);
  deallocate(block, 63 * kMiB);
  EXPECT_EQ(use().in_use, 0u);
  EXPECT_GE(use().kept, 63 * kMiB);
  void* const smaller = allocate(62 * kMiB + 1);
  EXPECT_EQ(smaller, block);
  EXPECT_EQ(use().kept, 0u);
  void* const other = allocate(30 * kMiB);
  EXPECT_NE(other, block);
  deallocate(other, 30 * kMiB);
  deallocate(smaller, 62 * kMiB + 1);
}

TEST_F(LargeBlocks, a_much_larger_one_stays_where_it_is) {
  keep({.freed = 100 * kMiB, .ceiling = 1000 * kMiB});
  void* const large = allocate(64 * kMiB);
  deallocate(large, 64 * kMiB);
  void* const small = allocate(30 * kMiB);
  EXPECT_NE(small, large);
  EXPECT_EQ(use().in_use, 30 * kMiB);
  EXPECT_EQ(use().kept, 64 * kMiB);
  deallocate(small, 30 * kMiB);
}

TEST_F(LargeBlocks, at_most_a_sixteenth_is_left_over) {
  keep({.freed = 100 * kMiB, .ceiling = 1000 * kMiB});
  for (const std::size_t bytes : {33 * kMiB, 64 * kMiB + 1, 100 * kMiB, 127 * kMiB}) {
    void* const block = allocate(bytes);
    EXPECT_GE(use().in_use, bytes);
    EXPECT_LE(use().in_use, bytes + bytes / 16 + 1);
    deallocate(block, bytes);
  }
}

// Pages that nothing was written to take no memory.
TEST_F(LargeBlocks, of_more_than_there_is_a_list_for_the_rest_is_given_back) {
  keep({.freed = 10000 * kMiB, .ceiling = 10000 * kMiB});
  std::vector<void*> blocks(260);
  for (void*& block : blocks) block = allocate(kHugePage);
  for (void* const block : blocks) deallocate(block, kHugePage);
  EXPECT_EQ(use().kept, 256 * kHugePage);
  EXPECT_EQ(use().in_use, 0u);
}

TEST_F(LargeBlocks, no_more_are_kept_than_may_be) {
  keep({.freed = 10 * kMiB, .ceiling = 1000 * kMiB});
  for (int round = 0; round < 3; ++round) {
    void* const one = allocate(6 * kMiB);
    void* const two = allocate(6 * kMiB);
    deallocate(one, 6 * kMiB);
    deallocate(two, 6 * kMiB);
    EXPECT_EQ(use().kept, 6 * kMiB);
    EXPECT_EQ(use().in_use, 0u);
  }
  trim();
  EXPECT_EQ(use().kept, 0u);
}

TEST_F(LargeBlocks, what_is_kept_gives_way_to_what_is_used) {
  keep({.freed = 100 * kMiB, .ceiling = 100 * kMiB});
  deallocate(allocate(50 * kMiB), 50 * kMiB);
  EXPECT_GE(use().kept, 50 * kMiB);
  void* const large = allocate(80 * kMiB);
  EXPECT_EQ(use().kept, 0u);
  void* const small = allocate(20 * kMiB);
  deallocate(small, 20 * kMiB);
  EXPECT_LE(use().in_use + use().kept, 100 * kMiB);
  deallocate(large, 80 * kMiB);
  EXPECT_EQ(use().in_use, 0u);
}

TEST_F(LargeBlocks, what_was_kept_longest_gives_way_first_and_no_more_than_must) {
  keep({.freed = 100 * kMiB, .ceiling = 100 * kMiB});
  void* const one = allocate(30 * kMiB);
  void* const two = allocate(20 * kMiB);
  deallocate(one, 30 * kMiB);
  deallocate(two, 20 * kMiB);
  void* const large = allocate(60 * kMiB);
  EXPECT_EQ(use().kept, 20 * kMiB);
  void* const small = allocate(10 * kMiB);
  void* const least = allocate(10 * kMiB);  // up to the ceiling
  EXPECT_EQ(use().kept, 20 * kMiB);
  deallocate(least, 10 * kMiB);
  deallocate(small, 10 * kMiB);
  deallocate(large, 60 * kMiB);
}

TEST_F(LargeBlocks, is_not_kept_where_those_in_use_leave_no_room) {
  keep({.freed = 100 * kMiB, .ceiling = 50 * kMiB});
  void* const large = allocate(40 * kMiB);
  deallocate(allocate(20 * kMiB), 20 * kMiB);
  EXPECT_EQ(use().kept, 0u);
  deallocate(large, 40 * kMiB);
  EXPECT_EQ(use().kept, 40 * kMiB);
}

}  // namespace
}  // namespace subdivd::large_blocks
