#include "core/base/text_of.h"

#include <gtest/gtest.h>

#include <limits>

namespace subdivd {
namespace {

TEST(TextOf, names_a_number_with_as_few_digits_as_do) {
  EXPECT_EQ(text_of(0), "0");
  EXPECT_EQ(text_of(7), "7");
  EXPECT_EQ(text_of(0.25), "0.25");
  EXPECT_EQ(text_of(-1e-9), "-1e-09");
  EXPECT_EQ(text_of(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(text_of(1e300), "1e+300");
  EXPECT_EQ(text_of(-std::numeric_limits<double>::max()), "-1.7976931348623157e+308");
}

}  // namespace
}  // namespace subdivd
