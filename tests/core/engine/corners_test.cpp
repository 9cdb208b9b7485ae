// The plain engine's step that makes a vertex of every corner, with Doo and Sabin's masks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/curves/subdivision.h"
#include "core/engine/plain/corner_rows.h"
#include "core/engine/plain/corner_split.h"
#include "core/schemes/catmull_clark.h"
#include "core/schemes/doo_sabin.h"
#include "core/schemes/tags.h"
#include "core/surfaces/patch.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {
namespace {

constexpr std::array kBothWeights = {DooSabin{DooSabinWeights::doo_sabin},
                                     DooSabin{DooSabinWeights::midpoint}};

// Polygons, and triangles that are not manifold; semi-sharp tags are left out.
std::vector<shapes::NamedShape> all_meshes() {
  std::vector<shapes::NamedShape> meshes = shapes::polygon_shapes();
  for (const auto& shape : shapes::non_manifold_shapes()) meshes.push_back(shape);
  for (const auto& shape : shapes::border_shapes()) meshes.push_back(shape);
  for (Index seed = 1; seed <= 40; ++seed)
    meshes.push_back({"random_" + std::to_string(seed),
                      shapes::with_joined_faces(shapes::random_mesh(seed), 4 + seed % 6, seed)});
  std::erase_if(meshes, [](const shapes::NamedShape& shape) {
    const auto semi_sharp = [](float s) { return is_semi_sharp(s); };
    return std::ranges::any_of(shape.mesh.crease_sharpnesses, semi_sharp) ||
           std::ranges::any_of(shape.mesh.corner_sharpnesses, semi_sharp);
  });
  return meshes;
}

Level first_of(const ControlMesh& mesh) {
  Level level = base_level(mesh);
  if (mesh.interpolate_boundary == BoundaryInterpolation::none) open_borders(level, mesh);
  return level;
}

// A level with its points, and the step to the next.
struct Surface {
  explicit Surface(const ControlMesh& mesh, DooSabin of = {})
      : scheme(of), level(first_of(mesh)), points(mesh.points), split(split_corners(level)) {}

  void refine() {
    points = apply<double>(step_rows(scheme, level, split), std::span<const double>(points), 3);
    level = next_level(std::move(split));
    split = split_corners(level);
  }
  std::array<double, 3> at(Index v) const { return {points[3 * v], points[3 * v + 1], points[3 * v + 2]}; }
  std::array<double, 3> centroid(Index f) const {
    std::array<double, 3> sum{};
    const Index n = level.faces.face_size(f);
    for (Index k = 0; k < n; ++k)
      for (Index axis = 0; axis < 3; ++axis)
        sum[axis] += points[3 * level.faces.corner_vertex(level.faces.face_begin(f) + k) + axis] / n;
    return sum;
  }

