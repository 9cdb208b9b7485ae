// Doo and Sabin's scheme by the plain engine: where its points, borders, creases and limits lie.
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
#include "core/schemes/doo_sabin.h"
#include "core/surfaces/patch.h"
#include "tests/core/engine/doo_sabin_surface.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {
namespace {

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
  DooSabinSurface surface(grid.mesh, scheme);
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
  for (const auto& [name, mesh] : doo_sabin_meshes())
    if (name == "one_quad" || name == "one_triangle" || name == "one_pentagon" ||
        name == "grid_border_edges" || name == "pole_of_5_quads" || name == "pole_of_8_triangles")
      meshes.push_back(mesh);
  ASSERT_EQ(meshes.size(), 6);
  for (ControlMesh& mesh : meshes) {
    mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
    DooSabinSurface surface(mesh);
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
  for (const auto& [name, mesh] : doo_sabin_meshes())
    if (mesh.crease_lengths.size() > 0 || name == "fin") meshes.emplace_back(name, mesh);
  int closed = 0;
  for (auto& [name, mesh] : meshes) {
    DooSabinSurface surface(mesh);
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

TEST(DooSabinByRows, keeps_the_vertex_where_more_than_two_creases_meet) {
  int found = 0;
  for (const auto& [name, mesh] : doo_sabin_meshes()) {
    if (name != "quad_cube_three_creases" && name != "triangles_alone_five_creases") continue;
    ++found;
    DooSabinSurface surface(mesh);
    const std::array<double, 3> place = surface.at(0);
    for (int depth = 0; depth < 3; ++depth) {
      surface.refine();
      int there = 0;
      for (Index v = 0; v < surface.level.faces.vertex_count(); ++v) there += surface.at(v) == place;
      EXPECT_EQ(there, name == "quad_cube_three_creases" ? 3 : 5) << depth;  // one for every side
    }
  }
  EXPECT_EQ(found, 2);
}

TEST(DooSabinByRows, loses_the_strip_along_an_open_border) {
  for (const auto& [name, mesh] : doo_sabin_meshes())
    if (name == "grid_border_none") {
      DooSabinSurface surface(mesh);
      surface.refine();
      EXPECT_EQ(surface.level.faces.vertex_count(), 24);  // of 3 x 2 quads: 6 x 4 points, 5 x 3 quads
      EXPECT_EQ(surface.level.faces.face_count(), 15);
    }
}

TEST(DooSabinByRows, keeps_pinned_vertices_where_they_are) {
  for (auto [name, mesh] : doo_sabin_meshes()) {
    if (mesh.points.size() > 300) continue;
    mesh.corner_indices = {mesh.face_vertex_indices[0]};
    mesh.corner_sharpnesses = {kInfiniteSharpness};
    DooSabinSurface surface(mesh);
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
  for (const auto& [name, mesh] : doo_sabin_meshes())
    for (const DooSabin& scheme : kBothWeights) {
      if (mesh.points.size() > 600) continue;
      DooSabinSurface surface(mesh, scheme);
      const double tolerance = 1e-13 * diagonal(mesh.points);
      for (int depth = 0; depth < 2; ++depth) {
        const std::vector<double> limits = apply<double>(limit_rows(scheme, surface.level, surface.split),
                                                         std::span<const double>(surface.points), 3);
        const CornerSplit split = surface.split;
        const Adjacency before = surface.level.faces;
        DooSabinSurface later = surface;
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
  for (const auto& [name, mesh] : doo_sabin_meshes()) {
    if (name != "prism_of_7" && name != "quad_cube" && name != "prism_of_5") continue;
    DooSabinSurface surface(mesh);
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
      DooSabinSurface later = surface;
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

}  // namespace
}  // namespace subdivd::plain
