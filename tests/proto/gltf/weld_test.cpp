// Welding by hash gives what sorting gives, for any input and in time.

#include "proto/gltf/weld.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <random>

#include "proto/gltf/row_hash.h"
#include "tests/proto/gltf/unlimited.h"

namespace subdivd::test {
namespace {

using proto::gltf::Welded;
using testing::ElementsAre;

template <class Number>
Welded weld_tuples(const std::vector<Number>& values, Count width, const std::vector<Index>& groups = {}) {
  Unlimited unlimited;
  Welded weld;
  if constexpr (std::is_same_v<Number, Index>)
    weld = *proto::gltf::weld_tuples(values, width, unlimited.work);
  else
    weld = *proto::gltf::weld_tuples(values, width, groups, unlimited.work);
  return {std::move(weld.id), std::move(weld.first), {}};
}

Welded weld_by_sorting(const std::vector<double>& values, Count width,
                       const std::vector<Index>& groups = {}) {
  Unlimited unlimited;
  Welded weld = *proto::gltf::weld_by_sorting(values, width, groups, unlimited.work);
  return {std::move(weld.id), std::move(weld.first), {}};
}

void expect_same(const Welded& a, const Welded& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.first, b.first);
}

// Numbers of which many are equal; some are zeros of both signs.
std::vector<double> random_values(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> values;
  while (values.size() < count) values.push_back((static_cast<double>(random() % 17) - 8) * -0.25);
  return values;
}

TEST(Weld, takes_minus_zero_for_zero) {
  EXPECT_THAT(weld_tuples(std::vector<double>{0.0, 1, -0.0, 1, 0.0, 2}, 2).id, ElementsAre(0, 0, 1));
}

TEST(Weld, numbers_by_first_appearance) {
  const Welded weld = weld_tuples(std::vector<double>{7, 3, 7, 5, 3}, 1);
  EXPECT_THAT(weld.id, ElementsAre(0, 1, 0, 2, 1));
  EXPECT_THAT(weld.first, ElementsAre(0, 1, 3));
}

TEST(Weld, of_tuples_of_any_width_is_that_of_sorting) {
  for (Count width = 1; width < 7; ++width) {
    const auto values = random_values(width * 5000, width);
    expect_same(weld_tuples(values, width), weld_by_sorting(values, width));
  }
}

TEST(Weld, keeps_groups_apart) {
  const auto values = random_values(2 * 5000, 9);
  std::vector<Index> groups;
  for (Index i = 0; i < 5000; ++i) groups.push_back(i * 7 % 13);
  expect_same(weld_tuples(values, 2, groups), weld_by_sorting(values, 2, groups));
  EXPECT_THAT(weld_tuples(std::vector<double>{1, 1, 1}, 1, std::vector<Index>{4, 5, 4}).id,
              ElementsAre(0, 1, 0));
}

TEST(Weld, of_nothing_is_nothing) { EXPECT_TRUE(weld_tuples(std::vector<double>(), 3).id.empty()); }

TEST(Weld, of_indices_compares_whole_tuples) {
  EXPECT_THAT(weld_tuples(std::vector<Index>{1, 2, 2, 1, 1, 2, kNoIndex, 0}, 2).id, ElementsAre(0, 1, 0, 2));
}

// What the first two words of a tuple make of the hash before the third goes in by exclusive or: a third word
// that undoes it makes all hashes equal. The constants are those of row_hash.h; if they change, the test
// notices.
std::uint64_t before_last(double x, double y) {
  constexpr std::uint64_t kSeed = 0x9E3779B97F4A7C15, kFactor = 0xD6E8FEB86659FD93;
  std::uint64_t h = kSeed * kFactor;
  for (const double word : {x, y}) {
    h ^= std::bit_cast<std::uint64_t>(word);
    h ^= h >> 32;
    h *= kFactor;
  }
  return h;
}

// Without the way out into sorting this takes 2 * 10^10 comparisons.
TEST(Weld, is_not_slowed_down_by_tuples_made_to_collide) {
  constexpr Count kTuples = 200000;
  std::mt19937_64 random(3);
  std::vector<double> values;
  while (values.size() < 3 * kTuples) {
    const double x = std::ldexp(static_cast<double>(random()), -60);
    const double z = std::bit_cast<double>(before_last(x, 1) ^ 0x123456789ABCDEF);
    if (std::isfinite(z)) values.insert(values.end(), {x, 1, z});
  }
  const auto hash = [&](Count tuple) {
    return proto::gltf::hash_of_row(
        0, 3, [&](Count k) { return std::bit_cast<std::uint64_t>(values[3 * tuple + k]); });
  };
  for (Count i = 1; i < 100; ++i) ASSERT_EQ(hash(i), hash(0));
  expect_same(weld_tuples(values, 3), weld_by_sorting(values, 3));
}

}  // namespace
}  // namespace subdivd::test