  DooSabin scheme;
  Level level;
  std::vector<double> points;
  CornerSplit split;
};

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(DooSabinMask, is_that_of_1978_and_that_of_the_course) {
  for (const Index n : {3u, 4u, 5u, 7u, 12u, 100u}) {
    const CornerMask mask = DooSabin{}.corner_mask(n), middle = kBothWeights[1].corner_mask(n);
    for (Index i = 0; i < n; ++i) {
      const double wave = std::cos(2 * std::numbers::pi * i / n);
      const double weight = (i == 0 ? mask.self : 0) + (mask.mean + mask.wave * wave) / n;
      EXPECT_NEAR(weight, i == 0 ? 1.0 / 4 + 5.0 / (4 * n) : (3 + 2 * wave) / (4 * n), 1e-15);
      const double of_middle = (i == 0 ? middle.self : 0) + (i == 1 || i == n - 1 ? middle.beside : 0) +
                               (middle.mean + middle.wave * wave) / n;
      EXPECT_NEAR(of_middle, (i == 0 ? 1.0 / 2 : i == 1 || i == n - 1 ? 1.0 / 8 : 0) + 1.0 / (4 * n), 1e-15);
      if (n == 4) {
        EXPECT_NEAR(weight, of_middle, 1e-16);
      }
    }
  }
}

TEST(DooSabinScheme, refuses_semi_sharpness_by_its_own_name) {
  ControlMesh mesh = shapes::octahedron();
  shapes::crease(mesh, {0, 2}, kInfiniteSharpness);
  EXPECT_TRUE(refuse_semi_sharp(DooSabin::name, mesh).ok());
  shapes::crease(mesh, {0, 3}, 2.5f);
  const auto refused = refuse_semi_sharp(DooSabin::name, mesh);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_EQ(refused.error().where, (Path{"creaseSharpnesses", std::uint64_t{1}}));
  EXPECT_NE(refused.error().message.find("dooSabin"), std::string::npos);
  mesh.crease_sharpnesses[1] = 0;
  shapes::corner(mesh, 1, 0.5f);
  EXPECT_EQ(refuse_semi_sharp(DooSabin::name, mesh).error().where,
            (Path{"cornerSharpnesses", std::uint64_t{0}}));
  EXPECT_FALSE(takes_semi_sharp<DooSabin>());
  EXPECT_TRUE(takes_semi_sharp<CatmullClark>());
}

TEST(DooSabinScheme, has_an_option_for_its_weights) {
  ASSERT_EQ(DooSabin::options().size(), 1);
  const SchemeOption<DooSabin>& option = DooSabin::options()[0];
  EXPECT_EQ(option.name, "dooSabinWeights");
  DooSabin scheme;
  EXPECT_EQ(option.words[option.get(scheme)], "dooSabin");
  option.set(scheme, 1);
  EXPECT_EQ(scheme.weights, DooSabinWeights::midpoint);
  EXPECT_EQ(option.words[option.get(scheme)], "midpoint");
}

TEST(CornerRows, have_weights_that_sum_to_one) {
  for (const auto& [name, mesh] : all_meshes())
    for (const DooSabin& scheme : kBothWeights) {
      Level level = first_of(mesh);
      for (int depth = 0; depth < 3; ++depth) {
        CornerSplit split = split_corners(level);
        const SparseRows rows = written_out(step_rows(scheme, level, split)),
                         limits = written_out(limit_rows(scheme, level, split)),
                         tangents = written_out(tangent_rows(scheme, level, split));
        ASSERT_EQ(rows.row_count(), level.faces.half_edge_count() + split.more.size());
        ASSERT_EQ(rows.row_count(), split.faces.vertex_count());
        ASSERT_EQ(limits.row_count(), level.faces.vertex_count());
        ASSERT_EQ(tangents.row_count(), 2 * limits.row_count());
        for (Count r = 0; r < rows.row_count(); ++r)
          ASSERT_NEAR(sum_of_row(rows, r), 1, 1e-12) << name << ' ' << depth << ' ' << r;
        for (Count r = 0; r < limits.row_count(); ++r) {
          ASSERT_NEAR(sum_of_row(limits, r), 1, 1e-12) << name << ' ' << depth << ' ' << r;
          ASSERT_NEAR(sum_of_row(tangents, 2 * r), 0, 1e-12) << name << ' ' << r;
          ASSERT_NEAR(sum_of_row(tangents, 2 * r + 1), 0, 1e-12) << name << ' ' << r;
        }
        level = next_level(std::move(split));
      }
    }
}

// With all that is sharp or not manifold, a step leaves a surface whose borders are curves or open.
TEST(CornerSplit, leaves_a_manifold_whose_every_vertex_has_a_face) {
  for (const auto& [name, mesh] : all_meshes()) {
    Level level = first_of(mesh);
    for (int depth = 0; depth < 3; ++depth) {
      level = next_level(split_corners(level));
      ASSERT_TRUE(is_manifold(level.faces)) << name << ' ' << depth;
      for (Index e = 0; e < level.faces.edge_count(); ++e) {
        const bool border = level.faces.edge_half_edges(e).size() == 1;
        const auto [a, b] = level.faces.edge_vertices(e);
        if (!border && is_sharp(level.sharpness.edges[e])) {  // a slit between two pinned points
          ASSERT_TRUE(is_infinite(level.sharpness.vertices[a]) && is_infinite(level.sharpness.vertices[b]))
              << name << ' ' << depth;
        } else if (!border) {
          ASSERT_EQ(level.sharpness.edges[e], 0) << name << ' ' << depth;
        } else if (mesh.interpolate_boundary != BoundaryInterpolation::none) {
          ASSERT_EQ(level.sharpness.edges[e], kInfiniteSharpness) << name << ' ' << depth << ' ' << e;
        }
      }
      for (Index v = 0; v < level.faces.vertex_count(); ++v) {
        const std::size_t corners = level.faces.vertex_corners(v).size();
        ASSERT_GE(corners, 1) << name << ' ' << depth;
        ASSERT_LE(level.faces.vertex_edges(v).size(), corners + 1) << name << ": several fans at " << v;
      }
    }
  }
}

TEST(CornerSplit, makes_of_a_closed_mesh_a_vertex_per_corner_and_a_face_per_face_edge_and_vertex) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Level level = base_level(mesh);
    bool ordinary = std::ranges::none_of(level.sharpness.edges, is_sharp) &&
                    std::ranges::none_of(level.sharpness.vertices, is_sharp);
    for (Index v = 0; v < level.faces.vertex_count(); ++v)
      ordinary &= level.faces.vertex_corners(v).size() > 2;
    if (!ordinary) continue;
    const CornerSplit split = split_corners(level);
    EXPECT_EQ(split.faces.vertex_count(), level.faces.half_edge_count()) << name;
    EXPECT_EQ(split.faces.face_count(),
              level.faces.face_count() + level.faces.edge_count() + level.faces.vertex_count())
        << name;
    EXPECT_EQ(split.faces.edge_count(), 2 * level.faces.half_edge_count()) << name;
    ASSERT_EQ(split.face_parents.size(), split.faces.face_count());
    for (Index f = 0; f < level.faces.face_count(); ++f) EXPECT_EQ(split.face_parents[f], f);
  }
}

