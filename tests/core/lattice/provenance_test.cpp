#include "core/lattice/provenance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "core/lattice/lattice.h"
#include "core/lattice/numbering.h"
#include "core/lattice/sources.h"
#include "core/refine/plan.h"
#include "core/refine/refine.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

constexpr Index kLevels[] = {0, 1, 2, 3};

std::shared_ptr<const Lattice> lattice_of(const ControlMesh& mesh) {
  const auto plan = Plan::build(mesh, {.max_level = 0}, {});
  EXPECT_TRUE(plan.ok());
  return plan->mesh().lattice();
}

std::vector<shapes::NamedShape> shapes_of_all_faces() {
  std::vector<shapes::NamedShape> shapes = shapes::all_shapes();
  for (auto& shape : shapes::polygon_shapes()) shapes.push_back(std::move(shape));
  return shapes;
}

std::vector<Provenance> provenance_of(const Lattice& lattice, Index level) {
  std::vector<Provenance> places(lattice.vertex_count(level));
  lattice.write_provenance(level, places, Pace());
  return places;
}

// The vertices of the refined faces of every base face, by that face.
std::vector<std::set<Index>> vertices_of_faces(const Lattice& lattice, Index level) {
  const std::vector<unsigned char> holes(lattice.base_face_count(), 0);
  std::vector<Index> corners(lattice.corner_count(level)), faces(lattice.face_count(level));
  EXPECT_TRUE(lattice.write_faces(level, holes, corners.data(), 1, {}));
  lattice.write_base_faces(level, holes, faces.data(), Pace());
  std::vector<Index> sizes(faces.size(), lattice.face_size(level));
  if (lattice.face_size(level) == 0) lattice.write_face_sizes(holes, sizes.data(), Pace());
  std::vector<std::set<Index>> vertices(lattice.base_face_count());
  auto corner = corners.begin();
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (Index k = 0; k < sizes[f]; ++k) vertices[faces[f]].insert(*corner++);
  EXPECT_EQ(corner, corners.end());
  return vertices;
}

TEST(Provenance, is_of_the_lowest_face_that_has_the_vertex) {
  for (const auto& [name, mesh] : shapes_of_all_faces()) {
    SCOPED_TRACE(name);
    const auto lattice = lattice_of(mesh);
    for (const Index level : kLevels) {
      std::vector<Index> lowest(lattice->vertex_count(level), kNoIndex);
      const auto vertices = vertices_of_faces(*lattice, level);
      for (Index f = 0; f < vertices.size(); ++f)
        for (const Index v : vertices[f]) lowest[v] = std::min(lowest[v], f);
      const auto places = provenance_of(*lattice, level);
      for (Index v = 0; v < places.size(); ++v) ASSERT_EQ(places[v].face, lowest[v]);
    }
  }
}

// Bilinear subdivision puts every vertex where its place on the face says.
TEST(Provenance, tells_the_place_on_the_face) {
  for (auto& [name, mesh] : shapes_of_all_faces()) {
    SCOPED_TRACE(name);
    ControlMesh bilinear = mesh;
    bilinear.subdivision_scheme = "bilinear";
    const auto plan = Plan::build(bilinear, {}, {});
    ASSERT_TRUE(plan.ok());
    const Lattice& lattice = *plan->mesh().lattice();
    std::vector<Index> begins{0};
    for (Index f = 0; f < lattice.base_face_count(); ++f)
      begins.push_back(begins.back() + lattice.base_face_size(f));
    for (const Index level : kLevels) {
      const auto refined = refine<double>(bilinear, *plan, {.level = level}, {});
      ASSERT_TRUE(refined.ok());
      const auto places = provenance_of(lattice, level);
      const double n = static_cast<double>(segments(level));
      for (Index v = 0; v < places.size(); ++v) {
        if (places[v].face == kNoIndex) continue;
        const Index begin = begins[places[v].face], size = begins[places[v].face + 1] - begin;
        using Point = std::array<double, 3>;
        const auto at = [&](Index k) {
          const double* p = &mesh.points[std::size_t{3} * mesh.face_vertex_indices[begin + k % size]];
          return Point{p[0], p[1], p[2]};
        };
        const auto mix = [](const Point& a, const Point& b, double t) {
          Point p{};
          for (std::size_t c = 0; c < 3; ++c) p[c] = (1 - t) * a[c] + t * b[c];
          return p;
        };
        const Index k = places[v].corner;
        ASSERT_LT(k, size == 4 ? 1 : size);
        Point quad[4] = {at(0), at(1), at(2), at(3)};
        if (size != 4) {
          Point mean{};
          for (Index c = 0; c < size; ++c)
            for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += at(c)[axis] / size;
          const Point of_quarter[4] = {at(k), mix(at(k), at(k + 1), 0.5), mean,
                                       mix(at(k), at(k + size - 1), 0.5)};
          std::copy_n(of_quarter, 4, quad);
        }
        const Point p = mix(mix(quad[0], quad[1], places[v].i / n), mix(quad[3], quad[2], places[v].i / n),
                            places[v].j / n);
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(refined->points[3 * std::size_t{v} + c], p[c], 1e-12) << level << ' ' << v;
      }
    }
  }
}

