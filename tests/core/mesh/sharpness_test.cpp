#include "core/mesh/sharpness.h"

#include <gtest/gtest.h>

#include "tests/shapes/build.h"

namespace subdivd {
namespace {

using Floats = std::vector<float>;

Floats decayed(CreaseMethod method, const Floats& parent) {
  Floats child(parent.size());
  decay_around_vertex(method, parent, child);
  return child;
}

TEST(Sharpness, decays_by_one_a_level_and_stays_infinite) {
  EXPECT_EQ(decay(0.0f), 0.0f);
  EXPECT_EQ(decay(0.4f), 0.0f);
  EXPECT_EQ(decay(1.0f), 0.0f);
  EXPECT_EQ(decay(2.3f), 2.3f - 1.0f);
  EXPECT_EQ(decay(kInfiniteSharpness), kInfiniteSharpness);
}

TEST(Sharpness, chaikin_mixes_three_quarters_own_with_a_quarter_of_the_others) {
  EXPECT_EQ(decayed(CreaseMethod::chaikin, {2, 4, 0}),
            (Floats{0.75f * 2 + 0.25f * 4 - 1, 0.75f * 4 + 0.25f * 2 - 1, 0}));
  EXPECT_EQ(decayed(CreaseMethod::uniform, {2, 4, 0}), (Floats{1, 3, 0}));
}

TEST(Sharpness, chaikin_leaves_infinite_edges_out_of_the_mean) {
  EXPECT_EQ(decayed(CreaseMethod::chaikin, {2, kInfiniteSharpness, 0}), (Floats{1, kInfiniteSharpness, 0}));
}

TEST(Rules, count_the_sharp_edges) {
  EXPECT_EQ(rule_of(0, Floats{0, 0, 0}), Rule::smooth);
  EXPECT_EQ(rule_of(0, Floats{0, 0.1f, 0}), Rule::dart);
  EXPECT_EQ(rule_of(0, Floats{10, 0.1f, 0}), Rule::crease);
  EXPECT_EQ(rule_of(0, Floats{10, 0.1f, 1}), Rule::corner);
  EXPECT_EQ(rule_of(0.2f, Floats{0, 0, 0}), Rule::corner);
}

TEST(FractionalWeight, is_the_mean_of_what_runs_out) {
  EXPECT_FLOAT_EQ(fractional_weight(CreaseMethod::uniform, 0.5f, 0, Floats{0.3f, 2}, Floats{0, 1}), 0.4f);
  EXPECT_FLOAT_EQ(fractional_weight(CreaseMethod::uniform, 0, 0, Floats{2, 3}, Floats{1, 2}), 0);
}

TEST(ControlSharpness, the_last_crease_that_names_an_edge_wins) {
  ControlMesh mesh = shapes::cube();
  shapes::crease(mesh, {0, 1}, 3);
  shapes::crease(mesh, {1, 0}, 2);
  const Topology<Triangles> topology(8, Triangles(mesh.face_vertex_indices));
  const Sharpness sharpness = control_sharpness(mesh, topology);
  for (Index e : topology.vertex_edges(0))
    EXPECT_EQ(sharpness.edges[e], topology.other_end(e, 0) == 1 ? 2.0f : 0.0f);
}

TEST(ControlSharpness, pins_border_corners_only_when_asked) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.face_vertex_indices = {0, 1, 2};
  const Topology<Triangles> topology(3, Triangles(mesh.face_vertex_indices));
  EXPECT_EQ(control_sharpness(mesh, topology).vertices, Floats(3, kInfiniteSharpness));
  mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
  EXPECT_EQ(control_sharpness(mesh, topology).vertices, Floats(3, 0.0f));
}

TEST(Holes, boundary_none_leaves_out_the_faces_that_touch_the_border) {
  ControlMesh mesh = shapes::grid(4, 4);
  mesh.interpolate_boundary = BoundaryInterpolation::none;
  const Topology<Triangles> topology(static_cast<Index>(mesh.point_count()),
                                     Triangles(mesh.face_vertex_indices));
  const auto holes = hole_flags(mesh, topology);
  EXPECT_EQ(std::ranges::count(holes, 0), 8);  // the inner 2 x 2 quads
}

}  // namespace
}  // namespace subdivd
