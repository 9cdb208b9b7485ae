#include "tests/bench/requests.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "tests/bench/workloads.h"
#include "tests/shapes/random.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::bench {
namespace {

using shapes::Random;
using Corners = std::vector<std::uint32_t>;

int positions_of(test::GltfBuilder& builder, const std::vector<float>& points) {
  std::vector<float> least(points.begin(), points.begin() + 3), most = least;
  for (std::size_t k = 0; k < points.size(); ++k) {
    least[k % 3] = std::min(least[k % 3], points[k]);
    most[k % 3] = std::max(most[k % 3], points[k]);
  }
  const int made = builder.values(points, 3);
  auto& accessor = builder.document()["accessors"][static_cast<std::size_t>(made)];
  accessor["min"] = least;
  accessor["max"] = most;
  return made;
}

// A colour for every point, as a scanner sees it: smooth, with some noise.
std::vector<std::uint8_t> colours_of(const std::vector<float>& points, Random& random) {
  std::vector<std::uint8_t> colours;
  colours.reserve(points.size() / 3 * 4);
  for (std::size_t k = 0; k < points.size(); k += 3) {
    for (std::size_t c = 0; c < 3; ++c)
      colours.push_back(
          static_cast<std::uint8_t>(120 + 90 * std::sin(3 * points[k + c]) + 10 * random.centred()));
    colours.push_back(255);
  }
  return colours;
}

std::string scan_glb(const std::vector<float>& points, const std::vector<std::uint8_t>& colours,
                     const Corners& corners) {
  test::GltfBuilder builder;
  const int positions = positions_of(builder, points);
  const int colour = builder.values(colours, 4, true);
  builder.mesh({{"POSITION", positions}, {"COLOR_0", colour}}, builder.values(corners, 1));
  return builder.glb();
}

// 0..count-1 in random order.
std::vector<std::uint32_t> shuffled_numbers(std::size_t count, Random& random) {
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t k = 0; k < count; ++k) numbers[k] = static_cast<std::uint32_t>(k);
  for (std::size_t k = count; k > 1; --k)
    std::swap(numbers[k - 1], numbers[random.below(static_cast<std::uint32_t>(k))]);
  return numbers;
}

std::string shuffled_scan_glb(const std::vector<float>& points, const std::vector<std::uint8_t>& colours,
                              const Corners& corners, Random& random) {
  const auto vertex_order = shuffled_numbers(points.size() / 3, random);
  const auto face_order = shuffled_numbers(corners.size() / 3, random);
  std::vector<float> moved_points(points.size());
  std::vector<std::uint8_t> moved_colours(colours.size());
  for (std::size_t v = 0; v < vertex_order.size(); ++v) {
    std::copy_n(&points[3 * v], 3, &moved_points[3 * std::size_t{vertex_order[v]}]);
    std::copy_n(&colours[4 * v], 4, &moved_colours[4 * std::size_t{vertex_order[v]}]);
  }
  Corners moved_corners;
  moved_corners.reserve(corners.size());
  for (const std::uint32_t face : face_order)
    for (std::size_t k = 0; k < 3; ++k)
      moved_corners.push_back(vertex_order[corners[3 * std::size_t{face} + k]]);
  return scan_glb(moved_points, moved_colours, moved_corners);
}

// A torus of 100 x 75 quads in charts of 5 x 5, each with vertices of its own.
std::string textured_glb() {
  constexpr int kAround = 100, kAlong = 75, kChart = 5;
  std::vector<float> points, normals, coordinates;
  Corners corners;
  const auto add_vertex = [&](int column, int row, double s, double t) {
    const double u = 2 * std::numbers::pi * (column % kAround) / kAround;
    const double v = 2 * std::numbers::pi * (row % kAlong) / kAlong;
    const double radius = 1 + 0.4 * std::cos(v) * (1 + 0.2 * std::sin(5 * u));
    for (const double x : {radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v)})
      points.push_back(static_cast<float>(x));
    for (const double x : {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)})
      normals.push_back(static_cast<float>(x));
    for (const double x : {s, t}) coordinates.push_back(static_cast<float>(x));
  };
  for (int row = 0; row < kAlong; row += kChart)
    for (int column = 0; column < kAround; column += kChart) {
      const auto first = static_cast<std::uint32_t>(points.size() / 3);
      for (int j = 0; j <= kChart; ++j)
        for (int i = 0; i <= kChart; ++i)
          add_vertex(column + i, row + j, (column * 1.2 + i) / (1.2 * kAround),
                     (row * 1.2 + j) / (1.2 * kAlong));
      for (std::uint32_t j = 0; j < kChart; ++j)
        for (std::uint32_t i = 0; i < kChart; ++i) {
          const std::uint32_t a = first + j * (kChart + 1) + i, b = a + 1, d = a + kChart + 1, c = d + 1;
          corners.insert(corners.end(), {a, b, c, a, c, d});
        }
    }
  test::GltfBuilder builder;
  const int position = positions_of(builder, points);
  const int normal = builder.values(normals, 3);
  const int coordinate = builder.values(coordinates, 2);
  builder.mesh({{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", coordinate}},
               builder.values(corners, 1));
  return builder.glb();
}

std::string jar_glb() {
  const Workload jar = model6k();
  test::GltfBuilder builder;
  const int positions = positions_of(builder, jar.points);
  builder.mesh({{"POSITION", positions}}, builder.values(Corners(jar.corners.begin(), jar.corners.end()), 1));
  return builder.glb();
}

}  // namespace

std::vector<Asset> request_assets() {
  Random random(7);
  const Workload scan = scan120k();
  const std::vector<std::uint8_t> colours = colours_of(scan.points, random);
  const Corners corners(scan.corners.begin(), scan.corners.end());
  return {{"scan120k", scan_glb(scan.points, colours, corners)},
          {"shuffled120k", shuffled_scan_glb(scan.points, colours, corners, random)},
          {"textured15k", textured_glb()},
          {"jar6k", jar_glb()}};
}

}  // namespace subdivd::bench
