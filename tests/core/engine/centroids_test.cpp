// The plain engine's step that puts points into triangles and flips the edges, with the masks of sqrt(3) subdivision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/engine/plain/base_faces.h"
#include "core/engine/plain/centroid_rows.h"
#include "core/engine/plain/centroid_split.h"
#include "core/schemes/sqrt3.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/shapes.h"

namespace subdivd::plain {
namespace {

// Without semi-sharp tags.
std::vector<shapes::NamedShape> all_meshes() {
  std::vector<shapes::NamedShape> meshes = shapes::all_shapes();
  for (Index seed = 1; seed <= 40; ++seed)
    meshes.push_back({"random_" + std::to_string(seed), shapes::random_mesh(seed)});
  std::erase_if(meshes, [](const shapes::NamedShape& shape) {
    const auto semi_sharp = [](float s) { return is_semi_sharp(s); };
    return std::ranges::any_of(shape.mesh.crease_sharpnesses, semi_sharp) ||
           std::ranges::any_of(shape.mesh.corner_sharpnesses, semi_sharp);
  });
  return meshes;
}

struct Surface {
  explicit Surface(const ControlMesh& mesh) : level(base_level(mesh)), points(mesh.points) {}

  std::vector<double> applied(const StepRows& rows) const {
    return apply<double>(rows, std::span<const double>(points), 3);
  }
  void refine() {
    points = applied(step_rows(Sqrt3{}, level, false));
    level = next_level_by_centroids(level);
  }

  Level level;
  std::vector<double> points;
};

double distance(std::span<const double> points, Index a, std::span<const double> others, Index b) {
  return std::hypot(points[3 * a] - others[3 * b], points[3 * a + 1] - others[3 * b + 1],
                    points[3 * a + 2] - others[3 * b + 2]);
}

TEST(CentroidRows, have_weights_that_sum_to_one) {
  for (const auto& [name, mesh] : all_meshes()) {
    Level level = base_level(mesh);
    for (int depth = 0; depth < 3; ++depth, level = next_level_by_centroids(level)) {
      const CentroidNumbers numbers(level, {});
      for (const bool linear : {false, true}) {
        const SparseRows rows = written_out(step_rows(Sqrt3{}, level, linear)),
                         limits = written_out(limit_rows(Sqrt3{}, level, linear)),
                         tangents = written_out(tangent_rows(Sqrt3{}, level, linear));
        ASSERT_EQ(rows.row_count(), numbers.vertex_count) << name;
        ASSERT_EQ(limits.row_count(), level.faces.vertex_count()) << name;
        ASSERT_EQ(tangents.row_count(), 2 * limits.row_count()) << name;
        for (Count r = 0; r < rows.row_count(); ++r) ASSERT_NEAR(sum_of_row(rows, r), 1, 1e-12) << name;
        for (Count r = 0; r < limits.row_count(); ++r) {
          ASSERT_NEAR(sum_of_row(limits, r), 1, 1e-12) << name;
          ASSERT_NEAR(sum_of_row(tangents, 2 * r), 0, 1e-12) << name;
          ASSERT_NEAR(sum_of_row(tangents, 2 * r + 1), 0, 1e-12) << name;
        }
      }
    }
  }
}

// F faces become 3 F, always; of vertices, a first step adds one a face, two steps together two an edge and one a face.
// And every edge keeps the faces it had: what was manifold stays so.
TEST(CentroidSplit, cuts_every_edge_in_three_by_two_steps) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Level base = base_level(mesh);
    const Level first = next_level_by_centroids(base), second = next_level_by_centroids(first);
    const Index v = base.faces.vertex_count(), e = base.faces.edge_count(), f = base.faces.face_count();
    EXPECT_EQ(first.faces.vertex_count(), v + f) << name;
    EXPECT_EQ(first.faces.face_count(), 3 * f) << name;
    EXPECT_EQ(first.faces.edge_count(), e + 3 * f) << name;
    EXPECT_EQ(second.faces.vertex_count(), v + 2 * e + f) << name;
    EXPECT_EQ(second.faces.face_count(), 9 * f) << name;
    EXPECT_EQ(second.faces.edge_count(), 3 * e + 9 * f) << name;
    EXPECT_EQ(is_manifold(second.faces), is_manifold(base.faces)) << name;
    for (const Level* level : {&first, &second}) {
      for (Index h = 0; h < level->faces.half_edge_count(); ++h) {
        const auto ends = level->faces.edge_vertices(level->faces.half_edge_edge(h));
        const Index a = level->faces.corner_vertex(h), b = level->faces.corner_vertex(level->faces.next(h));
        ASSERT_EQ(ends[0], std::min(a, b)) << name;
        ASSERT_EQ(ends[1], std::max(a, b)) << name;
      }
      for (Index edge = 0; edge < level->faces.edge_count(); ++edge) {
        const auto along = level->faces.edge_half_edges(edge);
        ASSERT_GE(along.size(), 1) << name;
        const bool crossed = level->faces.mate(along[0]) != kNoIndex;
        ASSERT_TRUE(crossed || is_infinite(level->sharpness.edges[edge])) << name;
      }
    }
  }
}

