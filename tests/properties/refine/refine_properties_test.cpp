// What refinement must obey whatever the mesh: RULES of the surface as properties, over every named shape and
// random meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/lattice/lattice.h"
#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"
#include "core/mesh/connectivity.h"
#include "core/refine/plan.h"
#include "core/refine/refine.h"
#include "core/schemes/all.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd {
namespace {

// Each of the shapes once for every scheme of the list that takes it.
std::vector<shapes::NamedShape> of_every_scheme(const std::vector<shapes::NamedShape>& given) {
  std::vector<shapes::NamedShape> result;
  for (const std::string_view scheme : kSchemeNames)
    for (shapes::NamedShape shape : given) {
      shape.name += ' ' + std::string(scheme);
      shape.mesh.subdivision_scheme = scheme;
      if (scheme_of(shape.mesh, {}, {})) result.push_back(std::move(shape));
    }
  return result;
}

bool has_quads_only(const ControlMesh& mesh) {
  return !mesh.face_vertex_counts.empty() &&
         std::ranges::all_of(mesh.face_vertex_counts, [](Index count) { return count == 4; });
}

std::vector<shapes::NamedShape> closed() {
  std::vector<shapes::NamedShape> result = shapes::closed_shapes();
  const auto is_closed = [](const ControlMesh& mesh) {
    const Connectivity<Quads> quads(static_cast<Index>(mesh.point_count()), Quads(mesh.face_vertex_indices),
                                    {});
    return std::ranges::all_of(
        quads.edge_sides(), [](const auto& sides) { return sides[0] != kNoIndex && sides[1] != kNoIndex; });
  };
  for (shapes::NamedShape& shape : shapes::polygon_shapes()) {
    const ControlMesh& mesh = shape.mesh;
    if (has_quads_only(mesh) && mesh.crease_indices.empty() && mesh.corner_indices.empty() && is_closed(mesh))
      result.push_back(std::move(shape));
  }
  return of_every_scheme(result);
}

std::vector<shapes::NamedShape> all() {
  std::vector<shapes::NamedShape> result = shapes::all_shapes();
  for (shapes::NamedShape& shape : shapes::polygon_shapes())
    if (has_quads_only(shape.mesh)) result.push_back(std::move(shape));
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    result.push_back({"random_mesh " + std::to_string(seed), shapes::random_mesh(seed)});
  return of_every_scheme(result);
}

RefinedMesh<double> refined(const ControlMesh& mesh, Index level, bool limit = false,
                            CreaseMethod method = CreaseMethod::uniform) {
  RefineOptions options;
  options.level = level;
  options.crease_method = method;
  options.limit = options.normals = limit;
  auto result = refine<double>(mesh, options, {});
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(*result);
}

double extent(const ControlMesh& mesh) {
  double largest = 0;
  for (double x : mesh.points) largest = std::max(largest, std::abs(x));
  return largest;
}

// The limit of a vertex is the same from every level: base vertices keep their numbers. Exact up to rounding
// for every rule, semi-sharp ones included.
TEST(RefineProperties, are_asked_of_every_scheme) {
  const auto meshes = all(), closed_ones = closed();
  for (const std::string_view scheme : kSchemeNames)
    for (const auto* list : {&meshes, &closed_ones})
      EXPECT_GE(
          std::ranges::count(*list, scheme,
                             [](const shapes::NamedShape& shape) { return shape.mesh.subdivision_scheme; }),
          3)
          << scheme;
}

TEST(RefineProperties, the_limit_of_the_refined_is_the_limit) {
  for (const auto& [name, mesh] : all())
    for (CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin}) {
      SCOPED_TRACE(name);
      const auto at0 = refined(mesh, 0, true, method), at1 = refined(mesh, 1, true, method),
                 at3 = refined(mesh, 3, true, method);
      // Around a vertex of quads twice as many points are added up, with weights that are further apart.
      const bool triangles = at0.face_size == 3 && at1.face_size == 3;
      const double tolerance = (triangles ? 2e-15 : 2e-14) * std::max(extent(mesh), 1.0);
      for (std::size_t k = 0; k < at0.limit_points.size(); ++k) {
        ASSERT_NEAR(at0.limit_points[k], at1.limit_points[k], tolerance) << "vertex " << k / 3;
        ASSERT_NEAR(at0.limit_points[k], at3.limit_points[k], tolerance) << "vertex " << k / 3;
      }
    }
}

// Likewise every other channel.
TEST(RefineProperties, the_limit_of_refined_face_varying_values_is_the_limit) {
  for (const auto& [name, mesh] : all()) {
    SCOPED_TRACE(name);
    const auto at0 = refined(mesh, 0, true), at2 = refined(mesh, 2, true);
    for (std::size_t p = 0; p < mesh.primvars.size(); ++p)
      for (std::size_t k = 0; k < at0.primvars[p].limit_values.size(); ++k)
        ASSERT_NEAR(at0.primvars[p].limit_values[k], at2.primvars[p].limit_values[k], 1e-12)
            << mesh.primvars[p].name << " scalar " << k;
  }
}

