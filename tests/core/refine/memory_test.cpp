// What plans and refinement allocate, counted, against what is predicted before them. A program of its own: it
// replaces operator new.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/refine/plan.h"
#include "core/refine/refine.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/random.h"
#include "tests/support/allocations.h"

namespace subdivd {
namespace {

constexpr std::int64_t kSlack = 65536;  // blocks are as large as the allocator gives them

ControlMesh sheet(Index n, Index corners_of_last) {
  ControlMesh mesh;
  for (Index y = 0; y <= n; ++y)
    for (Index x = 0; x <= n; ++x)
      mesh.points.insert(mesh.points.end(), {double(x), double(y), 0.1 * ((x * 7 + y * 3) % 5)});
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x < n; ++x) {
      const Index a = y * (n + 1) + x;
      mesh.face_vertex_counts.push_back(4);
      mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, a + 1, a + n + 2, a + n + 1});
    }
  mesh.face_vertex_counts.back() = corners_of_last;
  mesh.face_vertex_indices.resize(mesh.face_vertex_indices.size() - 4 + corners_of_last);
  return mesh;
}

ControlMesh apart(Index faces, Index size) {
  ControlMesh mesh;
  for (Index f = 0; f < faces; ++f) {
    for (Index k = 0; k < size; ++k) {
      mesh.points.insert(mesh.points.end(), {double(f), double(k), double(k) * k});
      mesh.face_vertex_indices.push_back(size * f + k);
    }
    mesh.face_vertex_counts.push_back(size);
  }
  return mesh;
}

ControlMesh hub(Index faces) {
  ControlMesh mesh;
  mesh.points = {0, 0, 1};
  for (Index k = 0; k < faces; ++k) {
    mesh.points.insert(mesh.points.end(), {std::cos(k * 6.28 / faces), std::sin(k * 6.28 / faces), 0});
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {0, 1 + k, 1 + (k + 1) % faces});
  }
  return mesh;
}

// n quads around a point.
ControlMesh disk(Index n) {
  ControlMesh mesh = apart(0, 4);
  mesh.points.assign(3 * (2 * Count{n} + 1), 0);
  for (Index k = 0; k < 2 * n; ++k) {
    mesh.points[3 * k + 3] = std::cos(3.14 * k / n);
    mesh.points[3 * k + 4] = std::sin(3.14 * k / n);
  }
  for (Index k = 0; k < n; ++k) {
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(),
                                    {0, 2 * k + 1, 2 * k + 2, (2 * k + 2) % (2 * n) + 1});
  }
  return mesh;
}

ControlMesh quad_cube() {
  ControlMesh mesh;
  for (Index v = 0; v < 8; ++v)
    mesh.points.insert(mesh.points.end(), {v & 1 ? 1. : 0, v & 2 ? 1. : 0, v & 4 ? 1. : 0});
  mesh.face_vertex_counts.assign(6, 4);
  mesh.face_vertex_indices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  return mesh;
}

// So many times, beside one another.
ControlMesh copies(const ControlMesh& one, Index count) {
  ControlMesh mesh;
  for (Index k = 0; k < count; ++k) {
    const auto first = static_cast<Index>(mesh.point_count());
    for (std::size_t x = 0; x < one.points.size(); ++x) mesh.points.push_back(one.points[x] + 3 * k);
    for (const Index v : one.face_vertex_indices) mesh.face_vertex_indices.push_back(first + v);
    mesh.face_vertex_counts.insert(mesh.face_vertex_counts.end(), one.face_vertex_counts.begin(),
                                   one.face_vertex_counts.end());
  }
  return mesh;
}

// Two faces of n corners, back to back: every point and edge has them both.
ControlMesh pillow(Index n) {
  ControlMesh mesh = apart(1, n);
  mesh.face_vertex_counts.push_back(n);
  for (Index k = n; k > 0; --k) mesh.face_vertex_indices.push_back(k - 1);
  return mesh;
}

// Every corner a value of its own, twice.
ControlMesh with_channels(ControlMesh mesh) {
  for (const char* name : {"a", "b"}) {
    Primvar primvar{.name = name,
                    .interpolation = Interpolation::face_varying,
                    .element_size = 2,
                    .values = {},
                    .indices = {}};
    const bool turned = *name == 'b';
    const auto corners = static_cast<Index>(mesh.face_vertex_indices.size());
    for (Index c = 0; c < corners; ++c) {
      primvar.values.insert(primvar.values.end(), {double(c), 1});
      primvar.indices.push_back(turned ? corners - 1 - c : c);
    }
    mesh.primvars.push_back(std::move(primvar));
  }
  return mesh;
}

// As a renderer has it whose every corner is a vertex of its own.
ControlMesh with_render_mesh(ControlMesh mesh) {
  RenderMesh render{0, static_cast<Index>(mesh.face_count()), 0, {}};
  for (std::size_t c = 0; c < mesh.face_vertex_indices.size(); ++c)
    render.indices.push_back(render.vertex_count++);
  mesh.render_meshes = {std::move(render)};
  return mesh;
}

