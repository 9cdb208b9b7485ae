// Meshes made to take quadratic time. Every deadline here lies far above what linear work takes, on a slow
// machine and with sanitizers, and far below what the quadratic work took.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "core/base/pace.h"
#include "core/mesh/channel.h"
#include "core/mesh/control_mesh.h"
#include "core/mesh/creases.h"
#include "core/mesh/repair.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"
#include "tests/shapes/build.h"
#include "tests/support/deadlines.h"

namespace subdivd {
namespace {

using testing::expect_stops_midway;
using testing::kLinear;
using testing::within;

// `faces` triangles on the edge between points 0 and 1.
ControlMesh book(Index faces) {
  ControlMesh mesh;
  mesh.points.assign(3 * (Count{faces} + 2), 0.5);
  for (Index k = 0; k < faces; ++k)
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {0, 1, k + 2});
  return mesh;
}

// 100,000 pairs whose keys (the lower number in the upper half of 64 bits) are equal modulo 172933, which a
// hash table of that many buckets puts into one: 11.7 s.
TEST(HostileMesh, creases_whose_numbers_collide_are_looked_up_in_linear_time) {
  constexpr std::uint64_t kBuckets = 172933;
  ControlMesh mesh = shapes::grid(700, 700);
  const auto points = static_cast<Index>(mesh.point_count());
  for (std::uint64_t low = 0; low < 100000; ++low) {
    std::uint64_t high = (kBuckets - (low << 32) % kBuckets) % kBuckets;
    while (high <= low) high += kBuckets;
    ASSERT_LT(high, points);
    mesh.crease_indices.insert(mesh.crease_indices.end(),
                               {static_cast<Index>(low), static_cast<Index>(high)});
    mesh.crease_lengths.push_back(2);
  }
  mesh.crease_sharpnesses.assign(mesh.crease_lengths.size(), 1);
  const auto start = Budget::Clock::now();
  EXPECT_EQ(mesh.check(within(kLinear)).error().code, ErrorCode::not_an_edge);
  EXPECT_LT(Budget::Clock::now() - start, kLinear);
}

// Every segment used to walk along the 100,000 edges of a hub: minutes.
TEST(HostileMesh, a_crease_to_and_fro_between_two_hubs_takes_linear_time) {
  ControlMesh mesh = book(100000);
  constexpr Index kPoints = 2000000;
  mesh.crease_lengths = {kPoints};
  mesh.crease_sharpnesses = {2};
  for (Index k = 0; k < kPoints; ++k) mesh.crease_indices.push_back(k % 2);
  const Budget budget = within(kLinear);
  ASSERT_TRUE(mesh.check(budget).ok());
  const auto sharpness = stoppable(budget, [&](const Pace& pace) {
    const Topology<Triangles> topology(static_cast<Index>(mesh.point_count()),
                                       Triangles(mesh.face_vertex_indices), pace);
    return control_sharpness(mesh, topology, pace);
  });
  EXPECT_TRUE(sharpness.ok());
}

TEST(HostileMesh, edges_between_many_hubs_are_found_in_linear_time) {
  ControlMesh mesh;
  constexpr Index kHubs = 1000;
  mesh.points.assign(3 * kHubs, 0.5);
  for (Index k = 0; k < 400000; ++k) {
    const Index a = k % kHubs, b = (a + 1 + k / kHubs) % kHubs, c = (b + 1 + k % 7) % kHubs;
    if (a != b && b != c && c != a)
      mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, b, c});
  }
  const auto built = Topology<Triangles>::build(kHubs, Triangles(mesh.face_vertex_indices), within(kLinear));
  ASSERT_TRUE(built.ok());
  for (Index h = 0; h < mesh.face_vertex_indices.size(); ++h) {
    const Index from = mesh.face_vertex_indices[h], to = mesh.face_vertex_indices[Triangles::next(h)];
    const auto ends = built->edge_vertices(built->half_edge_edge(h));
    ASSERT_EQ(ends, (std::array<Index, 2>{std::min(from, to), std::max(from, to)}));
  }
}

// Every corner at the hub has a value that another point owns, later corners lower ones: each used to be
// inserted before all the others.
TEST(HostileMesh, a_hub_of_many_shared_values_is_numbered_in_linear_time) {
  constexpr Index kFaces = 400000;
  ControlMesh mesh = shapes::disk(kFaces);
  Primvar& primvar = mesh.primvars.emplace_back();
  primvar.name = "st";
  primvar.interpolation = Interpolation::face_varying;
  primvar.values.assign(2 * kFaces + 1, 0.5);
  // Point 0 is the hub, its values are those of the points around it.
  for (std::size_t h = 0; h < mesh.face_vertex_indices.size(); ++h) {
    const Index v = mesh.face_vertex_indices[h];
    primvar.indices.push_back(v == 0 ? 2 * kFaces - static_cast<Index>(h / 3) : v);
  }
  ControlMesh owned = mesh;  // the same with a face before that owns the values
  const Budget budget = within(kLinear);
  ASSERT_TRUE(owned.check(budget).ok());
  const auto channel = stoppable(budget, [&](const Pace& pace) {
    // The hub is numbered last: all its values have owners by then.
    const Index hub = kFaces;
    std::vector<Index> triangles = mesh.face_vertex_indices, values;
    for (Index& v : triangles) v = v == 0 ? hub : v - 1;
    for (std::size_t h = 0; h < triangles.size(); ++h)
      values.push_back(triangles[h] == hub ? kFaces - 1 - static_cast<Index>(h / 3) : triangles[h]);
    const auto topology = std::make_shared<const Topology<Triangles>>(kFaces + 1, Triangles(triangles), pace);
    const Sharpness sharpness = control_sharpness(mesh, *topology, pace);
    return make_channel(mesh, CreaseMethod::uniform, topology, sharpness, vertices_with_faces(*topology),
                        values, kFaces, pace);
  });
  ASSERT_TRUE(channel.ok());
  EXPECT_EQ(channel->values.size(), 2 * kFaces);
}