// --- The witness: biquadratic B-splines ----------------------------------------------------------------------

// A grid of quads over the points of a patch; column and row of each vertex, which follow the corners of a step.
struct Grid {
  ControlMesh mesh;
  ControlPatch patch;
  std::vector<Index> columns, rows;
};

Grid grid_of(Index columns, Index rows, bool closed) {
  Grid grid;
  grid.patch.u_count = columns;
  grid.patch.v_count = rows;
  grid.patch.u_degree = grid.patch.v_degree = 2;
  if (closed) grid.patch.u_wrap = grid.patch.v_wrap = CurveWrap::periodic;
  std::vector<shapes::Point> points;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i)
      points.push_back({0.3 * i, 0.2 * j, std::sin(1.7 * i) + std::cos(2.3 * j)});
  grid.mesh = shapes::mesh_of(points, {});
  grid.patch.points = grid.mesh.points;
  for (Index j = 0; j + (closed ? 0 : 1) < rows; ++j)
    for (Index i = 0; i + (closed ? 0 : 1) < columns; ++i) {
      const Index right = (i + 1) % columns, above = (j + 1) % rows;
      grid.mesh.face_vertex_counts.push_back(4);
      grid.mesh.face_vertex_indices.insert(
          grid.mesh.face_vertex_indices.end(),
          {j * columns + i, j * columns + right, above * columns + right, above * columns + i});
    }
  for (Index v = 0; v < columns * rows; ++v) {
    grid.columns.push_back(v % columns);
    grid.rows.push_back(v / columns);
  }
  return grid;
}

