// The modified butterfly by the plain engine: old points stay, edge points see their ends' rings.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/curves/subdivision.h"
#include "core/engine/plain/ring_rows.h"
#include "core/schemes/butterfly.h"
#include "tests/core/engine/levels.h"
#include "tests/reference/plain.h"
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
    points = applied(step_rows(Butterfly{}, level, false));
    level = next_level(level, Split::triangles, CreaseMethod::uniform);
  }

  Level level;
  std::vector<double> points;
};

TEST(ButterflyMask, is_that_of_1996) {
  const auto weight = [](Index n, Index j) {
    const WaveMask mask = Butterfly{}.ring_mask(n);
    const double a = 2 * std::numbers::pi * j / n;
    return (mask.wave[0] + mask.wave[1] * std::cos(a) + mask.wave[2] * std::cos(2 * a)) / n;
  };
  const double three[] = {5.0 / 12, -1.0 / 12, -1.0 / 12}, four[] = {3.0 / 8, 0, -1.0 / 8, 0};
  for (Index j = 0; j < 3; ++j) EXPECT_NEAR(weight(3, j), three[j], 1e-15);
  for (Index j = 0; j < 4; ++j) EXPECT_NEAR(weight(4, j), four[j], 1e-15);
  for (const Index n : {5u, 6u, 7u, 12u, 100u}) {
    for (Index j = 0; j < n; ++j) {
      const double a = 2 * std::numbers::pi * j / n;
      EXPECT_NEAR(weight(n, j), (0.25 + std::cos(a) + std::cos(2 * a) / 2) / n, 1e-16);
    }
    EXPECT_EQ(Butterfly{}.ring_mask(n).self, 0.75);
  }
}

// Of a half plane of k sectors with ends at the unit circle, the edge points lie half way.
TEST(ButterflyMask, puts_the_edge_points_of_a_flat_sector_half_way) {
  for (const Index k : {2u, 3u, 4u, 5u, 8u, 40u})
    for (Index i = 1; i < k; ++i) {
      const SectorMask mask = Butterfly{}.sector_mask(k, i);
      const double theta = std::numbers::pi / k;
      double sum = mask.self + mask.first + mask.last, x = mask.first - mask.last, y = 0;
      for (Index j = 1; j < k; ++j) {
        const double weight = mask.sine[0] * std::sin(j * theta) + mask.sine[1] * std::sin(2 * j * theta);
        sum += weight;
        x += weight * std::cos(j * theta);
        y += weight * std::sin(j * theta);
      }
      EXPECT_NEAR(sum, 1, 1e-14) << k << ' ' << i;
      EXPECT_NEAR(x, std::cos(i * theta) / 2, 1e-14) << k << ' ' << i;
      EXPECT_NEAR(y, std::sin(i * theta) / 2, 1e-14) << k << ' ' << i;
    }
}

TEST(RingRows, have_weights_that_sum_to_one) {
  for (const auto& [name, mesh] : all_meshes()) {
    Level level = base_level(mesh);
    for (int depth = 0; depth < 2;
         ++depth, level = next_level(level, Split::triangles, CreaseMethod::uniform)) {
      const SparseRows rows = written_out(step_rows(Butterfly{}, level, false)),
                       tangents = written_out(tangent_rows(Butterfly{}, level, false));
      ASSERT_EQ(rows.row_count(), level.faces.vertex_count() + level.faces.edge_count()) << name;
      ASSERT_EQ(tangents.row_count(), 2 * level.faces.vertex_count()) << name;
      for (Count r = 0; r < rows.row_count(); ++r)
        ASSERT_NEAR(sum_of_row(rows, r), 1, 1e-12) << name << ' ' << r;
      for (Count r = 0; r < tangents.row_count(); ++r) ASSERT_NEAR(sum_of_row(tangents, r), 0, 1e-12) << name;
    }
  }
}

TEST(ButterflyByRows, keeps_old_points_to_the_bit) {
  for (const auto& [name, mesh] : all_meshes()) {
    Surface surface(mesh);
    surface.refine();
    surface.refine();
    for (std::size_t k = 0; k < mesh.points.size(); ++k) ASSERT_EQ(surface.points[k], mesh.points[k]) << name;
  }
}

TEST(ButterflyByRows, keeps_midpoints_where_it_is_linear) {
  const ControlMesh mesh = shapes::icosahedron();
  const StepRows rows = step_rows(Butterfly{}, base_level(mesh), true);
  for (const double weight : rows.rows.weights) EXPECT_TRUE(weight == 1 || weight == 0.5);
}

