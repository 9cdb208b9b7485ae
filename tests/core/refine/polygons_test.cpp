// Meshes of any faces refined into quads, beside OpenSubdiv's points at every level, and channels beside the plain
// engine's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/grid/kernels/instruction_sets.h"
#include "core/engine/plain/level.h"
#include "core/lattice/quads.h"
#include "core/mesh/channel.h"
#include "core/mesh/topology.h"
#include "core/oracle/far_polygons.h"
#include "core/refine/plan.h"
#include "core/refine/refine.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/random.h"

namespace subdivd {
namespace {

constexpr Index kDepth = 4;
constexpr double kTolerance = 1e-12;  // of the diagonal

double diagonal(const std::vector<double>& points) {
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = points[axis], most = points[axis];
    for (std::size_t k = axis; k < points.size(); k += 3) {
      least = std::min(least, points[k]);
      most = std::max(most, points[k]);
    }
    square += (most - least) * (most - least);
  }
  return std::sqrt(square);
}

// Where the corners of faces that were refined one by one lie on the grid that they belong to, of 2^depth segments.
struct Place {
  Index grid;
  std::array<GridPoint, 4> corners;
};

// A face's children follow its corners.
std::vector<Place> next_places(const std::vector<Place>& places) {
  const auto middle = [](GridPoint a, GridPoint b) { return GridPoint{(a.i + b.i) / 2, (a.j + b.j) / 2}; };
  std::vector<Place> next;
  for (const auto& [grid, c] : places)
    for (std::size_t k = 0; k < 4; ++k)
      next.push_back(
          {grid, {c[k], middle(c[k], c[(k + 1) % 4]), middle(c[0], c[2]), middle(c[k], c[(k + 3) % 4])}});
  return next;
}

std::vector<Place> first_places(Index grids) {
  const Index n = 1u << kDepth;
  std::vector<Place> places;
  for (Index g = 0; g < grids; ++g) places.push_back({g, {{{0, 0}, {n, 0}, {n, n}, {0, n}}}});
  return places;
}

// Our vertices at the corners of the faces of a level as whoever refines face by face has them.
std::vector<Index> corners_in_child_order(const Lattice& lattice, Index level) {
  if (level < lattice.first_level()) return {lattice.base_corners().begin(), lattice.base_corners().end()};
  const Index depth = level - lattice.first_level();
  std::vector<Place> places = first_places(lattice.quads().face_count());
  for (Index k = 0; k < depth; ++k) places = next_places(places);
  const Numbering numbering(lattice.quads(), depth);
  std::vector<Index> corners;
  for (const auto& [grid, c] : places)
    for (const auto [i, j] : c)
      corners.push_back(numbering.vertex(grid, i >> (kDepth - depth), j >> (kDepth - depth)));
  return corners;
}

void expect_as_far(const std::string& name, ControlMesh mesh, const std::string& scheme, CreaseMethod method,
                   Index depth) {
  mesh.subdivision_scheme = scheme;
  const auto far = oracle::far_refine_polygons(
      mesh, {method, scheme == "bilinear", mesh.triangle_subdivision_rule}, depth);
  ASSERT_TRUE(far.ok()) << name;
  const auto plan = Plan::build(mesh, {.crease_method = method}, {});
  ASSERT_TRUE(plan.ok()) << name;
  for (Index level = 0; level <= depth; ++level) {
    const auto ours = refine<double>(mesh, *plan, {.level = level, .crease_method = method}, {});
    ASSERT_TRUE(ours.ok()) << name;
    const std::vector<Index> corners = corners_in_child_order(*plan->mesh().lattice(), level);
    const oracle::FarPolygons& theirs = (*far)[level];
    ASSERT_EQ(corners.size(), theirs.corners.size()) << name;
    double largest = 0;
    for (std::size_t c = 0; c < corners.size(); ++c)
      for (std::size_t axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(ours->points[3 * std::size_t{corners[c]} + axis] -
                                             theirs.points[3 * std::size_t{theirs.corners[c]} + axis]));
    ASSERT_LT(largest, kTolerance * diagonal(mesh.points)) << name << " at level " << level;
  }
}

TEST(CatmullClarkMeshes, are_opensubdivs_on_every_shape) {
  for (auto& [name, mesh] : shapes::polygon_shapes())
    for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin})
      for (const TriangleRule triangles : {TriangleRule::catmull_clark, TriangleRule::smooth}) {
        mesh.triangle_subdivision_rule = triangles;
        expect_as_far(name, mesh, "catmullClark", method,
                      mesh.face_vertex_indices.size() > 1000 ? 2 : kDepth);
      }
}

TEST(BilinearMeshes, are_opensubdivs_on_every_shape) {
  for (const auto& [name, mesh] : shapes::polygon_shapes())
    expect_as_far(name, mesh, "bilinear", CreaseMethod::uniform, 3);
}

