// Grids of quads beside the plain engine, which knows every level's topology in full: every point of every level. And
// limits beside those of the next level.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/grid/evaluate.h"
#include "core/engine/grid/kernels/instruction_sets.h"
#include "core/engine/plain/level.h"
#include "core/lattice/quads.h"
#include "core/mesh/topology.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/random.h"

namespace subdivd {
namespace {

constexpr Index kDepth = 4;

bool all_quads(const ControlMesh& mesh) {
  return !mesh.face_vertex_counts.empty() &&
         std::ranges::all_of(mesh.face_vertex_counts, [](Index count) { return count == 4; });
}

std::vector<shapes::NamedShape> quad_shapes() {
  std::vector<shapes::NamedShape> shapes;
  for (auto& shape : shapes::polygon_shapes())
    if (all_quads(shape.mesh)) shapes.push_back(std::move(shape));
  return shapes;
}

Net<Quads> net_of(const ControlMesh& mesh, const AnyGridScheme& scheme, CreaseMethod method) {
  auto topology = std::make_shared<const Topology<Quads>>(static_cast<Index>(mesh.point_count()),
                                                          Quads(mesh.face_vertex_indices));
  Sharpness sharpness = control_sharpness(mesh, *topology);
  return Net<Quads>::build(scheme, method, std::move(topology), std::move(sharpness), kDepth + 1, {});
}

plain::Level plain_level(const ControlMesh& mesh, CreaseMethod method) {
  std::vector<Index> begins;
  for (Index f = 0; f <= mesh.face_count(); ++f) begins.push_back(4 * f);
  const auto vertices = static_cast<Index>(mesh.point_count());
  return plain::first_level(
      plain::Adjacency(vertices, Polygons(begins, mesh.face_vertex_indices)),
      control_sharpness(mesh, Topology<Quads>(vertices, Quads(mesh.face_vertex_indices))), method);
}

double diagonal(const std::vector<double>& points) {
  double largest = 0;
  for (const double x : points) largest = std::max(largest, std::abs(x));
  return 2 * largest;
}

// Where the corners of a plain level's faces lie on the base face's grid of 2^kDepth segments.
struct Place {
  Index face;
  std::array<GridPoint, 4> corners;
};

std::vector<Place> base_places(Index faces) {
  const Index n = 1u << kDepth;
  std::vector<Place> places;
  for (Index f = 0; f < faces; ++f) places.push_back({f, {{{0, 0}, {n, 0}, {n, n}, {0, n}}}});
  return places;
}

// A face's children follow its corners.
std::vector<Place> next_places(const std::vector<Place>& places) {
  const auto middle = [](GridPoint a, GridPoint b) { return GridPoint{(a.i + b.i) / 2, (a.j + b.j) / 2}; };
  std::vector<Place> next;
  for (const auto& [face, c] : places)
    for (std::size_t k = 0; k < 4; ++k)
      next.push_back(
          {face, {c[k], middle(c[k], c[(k + 1) % 4]), middle(c[0], c[2]), middle(c[k], c[(k + 3) % 4])}});
  return next;
}

void expect_as_plain(const std::string& what, const ControlMesh& mesh, const AnyGridScheme& scheme,
                     CreaseMethod method, Index width) {
  const Net<Quads> net = net_of(mesh, scheme, method);
  std::vector<double> control;
  for (std::size_t k = 0; k < mesh.points.size() / 3; ++k)
    for (Index c = 0; c < width; ++c) control.push_back(mesh.points[3 * k + c % 3] * (1 + c / 3));
  plain::Level level = plain_level(mesh, method);
  std::vector<Place> places = base_places(static_cast<Index>(mesh.face_count()));
  std::vector<double> by_rows = control;
  for (Index depth = 0; depth <= kDepth; ++depth) {
    std::vector<double> values(net.value_count(depth) * width);
    ASSERT_TRUE(
        evaluate<double>(net, depth, control, width, Smoothing::smooth, {.values = values.data()}, 1, {}));
    const Numbering numbering(net.topology(), depth);
    const Index unit = 1u << (kDepth - depth);
    double largest = 0;
    for (Index f = 0; f < places.size(); ++f)
      for (Index k = 0; k < 4; ++k) {
        const auto [i, j] = places[f].corners[k];
        const Index ours = numbering.vertex(places[f].face, i / unit, j / unit);
        const Index theirs = level.faces.corner_vertex(4 * f + k);
        for (Index c = 0; c < width; ++c)
          largest = std::max(largest,
                             std::abs(values[Count{ours} * width + c] - by_rows[Count{theirs} * width + c]));
      }
    ASSERT_LE(largest, 2e-14 * diagonal(control)) << what << " at level " << depth << ", width " << width;
    if (depth == kDepth) break;
    by_rows = plain::apply<double>(plain::rows_of(scheme, method, level, false),
                                   std::span<const double>(by_rows), width);
    level = plain::next_level(level, Split::quads, method);
    places = next_places(places);
  }
}

TEST(QuadGrid, is_the_plain_engine_at_every_point) {
  for (const auto& [name, mesh] : quad_shapes())
    for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin}) {
      for_each_scheme(AllGridSchemes(), [&]<class S>(const S& scheme) {
        if (S::split == Split::quads) expect_as_plain(name, mesh, scheme, method, 3);
      });
    }
}