double deviation_from_patch(Grid grid, DooSabin scheme, Index depth) {
  Surface surface(grid.mesh, scheme);
  const bool closed = grid.patch.u_wrap == CurveWrap::periodic;
  double largest = 0;
  Index columns = grid.patch.u_count, rows = grid.patch.v_count;
  for (Index l = 1; l <= depth; ++l) {
    // Where the vertices of the step stand: a face's corner in the lower half or in the upper one.
    const Adjacency& faces = surface.level.faces;
    const auto child = [&](Index own, Index other, Index count) {
      const bool lower = closed ? (own + 1) % count == other : own < other;
      if (!closed) return lower ? 2 * own : 2 * other + 1;
      return (lower ? 2 * own + 1 : 2 * own) % (2 * count);
    };
    std::vector<Index> next_columns, next_rows;
    for (Index h = 0; h < faces.half_edge_count(); ++h) {
      const Index v = faces.corner_vertex(h), opposite = faces.corner_vertex(faces.next(faces.next(h)));
      next_columns.push_back(child(grid.columns[v], grid.columns[opposite], columns));
      next_rows.push_back(child(grid.rows[v], grid.rows[opposite], rows));
    }
    surface.refine();
    grid.columns = next_columns;
    grid.rows = next_rows;
    columns = closed ? 2 * columns : 2 * columns - 2;
    rows = closed ? 2 * rows : 2 * rows - 2;
    const auto patch = refine<double>(grid.patch, {.level = l}, {});
    EXPECT_EQ(patch->u_count, columns);
    EXPECT_EQ(surface.level.faces.vertex_count(), patch->u_count * patch->v_count);
    for (Index v = 0; v < grid.columns.size(); ++v)
      for (Index axis = 0; axis < 3; ++axis)
        largest =
            std::max(largest, std::abs(surface.points[3 * v + axis] -
                                       patch->points[3 * (grid.rows[v] * columns + grid.columns[v]) + axis]));
  }
  return largest;
}

TEST(DooSabinByRows, is_the_pinned_biquadratic_surface_on_a_grid) {
  for (const DooSabin& scheme : kBothWeights) {
    EXPECT_LT(deviation_from_patch(grid_of(5, 4, false), scheme, 3), 1e-14);
    EXPECT_LT(deviation_from_patch(grid_of(3, 3, false), scheme, 4), 1e-14);
  }
}

TEST(DooSabinByRows, is_the_periodic_biquadratic_surface_on_a_torus) {
  for (const DooSabin& scheme : kBothWeights)
    EXPECT_LT(deviation_from_patch(grid_of(5, 4, true), scheme, 3), 1e-14);
}

// --- Borders and creases -----------------------------------------------------------------------------------

// The vertices along the border from half-edge h on.
std::vector<Index> border_from(const Adjacency& faces, Index h) {
  std::vector<Index> vertices;
  const Index start = h;
  do {
    vertices.push_back(faces.corner_vertex(h));
    h = faces.next(h);
    while (faces.mate(h) != kNoIndex) h = faces.next(faces.mate(h));
  } while (h != start);
  return vertices;
}

TEST(DooSabinByRows, has_chaikins_curve_as_border_where_corners_are_round) {
  std::vector<ControlMesh> meshes;
  for (const auto& [name, mesh] : all_meshes())
    if (name == "one_quad" || name == "one_triangle" || name == "one_pentagon" ||
        name == "grid_border_edges" || name == "pole_of_5_quads" || name == "pole_of_8_triangles")
      meshes.push_back(mesh);
  ASSERT_EQ(meshes.size(), 6);
  for (ControlMesh& mesh : meshes) {
    mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
    Surface surface(mesh);
    const auto some_border = [&] {
      Index h = 0;
      while (surface.level.faces.mate(h) != kNoIndex) ++h;
      return h;
    };
    ControlCurves curve;
    curve.wrap = CurveWrap::periodic;
    curve.basis = UniformBSpline{2};
    for (const Index v : border_from(surface.level.faces, some_border()))
      for (const double x : surface.at(v)) curve.points.push_back(x);
    for (Index l = 1; l <= 3; ++l) {
      surface.refine();
      const auto refined = refine<double>(curve, {.level = l}, {});
      const std::vector<Index> border = border_from(surface.level.faces, some_border());
      ASSERT_EQ(3 * border.size(), refined->points.size()) << mesh.name;
      double nearest = 1e9;
      for (std::size_t shift = 0; shift < border.size(); ++shift) {
        double largest = 0;
        for (std::size_t k = 0; k < border.size(); ++k)
          for (Index axis = 0; axis < 3; ++axis)
            largest =
                std::max(largest, std::abs(surface.points[3 * border[(k + shift) % border.size()] + axis] -
                                           refined->points[3 * k + axis]));
        nearest = std::min(nearest, largest);
      }
      EXPECT_LT(nearest, 1e-14) << mesh.name << ' ' << l;
    }
  }
}