// Of some `size` * 1,000 corners each.
std::vector<shapes::NamedShape> meshes_of(Index size) {
  ControlMesh mixed = apart(250 * size, 4);  // as many corners as quads have
  for (Index f = 0; f < 250 * size; ++f) mixed.face_vertex_counts[f] = f % 2 == 0 ? 3 : 5;
  ControlMesh pairs_of_eight = apart(63 * size, 8);
  for (Index f = 0; f < 63 * size; ++f) {
    pairs_of_eight.face_vertex_counts.push_back(8);
    for (Index k = 8; k > 0; --k) pairs_of_eight.face_vertex_indices.push_back(8 * f + k - 1);
  }
  const auto side = static_cast<Index>(std::sqrt(250.0 * size));
  return {{"quads", sheet(side, 4)},
          {"quads and a triangle", sheet(side, 3)},
          {"pentagons apart", apart(200 * size, 5)},
          {"triangles and pentagons apart", std::move(mixed)},
          {"triangles apart", apart(333 * size, 3)},
          {"a hub", hub(333 * size)},
          {"one face", apart(1, 1000 * size)},
          {"two faces that share all edges", pillow(500 * size)},
          {"two faces with seams", with_channels(pillow(500 * size))},
          {"faces of eight, pairs of them", pairs_of_eight},
          {"seams", with_channels(sheet(side, 3))},
          {"seams of quads", with_channels(sheet(side, 4))},
          {"rendered quads", with_render_mesh(sheet(side, 4))},
          {"rendered polygons", with_render_mesh(sheet(side, 3))},
          {"rendered polygons with seams", with_render_mesh(with_channels(sheet(side, 3)))},
          {"icosahedra", copies(shapes::icosahedron(), 16 * size)},
          {"cubes", copies(quad_cube(), 40 * size)},
          {"disks of sixteen", copies(disk(16), 16 * size)}};
}

// At most `factor` times what it takes.
void expect_plan_as_predicted(const ControlMesh& mesh, const PlanOptions& options, const std::string& what,
                              std::int64_t factor = 5) {
  const auto predicted = static_cast<std::int64_t>(plan_bytes(mesh, options, {}));
  const test::Allocations count;
  const auto plan = Plan::build(mesh, options, {});
  ASSERT_TRUE(plan.ok()) << what;
  EXPECT_LE(count.peak_bytes(), predicted + kSlack) << what << ' ' << mesh.subdivision_scheme;
  EXPECT_GE(factor * count.peak_bytes(), predicted) << what << ' ' << mesh.subdivision_scheme;
}

TEST(Memory, of_a_plan_is_known_before) {
  for (const auto& [name, mesh] : meshes_of(40))
    for (const char* scheme : {"catmullClark", "bilinear"}) {
      ControlMesh of_scheme = mesh;
      of_scheme.subdivision_scheme = scheme;
      expect_plan_as_predicted(of_scheme, {.max_level = 3}, name);
    }
}

// What these hold grows with the levels. How long rows are depends on what nobody has counted yet.
TEST(Memory, of_a_plan_by_steps_is_known_before) {
  for (const char* scheme : {"butterfly", "kobbelt"})
    for (auto& [name, mesh] : meshes_of(4)) {
      ControlMesh of_scheme = mesh;
      of_scheme.subdivision_scheme = scheme;
      if (!scheme_of(of_scheme, {}, {})) continue;
      for (const Index level : {0, 1, 2, 3})
        for (const bool frames : {false, true})
          expect_plan_as_predicted(
              of_scheme, {.max_level = level, .frames = frames},
              name + " to level " + std::to_string(level) + (frames ? " with frames" : ""), 10);
    }
}

// Arrays of less than 2 MiB: larger ones are rounded up to whole huge pages (core/base/large_blocks.h).
TEST(Memory, of_refinement_is_known_from_the_plan) {
  for (const char* scheme : {"catmullClark", "butterfly", "kobbelt"})
    for (const auto& [name, mesh] : meshes_of(4))
      for (const Index level : {0, 1, 2}) {
        ControlMesh of_scheme = mesh;
        of_scheme.subdivision_scheme = scheme;
        if (!scheme_of(of_scheme, {}, {})) continue;
        const RefineOptions options = {.level = level, .limit = true, .normals = true};
        const auto size = predict_size<double>(of_scheme, options);
        ASSERT_TRUE(size.ok()) << name;
        const test::Allocations count;
        const auto refined = refine<double>(of_scheme, options, {});
        ASSERT_TRUE(refined.ok()) << name;
        const auto promised = static_cast<std::int64_t>(size->bytes + size->working_bytes);
        EXPECT_LE(count.peak_bytes(), promised + kSlack) << name << " at level " << level << ' ' << scheme;
        EXPECT_GE(5 * count.peak_bytes(), promised) << name << " at level " << level << ' ' << scheme;
      }
}

}  // namespace
}  // namespace subdivd