TEST(QuadGrid, refines_values_of_any_width) {
  for (const auto& [name, mesh] : quad_shapes())
    for (const Index width : {1, 2, 4, 5, 7})
      if (mesh.face_count() < 40) expect_as_plain(name, mesh, CatmullClark{}, CreaseMethod::uniform, width);
}

TEST(QuadGrid, there_are_shapes_to_try_it_on) { EXPECT_GE(quad_shapes().size(), 30u); }

// The limit of a point is that of the same point one level on.
TEST(QuadGrid, limits_and_normals_outlive_a_level) {
  const auto check = [](const std::string& name, const ControlMesh& mesh, const AnyGridScheme& scheme,
                        CreaseMethod method) {
    const Net<Quads> net = net_of(mesh, scheme, method);
    std::vector<std::vector<double>> limits, normals;
    for (Index level = 0; level <= kDepth; ++level) {
      limits.emplace_back(net.value_count(level) * 3);
      normals.emplace_back(net.value_count(level) * 3);
      ASSERT_TRUE(evaluate<double>(net, level, std::span<const double>(mesh.points), 3, Smoothing::smooth,
                                   {.limits = limits.back().data(), .normals = normals.back().data()}, 1,
                                   {}));
    }
    for (Index level = 0; level < kDepth; ++level) {
      const Numbering here(net.topology(), level), next(net.topology(), level + 1);
      const Count n = segments(level);
      double largest = 0, steepest = 0;
      for (Index f = 0; f < net.topology().face_count(); ++f)
        for (Count j = 0; j <= n; ++j)
          for (Count i = 0; i <= n; ++i)
            for (Index c = 0; c < 3; ++c) {
              // A corner of several faces has no tangent plane, and no normal that a level could not turn.
              const Index vertex = here.vertex(f, i, j);
              const bool corner = vertex < net.topology().vertex_count() &&
                                  net.vertex_rules()[vertex] == VertexRule::corner &&
                                  net.topology().vertex_corners(vertex).size() > 1;
              const Count a = Count{3} * here.vertex(f, i, j) + c,
                          b = Count{3} * next.vertex(f, 2 * i, 2 * j) + c;
              largest = std::max(largest, std::abs(limits[level][a] - limits[level + 1][b]));
              if (!corner) steepest = std::max(steepest, std::abs(normals[level][a] - normals[level + 1][b]));
            }
      ASSERT_LE(largest, 1e-13 * diagonal(mesh.points)) << name << " at level " << level;
      EXPECT_LE(steepest, 1e-6) << name << " at level " << level;
    }
  };
  for (const auto& [name, mesh] : quad_shapes())
    for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin}) {
      check(name, mesh, CatmullClark{}, method);
    }
}

}  // namespace
}  // namespace subdivd