// Refined points come closer to the limit by about 1/4 a level or, at high valences, by less: they do
// approach.
TEST(RefineProperties, refined_points_approach_the_limit) {
  for (const auto& [name, mesh] : closed()) {
    SCOPED_TRACE(name);
    auto distance = [&](Index level) {
      const auto mesh_at = refined(mesh, level, true);
      double largest = 0;
      for (Count k = 0; k < 3 * mesh.point_count(); ++k)
        largest = std::max(largest, std::abs(mesh_at.points[k] - mesh_at.limit_points[k]));
      return largest;
    };
    EXPECT_LT(distance(4), 0.6 * distance(2) + 1e-15);
  }
}

TEST(RefineProperties, affine_maps_commute_with_refinement) {
  const double a[3][4] = {{0.9, -0.4, 0.2, 3}, {0.3, 1.1, -0.5, -2}, {-0.1, 0.6, 0.8, 5}};
  auto mapped = [&](std::span<const double> points) {
    std::vector<double> out(points.size());
    for (std::size_t v = 0; v < points.size(); v += 3)
      for (std::size_t r = 0; r < 3; ++r)
        out[v + r] = a[r][0] * points[v] + a[r][1] * points[v + 1] + a[r][2] * points[v + 2] + a[r][3];
    return out;
  };
  for (const auto& [name, mesh] : all()) {
    SCOPED_TRACE(name);
    ControlMesh moved = mesh;
    moved.points = mapped(mesh.points);
    const auto straight = refined(mesh, 2, true), turned = refined(moved, 2, true);
    const auto points = mapped(straight.points), limits = mapped(straight.limit_points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      ASSERT_NEAR(points[k], turned.points[k], 1e-13 * (extent(moved) + 1));
      ASSERT_NEAR(limits[k], turned.limit_points[k], 1e-13 * (extent(moved) + 1));
    }
  }
}

TEST(RefineProperties, planar_meshes_stay_planar_with_normals_across) {
  for (const auto& shape : of_every_scheme(shapes::border_shapes())) {
    ControlMesh mesh = shape.mesh;
    SCOPED_TRACE(shape.name);
    for (std::size_t k = 2; k < mesh.points.size(); k += 3) mesh.points[k] = 7;
    const auto result = refined(mesh, 2, true);
    for (std::size_t k = 0; k < result.points.size(); k += 3) {
      ASSERT_NEAR(result.points[k + 2], 7, 1e-14);
      ASSERT_NEAR(result.limit_points[k + 2], 7, 1e-14);
      ASSERT_NEAR(std::abs(result.normals[k + 2]), result.provenance[k / 3].face == kNoIndex ? 0 : 1, 1e-12);
    }
  }
}

// New numbers for points and faces, faces turned by a corner: the same surface under the new numbers.
// The vertex at every point of every base face's grid, or of the grids of its quads: {face, corner, i, j}.
std::vector<std::pair<std::array<Index, 4>, Index>> vertices_at_places(const Lattice& lattice, Index level) {
  std::vector<std::pair<std::array<Index, 4>, Index>> places;
  const Index n = 1u << (level - lattice.first_level());
  if (lattice.has_triangles()) {
    const Numbering numbering(lattice.triangles(), level);
    for (Index f = 0; f < lattice.base_face_count(); ++f)
      for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i + j <= n; ++i) places.push_back({{f, 0, i, j}, numbering.vertex(f, i, j)});
    return places;
  }
  const Numbering numbering(lattice.quads(), level - lattice.first_level());
  Index quad = 0;
  for (Index f = 0; f < lattice.base_face_count(); ++f)
    for (Index k = 0; k < (lattice.first_level() == 0 ? 1 : lattice.base_face_size(f)); ++k, ++quad)
      for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i <= n; ++i) places.push_back({{f, k, i, j}, numbering.vertex(quad, i, j)});
  return places;
}