// The array may come unset.
TEST(Provenance, of_a_point_without_faces_is_none_whatever_stood_there) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points.insert(mesh.points.end(), {7, 7, 7});
  const auto lattice = lattice_of(mesh);
  std::vector<Provenance> places(lattice->vertex_count(1), Provenance{2, 1, 1});
  lattice->write_provenance(1, places, Pace());
  EXPECT_EQ(places[4].face, kNoIndex);
}

TEST(BaseFaces, leave_out_holes) {
  ControlMesh mesh;
  mesh.points.resize(15);
  mesh.face_vertex_indices = {0, 1, 2, 1, 2, 3, 2, 3, 4};
  const std::vector<unsigned char> holes{0, 1, 0};
  std::vector<Index> faces(2 * triangles_per_face(1), kNoIndex);
  lattice_of(mesh)->write_base_faces(1, holes, faces.data(), Pace());
  EXPECT_EQ(faces, (std::vector<Index>{0, 0, 0, 0, 2, 2, 2, 2}));
}

TEST(Split, finds_a_triangle_by_its_corners_from_any_of_them_on) {
  for (const Count n : {1, 2, 4, 8}) {
    Count expected = 0;
    const auto at = [](Count i, Count j) { return GridPoint{static_cast<Index>(i), static_cast<Index>(j)}; };
    for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
      const GridPoint a = at(i0, j0), b = at(i1, j1), c = at(i2, j2);
      for (const auto& corners : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
        ASSERT_EQ(triangle_index(n, corners), expected);
      }
      ++expected;
    });
  }
}

TEST(Split, numbers_the_points_of_a_face_row_by_row) {
  for (const Count n : {1, 2, 4, 8}) {
    Count expected = 0;
    for (Count j = 0; j <= n; ++j)
      for (Count i = 0; i + j <= n; ++i) ASSERT_EQ(face_point_index(n, i, j), expected++);
    EXPECT_EQ(face_points(n), expected);
  }
}

// Faces 5 to 12 of a mesh, or as many as there are, torn apart at every edge.
TEST(Sources, are_at_the_same_place_of_the_same_face) {
  for (const auto& [name, mesh] : shapes_of_all_faces()) {
    SCOPED_TRACE(name);
    const auto whole = lattice_of(mesh);
    if (whole->base_face_count() < 7) continue;
    const Index first = 5, count = std::min<Index>(8, whole->base_face_count() - first);
    RenderMesh render{first, first + count, 0, {}};
    for (Index f = first; f < first + count; ++f)
      for (Index k = 0; k < whole->base_face_size(f); ++k) render.indices.push_back(render.vertex_count++);
    ControlMesh with_render = mesh;
    with_render.render_meshes = {render};
    const auto plan = Plan::build(with_render, {.max_level = 0}, {});
    ASSERT_TRUE(plan.ok());
    const Lattice& part = *plan->render_lattice(0);
    std::vector<unsigned char> holes(count, 0), others(whole->base_face_count(), 1);
    holes[1] = 1;
    for (Index f = 0; f < count; ++f) others[first + f] = holes[f];
    for (const Index level : kLevels) {
      const Buffer<Index> sources = vertex_sources(part, *whole, first, level, holes, Pace());
      ASSERT_EQ(sources.size(), part.vertex_count(level));
      std::vector<Index> own(part.corner_count(level, holes, Pace())), theirs(own.size());
      ASSERT_TRUE(part.write_faces(level, holes, own.data(), 1, {}));
      ASSERT_TRUE(whole->write_faces(level, others, theirs.data(), 1, {}));
      std::vector<unsigned char> reached(sources.size(), 0);
      for (std::size_t c = 0; c < own.size(); ++c) {
        ASSERT_EQ(sources[own[c]], theirs[c]) << level << ' ' << c;
        reached[own[c]] = 1;
      }
      for (std::size_t v = 0; v < sources.size(); ++v)
        if (reached[v] == 0) {
          ASSERT_EQ(sources[v], kNoIndex);
        }
    }
  }
}

}  // namespace
}  // namespace subdivd
