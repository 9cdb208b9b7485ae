#include "core/curves/kernels/curve_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/curves/corner_cutting.h"
#include "core/curves/four_point.h"
#include "core/curves/lane_riesenfeld.h"
#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

// For one test: the instruction set, and the best one again behind it.
class WithInstructionSet {
 public:
  explicit WithInstructionSet(int set) { kernels::force_curve_instruction_set(set); }
  ~WithInstructionSet() { kernels::force_curve_instruction_set(-1); }
};

std::vector<int> instruction_sets() {
  std::vector<int> sets;
  for (int set = 0; set < kernels::kCurveInstructionSets; ++set)
    if (kernels::has_curve_instruction_set(set)) sets.push_back(set);
  return sets;
}

template <class Real>
kernels::SplitPoints<Real> kernel_of(const ControlCurves& rule) {
  const auto& all = kernels::curve_kernels<Real>();
  if (rule.basis == CurveBasis::four_point) return all.four_point[rule.width - 1];
  if (rule.basis == CurveBasis::corner_cutting) return all.corner_cutting[rule.width - 1];
  return all.lane_riesenfeld[rule.degree - 1][rule.width - 1];
}

// The plain way: each child by itself, then in turn.
template <class Real>
std::vector<Real> in_turn(const ControlCurves& rule, const Real* self, Count points) {
  const Count width = rule.width;
  std::vector<Real> first(points * width), second(points * width), both;
  if (rule.basis == CurveBasis::four_point)
    four_point_children(rule.tension, rule.width, self, points * width, first.data(), second.data());
  else if (rule.basis == CurveBasis::corner_cutting)
    corner_cutting_children(rule.ratio, rule.width, self, points * width, first.data(), second.data());
  else
    lane_riesenfeld_children(rule.degree, rule.width, self, points * width, first.data(), second.data());
  for (Count i = 0; i < points; ++i)
    for (const std::vector<Real>* child : {&first, &second})
      both.insert(both.end(), child->begin() + static_cast<std::ptrdiff_t>(i * width),
                  child->begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
  return both;
}

// The array ends with the last point in reach, so that a sanitizer sees what reads farther.
template <class Real>
void expect_plain_children(const ControlCurves& rule, Count points) {
  const Count reach = split_of(rule).reach;
  shapes::Random random(kCurveSeed);
  std::vector<Real> control((points + 2 * reach) * rule.width);
  for (Real& x : control) x = static_cast<Real>(random.centred());
  const Real* self = control.data() + reach * rule.width;
  std::vector<Real> expected = in_turn(rule, self, points);
  expected.insert(expected.end(), 8, Real(7));  // what lies behind stays
  std::vector<Real> children(expected.size(), Real(7));
  const bool tension = rule.basis == CurveBasis::four_point;
  kernel_of<Real>(rule)(tension ? rule.tension : rule.ratio, self, points, children.data());
  ASSERT_EQ(children, expected) << name_of_rule(rule) << " width " << rule.width << " points " << points;
}

TEST(CurveKernels, children_are_the_plain_ones_to_the_bit) {
  for (const int set : instruction_sets()) {
    const WithInstructionSet with(set);
    for (ControlCurves rule : all_rules()) {
      if (rule.wrap != CurveWrap::pinned || rule.degree > kernels::kKernelDegree) continue;
      for (rule.width = 1; rule.width <= kernels::kKernelWidth; ++rule.width)
        for (const Count points : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 21u}) {
          expect_plain_children<double>(rule, points);
          expect_plain_children<float>(rule, points);
        }
    }
  }
}

template <class Real>
void expect_same_answers(const ControlCurves& curves) {
  std::vector<Real> first;
  for (const int set : instruction_sets()) {
    const WithInstructionSet with(set);
    const Refined<Real> answer = refined<Real>(curves, 5);
    ASSERT_FALSE(answer.points.empty());
    if (first.empty()) first = answer.points;
    ASSERT_EQ(answer.points, first) << name_of_rule(curves);
  }
}

TEST(CurveKernels, answers_do_not_depend_on_the_instruction_set) {
  for (const ControlCurves& rule : all_rules())
    for (const Index width : {1u, 2u, 3u, 4u, 5u}) {
      expect_same_answers<double>(random_curve(rule, 3, width));
      expect_same_answers<float>(random_curve(rule, 3, width));
    }
}

// An overflow or a NaN in one coordinate, or behind the points, is none of the others' business.
TEST(CurveKernels, coordinates_do_not_spoil_each_other) {
  for (const int set : instruction_sets()) {
    const WithInstructionSet with(set);
    std::vector<double> control(3 * 5, 1.0);
    for (Count i = 0; i < 5; ++i) control[3 * i + 1] = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> children(3 * 6);
    kernels::curve_kernels<double>().lane_riesenfeld[2][2](0, control.data() + 3, 3, children.data());
    for (Count i = 0; i < 6; ++i) {
      EXPECT_EQ(children[3 * i], 1);
      EXPECT_EQ(children[3 * i + 2], 1);
    }
  }
}

}  // namespace
}  // namespace subdivd::testing