// Both sides of a crease follow the same curve, whatever their faces, corners and darts are: nothing gapes.
TEST(DooSabinByRows, keeps_both_sides_of_a_crease_together) {
  std::vector<std::pair<std::string, ControlMesh>> meshes;
  for (const auto& [name, mesh] : all_meshes())
    if (mesh.crease_lengths.size() > 0 || name == "fin") meshes.emplace_back(name, mesh);
  int closed = 0;
  for (auto& [name, mesh] : meshes) {
    Surface surface(mesh);
    bool has_border = false;
    for (Index e = 0; e < surface.level.faces.edge_count(); ++e)
      has_border |= surface.level.faces.edge_half_edges(e).size() == 1;
    if (has_border) continue;
    ++closed;
    for (int depth = 0; depth < 3; ++depth) {
      surface.refine();
      std::map<std::array<std::array<double, 3>, 2>, int> sides;
      for (Index e = 0; e < surface.level.faces.edge_count(); ++e) {
        if (surface.level.faces.edge_half_edges(e).size() != 1) continue;
        std::array ends{surface.at(surface.level.faces.edge_vertices(e)[0]),
                        surface.at(surface.level.faces.edge_vertices(e)[1])};
        std::ranges::sort(ends);
        if (ends[0] != ends[1]) ++sides[ends];  // the tip of a slit
      }
      for (const auto& [ends, count] : sides) EXPECT_EQ(count, 2) << name << ' ' << depth;
    }
  }
  EXPECT_GE(closed, 3);
}

TEST(DooSabinByRows, loses_the_strip_along_an_open_border) {
  for (const auto& [name, mesh] : all_meshes())
    if (name == "grid_border_none") {
      Surface surface(mesh);
      surface.refine();
      EXPECT_EQ(surface.level.faces.vertex_count(), 24);  // of 3 x 2 quads: 6 x 4 points, 5 x 3 quads
      EXPECT_EQ(surface.level.faces.face_count(), 15);
    }
}

TEST(DooSabinByRows, keeps_pinned_vertices_where_they_are) {
  for (auto [name, mesh] : all_meshes()) {
    if (mesh.points.size() > 300) continue;
    mesh.corner_indices = {mesh.face_vertex_indices[0]};
    mesh.corner_sharpnesses = {kInfiniteSharpness};
    Surface surface(mesh);
    const std::array<double, 3> pinned = surface.at(mesh.corner_indices[0]);
    if (mesh.interpolate_boundary == BoundaryInterpolation::none) continue;
    for (int depth = 0; depth < 3; ++depth) {
      surface.refine();
      double nearest = 1e9;
      for (Index v = 0; v < surface.level.faces.vertex_count(); ++v)
        if (is_infinite(surface.level.sharpness.vertices[v]))
          nearest = std::min(nearest, distance(surface.at(v), pinned));
      EXPECT_EQ(nearest, 0) << name << ' ' << depth;
    }
  }
}

// --- Limits --------------------------------------------------------------------------------------------------

