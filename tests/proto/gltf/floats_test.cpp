#include "proto/gltf/floats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/thread_pool.h"
#include "tests/shapes/random.h"

namespace subdivd::proto::gltf {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<float> random_floats(Count count, std::uint64_t seed) {
  shapes::Random random(seed);
  std::vector<float> values;
  for (Count k = 0; k < count; ++k) values.push_back(static_cast<float>(3 * random.centred()));
  return values;
}

FloatScan scanned(std::vector<float>& values, Index components, bool bounds, Clamp clamp,
                  Helpers* helpers = nullptr) {
  Budget budget;
  budget.helpers = helpers;
  Work work(budget);
  auto scan = scan_floats(values, components, bounds, clamp, work);
  EXPECT_TRUE(scan.ok());
  return *scan;
}

TEST(Floats, bounds_are_those_of_every_component) {
  ThreadPool pool(3);
  for (Index components = 1; components <= 4; ++components)
    for (const Count tuples : {1, 2, 7, 8, 9, 100, 70001, 600003}) {
      std::vector<float> values = random_floats(tuples * components, tuples + components);
      for (Helpers* helpers : {static_cast<Helpers*>(nullptr), static_cast<Helpers*>(&pool)}) {
        const FloatScan scan = scanned(values, components, true, Clamp::none, helpers);
        EXPECT_TRUE(scan.finite);
        ASSERT_EQ(scan.least.size(), components);
        for (Index k = 0; k < components; ++k) {
          float least = kInfinity, most = -kInfinity;
          for (Count i = k; i < values.size(); i += components)
            least = std::min(least, values[i]), most = std::max(most, values[i]);
          EXPECT_EQ(scan.least[k], least) << components << ' ' << tuples;
          EXPECT_EQ(scan.most[k], most) << components << ' ' << tuples;
        }
      }
    }
}

TEST(Floats, what_is_not_finite_is_found_wherever_it_stands) {
  for (const float bad : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()})
    for (const Count at : {0, 1, 23, 24, 50000, 99998}) {
      std::vector<float> values = random_floats(99999, at);
      values[at] = bad;
      EXPECT_FALSE(scanned(values, 3, at % 2 == 0, Clamp::none).finite) << at;
    }
}

TEST(Floats, bounds_hold_no_negative_zero) {
  for (std::vector<float> values : {std::vector<float>{-0.0f, 0.0f, -0.0f}, {0.0f, -0.0f}}) {
    const FloatScan scan = scanned(values, 1, true, Clamp::none);
    EXPECT_FALSE(std::signbit(scan.least[0]));
    EXPECT_FALSE(std::signbit(scan.most[0]));
  }
}

TEST(Floats, colours_are_clamped) {
  std::vector<float> values = random_floats(300000 * 4, 5);
  const std::vector<float> before = values;
  EXPECT_TRUE(scanned(values, 4, false, Clamp::unit).least.empty());
  for (Count k = 0; k < values.size(); ++k) ASSERT_EQ(values[k], std::clamp(before[k], 0.0f, 1.0f));
}

TEST(Floats, blocks_cover_everything_once) {
  ThreadPool pool(2);
  Budget budget;
  budget.helpers = &pool;
  Work work(budget);
  for (const Count total : {0, 1, 16384, 600000}) {
    std::vector<std::atomic<int>> touched(total);
    ASSERT_TRUE(in_shared_blocks(total, work, [&](Count begin, Count end) {
                  for (Count k = begin; k < end; ++k) ++touched[k];
                }).ok());
    EXPECT_TRUE(std::ranges::all_of(touched, [](const auto& count) { return count == 1; }));
  }
}

TEST(Floats, a_scan_stops_with_its_budget) {
  const std::atomic<bool> cancelled{true};
  Budget budget;
  budget.cancelled = &cancelled;
  Work work(budget);
  std::vector<float> values(1'000'000, 1.0f);
  const auto scan = scan_floats(values, 1, true, Clamp::none, work);
  ASSERT_FALSE(scan.ok());
  EXPECT_EQ(scan.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd::proto::gltf