// A regular net of 12 x 12 points over a plane; far from the border cubics are met exactly.
TEST(ButterflyByRows, reproduces_cubics_on_regular_nets) {
  ControlMesh mesh = shapes::grid(11, 11);
  for (std::size_t k = 0; k < mesh.points.size(); k += 3) {
    mesh.points[k] = static_cast<double>(k / 3 % 12);
    mesh.points[k + 1] = static_cast<double>(k / 3 / 12);
  }
  const auto cubic = [](double x, double y) {
    return 0.01 * x * x * x - 0.02 * x * x * y + 0.3 * x * y - y * y * y / 50 + 1;
  };
  for (std::size_t k = 0; k < mesh.points.size(); k += 3)
    mesh.points[k + 2] = cubic(mesh.points[k], mesh.points[k + 1]);
  Surface surface(mesh);
  surface.refine();
  int inside = 0;
  for (std::size_t k = 0; k < surface.points.size(); k += 3) {
    const double x = surface.points[k], y = surface.points[k + 1];
    if (std::min(x, y) < 2 || std::max(x, y) > 9) continue;
    ++inside;
    EXPECT_NEAR(surface.points[k + 2], cubic(x, y), 1e-13);
    EXPECT_EQ(2 * x, std::round(2 * x));
  }
  EXPECT_GT(inside, 200);
}

// Borders are four-point curves: of round corners closed ones, from corner to corner pinned ones.
TEST(ButterflyByRows, has_the_four_point_curve_as_border) {
  const ControlMesh mesh = shapes::disk(7);  // points 1..7 are the border, none of one face
  Surface surface(mesh);
  for (Index l = 1; l <= 3; ++l) {
    surface.refine();
    ControlCurves curve;
    curve.points.assign(mesh.points.begin() + 3, mesh.points.begin() + 24);
    curve.wrap = CurveWrap::periodic;
    curve.basis = FourPoint{};
    const auto refined = refine<double>(curve, {.level = l}, {});
    for (std::size_t k = 0; k < refined->points.size(); k += 3) {
      double nearest = 1e9;
      for (std::size_t j = 0; j < surface.points.size(); j += 3)
        nearest = std::min(nearest, std::hypot(refined->points[k] - surface.points[j],
                                               refined->points[k + 1] - surface.points[j + 1],
                                               refined->points[k + 2] - surface.points[j + 2]));
      EXPECT_LT(nearest, 1e-15);
    }
  }
}

TEST(ButterflyByRows, has_pinned_four_point_curves_from_corner_to_corner) {
  ControlMesh mesh = shapes::octahedron();
  const Level base = base_level(mesh);
  // Four edges in a row around the octahedron's belt, of which the ends of two are corners.
  std::vector<Index> belt{base.faces.edge_vertices(0)[0], base.faces.edge_vertices(0)[1]};
  for (const Index e : base.faces.vertex_edges(belt[1])) {
    const Index end = base.faces.other_end(e, belt[1]);
    if (end != belt[0] && belt.size() == 2) {
      bool beside = false;
      for (const Index other : base.faces.vertex_edges(end))
        beside |= base.faces.other_end(other, end) == belt[0];
      if (!beside) belt.push_back(end);
    }
  }
  ASSERT_EQ(belt.size(), 3);
  shapes::crease(mesh, belt, kInfiniteSharpness);
  for (const Index end : {belt[0], belt[2]}) shapes::corner(mesh, end, kInfiniteSharpness);
  Surface surface(mesh);
  surface.refine();
  surface.refine();
  ControlCurves curve;
  for (const Index v : belt)
    for (Index axis = 0; axis < 3; ++axis) curve.points.push_back(mesh.points[3 * v + axis]);
  curve.wrap = CurveWrap::pinned;
  curve.basis = FourPoint{};
  const auto refined = refine<double>(curve, {.level = 2}, {});
  ASSERT_EQ(refined->points.size(), 27);
  for (std::size_t k = 0; k < refined->points.size(); k += 3) {
    double nearest = 1e9;
    for (std::size_t j = 0; j < surface.points.size(); j += 3)
      nearest = std::min(nearest, std::hypot(refined->points[k] - surface.points[j],
                                             refined->points[k + 1] - surface.points[j + 1],
                                             refined->points[k + 2] - surface.points[j + 2]));
    EXPECT_LT(nearest, 1e-15);
  }
}

