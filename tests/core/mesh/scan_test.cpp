#include "core/mesh/scan.h"

#include <gtest/gtest.h>

#include <vector>

namespace subdivd {
namespace {

constexpr Index kHalf = Index{1} << 31;

TEST(Scan, all_below_is_exact_at_every_limit) {
  for (const Count limit : {Count{1}, Count{2}, Count{1000}, Count{kHalf} - 1, Count{kHalf}, Count{kHalf} + 1,
                            kMaxIndexCount, kMaxIndexCount + 1}) {
    const auto last = static_cast<Index>(limit - 1);
    for (std::size_t size : {1u, 7u, 64u, 100u}) {
      std::vector<Index> indices(size, 0);
      EXPECT_TRUE(all_below(indices, limit)) << limit;
      for (const std::size_t place : {std::size_t{0}, size / 2, size - 1}) {
        indices[place] = last;
        EXPECT_TRUE(all_below(indices, limit)) << limit << ' ' << place;
        for (const Count more : {limit, limit + 1, Count{kHalf} - 1, Count{kHalf}, kMaxIndexCount})
          if (more >= limit && more <= kMaxIndexCount) {
            indices[place] = static_cast<Index>(more);
            EXPECT_FALSE(all_below(indices, limit)) << limit << ' ' << place << ' ' << more;
          }
        indices[place] = 0;
      }
    }
  }
}

// A limit of the indices' own type once chose all_below() of core/base/all_finite, which knows numbers with a
// sign bit: it took every index from 2^31 on for a small one.
TEST(Scan, all_below_of_indices_takes_a_limit_of_their_own_type) {
  const std::vector<Index> indices{0, kHalf + 1};
  EXPECT_FALSE(all_below(std::span<const Index>(indices), Index{2}));
}

TEST(Scan, nothing_is_below_zero_but_no_index_at_all) {
  EXPECT_TRUE(all_below({}, 0));
  EXPECT_FALSE(all_below(std::vector<Index>{0}, 0));
}

TEST(Scan, any_repeats_finds_each_way_to_repeat_in_every_triangle) {
  for (const std::size_t triangles : {1u, 3u, 4u, 5u, 9u, 40u}) {
    std::vector<Index> indices(3 * triangles);
    for (std::size_t h = 0; h < indices.size(); ++h) indices[h] = static_cast<Index>(h % 5);
    EXPECT_FALSE(any_repeats(indices)) << triangles;
    for (std::size_t f = 0; f < triangles; ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        std::vector<Index> changed = indices;
        changed[3 * f + k] = changed[3 * f + (k + 1) % 3];
        EXPECT_TRUE(any_repeats(changed)) << f << ' ' << k;
      }
  }
}

TEST(Scan, for_each_set_goes_through_what_is_not_zero_in_order) {
  std::vector<unsigned char> values(1000, 0);
  const std::vector<std::size_t> set{0, 1, 63, 64, 500, 999};
  for (const std::size_t k : set) values[k] = 1;
  std::vector<std::size_t> met;
  for_each_set(std::span<const unsigned char>(values), [&](std::size_t k) { met.push_back(k); });
  EXPECT_EQ(met, set);
}

}  // namespace
}  // namespace subdivd
