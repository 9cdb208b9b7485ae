// What verifying takes is known before, and what it does not get is no fault of the caller's.

#include <new>
#include <numeric>
#include <string>

#include "core/oracle/far_curves.h"
#include "core/oracle/far_surfaces.h"
#include "core/oracle/verify.h"
#include "tests/core/oracle/fixtures.h"
#include "tests/support/allocations.h"

#ifdef __SANITIZE_ADDRESS__
// Where memory runs out, Far loses the refiner or the level that it was about to make. What its library and
// its headers allocate is not looked for in this program; all else is.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libosdCPU\n"
         "leak:include/opensubdiv/far/topologyRefinerFactory.h\n";
}
#endif

namespace subdivd::oracle::testing {
namespace {

using subdivd::test::Allocations;

struct Shape {
  const char* name;
  ControlMesh mesh;
  Index deepest;
};

ControlMesh confetti(Index faces) {
  ControlMesh mesh = shapes::torus(3, 3);
  mesh.points.resize(std::size_t{9} * faces);
  for (std::size_t k = 0; k < mesh.points.size(); ++k) mesh.points[k] = double(k * 7919 % 1000);
  mesh.face_vertex_indices.resize(std::size_t{3} * faces);
  std::iota(mesh.face_vertex_indices.begin(), mesh.face_vertex_indices.end(), 0u);
  return mesh;
}

// Triangles between any points: every point has some dozen faces, hardly any edge two.
ControlMesh thicket(Index points, Index faces) {
  ControlMesh mesh = confetti(points / 3);
  mesh.face_vertex_indices.clear();
  for (Index f = 0; f < faces; ++f) {
    const Index a = f * 2654435761u % points, b = (a + 1 + f * 40503u % (points / 2)) % points;
    Index c = (b + 1 + f * 9176u % (points / 2 - 1)) % points;
    while (c == a || c == b) c = (c + 1) % points;
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, b, c});
  }
  return mesh;
}

// Single faces of `corners` corners.
ControlMesh polygons(Index corners, Index faces) {
  ControlMesh mesh;
  mesh.points.resize(std::size_t{3} * corners * faces);
  for (std::size_t k = 0; k < mesh.points.size(); ++k) mesh.points[k] = double(k * 7919 % 1000);
  mesh.face_vertex_counts.assign(faces, corners);
  mesh.face_vertex_indices.resize(std::size_t{corners} * faces);
  std::iota(mesh.face_vertex_indices.begin(), mesh.face_vertex_indices.end(), 0u);
  return mesh;
}

ControlMesh quad_torus(Index rows, Index columns) {
  ControlMesh mesh = shapes::torus(rows, columns);
  mesh.face_vertex_counts.assign(std::size_t{rows} * columns, 4);
  mesh.face_vertex_indices.clear();
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index right = (i + 1) % columns, above = (j + 1) % rows;
      mesh.face_vertex_indices.insert(
          mesh.face_vertex_indices.end(),
          {j * columns + i, j * columns + right, above * columns + right, above * columns + i});
    }
  return mesh;
}

ControlMesh with(ControlMesh mesh, Interpolation interpolation, Index width, int channels) {
  for (int k = 0; k < channels; ++k)
    mesh.primvars.push_back(interpolation == Interpolation::face_varying
                                ? shapes::unindexed(mesh, std::to_string(k), width)
                                : shapes::plain_primvar(mesh, std::to_string(k), interpolation, width));
  return mesh;
}

std::vector<Shape> worst_shapes() {
  const auto varying = Interpolation::face_varying;
  std::vector<Shape> shapes;
  shapes.push_back({"confetti", confetti(3000), 3});
  shapes.push_back({"confetti_with_channels", with(confetti(1000), varying, 2, 8), 3});
  shapes.push_back({"torus", shapes::big_torus(40, 40, 1), 4});
  shapes.push_back({"torus_with_a_wide_channel", with(shapes::big_torus(20, 20, 1), varying, 40, 1), 3});
  shapes.push_back({"torus_with_channels", with(shapes::big_torus(20, 20, 1), varying, 1, 16), 3});
  shapes.push_back(
      {"torus_with_vertex_values", with(shapes::big_torus(20, 20, 1), Interpolation::vertex, 30, 2), 3});
  shapes.push_back(
      {"torus_with_uniform_values", with(shapes::big_torus(20, 20, 1), Interpolation::uniform, 30, 2), 3});
  shapes.push_back({"fan", shapes::disk(4000), 2});
  shapes.push_back({"thicket", thicket(600, 3000), 2});
  // Quads, and faces of other sizes.
  shapes.push_back({"quad_confetti", polygons(4, 2500), 3});
  shapes.push_back({"quad_confetti_with_channels", with(polygons(4, 800), varying, 2, 8), 3});
  shapes.push_back({"pentagons", polygons(5, 1500), 3});
  shapes.push_back({"large_faces", polygons(500, 20), 3});
  shapes.push_back({"large_faces_with_channels", with(polygons(500, 8), varying, 2, 8), 2});
  shapes.push_back({"quad_torus", quad_torus(40, 40), 4});
  shapes.push_back({"quad_torus_with_channels", with(quad_torus(20, 20), varying, 1, 16), 3});
  shapes.push_back(
      {"quad_torus_with_vertex_values", with(quad_torus(20, 20), Interpolation::vertex, 30, 2), 3});
  shapes.push_back(
      {"quad_torus_with_uniform_values", with(quad_torus(20, 20), Interpolation::uniform, 30, 2), 3});
  ControlMesh cut = shapes::big_torus(30, 30, 1);  // triangles that become quads
  cut.subdivision_scheme = "catmullClark";
  shapes.push_back({"triangles_into_quads", cut, 3});
  ControlMesh lonely_quad = polygons(4, 1);
  lonely_quad.points.resize(300000, 0.5);
  shapes.push_back({"unreferenced_points_beside_a_quad", lonely_quad, 1});
  ControlMesh lonely = shapes::tetrahedron();
  lonely.points.resize(300000, 0.5);
  shapes.push_back({"unreferenced_points", lonely, 1});
  return shapes;
}

