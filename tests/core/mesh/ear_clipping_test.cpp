#include "core/mesh/ear_clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "tests/shapes/random.h"
#include "tests/support/deadlines.h"

namespace subdivd {
namespace {

using Triangles = std::vector<Index>;
using Outline = std::vector<std::array<double, 2>>;

std::vector<Index> in_order(Count size) {
  std::vector<Index> corners(size);
  std::iota(corners.begin(), corners.end(), Index{0});
  return corners;
}

Triangles cut(const std::vector<double>& points, const std::vector<Index>& corners) {
  Triangles out;
  PolygonCutter(points, corners.size()).cut(corners, Pace(), out);
  return out;
}
Triangles cut(const std::vector<double>& points) { return cut(points, in_order(points.size() / 3)); }

Triangles fan(Index corners) {
  Triangles out;
  for (Index k = 1; k + 1 < corners; ++k) out.insert(out.end(), {0, k, k + 1});
  return out;
}

std::vector<double> flat(const Outline& outline) {
  std::vector<double> points;
  for (const auto& [x, y] : outline) points.insert(points.end(), {x, y, 0});
  return points;
}

// The outline in a plane with some other normal, far from the origin.
std::vector<double> tilted(const Outline& outline, shapes::Random& random) {
  double u[3], v[3], o[3];
  for (int axis = 0; axis < 3; ++axis) {
    u[axis] = random.centred();
    v[axis] = random.centred();
    o[axis] = 10 * random.centred();
  }
  std::vector<double> points;
  for (const auto& [x, y] : outline)
    for (int axis = 0; axis < 3; ++axis) points.push_back(o[axis] + x * u[axis] + y * v[axis]);
  return points;
}

std::array<double, 3> twice_area(const std::vector<double>& p, Index a, Index b, Index c) {
  std::array<double, 3> n{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
    const auto side = [&](Index to, std::size_t k) { return p[3 * to + k] - p[3 * a + k]; };
    n[axis] = side(b, y) * side(c, z) - side(b, z) * side(c, y);
  }
  return n;
}
double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Positive areas that add up to the polygon's, its sides once, all other edges once in either direction:
// nothing is folded, nothing left out.
void expect_covers(const std::vector<double>& points, const std::vector<Index>& corners,
                   const Triangles& cut) {
  const auto k = static_cast<Index>(corners.size());
  ASSERT_EQ(cut.size(), 3 * (corners.size() - 2));
  std::array<double, 3> normal{};
  for (Index c = 1; c + 1 < k; ++c) {
    const auto part = twice_area(points, corners[0], corners[c], corners[c + 1]);
    for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += part[axis];
  }
  const double whole = std::sqrt(dot(normal, normal));
  for (double& x : normal) x /= whole;
  double sum = 0;
  std::map<std::pair<Index, Index>, int> edges;
  for (std::size_t t = 0; t < cut.size(); t += 3) {
    const double area =
        dot(normal, twice_area(points, corners[cut[t]], corners[cut[t + 1]], corners[cut[t + 2]]));
    EXPECT_GT(area, 0) << "triangle " << t / 3;
    sum += area;
    EXPECT_EQ(*std::min_element(cut.begin() + static_cast<std::ptrdiff_t>(t),
                                cut.begin() + static_cast<std::ptrdiff_t>(t) + 3),
              cut[t]);
    for (std::size_t e = 0; e < 3; ++e) ++edges[{cut[t + e], cut[t + (e + 1) % 3]}];
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
  for (Index c = 0; c < k; ++c) {
    EXPECT_EQ((edges[{c, (c + 1) % k}]), 1) << "side " << c;
    edges.erase({c, (c + 1) % k});
  }
  EXPECT_EQ(edges.size(), 2 * (corners.size() - 3));
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << '-' << edge.second;
  }
}

// Seen from a point in its middle every corner is visible.
Outline star(shapes::Random& random, Index corners) {
  Outline outline;
  for (Index k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners, radius = 0.1 + random.unit();
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}
// A band wound up three times: no corner sees more than a few others.
Outline spiral(shapes::Random& random, Index corners) {
  Outline outline;
  const Index half = corners / 2;
  const auto at = [&](Index k, double radius) {
    const double angle = 6 * std::numbers::pi * k / half;
    radius += angle + 0.3 * random.centred();
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  for (Index k = 0; k < half; ++k) at(k, 4);
  for (Index k = half; k-- > 0;) at(k, 2);
  return outline;
}
// Teeth of a comb on a long back.
Outline comb(shapes::Random& random, Index corners) {
  Outline outline{{0.0, -1.0}, {double(corners), -1.0}};
  for (Index k = corners - 2; k-- > 0;)
    outline.push_back({k + 0.5 + 0.3 * random.centred(), k % 2 == 0 ? 9.0 : random.unit()});
  return outline;
}

// Also where the list begins at another corner or runs the other way round; the same at any scale.
TEST(EarClipping, covers_concave_polygons_in_any_plane_without_folding) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    shapes::Random random(seed);
    const Index corners = 40 + 2 * random.below(60);
    for (const auto& make : {star, spiral, comb}) {
      const std::vector<double> points = tilted(make(random, corners), random);
      std::vector<Index> order = in_order(corners);
      const Triangles triangles = cut(points, order);
      expect_covers(points, order, triangles);
      for (const int power : {-1000, -3, 7, 1000}) {
        std::vector<double> other = points;
        for (double& x : other) x = std::ldexp(x, power);
        EXPECT_EQ(cut(other, order), triangles) << power;
      }
      std::rotate(order.begin(), order.begin() + random.below(corners), order.end());
      expect_covers(points, order, cut(points, order));
      std::ranges::reverse(order);
      expect_covers(points, order, cut(points, order));
      if (HasFailure()) return;
    }
  }
}

TEST(EarClipping, moves_with_the_polygon) {
  shapes::Random random(5);
  Outline outline = spiral(random, 80);
  for (auto& [x, y] : outline) {  // so that moving rounds nothing
    x = std::round(1024 * x);
    y = std::round(1024 * y);
  }
  const Triangles triangles = cut(flat(outline));
  for (auto& [x, y] : outline) x += 4096, y -= 65536;
  EXPECT_EQ(cut(flat(outline)), triangles);
}

TEST(EarClipping, chooses_the_diagonal_of_a_quad_that_does_not_fold) {
  const std::vector<double> points = flat({{0, 0}, {4, 0}, {4, 4}, {3, 1}});
  EXPECT_EQ(cut(points), (Triangles{0, 1, 3, 1, 2, 3}));
  for (const std::vector<Index>& order : {std::vector<Index>{1, 2, 3, 0}, {2, 3, 0, 1}, {3, 0, 1, 2}})
    expect_covers(points, order, cut(points, order));
  EXPECT_EQ(cut(points, {3, 0, 1, 2}), fan(4));  // from the reflex corner nothing folds
}

TEST(EarClipping, leaves_fans_that_do_not_fold) {
  Outline circle;
  for (int k = 0; k < 50; ++k) circle.push_back({std::cos(k * 0.125), std::sin(k * 0.125)});
  shapes::Random random(1);
  EXPECT_EQ(cut(flat(circle)), fan(50));
  EXPECT_EQ(cut(tilted(circle, random)), fan(50));
  // Corners along straight sides, also where rounding bends them.
  const Outline square{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 1}};
  EXPECT_EQ(cut(flat(square)), fan(9));
  for (int run = 0; run < 100; ++run) EXPECT_EQ(cut(tilted(square, random)), fan(9)) << run;
  EXPECT_EQ(cut({0, 0, 0, 1, 0, 1, 1, 1, 0, 0, 1, 1}), fan(4));  // a saddle
  EXPECT_EQ(cut({0, 0, 0, 1, 0, 0, 0, 1, 0}), fan(3));
}

// A square with a square hole, cut open between 0 and 4: both corners of the cut are there twice.
TEST(EarClipping, covers_a_polygon_with_a_hole_that_was_cut_open) {
  const std::vector<double> points =
      flat({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}});
  for (Index first = 0; first < 10; ++first) {
    std::vector<Index> order = in_order(10);
    std::rotate(order.begin(), order.begin() + first, order.end());
    SCOPED_TRACE(first);
    expect_covers(points, order, cut(points, order));
  }
}