// Sorting fans by their lowest corner used to look for it again in every comparison.
TEST(HostileMesh, one_large_fan_among_many_small_ones_is_sorted_in_linear_time) {
  constexpr Index kFaces = 200000;
  const ControlMesh mesh = shapes::disk(kFaces);
  const auto fans = stoppable(within(kLinear), [&](const Pace& pace) {
    const Topology<Triangles> topology(kFaces + 1, Triangles(mesh.face_vertex_indices), pace);
    // Half of the spokes are walls, in the second half of the numbers.
    const auto passable = [&](Index e) { return topology.edge_vertices(e)[1] % kFaces < kFaces / 2; };
    return topology.fans(0, passable, pace);
  });
  ASSERT_TRUE(fans.ok());
  EXPECT_GE(fans->size(), kFaces / 2);
}

TEST(HostileMesh, a_hundred_thousand_primvars_are_checked_in_linear_time) {
  ControlMesh mesh = shapes::tetrahedron();
  for (Index k = 0; k < 100000; ++k) {
    Primvar& primvar = mesh.primvars.emplace_back();
    primvar.name = "name" + std::to_string(k);
    primvar.interpolation = Interpolation::constant;
    primvar.values = {1};
  }
  EXPECT_TRUE(mesh.check(within(kLinear)).ok());
  mesh.primvars.back().name = mesh.primvars[5].name;
  const auto twice = mesh.check(within(kLinear));
  ASSERT_FALSE(twice.ok());
  EXPECT_EQ(twice.error().code, ErrorCode::duplicate_field);
}

TEST(StopsMidway, checking) {
  ControlMesh mesh = shapes::grid(400, 400);
  for (Index row = 0; row <= 400; ++row) {
    mesh.crease_lengths.push_back(401);
    for (Index k = 0; k <= 400; ++k) mesh.crease_indices.push_back(row * 401 + k);
  }
  for (int more = 0; more < 3; ++more) {
    mesh.crease_lengths.insert(mesh.crease_lengths.end(), mesh.crease_lengths.begin(),
                               mesh.crease_lengths.begin() + 401);
    mesh.crease_indices.insert(mesh.crease_indices.end(), mesh.crease_indices.begin(),
                               mesh.crease_indices.begin() + 401 * 401);
  }
  mesh.crease_sharpnesses.assign(mesh.crease_lengths.size(), 1);
  expect_stops_midway([&](const Budget& budget) { return mesh.check(budget); });
}

TEST(StopsMidway, triangulating) {
  ControlMesh mesh;
  mesh.points.assign(9, 0.5);
  mesh.face_vertex_counts = {3000000};
  for (Index k = 0; k < 3000000; ++k) mesh.face_vertex_indices.push_back(k % 3);
  expect_stops_midway([&](const Budget& budget) {
    ControlMesh copy = mesh;
    return triangulate(copy, budget);
  });
}

TEST(StopsMidway, dropping_degenerate_faces) {
  ControlMesh mesh = shapes::grid(700, 700);
  for (std::size_t h = 0; h < mesh.face_vertex_indices.size(); h += 9)
    mesh.face_vertex_indices[h] = mesh.face_vertex_indices[h + 1];
  mesh.primvars.push_back(shapes::unindexed(mesh, "st", 2));
  expect_stops_midway([&](const Budget& budget) {
    ControlMesh copy = mesh;
    return drop_degenerate_faces(copy, budget);
  });
}

TEST(CheckMagnitudes, names_the_number_that_is_too_large) {
  ControlMesh mesh = shapes::cube();
  EXPECT_TRUE(check_magnitudes<float>(mesh).ok());
  mesh.points[7] = -1e35;  // a float, but not one to calculate with
  const auto single = check_magnitudes<float>(mesh);
  ASSERT_FALSE(single.ok());
  EXPECT_EQ(single.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(single.error().where, (Path{"points", std::uint64_t{7}}));
  EXPECT_TRUE(check_magnitudes<double>(mesh).ok());
  mesh.points[7] = 1e303;
  EXPECT_EQ(check_magnitudes<double>(mesh).error().where, (Path{"points", std::uint64_t{7}}));
  mesh.points[7] = 0;
  mesh.primvars.push_back(shapes::plain_primvar(mesh, "heat", Interpolation::vertex, 2));
  mesh.primvars[0].values[5] = 4e32;
  EXPECT_EQ(check_magnitudes<float>(mesh).error().where,
            (Path{"primvars", "heat", "values", std::uint64_t{5}}));
}

}  // namespace
}  // namespace subdivd