TEST(ButterflyTangents, are_halved_by_every_step) {
  int compared = 0;
  for (const auto& [name, mesh] : all_meshes()) {
    if (mesh.points.size() > 3000) continue;
    Surface surface(mesh);
    for (int depth = 0; depth < 3; ++depth) {
      const std::vector<double> before = surface.applied(tangent_rows(Butterfly{}, surface.level, false));
      const SparseRows known = tangent_rows(Butterfly{}, surface.level, false).rows;
      // Edge 0 of a vertex inside stays its edge 0 where its lowest corner stays lowest: turned rings are left out.
      const Adjacency from = surface.level.faces;
      surface.refine();
      const std::vector<double> after = surface.applied(tangent_rows(Butterfly{}, surface.level, false));
      const SparseRows still = tangent_rows(Butterfly{}, surface.level, false).rows;
      for (Index v = 0; v < from.vertex_count(); ++v) {
        if (known.offsets[2 * v] == known.offsets[2 * v + 1] ||
            still.offsets[2 * v] == still.offsets[2 * v + 1])
          continue;
        const Index edge = from.half_edge_edge(from.vertex_corners(v)[0]);
        const Index first = surface.level.faces.half_edge_edge(surface.level.faces.vertex_corners(v)[0]);
        if (first / 2 != edge || first >= 2 * from.edge_count()) continue;
        ++compared;
        for (Index k = 0; k < 6; ++k)
          ASSERT_NEAR(after[6 * v + k], before[6 * v + k] / 2, 1e-13 * diagonal(mesh.points))
              << name << ' ' << v;
      }
    }
  }
  EXPECT_GT(compared, 500);
}

// Points around a vertex, taken ever closer, come to lie in the plane of its tangents.
TEST(ButterflyTangents, are_those_of_the_limit) {
  for (const Index n : {3u, 4u, 5u, 6u, 7u, 9u}) {
    Surface surface(shapes::double_pyramid(n));
    surface.refine();
    const std::vector<double> tangents = surface.applied(tangent_rows(Butterfly{}, surface.level, false));
    const double* u = tangents.data();
    const double* w = u + 3;
    std::array<double, 3> normal{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                                 u[0] * w[1] - u[1] * w[0]};
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    ASSERT_GT(length, 1e-3) << n;
    for (int depth = 0; depth < 6; ++depth) surface.refine();
    for (const Index e : surface.level.faces.vertex_edges(0)) {
      const Index end = surface.level.faces.other_end(e, 0);
      double out = 0, square = 0;
      for (Index axis = 0; axis < 3; ++axis) {
        const double d = surface.points[3 * end + axis] - surface.points[axis];
        out += d * normal[axis] / length;
        square += d * d;
      }
      EXPECT_LT(std::abs(out) / std::sqrt(square), 0.05) << n;
    }
  }
}

TEST(ButterflyByRows, does_not_depend_on_how_points_and_faces_are_numbered) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Renumbered other = renumbered(mesh, 5);
    Surface a(mesh), b(other.mesh);
    const Adjacency from = a.level.faces, to = b.level.faces;
    a.refine();
    b.refine();
    for (Index h = 0; h < from.half_edge_count(); ++h) {
      const Index f = h / 3, there = 3 * other.face_at[f] + (h % 3 + 3 - other.turned[f]) % 3;
      const Index v = from.vertex_count() + from.half_edge_edge(h),
                  w = to.vertex_count() + to.half_edge_edge(there);
      for (Index axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(a.points[3 * v + axis], b.points[3 * w + axis], 1e-14) << name << ' ' << h;
    }
  }
}

TEST(ButterflyByRows, keeps_a_plane_a_plane) {
  for (auto [name, mesh] : all_meshes()) {
    for (std::size_t k = 0; k < mesh.points.size(); k += 3)
      mesh.points[k + 2] = 1 + 2 * mesh.points[k] - 3 * mesh.points[k + 1];
    Surface surface(mesh);
    surface.refine();
    surface.refine();
    for (std::size_t k = 0; k < surface.points.size(); k += 3)
      ASSERT_NEAR(surface.points[k + 2], 1 + 2 * surface.points[k] - 3 * surface.points[k + 1], 1e-13)
          << name;
  }
}

// Every edge at a pole sees all others: 1e10 weights, written out.
TEST(ButterflyByRows, are_linear_in_the_faces_of_a_pole) {
  const Index n = 100000;
  for (const ControlMesh& mesh : {shapes::double_pyramid(n), shapes::open_fan(n)}) {
    const Level level = base_level(mesh);
    const StepRows rows = step_rows(Butterfly{}, level, false);
    EXPECT_LT(rows.rows.columns.size() + rows.sums.columns.size(), Count{20} * level.faces.half_edge_count());
  }
}