// Linear rows show where the points belong: the new vertices of two steps lie at thirds of the edges and in the middles
// of faces.
TEST(CentroidSplit, puts_the_points_of_two_steps_at_thirds_of_edges_and_into_faces) {
  const ControlMesh mesh = shapes::grid(3, 2);
  Surface surface(mesh);
  for (int step = 0; step < 2; ++step) {
    surface.points = surface.applied(step_rows(Sqrt3{}, surface.level, true));
    surface.level = next_level_by_centroids(surface.level);
  }
  const Level base = base_level(mesh);
  std::vector<double> expected = mesh.points;
  const auto add = [&](std::array<Index, 3> corners, std::array<double, 3> weights) {
    for (Index axis = 0; axis < 3; ++axis) {
      double x = 0;
      for (std::size_t k = 0; k < 3; ++k) x += weights[k] * mesh.points[3 * corners[k] + axis];
      expected.push_back(x);
    }
  };
  for (Index e = 0; e < base.faces.edge_count(); ++e)
    for (const Index end : {0u, 1u}) {
      const auto ends = base.faces.edge_vertices(e);
      if (base.faces.edge_half_edges(e).size() == 1)
        add({ends[end], ends[1 - end], 0}, {2.0 / 3, 1.0 / 3, 0});
    }
  for (Index f = 0; f < base.faces.face_count(); ++f) {
    const Index h = 3 * f;
    const auto corner = [&](Index k) { return base.faces.corner_vertex(h + k); };
    add({corner(0), corner(1), corner(2)}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
  }
  for (std::size_t k = 0; k < expected.size(); k += 3) {
    double nearest = 1e9;
    for (std::size_t j = 0; j < surface.points.size(); j += 3)
      nearest = std::min(nearest,
                         std::hypot(expected[k] - surface.points[j], expected[k + 1] - surface.points[j + 1],
                                    expected[k + 2] - surface.points[j + 2]));
    EXPECT_LT(nearest, 1e-14) << k / 3;
  }
}

// Of every vertex that a level has, at the levels that follow.
TEST(Sqrt3Limit, is_the_same_at_every_level) {
  for (const auto& [name, mesh] : all_meshes()) {
    if (mesh.points.size() > 3000) continue;
    Surface surface(mesh);
    const double tolerance = 1e-13 * diagonal(mesh.points);
    for (int depth = 0; depth < 3; ++depth) {
      const std::vector<double> before = surface.applied(limit_rows(Sqrt3{}, surface.level, false));
      const Index vertices = surface.level.faces.vertex_count();
      surface.refine();
      const std::vector<double> after = surface.applied(limit_rows(Sqrt3{}, surface.level, false));
      for (Index v = 0; v < vertices; ++v)
        ASSERT_LT(distance(before, v, after, v), tolerance) << name << ' ' << depth << ' ' << v;
    }
  }
}

TEST(Sqrt3Limit, is_approached_by_the_points) {
  for (const Index n : {3u, 4u, 5u, 7u, 12u}) {
    Surface surface(shapes::double_pyramid(n));
    const std::vector<double> limits = surface.applied(limit_rows(Sqrt3{}, surface.level, false));
    for (int depth = 0; depth < 8; ++depth) surface.refine();
    for (Index v = 0; v < limits.size() / 3; ++v)
      EXPECT_LT(distance(limits, v, surface.points, v), 0.01) << n;
  }
}

TEST(Sqrt3Tangents, keep_their_plane_from_level_to_level) {
  for (const auto& [name, mesh] : all_meshes()) {
    if (mesh.points.size() > 3000) continue;
    Surface surface(mesh);
    std::vector<double> before;
    for (int depth = 0; depth < 4; ++depth) {
      const std::vector<double> tangents = surface.applied(tangent_rows(Sqrt3{}, surface.level, false));
      std::vector<double> normals;
      for (std::size_t k = 0; k < tangents.size(); k += 6) {
        const double* u = &tangents[k];
        const double* v = u + 3;
        double normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double length = std::hypot(normal[0], normal[1], normal[2]);
        for (const double x : normal) normals.push_back(length > 1e-8 ? x / length : 0);
      }
      for (std::size_t k = 0; k < before.size(); k += 3) {
        const double length = std::hypot(before[k], before[k + 1], before[k + 2]) *
                              std::hypot(normals[k], normals[k + 1], normals[k + 2]);
        if (length == 0) continue;
        const double cosine =
            before[k] * normals[k] + before[k + 1] * normals[k + 1] + before[k + 2] * normals[k + 2];
        ASSERT_NEAR(cosine, 1, 1e-9) << name << ' ' << depth << ' ' << k / 3;
      }
      before = normals;
      surface.refine();
    }
  }
}

// Two steps of a border are one ternary step of a cubic B-spline.
TEST(Sqrt3ByRows, has_the_cubic_curve_as_border) {
  const ControlMesh mesh = shapes::disk(7);  // points 1..7 are the border
  Surface surface(mesh);
  surface.refine();
  for (Index v = 1; v <= 7; ++v) EXPECT_EQ(distance(surface.points, v, mesh.points, v), 0);
  surface.refine();
  std::vector<double> border;
  for (Index v = 1; v <= 7; ++v)
    for (Index axis = 0; axis < 3; ++axis) border.push_back(mesh.points[3 * v + axis]);
  // The mask (1, 3, 6, 7, 6, 3, 1) / 9 convolved with (1, 1, 1) / 3: 1 4 10 16 19 16 10 4 1, over 27.
  const double mask[9] = {1, 4, 10, 16, 19, 16, 10, 4, 1};
  std::vector<double> expected(63);
  for (int k = 0; k < 7; ++k)
    for (int i = 0; i < 9; ++i)
      for (int axis = 0; axis < 3; ++axis)
        expected[static_cast<std::size_t>(3 * ((3 * k + i - 4 + 21) % 21) + axis)] +=
            mask[i] / 27 * border[static_cast<std::size_t>(3 * k + axis)];
  for (std::size_t k = 0; k < 21; ++k) {
    double nearest = 1e9;
    for (Index v = 0; v < surface.level.faces.vertex_count(); ++v)
      nearest = std::min(nearest, distance(expected, static_cast<Index>(k), surface.points, v));
    EXPECT_LT(nearest, 1e-15) << k;
  }
}

TEST(Sqrt3ByRows, keeps_corners_and_the_ends_of_creases) {
  ControlMesh mesh = shapes::icosahedron();
  shapes::crease(mesh, {0, mesh.face_vertex_indices[0] == 0 ? mesh.face_vertex_indices[1] : 1},
                 kInfiniteSharpness);
  const std::vector<Index> ends = mesh.crease_indices;
  shapes::corner(mesh, 11, kInfiniteSharpness);
  Surface surface(mesh);
  for (int depth = 0; depth < 4; ++depth) surface.refine();
  for (const Index v : {ends[0], ends[1], Index{11}})
    EXPECT_EQ(distance(surface.points, v, mesh.points, v), 0);
  for (Index v = 0; v < 11; ++v) {
    if (v != ends[0] && v != ends[1]) {
      EXPECT_GT(distance(surface.points, v, mesh.points, v), 0.01);
    }
  }
}

TEST(Sqrt3ByRows, does_not_depend_on_how_points_and_faces_are_numbered) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Renumbered other = renumbered(mesh, 11);
    Surface a(mesh), b(other.mesh);
    for (int depth = 0; depth < 2; ++depth) {
      a.refine();
      b.refine();
    }
    // Faces of two steps: of half-edge h of a face of the first, which is half-edge h / 3 of the base.
    const auto there = [&](Index h) {
      const Index f = h / 9, k = h / 3 % 3, t = other.turned[f];
      return 9 * other.face_at[f] + 3 * ((k + 3 - t) % 3) + h % 3;
    };
    for (Index f = 0; f < a.level.faces.face_count(); ++f)
      for (Index k = 0; k < 3; ++k) {
        const Index v = a.level.faces.corner_vertex(3 * f + k),
                    w = b.level.faces.corner_vertex(3 * there(f) + k);
        ASSERT_LT(distance(a.points, v, b.points, w), 1e-14) << name << ' ' << f;
      }
  }
}