TEST(CatmullClarkMeshes, are_opensubdivs_on_random_polygons) {
  for (Index seed = 1; seed <= 500; ++seed) {
    const ControlMesh mesh = shapes::with_joined_faces(shapes::random_mesh(seed), 4 + seed % 6, seed);
    expect_as_far(std::to_string(seed), mesh, "catmullClark",
                  seed % 2 == 0 ? CreaseMethod::uniform : CreaseMethod::chaikin, 3);
  }
}

TEST(CatmullClarkMeshes, take_triangles_when_asked_to) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    if (mesh.face_count() > 300) continue;
    ControlMesh bare = mesh;
    bare.primvars.clear();
    bare.render_meshes.clear();
    bare.hole_indices.clear();
    expect_as_far(name, bare, "catmullClark", CreaseMethod::uniform, 3);
  }
}

// --- channels ---

Polygons polygons_of(const ControlMesh& mesh, std::vector<Index> corners) {
  std::vector<Index> begins{0};
  for (Count f = 0; f < mesh.face_count(); ++f) begins.push_back(begins.back() + mesh.face_size(f));
  return Polygons(std::move(begins), std::move(corners));
}

// With a face-varying primvar that has seams: corners of a face take the point's value, moved by what their face is of.
ControlMesh with_seams(ControlMesh mesh, Index islands) {
  Primvar st{.name = "st",
             .interpolation = Interpolation::face_varying,
             .element_size = 2,
             .values = {},
             .indices = {}};
  const auto points = static_cast<Index>(mesh.point_count());
  for (Index island = 0; island < islands; ++island)
    for (Index v = 0; v < points; ++v)
      st.values.insert(st.values.end(),
                       {mesh.points[3 * v] + 5 * island, mesh.points[3 * v + 1] + mesh.points[3 * v + 2]});
  std::size_t corner = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index size = mesh.face_size(f);
    for (Index k = 0; k < size; ++k)
      st.indices.push_back(mesh.face_vertex_indices[corner++] + points * (f % islands));
  }
  mesh.primvars = {std::move(st)};
  return mesh;
}

void expect_channel_as_plain(const std::string& name, const ControlMesh& mesh, CreaseMethod method) {
  const auto plan = Plan::build(mesh, {.crease_method = method}, {});
  ASSERT_TRUE(plan.ok()) << name;
  const auto vertices = static_cast<Index>(mesh.point_count());
  const auto base =
      std::make_shared<const Topology<Polygons>>(vertices, polygons_of(mesh, mesh.face_vertex_indices));
  const Sharpness sharpness = control_sharpness(mesh, *base);
  const Primvar& primvar = mesh.primvars[0];
  Channel<Polygons> channel = make_channel(mesh, method, base, sharpness, vertices_with_faces(*base),
                                           primvar.indices, static_cast<Index>(primvar.values.size() / 2));
  plain::Level level = plain::first_level(plain::Adjacency(vertices, base->faces()), sharpness, method);
  const auto channel_vertices = static_cast<Index>(channel.values.size());
  plain::Level own = plain::first_level(plain::Adjacency(channel_vertices, channel.topology->faces()),
                                        channel.sharpness, channel.linear, channel.linear_borders, level);
  std::vector<double> values;
  for (const Index value : channel.values)
    values.insert(values.end(),
                  {primvar.values[2 * std::size_t{value}], primvar.values[2 * std::size_t{value} + 1]});
  for (Index depth = 0; depth <= 3; ++depth) {
    const auto refined = refine<double>(mesh, *plan, {.level = depth, .crease_method = method}, {});
    ASSERT_TRUE(refined.ok()) << name;
    const std::vector<Index> corners = corners_in_child_order(*plan->channel(0).lattice(), depth);
    ASSERT_EQ(corners.size(), own.faces.half_edge_count()) << name;
    double largest = 0;
    for (Index h = 0; h < corners.size(); ++h)
      for (Index c = 0; c < 2; ++c)
        largest = std::max(largest, std::abs(refined->primvars[0].values[2 * std::size_t{corners[h]} + c] -
                                             values[2 * std::size_t{own.faces.corner_vertex(h)} + c]));
    ASSERT_LT(largest, kTolerance * diagonal(mesh.points))
        << name << " at level " << depth << ", mode "
        << static_cast<int>(mesh.face_varying_linear_interpolation);
    const auto scheme = as_one_of<AnyGridScheme>(plan->scheme());
    values =
        plain::apply<double>(plain::rows_of(*scheme, method, own, false), std::span<const double>(values), 2);
    level = plain::next_level(level, Split::quads, method);
    own = plain::next_level(own, Split::quads, level);
  }
}