TEST(EarClipping, gives_no_triangle_of_a_concave_polygon_a_wrong_turn_because_of_corners_on_straight_sides) {
  const std::vector<double> points =
      flat({{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 2}, {0, 4}, {0, 1}});
  for (Index first = 0; first < 9; ++first) {
    std::vector<Index> order = in_order(9);
    std::rotate(order.begin(), order.begin() + first, order.end());
    SCOPED_TRACE(first);
    expect_covers(points, order, cut(points, order));
  }
}

// k - 2 triangles of all corners, whatever is sent.
TEST(EarClipping, cuts_anything_into_as_many_triangles_that_use_every_corner) {
  const double tiny = 1e-300, huge = 1e300;
  const std::vector<std::pair<const char*, std::vector<double>>> polygons = {
      {"one point", std::vector<double>(21, 0.5)},
      {"on a line", {0, 0, 0, 1, 1, 1, 3, 3, 3, 2, 2, 2, 5, 5, 5}},
      {"bow tie", flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}})},
      {"uneven bow tie", flat({{0, 0}, {3, 1}, {3, 0}, {0, 2}, {-1, 1}})},
      {"pentagram", flat({{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}})},
      {"spike", flat({{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {3, 1}})},
      {"repeated", flat({{0, 0}, {0, 0}, {4, 0}, {4, 0}, {4, 4}, {4, 4}, {3, 1}, {3, 1}})},
      {"denormal", {0, 0, 0, 4 * 5e-324, 0, 0, 4 * 5e-324, 4 * 5e-324, 0, 3 * 5e-324, 5e-324, 0}},
      {"tiny and huge", {0, 0, 0, tiny, 0, 0, huge, huge, 0, 3, tiny, huge, -huge, 1, tiny}},
      {"largest", {-1.7e308, 0, 0, 1.7e308, 0, 0, 1.7e308, 1.7e308, 0, 1.6e308, 1e307, 0}},
      {"infinite", {0, 0, 0, INFINITY, 0, 0, 4, 4, 0, NAN, 1, 0}},
      {"far away", {1e16, 1e16, 0, 1e16 + 4, 1e16, 0, 1e16 + 4, 1e16 + 4, 0, 1e16 + 2, 1e16 + 2, 0}},
  };
  const auto expect_whole = [](const std::string& name, const std::vector<double>& points) {
    const Triangles triangles = cut(points);
    EXPECT_EQ(triangles.size(), points.size() - 6) << name;
    EXPECT_EQ(std::set<Index>(triangles.begin(), triangles.end()).size(), points.size() / 3) << name;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
      EXPECT_TRUE(triangles[t] < triangles[t + 1] && triangles[t] < triangles[t + 2]) << name;
  };
  for (const auto& [name, points] : polygons) expect_whole(name, points);
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {  // on a coarse grid: crossing, touching, repeated
    shapes::Random random(seed);
    Outline outline;
    const Index corners = 4 + random.below(12), grid = 2 + random.below(6);
    for (Index k = 0; k < corners; ++k)
      outline.push_back({double(random.below(grid)), double(random.below(grid))});
    expect_whole("seed " + std::to_string(seed), flat(outline));
  }
  EXPECT_EQ(cut(polygons[0].second), fan(7));
  EXPECT_EQ(cut({0, 0, 0, 4, 0, 0, 4, 4, 0, 3, 1, 0}, {0, 1, 2, 9}), fan(4));  // no point 9
}

TEST(EarClipping, covers_concave_quads_of_any_size) {
  for (const double unit : {5e-324, 1e-300, 1e-30, 1e30, 1e300, 0x1p1020}) {
    std::vector<double> points = {0, 0, 0, 4, 0, 0, 4, 4, 0, 3, 1, 0};
    for (double& x : points) x *= unit;
    EXPECT_EQ(cut(points), (Triangles{0, 1, 3, 1, 2, 3})) << unit;
  }
}

// Half of the corners are reflex, and an ear must look at all of them.
TEST(EarClipping, stops_in_the_middle_of_a_polygon_of_many_reflex_corners) {
  shapes::Random random(3);
  const std::vector<double> points = flat(spiral(random, 12000));
  const std::vector<Index> corners = in_order(points.size() / 3);
  testing::expect_stops_midway([&](const Budget& budget) {
    return stoppable(budget, [&](const Pace& pace) {
      Triangles out;
      PolygonCutter(points, corners.size()).cut(corners, pace, out);
    });
  });
}

}  // namespace
}  // namespace subdivd