TEST(Sqrt3ByRows, keeps_a_plane_a_plane) {
  for (auto [name, mesh] : all_meshes()) {
    for (std::size_t k = 0; k < mesh.points.size(); k += 3)
      mesh.points[k + 2] = 1 + 2 * mesh.points[k] - 3 * mesh.points[k + 1];
    Surface surface(mesh);
    for (int depth = 0; depth < 3; ++depth) surface.refine();
    for (std::size_t k = 0; k < surface.points.size(); k += 3)
      ASSERT_NEAR(surface.points[k + 2], 1 + 2 * surface.points[k] - 3 * surface.points[k + 1], 1e-13)
          << name;
  }
}

// A face's nine children of two steps come from it, though corners of some lie in its neighbours.
TEST(Sqrt3ByRows, knows_the_base_face_of_every_part) {
  for (const auto& [name, mesh] : all_meshes()) {
    Surface surface(mesh);
    const Adjacency control = surface.level.faces;
    BaseFaces base = first_base_faces(control);
    for (int depth = 0; depth < 2; ++depth) {
      base = next_base_faces_by_centroids(base, surface.level);
      surface.refine();
    }
    ASSERT_EQ(base.of_vertices.size(), surface.level.faces.vertex_count()) << name;
    ASSERT_EQ(base.of_faces.size(), surface.level.faces.face_count()) << name;
    for (Index f = 0; f < base.of_faces.size(); ++f) ASSERT_EQ(base.of_faces[f], f / 9) << name;
    for (Index v = 0; v < base.of_vertices.size(); ++v) {
      const bool is_free = v < control.vertex_count() && control.vertex_corners(v).empty();
      ASSERT_TRUE(is_free ? base.of_vertices[v] == kNoIndex : base.of_vertices[v] < control.face_count())
          << name;
    }
  }
}

TEST(Sqrt3ByRows, are_linear_in_the_faces_of_a_pole) {
  const Index n = 100000;
  const ControlMesh mesh = shapes::double_pyramid(n);
  Level level = base_level(mesh);
  for (int depth = 0; depth < 2; ++depth, level = next_level_by_centroids(level))
    for (const StepRows& rows : {step_rows(Sqrt3{}, level, false), limit_rows(Sqrt3{}, level, false)})
      EXPECT_LT(rows.rows.columns.size() + rows.sums.columns.size(),
                Count{10} * level.faces.half_edge_count());
}

TEST(CentroidSplit, stops_when_the_budget_says_so) {
  Level level = base_level(shapes::icosahedron());
  for (int depth = 0; depth < 6; ++depth) level = next_level_by_centroids(level);
  Budget budget;
  budget.deadline = Budget::Clock::now();
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { next_level_by_centroids(level, pace); }).ok());
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { step_rows(Sqrt3{}, level, false, pace); }).ok());
}

}  // namespace
}  // namespace subdivd::plain