TEST(CatmullClarkMeshes, have_channels_as_the_plain_engine_has_them) {
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    if (mesh.face_vertex_indices.size() > 1000) continue;
    for (int mode = 0; mode < 6; ++mode) {
      ControlMesh seamed = with_seams(mesh, 1 + static_cast<Index>(mode) % 3);
      seamed.subdivision_scheme = "catmullClark";
      seamed.face_varying_linear_interpolation = static_cast<FaceVaryingInterpolation>(mode);
      expect_channel_as_plain(name, seamed, mode % 2 == 0 ? CreaseMethod::uniform : CreaseMethod::chaikin);
    }
  }
}

// --- the rest of an answer ---

TEST(CatmullClarkMeshes, are_the_same_for_any_number_of_threads_and_on_any_processor) {
  for (const Index seed : {3u, 4u, 5u}) {
    ControlMesh mesh = with_seams(shapes::with_joined_faces(shapes::random_mesh(seed), 6, seed), 2);
    RefineOptions options{.level = 6, .limit = true, .normals = true};
    const auto expected = refine<float>(mesh, options, {});
    ASSERT_TRUE(expected.ok());
    for (int set = 0; set < kernels::kInstructionSets; ++set) {
      if (!kernels::has_instruction_set(set)) continue;
      kernels::force_instruction_set(set);
      for (const Index threads : {1, 2, 5}) {
        options.threads = threads;
        const auto refined = refine<float>(mesh, options, {});
        ASSERT_TRUE(refined.ok());
        EXPECT_EQ(refined->points, expected->points) << set << ' ' << threads;
        EXPECT_EQ(refined->limit_points, expected->limit_points) << set << ' ' << threads;
        EXPECT_EQ(refined->normals, expected->normals) << set << ' ' << threads;
        EXPECT_EQ(refined->faces, expected->faces) << set << ' ' << threads;
        EXPECT_EQ(refined->primvars[0].values, expected->primvars[0].values) << set << ' ' << threads;
      }
    }
    kernels::force_instruction_set(-1);
  }
}

// A varying primvar is refined linearly whatever the scheme: bilinear's points are its values.
TEST(CatmullClarkMeshes, refine_varying_values_linearly) {
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    ControlMesh smooth = mesh, linear = mesh;
    smooth.subdivision_scheme = "catmullClark";
    linear.subdivision_scheme = "bilinear";
    smooth.primvars = {{.name = "p",
                        .interpolation = Interpolation::varying,
                        .element_size = 3,
                        .values = mesh.points,
                        .indices = {}}};
    for (const Index level : {0, 1, 2}) {
      const auto a = refine<double>(smooth, {.level = level}, {}),
                 b = refine<double>(linear, {.level = level}, {});
      ASSERT_TRUE(a.ok() && b.ok()) << name;
      for (std::size_t k = 0; k < b->points.size(); ++k)
        ASSERT_NEAR(a->primvars[0].values[k], b->points[k], 1e-14 * diagonal(mesh.points))
            << name << ' ' << level;
    }
  }
}

// The limits of a level's points are where those of the next level lie, from polygons on.
TEST(CatmullClarkMeshes, have_limits_that_outlive_every_step) {
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    ControlMesh smooth = mesh;
    smooth.subdivision_scheme = "catmullClark";
    const auto plan = Plan::build(smooth, {}, {});
    ASSERT_TRUE(plan.ok()) << name;
    for (const Index level : {0, 1, 2}) {
      const auto here = refine<double>(smooth, *plan, {.level = level, .limit = true}, {}),
                 next = refine<double>(smooth, *plan, {.level = level + 1, .limit = true}, {});
      ASSERT_TRUE(here.ok() && next.ok()) << name;
      const auto corners = corners_in_child_order(*plan->mesh().lattice(), level),
                 children = corners_in_child_order(*plan->mesh().lattice(), level + 1);
      // The first corner of the k-th child of a face is its corner k.
      for (std::size_t c = 0; c < corners.size(); ++c)
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_NEAR(here->limit_points[3 * std::size_t{corners[c]} + axis],
                      next->limit_points[3 * std::size_t{children[4 * c]} + axis],
                      1e-12 * diagonal(mesh.points))
              << name << ' ' << level;
    }
  }
}

TEST(Schemes, that_do_not_take_a_mesh_say_so) {
  ControlMesh mesh;
  mesh.points.resize(15);
  mesh.face_vertex_counts = {3, 4};
  mesh.face_vertex_indices = {0, 1, 2, 1, 2, 3, 4};
  mesh.subdivision_scheme = "loop";
  const auto refused = Plan::build(mesh, {}, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_EQ(refused.error().where, (Path{"subdivisionScheme"}));
  EXPECT_NE(refused.error().message.find("face 1 has 4"), std::string::npos) << refused.error().message;
  EXPECT_NE(refused.error().message.find("catmullClark"), std::string::npos) << refused.error().message;
  mesh.subdivision_scheme.clear();
  const auto chosen = Plan::build(mesh, {}, {});
  ASSERT_TRUE(chosen.ok());
  EXPECT_TRUE(std::holds_alternative<CatmullClark>(chosen->scheme()));
}

}  // namespace
}  // namespace subdivd
