#include "core/refine/render_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/refine/refine.h"
#include "tests/shapes/build.h"

namespace subdivd {
namespace {

// A tube cut along a column for rendering: the points of column 0 appear twice.
ControlMesh cut_tube() {
  ControlMesh mesh = shapes::tube(6, 3);
  RenderMesh render{0,
                    static_cast<Index>(mesh.face_count()),
                    static_cast<Index>(mesh.point_count() + mesh.point_count() / 6),
                    {}};
  const std::size_t half = mesh.face_vertex_indices.size();
  for (std::size_t h = 0; h < half; h += 3) {
    bool last = false, first = false;
    for (std::size_t k = 0; k < 3; ++k) {
      last |= mesh.face_vertex_indices[h + k] % 6 == 5;
      first |= mesh.face_vertex_indices[h + k] % 6 == 0;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.face_vertex_indices[h + k];
      render.indices.push_back(last && first && v % 6 == 0 ? static_cast<Index>(mesh.point_count()) + v / 6
                                                           : v);
    }
  }
  mesh.render_meshes = {render};
  return mesh;
}

Buffer<Index> indices_of(const RefinedRenderMesh& render) { return *render.triangles.all(1, {}); }

TEST(RenderMesh, copies_positions_so_that_seams_cannot_crack) {
  const ControlMesh mesh = cut_tube();
  ASSERT_TRUE(mesh.check().ok());
  RefineOptions options;
  options.level = 2;
  const auto refined = refine<float>(mesh, options, {});
  ASSERT_TRUE(refined.ok());
  const RefinedRenderMesh& render = refined->render_meshes[0];
  const Buffer<Index> indices = indices_of(render);
  ASSERT_EQ(indices.size(), refined->faces.size());
  // Every corner of the render mesh copies the refined vertex that stands at that corner.
  for (std::size_t k = 0; k < indices.size(); ++k)
    ASSERT_EQ(render.source_vertices[indices[k]], refined->faces[k]);
  // The seam's refined points exist twice: its render vertices, and 3 points inside each edge between them.
  const Count seam = mesh.point_count() / 6;
  EXPECT_EQ(render.vertex_count, refined->points.size() / 3 + seam + 3 * (seam - 1));
}

TEST(RenderMesh, parts_take_their_own_ranges_of_triangles) {
  ControlMesh mesh = shapes::cube();
  mesh.render_meshes = {{0, 5, 8, {}}, {5, 12, 8, {}}};
  const auto cut = mesh.face_vertex_indices.begin() + 15;
  mesh.render_meshes[0].indices.assign(mesh.face_vertex_indices.begin(), cut);
  mesh.render_meshes[1].indices.assign(cut, mesh.face_vertex_indices.end());
  mesh.hole_indices = {1, 6};
  RefineOptions options;
  options.level = 1;
  const auto refined = refine<float>(mesh, options, {});
  EXPECT_EQ(refined->render_meshes[0].face_begin, 0u);
  EXPECT_EQ(refined->render_meshes[0].face_end, 16u);
  EXPECT_EQ(refined->render_meshes[1].face_begin, 16u);
  EXPECT_EQ(refined->render_meshes[1].face_end, 40u);
  for (const RefinedRenderMesh& render : refined->render_meshes) {
    const Buffer<Index> indices = indices_of(render);
    ASSERT_EQ(indices.size(), 3 * (render.face_end - render.face_begin));
    for (Count k = 0; k < indices.size(); ++k)
      EXPECT_EQ(render.source_vertices[indices[k]], refined->faces[3 * render.face_begin + k]);
  }
}

// The whole mesh, under its own numbers.
ControlMesh rendered_as_it_is(ControlMesh mesh) {
  mesh.render_meshes = {{0, static_cast<Index>(mesh.face_count()), static_cast<Index>(mesh.point_count()),
                         mesh.face_vertex_indices}};
  return mesh;
}

RefinedRenderMesh refined_render_mesh(const ControlMesh& mesh) {
  EXPECT_TRUE(mesh.check().ok());
  auto refined = refine<float>(mesh, {.level = 2}, {});
  EXPECT_TRUE(refined.ok());
  EXPECT_EQ(refined->render_meshes[0].triangles.index_count(), refined->faces.size());
  return std::move(refined->render_meshes[0]);
}

TEST(RenderMesh, that_connects_as_the_mesh_does_needs_no_sources) {
  const ControlMesh mesh = rendered_as_it_is(shapes::icosahedron());
  const RefinedRenderMesh render = refined_render_mesh(mesh);
  EXPECT_TRUE(render.source_vertices.empty());
  EXPECT_EQ(indices_of(render), refine<float>(mesh, {.level = 2}, {})->faces);
  EXPECT_EQ(render.vertex_count, refine<float>(mesh, {.level = 2}, {})->points.size() / 3);
}

TEST(RenderMesh, with_a_hole_says_which_vertices_no_triangle_uses) {
  ControlMesh mesh = rendered_as_it_is(shapes::icosahedron());
  mesh.hole_indices = {3};
  const RefinedRenderMesh render = refined_render_mesh(mesh);
  // The three points inside the hole.
  EXPECT_EQ(std::ranges::count(render.source_vertices, kNoIndex), 3);
}

TEST(RenderMesh, with_a_point_that_no_face_uses_says_so) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.points.insert(mesh.points.end(), {9, 9, 9});
  const RefinedRenderMesh render = refined_render_mesh(rendered_as_it_is(mesh));
  EXPECT_EQ(std::ranges::count(render.source_vertices, kNoIndex), 1);
}

TEST(RenderMesh, whose_seams_are_those_of_a_channel_takes_that_channels_values_as_they_are) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.primvars = {shapes::seamed(mesh, "st", 2, shapes::edges_along({0, 1, 2}))};
  const Primvar& st = mesh.primvars[0];
  mesh.render_meshes = {
      {0, static_cast<Index>(mesh.face_count()), static_cast<Index>(st.values.size() / 2), st.indices}};
  const RefinedRenderMesh render = refined_render_mesh(mesh);
  EXPECT_EQ(render.source_vertices.size(), render.vertex_count);
  ASSERT_EQ(render.source_values.size(), 1u);
  EXPECT_TRUE(render.source_values[0].empty());
  EXPECT_EQ(indices_of(render), refine<float>(mesh, {.level = 2}, {})->primvars[0].indices);
}

}  // namespace
}  // namespace subdivd
