// Every named shape, levels 1-4, both precisions, both crease methods.

#include <gtest/gtest.h>

#include "tests/differential/agreement.h"
#include "tests/shapes/shapes.h"

namespace subdivd::differential {
namespace {

constexpr Index kLevels = kSanitized ? 2 : 4;

struct Case {
  const shapes::NamedShape* shape;
  CreaseMethod method;
};

const std::vector<shapes::NamedShape>& named_shapes() {
  static const std::vector<shapes::NamedShape> shapes = shapes::all_shapes();
  return shapes;
}

std::vector<Case> cases() {
  std::vector<Case> result;
  for (const shapes::NamedShape& shape : named_shapes()) {
    result.push_back({&shape, CreaseMethod::uniform});
    if (has_semi_sharp_creases(shape.mesh)) result.push_back({&shape, CreaseMethod::chaikin});
  }
  return result;
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return info.param.shape->name + (info.param.method == CreaseMethod::chaikin ? "_chaikin" : "");
}

class Shape : public ::testing::TestWithParam<Case> {};

TEST_P(Shape, agrees_with_far_in_double_precision) {
  EXPECT_EQ(agreement<double>(GetParam().shape->mesh, GetParam().method, kLevels).disagreements, "");
}

TEST_P(Shape, agrees_with_far_in_single_precision) {
  EXPECT_EQ(agreement<float>(GetParam().shape->mesh, GetParam().method, kLevels).disagreements, "");
}

INSTANTIATE_TEST_SUITE_P(Named, Shape, ::testing::ValuesIn(cases()), name_of);

TEST(Shapes, are_at_least_forty) { EXPECT_GE(named_shapes().size(), 40u); }

// An exception that swallowed everything would pass every test above.
TEST(Shapes, are_compared_for_the_most_part) {
  Coverage limits, normals, values;
  for (const Case& item : cases()) {
    const Agreement agreed = agreement<double>(item.shape->mesh, item.method, 2);
    for (auto [total, part] : {std::pair{&limits, &agreed.limits}, std::pair{&normals, &agreed.normals},
                               std::pair{&values, &agreed.values}}) {
      total->compared += part->compared;
      total->excepted += part->excepted;
    }
  }
  const auto share = [](const Coverage& c) {
    return static_cast<double>(c.excepted) / static_cast<double>(c.compared + c.excepted);
  };
  RecordProperty("limits_left_out", std::to_string(share(limits)));
  RecordProperty("normals_left_out", std::to_string(share(normals)));
  EXPECT_LT(share(values), 0.01);
  EXPECT_LT(share(limits), 0.10);
  EXPECT_LT(share(normals), 0.25);
}

}  // namespace
}  // namespace subdivd::differential
