#include "core/curves/kernels/curve_kernels.h"
#include "core/base/overloaded.h"

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
struct Kernel {
  kernels::SplitPoints<Real> split;
  double parameter;
};

template <class Real>
Kernel<Real> kernel_of(const ControlCurves& rule) {
  const auto& all = kernels::curve_kernels<Real>();
  const Index w = rule.width - 1;
  const auto kernel = Overloaded{[&](const UniformBSpline& kind) {
                                   return Kernel<Real>{all.lane_riesenfeld[kind.degree - 1][w], 0};
                                 },
                                 [&](const FourPoint& kind) {
                                   return Kernel<Real>{all.four_point[w], kind.tension};
                                 },
                                 [&](const CornerCutting& kind) {
                                   return Kernel<Real>{all.corner_cutting[w], kind.ratio};
                                 }};
  return visit_scheme(rule.basis, kernel);
}

// The plain way: each child by itself, then in turn.
template <class Real>
std::vector<Real> in_turn(const ControlCurves& rule, const Real* self, Count points) {
  const Count width = rule.width;
  std::vector<Real> first(points * width), second(points * width), both;
  visit_scheme(rule.basis, [&](const auto& kind) {
    kind.children(rule.width, self, points * width, first.data(), second.data());
  });
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
  const Kernel<Real> kernel = kernel_of<Real>(rule);
  kernel.split(kernel.parameter, self, points, children.data());
  ASSERT_EQ(children, expected) << name_of_rule(rule) << " width " << rule.width << " points " << points;
}

TEST(CurveKernels, children_are_the_plain_ones_to_the_bit) {
  for (const int set : instruction_sets()) {
    const WithInstructionSet with(set);
    for (ControlCurves rule : all_rules()) {
      const UniformBSpline* bspline = std::get_if<UniformBSpline>(&rule.basis);
      if (rule.wrap != CurveWrap::pinned) continue;
      if (bspline != nullptr && bspline->degree > kernels::kKernelDegree) continue;
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