// A limit is the centroid of a face of the next level, and stays one of every level from there on; on a curve it is
// the middle of an edge, and stays so.
TEST(DooSabinLimit, is_met_by_every_level_that_follows) {
  for (const auto& [name, mesh] : all_meshes())
    for (const DooSabin& scheme : kBothWeights) {
      if (mesh.points.size() > 600) continue;
      Surface surface(mesh, scheme);
      const double tolerance = 1e-13 * diagonal(mesh.points);
      for (int depth = 0; depth < 2; ++depth) {
        const std::vector<double> limits = apply<double>(limit_rows(scheme, surface.level, surface.split),
                                                         std::span<const double>(surface.points), 3);
        const CornerSplit split = surface.split;
        const Adjacency before = surface.level.faces;
        Surface later = surface;
        later.refine();
        // Of smooth vertices inside: the faces of their sectors.
        for (int more = 0; more < 2; ++more, later.refine()) {
          std::vector<std::array<double, 3>> places;
          for (Index f = 0; f < later.level.faces.face_count(); ++f) places.push_back(later.centroid(f));
          for (Index e = 0; e < later.level.faces.edge_count(); ++e) {
            const auto [a, b] = later.level.faces.edge_vertices(e);
            if (is_infinite(later.level.sharpness.edges[e]))
              places.push_back({(later.at(a)[0] + later.at(b)[0]) / 2, (later.at(a)[1] + later.at(b)[1]) / 2,
                                (later.at(a)[2] + later.at(b)[2]) / 2});
          }
          for (Index v = 0; v < later.level.faces.vertex_count(); ++v)
            if (is_infinite(later.level.sharpness.vertices[v])) places.push_back(later.at(v));
          for (Index v = 0; v < before.vertex_count(); ++v) {
            const bool open = std::ranges::any_of(before.vertex_edges(v),
                                                  [&](Index e) { return split.roles[e] == EdgeRole::open; });
            if (before.vertex_corners(v).empty() || open) continue;
            if (more == 0 && before.vertex_corners(v).size() == 2) continue;  // met one level later
            const std::array<double, 3> limit{limits[3 * v], limits[3 * v + 1], limits[3 * v + 2]};
            double nearest = 1e9;
            for (const auto& place : places) nearest = std::min(nearest, distance(place, limit));
            ASSERT_LT(nearest, tolerance) << name << ' ' << depth << ' ' << more << ' ' << v;
          }
        }
        surface.refine();
      }
    }
}

// The tangents at a vertex, taken at one level and at the next around the face in its place: halved by Doo and
// Sabin's weights.
TEST(DooSabinTangents, span_the_same_plane_from_level_to_level) {
  for (const auto& [name, mesh] : all_meshes()) {
    if (name != "prism_of_7" && name != "quad_cube" && name != "prism_of_5") continue;
    Surface surface(mesh);
    surface.refine();
    // A vertex of 4 faces; its face at the next level has the corners in the order of the sector.
    const std::vector<double> tangents =
        apply<double>(tangent_rows(surface.scheme, surface.level, surface.split),
                      std::span<const double>(surface.points), 3);
    const CornerSplit split = surface.split;
    const Index vertices = surface.level.faces.vertex_count();
    surface.refine();
    for (Index s = 0; s < split.sectors.count(); ++s) {
      const auto corners = split.sectors.corners(s);
      std::array<double, 3> u{}, w{};
      // One step on, the corners of that face are the corners of its own vertices there.
      Surface later = surface;
      const Index face = static_cast<Index>(split.faces.face_count() - vertices + s);
      later.refine();
      for (Index i = 0; i < corners.size(); ++i)
        for (Index axis = 0; axis < 3; ++axis) {
          const double x = later.points[3 * (surface.level.faces.face_begin(face) + i) + axis];
          u[axis] += std::cos(2 * std::numbers::pi * i / static_cast<double>(corners.size())) * x;
          w[axis] += std::sin(2 * std::numbers::pi * i / static_cast<double>(corners.size())) * x;
        }
      ASSERT_EQ(surface.level.faces.corner_vertex(surface.level.faces.face_begin(face)), corners[0]);
      const Index v = s;  // every vertex has one sector, by number
      for (Index axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(2 * u[axis], tangents[6 * v + axis], 1e-14) << name;
        EXPECT_NEAR(2 * w[axis], tangents[6 * v + 3 + axis], 1e-14) << name;
      }
    }
  }
}

