#include "core/schemes/loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "core/schemes/all.h"

namespace subdivd {
namespace {

TEST(LoopBeta, follows_loop_1987) {
  EXPECT_NEAR((Loop{LoopWeights::loop}.beta(3)), 3.0 / 16, 1e-16);
  EXPECT_NEAR((Loop{LoopWeights::loop}.beta(4)), (5.0 / 8 - 9.0 / 64) / 4, 1e-16);
  EXPECT_NEAR((Loop{LoopWeights::loop}.beta(6)), 1.0 / 16, 1e-16);
  EXPECT_NEAR((Loop{LoopWeights::loop}.beta(12)), (5.0 / 8 - std::pow(3.0 / 8 + std::sqrt(3.0) / 8, 2)) / 12,
              1e-16);
}

TEST(LoopBeta, warren_agrees_at_valences_3_and_6_only) {
  for (Index n : {2, 3, 4, 5, 6, 7, 8, 12, 100}) {
    const double difference = (Loop{LoopWeights::loop}.beta(n)) - (Loop{LoopWeights::warren}.beta(n));
    if (n == 3 || n == 6)
      EXPECT_NEAR(difference, 0, 1e-16) << n;
    else
      EXPECT_GT(std::abs(difference), 1e-5) << n;
  }
}

TEST(LoopEdge, non_manifold_faces_share_the_opposite_weight) {
  const EdgeMask mask = Loop{}.edge_mask({4, 0, {0, 0}});
  EXPECT_EQ(mask.end, 3.0 / 8);
  EXPECT_EQ(mask.opposite, 1.0 / 16);
}

TEST(LoopEdge, sharpness_below_one_blends_crease_and_smooth) {
  const EdgeMask mask = Loop{}.edge_mask({2, 0.25f, {0, 0}});
  EXPECT_DOUBLE_EQ(mask.end, 0.25 / 2 + 0.75 * 3 / 8);
  EXPECT_DOUBLE_EQ(mask.opposite, 0.75 / 8);
}

TEST(LoopVertex, crease_takes_its_two_ends_and_nothing_else) {
  const std::vector<float> edges{0, 10, 0, 0, 10};
  const VertexMask mask = Loop{}.vertex_mask({5, CreaseMethod::uniform, 0, 0, edges, edges});
  EXPECT_EQ(mask.self, 3.0 / 4);
  EXPECT_EQ(mask.each, 0);
  EXPECT_EQ(mask.crease, 1.0 / 8);
  EXPECT_EQ(mask.crease_ends[0], 1u);
  EXPECT_EQ(mask.crease_ends[1], 4u);
}

TEST(LoopVertex, a_dart_is_smooth) {
  const std::vector<float> dart{0, 10, 0, 0, 0}, none(5, 0.0f);
  const VertexMask a = Loop{}.vertex_mask({5, CreaseMethod::uniform, 0, 0, dart, dart});
  const VertexMask b = Loop{}.vertex_mask({5, CreaseMethod::uniform, 0, 0, none, none});
  EXPECT_EQ(a.self, b.self);
  EXPECT_EQ(a.each, b.each);
}

TEST(LoopVertex, a_corner_that_runs_out_blends_into_its_crease) {
  const std::vector<float> edges{10, 0, 10, 0.5f}, child{10, 0, 10, 0};
  const VertexMask mask = Loop{}.vertex_mask({4, CreaseMethod::uniform, 0, 0, edges, child});
  EXPECT_DOUBLE_EQ(mask.self, 0.5 + 0.5 * 3 / 4);
  EXPECT_DOUBLE_EQ(mask.crease, 0.5 / 8);
  EXPECT_EQ(mask.crease_ends[0], 0u);
  EXPECT_EQ(mask.crease_ends[1], 2u);
}

TEST(LoopVertex, without_faces_it_stays) {
  EXPECT_EQ((Loop{}.vertex_mask({0, CreaseMethod::uniform, 0, 0, {}, {}}).self), 1);
}

TEST(LoopLimit, regular_masks_are_those_of_the_box_spline) {
  const VertexMask mask = Loop{}.smooth_limit_mask(6);
  EXPECT_NEAR(mask.self, 1.0 / 2, 1e-15);
  EXPECT_NEAR(mask.each, 1.0 / 12, 1e-15);
}

// That they are left eigenvectors is tested of every scheme; this is the eigenvalue, of either weights. Of a
// tangent only the edge points count: the vertex itself has no weight, or its column sums to nothing.
TEST(LoopTangent, shrinks_by_three_eighths_and_a_quarter_of_the_cosine) {
  for (const Index n : {3, 4, 5, 6, 7, 8, 12, 100}) {
    const double lambda = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4;
    const EdgeMask edge = Loop{}.edge_mask({2, 0, {0, 0}});
    for (const RingMask& mask : {Loop{}.smooth_tangent_u(n), Loop{}.smooth_tangent_v(n)})
      for (Index k = 0; k < n; ++k)
        EXPECT_NEAR(edge.end * mask.edges[k] +
                        edge.opposite * (mask.edges[(k + 1) % n] + mask.edges[(k + n - 1) % n]),
                    lambda * mask.edges[k], 4e-15)
            << n << ' ' << k;
  }
}

TEST(LoopTangent, across_a_crease_shrinks_by_the_cosine_of_a_sector) {
  for (const Index m : {2, 3, 4, 5, 8, 100}) {
    const double lambda = 3.0 / 8 + std::cos(std::numbers::pi / m) / 4;
    const EdgeMask edge = Loop{}.edge_mask({2, 0, {0, 0}});
    const RingMask mask = Loop{}.crease_tangent_across(m);
    const auto inner = [&](Index k) { return k == 0 || k == m ? 0 : mask.edges[k]; };  // borders give nothing
    for (Index k = 1; k < m; ++k)
      EXPECT_NEAR(edge.end * mask.edges[k] + edge.opposite * (inner(k - 1) + inner(k + 1)),
                  lambda * mask.edges[k], 4e-15)
          << m << ' ' << k;
  }
}

TEST(AllSchemes, are_found_by_name_and_no_other_is) {
  AllSchemes schemes;
  std::get<Loop>(schemes).weights = LoopWeights::warren;
  const auto found = find_scheme("loop", schemes);
  ASSERT_TRUE(found.has_value());
  ASSERT_TRUE(std::holds_alternative<Loop>(*found));
  EXPECT_EQ(std::get<Loop>(*found).weights, LoopWeights::warren);
  EXPECT_FALSE(find_scheme("catmullclark").has_value());
  EXPECT_FALSE(find_scheme("").has_value());
}

TEST(AllSchemes, a_mesh_that_names_none_has_the_first) {
  AllSchemes schemes;
  std::get<Loop>(schemes).weights = LoopWeights::warren;
  const auto standard = scheme_of_mesh(ControlMesh().subdivision_scheme, {3, 3}, schemes);
  ASSERT_TRUE(standard.has_value());
  EXPECT_EQ(standard->index(), 0u);
  EXPECT_EQ(std::get<Loop>(*standard).weights, LoopWeights::warren);
  EXPECT_TRUE(scheme_of_mesh(kSchemeNames.back(), {3, 3}).has_value());
  EXPECT_FALSE(scheme_of_mesh("catmullclark", {3, 3}).has_value());
}

TEST(AllSchemes, options_have_names_of_their_own_and_take_their_words) {
  std::set<std::string_view> names;
  for_each_scheme(AllSchemes(), [&]<class S>(const S&) {
    EXPECT_TRUE(names.insert(S::name).second) << S::name;
    for (const SchemeOption<S>& option : S::options()) {
      EXPECT_TRUE(names.insert(option.name).second) << option.name;
      EXPECT_EQ(option.get(S{}), 0u) << option.name << ": the first word is the standard";
      for (std::size_t word = 0; word < option.words.size(); ++word) {
        S scheme;
        option.set(scheme, word);
        EXPECT_EQ(option.get(scheme), word) << option.name;
      }
    }
  });
}

TEST(AllSchemes, opensubdiv_knows_loops_own_weights_only) {
  EXPECT_EQ(beyond_opensubdiv(Loop{}), "");
  EXPECT_NE(beyond_opensubdiv(Loop{LoopWeights::warren}), "");
}

}  // namespace
}  // namespace subdivd