TEST(RefineProperties, renumbering_only_renumbers) {
  for (const auto& [name, mesh] : all()) {
    SCOPED_TRACE(name);
    const auto points = static_cast<Index>(mesh.point_count()), faces = static_cast<Index>(mesh.face_count());
    auto new_point = [&](Index v) { return points - 1 - v; };
    auto new_face = [&](Index f) { return faces - 1 - f; };
    ControlMesh other = mesh;
    other.primvars.clear();
    for (Index v = 0; v < points; ++v)
      for (Index c = 0; c < 3; ++c) other.points[3 * new_point(v) + c] = mesh.points[3 * v + c];
    const Index size = mesh.face_size(0);  // of all faces
    for (Index f = 0; f < faces; ++f)
      for (Index k = 0; k < size; ++k)
        other.face_vertex_indices[size * new_face(f) + (k + 1) % size] =
            new_point(mesh.face_vertex_indices[size * f + k]);
    for (auto* indices : {&other.crease_indices, &other.corner_indices})
      for (Index& v : *indices) v = new_point(v);
    for (Index& f : other.hole_indices) f = new_face(f);
    const auto a = refined(mesh, 2, true), b = refined(other, 2, true);
    ASSERT_EQ(a.points.size(), b.points.size());
    // Where on the control mesh a vertex lies tells which it is: corner k became corner k + 1.
    const auto key = [](Index face, const Provenance& place) {
      return std::array<Index, 4>{face, place.corner, place.i, place.j};
    };
    std::map<std::array<Index, 4>, Index> in_b;
    const auto lattice = Plan::build(other, {.max_level = 2}, {})->mesh().lattice();
    for (const auto& [place, v] : vertices_at_places(*lattice, 2)) in_b[place] = v;
    const auto lattice_a = Plan::build(mesh, {.max_level = 2}, {})->mesh().lattice();
    const bool triangles = lattice_a->has_triangles();
    for (const auto& [place, va] : vertices_at_places(*lattice_a, 2)) {
      const auto [f, k, i, j] = place;
      const Provenance turned = triangles   ? Provenance{0, 4 - i - j, i, 0}
                                : size == 4 ? Provenance{0, 4 - j, i, 0}
                                            : Provenance{0, i, j, (k + 1) % 3};
      const Index vb = in_b.at(key(new_face(f), turned));
      for (Index c = 0; c < 3; ++c) {
        ASSERT_NEAR(a.points[3 * va + c], b.points[3 * vb + c], 1e-14 * (extent(mesh) + 1));
        ASSERT_NEAR(a.limit_points[3 * va + c], b.limit_points[3 * vb + c], 1e-14 * (extent(mesh) + 1));
      }
    }
  }
}

// Without tags the refined mesh is a control mesh like any other; unless two of its edges have the same ends,
// which a list of faces cannot say: the two sides of a pillow.
TEST(RefineProperties, two_single_steps_are_one_double_step) {
  for (const auto& [name, mesh] : closed()) {
    SCOPED_TRACE(name);
    if (mesh.name == "closed_pillow_valence_2") continue;
    const auto once = refined(mesh, 1), twice = refined(mesh, 2);
    ControlMesh between;
    between.points.assign(once.points.begin(), once.points.end());
    between.face_vertex_indices.assign(once.faces.begin(), once.faces.end());
    between.subdivision_scheme = mesh.subdivision_scheme;
    const Index size = once.face_size;
    if (size != 3) between.face_vertex_counts.assign(once.face_count, size);
    const auto again = refined(between, 1);
    ASSERT_EQ(again.points.size(), twice.points.size());
    // Numbers differ; the faces are the same faces.
    auto corners = [size](const RefinedMesh<double>& m) {
      std::vector<std::vector<double>> rows;
      for (std::size_t f = 0; f < m.faces.size(); f += size) {
        std::vector<double> row;
        for (Index k = 0; k < size; ++k)
          for (std::size_t c = 0; c < 3; ++c)  // rounded: sums may run in another order
            row.push_back(std::round(m.points[3 * m.faces[f + k] + c] * 1e10) / 1e10 + 0.0);
        // Start at the smallest corner, keeping the winding.
        std::vector<double> best = row;
        for (Index turn = 1; turn < size; ++turn) {
          std::rotate(row.begin(), row.begin() + 3, row.end());
          best = std::min(best, row);
        }
        rows.push_back(std::move(best));
      }
      std::ranges::sort(rows);
      return rows;
    };
    const auto a = corners(again), b = corners(twice);
    for (std::size_t f = 0; f < a.size(); ++f)
      for (std::size_t k = 0; k < a[f].size(); ++k) ASSERT_NEAR(a[f][k], b[f][k], 2e-10) << "face " << f;
  }
}

// Same input, same bits; the order of primvars or their presence does not touch the positions.
TEST(RefineProperties, bits_depend_on_nothing_but_the_mesh) {
  for (const auto& [name, mesh] : all()) {
    SCOPED_TRACE(name);
    ControlMesh bare = mesh;
    bare.primvars.clear();
    const auto a = refined(mesh, 2, true), b = refined(mesh, 2, true), c = refined(bare, 2, true);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.limit_points, b.limit_points);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.points, c.points);
  }
}

// Normals of the limit surface do not depend on the level they are asked at: where masks see two rings, from the level on
// at which no extraordinary vertex is near another.
TEST(RefineProperties, normals_are_those_of_the_limit_surface) {
  for (const auto& [name, mesh] : closed()) {
    SCOPED_TRACE(name);
    const Index least = as_one_of<AnyGridScheme>(*scheme_of(mesh, {}, {})) ? 1 : 2;
    const auto at1 = refined(mesh, least, true), at3 = refined(mesh, least + 2, true);
    for (std::size_t v = 0; v < mesh.point_count(); ++v) {
      if (at1.provenance[v].face == kNoIndex) continue;  // an unreferenced point has no surface
      double dot = 0;
      for (std::size_t c = 0; c < 3; ++c) dot += at1.normals[3 * v + c] * at3.normals[3 * v + c];
      // Two triangles over the same three points are flat, and out is on both sides: no normal, at any level.
      if (mesh.name == "closed_pillow_valence_2")
        ASSERT_EQ(dot, 0) << "vertex " << v;
      else
        ASSERT_GT(dot, 1 - 1e-12) << "vertex " << v;
    }
  }
}

}  // namespace
}  // namespace subdivd
