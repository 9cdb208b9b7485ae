#include "core/base/all_finite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace subdivd {
namespace {

template <class Real>
class AllFinite : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(AllFinite, Precisions);

TYPED_TEST(AllFinite, takes_the_largest_and_the_smallest_numbers_of_both_signs) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam value : {Limits::max(), Limits::min(), Limits::denorm_min(), TypeParam{0}}) {
    EXPECT_TRUE(all_finite<TypeParam>(std::vector<TypeParam>(100, value))) << value;
    EXPECT_TRUE(all_finite<TypeParam>(std::vector<TypeParam>(100, -value))) << value;
  }
  EXPECT_TRUE(all_finite<TypeParam>({}));
}

TYPED_TEST(AllFinite, finds_a_nan_or_an_infinity_at_any_place) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::infinity(), Limits::quiet_NaN(), Limits::signaling_NaN()})
    for (const TypeParam sign : {TypeParam{1}, TypeParam{-1}})
      for (std::size_t place = 0; place < 33; ++place) {
        std::vector<TypeParam> values(33, Limits::max());
        values[place] = std::copysign(bad, sign);
        EXPECT_FALSE(all_finite<TypeParam>(values)) << bad << ' ' << sign << ' ' << place;
      }
}

TYPED_TEST(AllFinite, all_below_is_exact_at_the_limit) {
  const TypeParam limit = 3;
  const std::vector<TypeParam> below{std::nextafter(limit, TypeParam{0}),
                                     -std::nextafter(limit, TypeParam{0})};
  EXPECT_TRUE(all_below<TypeParam>(below, limit));
  EXPECT_FALSE(all_below<TypeParam>(std::vector<TypeParam>{limit}, limit));
  EXPECT_FALSE(all_below<TypeParam>(std::vector<TypeParam>{-limit}, limit));
}

TYPED_TEST(AllFinite, all_up_to_takes_the_limit_and_nothing_beyond_it) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam limit : {TypeParam{3}, Limits::max()}) {
    EXPECT_TRUE(all_up_to<TypeParam>(std::vector<TypeParam>{limit, -limit, 0}, limit));
    const TypeParam beyond = std::nextafter(limit, Limits::infinity());
    for (const TypeParam bad : {beyond, -beyond, Limits::quiet_NaN()})
      EXPECT_FALSE(all_up_to<TypeParam>(std::vector<TypeParam>{0, bad}, limit)) << bad;
  }
}

}  // namespace
}  // namespace subdivd