// Sums and rows that are written out give the same points.
TEST(ButterflyByRows, are_the_same_for_rings_that_are_summed_first) {
  for (const Index n : {17u, 40u})
    for (const ControlMesh& mesh : {shapes::double_pyramid(n), shapes::open_fan(n)}) {
      const Level level = base_level(mesh);
      const StepRows rows = step_rows(Butterfly{}, level, false);
      EXPECT_GT(rows.sums.row_count(), 0);
      const SparseRows all = written_out(rows);
      for (Index e = 0; e < level.faces.edge_count(); ++e) {
        const auto [a, b] = level.faces.edge_vertices(e);
        const auto along = level.faces.edge_half_edges(e);
        if (a != 0 || along.size() != 2) continue;
        // The edge point's weight of its own far end, by the formula; both ends are extraordinary but for n = 6.
        const Count row = level.faces.vertex_count() + e;
        const auto columns =
            std::span(all.columns).subspan(all.offsets[row], all.offsets[row + 1] - all.offsets[row]);
        const double weight =
            all.weights[all.offsets[row] +
                        static_cast<Count>(std::ranges::find(columns, b) - columns.begin())];
        if (level.faces.vertex_corners(0).size() == level.faces.vertex_edges(0).size()) {
          EXPECT_NEAR(weight, ((0.25 + 1 + 0.5) / n + 0.75) / 2, 1e-15) << n;  // b has valence 4: the mean
        }
      }
    }
}

// At a vertex of k faces on a border, where the other ends of its edges have two faces and so make middles: the mean of
// those and of the sector's mask, written out from short sectors and from large ones alike.
TEST(ButterflyByRows, have_the_weights_of_a_sector_whether_it_is_summed_first_or_not) {
  for (const Index k : {4u, 5u, 16u, 17u, 40u}) {
    const ControlMesh mesh = shapes::open_fan(k);
    const Level level = base_level(mesh);
    const SparseRows all = written_out(step_rows(Butterfly{}, level, false));
    const auto edges = level.faces.vertex_edges(0);  // counter-clockwise from the border on
    const double theta = std::numbers::pi / k;
    ASSERT_EQ(edges.size(), k + 1);
    for (Index i = 1; i < k; ++i) {
      const Count row = level.faces.vertex_count() + edges[i];
      for (Index j = 1; j < k; ++j) {
        const Index end = level.faces.other_end(edges[j], 0);
        double weight = 0;
        for (Count c = all.offsets[row]; c < all.offsets[row + 1]; ++c)
          if (all.columns[c] == end) weight = all.weights[c];
        const double of_sector = (std::sin(i * theta) * std::sin(j * theta) +
                                  std::sin(2 * i * theta) * std::sin(2 * j * theta) / 2) /
                                 k;
        EXPECT_NEAR(weight, of_sector / 2 + (i == j ? 1.0 / 4 : 0), 1e-15) << k << ' ' << i << ' ' << j;
      }
    }
  }
}

// A channel is a mesh of its own, in which seams are borders: four-point curves of its values.
TEST(ButterflyByRows, have_seams_of_channels_as_borders) {
  int seams = 0;
  for (const auto& [name, mesh] : shapes::seam_shapes()) {
    if (std::ranges::any_of(mesh.crease_sharpnesses, [](float s) { return is_semi_sharp(s); })) continue;
    for (const Primvar& primvar : mesh.primvars) {
      if (primvar.interpolation != Interpolation::face_varying || primvar.indices.empty()) continue;
      const auto base = std::make_shared<const Topology<Triangles>>(static_cast<Index>(mesh.point_count()),
                                                                    Triangles(mesh.face_vertex_indices));
      const Sharpness sharpness = control_sharpness(mesh, *base);
      const Channel channel =
          make_channel(mesh, CreaseMethod::uniform, base, sharpness, vertices_with_faces(*base),
                       primvar.indices, static_cast<Index>(primvar.values.size() / primvar.element_size));
      const Level of_mesh = first_level(*base, sharpness, CreaseMethod::uniform),
                  level = first_level(channel, of_mesh);
      const Level next =
          next_level(level, Split::triangles, next_level(of_mesh, Split::triangles, CreaseMethod::uniform));
      for (const Level* at : {&level, &next}) {
        const SparseRows rows = written_out(step_rows(Butterfly{}, *at, false));
        for (Index e = 0; e < at->faces.edge_count(); ++e) {
          const Count row = at->faces.vertex_count() + e;
          ASSERT_NEAR(sum_of_row(rows, row), 1, 1e-12) << name;
          if (at->faces.edge_half_edges(e).size() != 1 || channel.linear) continue;
          ++seams;
          ASSERT_LE(rows.offsets[row + 1] - rows.offsets[row], 4) << name;  // the border's own points
        }
      }
    }
  }
  EXPECT_GT(seams, 100);
}

TEST(RingRows, stop_when_the_budget_says_so) {
  Level level = base_level(shapes::icosahedron());
  for (int depth = 0; depth < 4; ++depth) level = next_level(level, Split::triangles, CreaseMethod::uniform);
  Budget budget;
  budget.deadline = Budget::Clock::now();
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { step_rows(Butterfly{}, level, false, pace); }).ok());
}

}  // namespace
}  // namespace subdivd::plain