// The most that this work has allocated at once.
template <class Work>
std::int64_t peak_of(Work&& work) {
  const Allocations allocations;
  EXPECT_TRUE(work());
  return allocations.peak_bytes();
}

TEST(Memory, of_verifying_stays_within_what_is_predicted) {
  for (const Shape& shape : worst_shapes()) {
    ASSERT_TRUE(shape.mesh.check().ok()) << shape.name;
    for (Index level = 0; level <= shape.deepest; ++level) {
      const RefineOptions options = everything(level);
      const std::int64_t ours = peak_of([&] { return refine<double>(shape.mesh, options, Budget{}).ok(); });
      const std::int64_t all = peak_of([&] { return verify<double>(shape.mesh, options, Budget{}).ok(); });
      const Count predicted = far_mesh_bytes(shape.mesh, level) + report_bytes(shape.mesh, level);
      const std::int64_t far =
          peak_of([&] { return far_refine<double>(shape.mesh, options, Budget{}).ok(); });
      EXPECT_LE(far, std::int64_t(predicted)) << shape.name << ", level " << level;
      // Not all of our own share is there when Far is at its peak.
      const double share = double(std::max(all - ours, far)) / double(predicted);
      RecordProperty(std::string(shape.name) + "_" + std::to_string(level), std::to_string(share));
      EXPECT_LE(share, 1) << shape.name << ", level " << level;
      EXPECT_GE(share, 0.2) << shape.name << ", level " << level << ": too careful";
      // Without limits Far's levels stay while those below the last are compared.
      RefineOptions values = options;
      values.limit = values.tangents = values.normals = false;
      const std::int64_t ours_alone =
          peak_of([&] { return refine<double>(shape.mesh, values, Budget{}).ok(); });
      const std::int64_t together =
          peak_of([&] { return verify<double>(shape.mesh, values, Budget{}).ok(); });
      EXPECT_LE(together - ours_alone, std::int64_t(predicted)) << shape.name << ", level " << level;
    }
  }
}

TEST(Memory, of_verifying_curves_stays_within_what_is_predicted) {
  for (const Index width : {1u, 3u, 17u})
    for (const CurveWrap wrap : {CurveWrap::pinned, CurveWrap::periodic})
      for (const Index level : {0u, 1u, 4u}) {
        ControlCurves curves;
        curves.wrap = wrap;
        curves.width = width;
        curves.vertex_counts.assign(20, 30);
        for (Index k = 0; k < 600 * width; ++k) curves.points.push_back(k * 7919 % 1000);
        const CurveOptions options{.level = level, .limit = true};
        const auto ours = predict_bytes<double>(curves, options);
        ASSERT_TRUE(ours.ok());
        const std::int64_t peak = peak_of([&] { return verify<double>(curves, options, Budget{}).ok(); });
        EXPECT_LE(double(peak) / double(far_curve_bytes(curves, level) + 2 * *ours), 1)
            << "width " << width << ", level " << level;
      }
}

TEST(Memory, of_verifying_surfaces_stays_within_what_is_predicted) {
  for (const Index width : {1u, 3u, 4u})
    for (const CurveWrap wrap : {CurveWrap::pinned, CurveWrap::periodic})
      for (const Index level : {0u, 1u, 4u}) {
        ControlPatch patch{"", 20, 10, 3, 3, wrap, wrap, width, {}};
        for (Index k = 0; k < 200 * width; ++k) patch.points.push_back(k * 7919 % 1000);
        PatchOptions options{.level = level, .limit = true, .normals = width == 3};
        options.faces = PatchFaces::quads;
        const auto ours = predict_bytes<double>(patch, options);
        ASSERT_TRUE(ours.ok());
        const std::int64_t peak = peak_of([&] { return verify<double>(patch, options, Budget{}).ok(); });
        EXPECT_LE(double(peak) / double(far_surface_bytes(patch, level) + 2 * *ours), 1)
            << "width " << width << ", level " << level;
      }
}

// Every allocation in turn, Far's among them, is the one that there is no memory for.
TEST(Memory, that_runs_out_is_neither_swallowed_nor_blamed_on_the_mesh) {
  const ControlMesh mesh = rich_mesh();
  std::int64_t count = 0;
  {
    const Allocations allocations;
    ASSERT_TRUE(verify<double>(mesh, everything(2), Budget{}).ok());
    count = allocations.count();
  }
  ASSERT_GT(count, 100);
  for (std::int64_t failing = 0; failing < count; ++failing) {
    const Allocations allocations({.at = failing});
    bool thrown = false;
    try {
      const auto report = verify<double>(mesh, everything(2), Budget{});
    } catch (const std::bad_alloc&) {
      thrown = true;
    }
    EXPECT_TRUE(thrown) << "allocation " << failing << " of " << count;
  }
}

TEST(Memory, estimates_of_absurd_sizes_stay_numbers) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.face_vertex_indices.resize(3000000);
  mesh.primvars.resize(100000);
  for (Primvar& primvar : mesh.primvars) primvar.element_size = kMaxElementSize;
  EXPECT_GT(far_mesh_bytes(mesh, kMaxLevel), Count{1} << 62);
  EXPECT_EQ(far_mesh_bytes(mesh, kMaxLevel), far_mesh_bytes(mesh, kMaxFarLevel));
}

}  // namespace
}  // namespace subdivd::oracle::testing
