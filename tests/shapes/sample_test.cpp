// The committed samples are what make_sample writes, and small enough for a repository.
#include "tests/shapes/sample.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

namespace subdivd::shapes {
namespace {

std::string committed(const std::string& name) {
  std::ifstream file(std::string(SUBDIVD_SOURCE_DIR) + "/tests/shapes/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Where two byte strings part, or npos: gtest would print both whole.
std::size_t first_difference(const std::string& a, const std::string& b) {
  if (a == b) return std::string::npos;
  std::size_t k = 0;
  while (k < a.size() && k < b.size() && a[k] == b[k]) ++k;
  return k;
}

// Directed edges of a surface, each with the number of faces that run along it.
std::map<std::pair<Index, Index>, int> directed_edges(const SampleSurface& surface) {
  std::map<std::pair<Index, Index>, int> edges;
  for (const auto& face : surface.faces)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{face.corners[k].point, face.corners[(k + 1) % 3].point}];
  return edges;
}

void expect_closed_and_oriented(const SampleSurface& surface) {
  const auto edges = directed_edges(surface);
  for (const auto& [edge, faces] : edges) {
    EXPECT_EQ(faces, 1) << edge.first << " " << edge.second;
    EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << " " << edge.second;
  }
}

TEST(Sample, glb_is_the_one_that_the_program_writes) {
  EXPECT_EQ(first_difference(sample_glb(), committed("sample.glb")), std::string::npos)
      << "run: build/make_sample tests/shapes";
}

TEST(Sample, vase_is_the_one_that_the_program_writes) {
  EXPECT_EQ(first_difference(sample_vase_json(), committed("vase.json")), std::string::npos)
      << "run: build/make_sample tests/shapes";
}

TEST(Sample, glb_is_smaller_than_60_kB) { EXPECT_LT(sample_glb().size(), 60'000u); }

TEST(Sample, jug_is_closed_and_consistently_wound) { expect_closed_and_oriented(sample_jug()); }

TEST(Sample, jug_has_one_handle) {
  const SampleSurface jug = sample_jug();
  // Euler: V - E + F = 2 - 2 genus
  const auto edges = directed_edges(jug).size() / 2;
  EXPECT_EQ(jug.points.size() + jug.faces.size(), edges);
}

TEST(Sample, pear_is_closed_and_consistently_wound) { expect_closed_and_oriented(sample_pear()); }

TEST(Sample, jug_has_a_seam_and_a_border_between_materials) {
  const SampleSurface jug = sample_jug();
  std::map<Index, std::map<std::size_t, std::map<std::pair<double, double>, int>>> values;
  for (const auto& face : jug.faces)
    for (const auto& corner : face.corners) ++values[corner.point][face.material][{corner.u, corner.v}];
  int seam_points = 0, border_points = 0;
  for (const auto& [point, by_material] : values) {
    border_points += by_material.size() == 2;
    for (const auto& [material, by_value] : by_material) seam_points += by_value.size() > 1;
  }
  EXPECT_GE(seam_points, 11);    // a row from foot to lip
  EXPECT_EQ(border_points, 30);  // a ring at the foot and one at the lip
}

}  // namespace
}  // namespace subdivd::shapes