// --- Order and size ------------------------------------------------------------------------------------------

TEST(DooSabinByRows, does_not_depend_on_how_points_and_faces_are_numbered) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Renumbered other = renumbered(mesh, 7);
    Surface a(mesh), b(other.mesh);
    const Adjacency from = a.level.faces, to = b.level.faces;
    a.refine();
    b.refine();
    ASSERT_EQ(a.level.faces.vertex_count(), b.level.faces.vertex_count()) << name;
    ASSERT_EQ(a.level.faces.face_count(), b.level.faces.face_count()) << name;
    for (Index f = 0; f < from.face_count(); ++f) {
      const Index n = from.face_size(f);
      for (Index k = 0; k < n; ++k) {
        const Index there = to.face_begin(other.face_at[f]) + (k + n - other.turned[f]) % n;
        ASSERT_LT(distance(a.at(from.face_begin(f) + k), b.at(there)), 1e-14) << name;
      }
    }
  }
}

TEST(DooSabinByRows, keeps_a_plane_a_plane) {
  for (auto [name, mesh] : all_meshes()) {
    for (std::size_t k = 0; k < mesh.points.size(); k += 3)
      mesh.points[k + 2] = 1 + 2 * mesh.points[k] - 3 * mesh.points[k + 1];
    Surface surface(mesh);
    surface.refine();
    surface.refine();
    for (Index v = 0; v < surface.level.faces.vertex_count(); ++v) {
      const auto [x, y, z] = surface.at(v);
      ASSERT_NEAR(z, 1 + 2 * x - 3 * y, 1e-13) << name;
    }
  }
}

// Two faces of 100,000 corners see all of them from each: rows written out would have 2e10 weights.
TEST(DooSabinByRows, are_linear_in_the_corners_of_a_face) {
  const Index n = 100000;
  ControlMesh mesh;
  for (Index k = 0; k < 2 * n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    mesh.points.insert(mesh.points.end(), {std::cos(angle), std::sin(angle), k < n ? -0.5 : 0.5});
  }
  mesh.face_vertex_counts = {n, n};
  for (Index k = 0; k < n; ++k) mesh.face_vertex_indices.push_back(n - 1 - k);
  for (Index k = 0; k < n; ++k) mesh.face_vertex_indices.push_back(n + k);
  for (Index k = 0; k < n; ++k) {
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  const Level level = base_level(mesh);
  const CornerSplit split = split_corners(level);
  for (const StepRows& rows : {step_rows(DooSabin{}, level, split), limit_rows(DooSabin{}, level, split)}) {
    EXPECT_LT(rows.rows.columns.size() + rows.sums.columns.size(), Count{60} * n);
    const std::vector<double> points = apply<double>(rows, std::span<const double>(mesh.points), 3);
    for (std::size_t k = 0; k < points.size(); k += 3) ASSERT_LT(std::abs(points[k + 2]), 0.5 + 1e-9);
  }
  // All corners of such a face are its own shrunk by half.
  const std::vector<double> points =
      apply<double>(step_rows(DooSabin{}, level, split), std::span<const double>(mesh.points), 3);
  for (Index k = 0; k < n; k += 997) EXPECT_NEAR(std::hypot(points[3 * k], points[3 * k + 1]), 0.5, 1e-9);
}

TEST(CornerSplit, stops_when_the_budget_says_so) {
  Level level = base_level(shapes::icosahedron());
  for (int depth = 0; depth < 4; ++depth) level = next_level(split_corners(level));
  Budget budget;
  budget.deadline = Budget::Clock::now();
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { split_corners(level, pace); }).ok());
  const CornerSplit split = split_corners(level);
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { step_rows(DooSabin{}, level, split, pace); }).ok());
}

}  // namespace
}  // namespace subdivd::plain
