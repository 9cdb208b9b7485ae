// Every named shape of polygons, levels 0-4, by both schemes that take them, in both precisions, by both
// crease methods and both rules of triangles, with primvars of every interpolation.

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/differential/agreement.h"
#include "tests/shapes/polygons.h"

namespace subdivd::differential {
namespace {

constexpr Index kLevels = kSanitized ? 2 : 4;

const std::vector<shapes::NamedShape>& named_shapes() {
  static const std::vector<shapes::NamedShape> shapes = shapes::polygon_shapes();
  return shapes;
}

Index deepest(const ControlMesh& mesh) { return mesh.face_vertex_indices.size() > 1000 ? 2 : kLevels; }

ControlMesh by(ControlMesh mesh, std::string_view scheme) {
  mesh.subdivision_scheme = scheme;
  return mesh;
}

// Of level 0 and of the others, one line each.
template <class Real>
std::string disagreements(const ControlMesh& mesh, CreaseMethod method, Index levels) {
  return agreement<Real>(mesh, method, 0).disagreements + agreement<Real>(mesh, method, levels).disagreements;
}

template <class Real>
void expect_agreement(const std::string& name, ControlMesh mesh) {
  int mode = 0;
  for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin})
    for (const TriangleRule rule : {TriangleRule::catmull_clark, TriangleRule::smooth}) {
      mesh.triangle_subdivision_rule = rule;
      mesh.face_varying_linear_interpolation = static_cast<FaceVaryingInterpolation>(mode++ % 6);
      EXPECT_EQ(disagreements<Real>(mesh, method, deepest(mesh)), "")
          << name << ", " << mesh.subdivision_scheme
          << (method == CreaseMethod::chaikin ? ", chaikin" : ", uniform")
          << (rule == TriangleRule::smooth ? ", smooth triangles" : "");
    }
}

TEST(PolygonShapes, are_at_least_sixty) { EXPECT_GE(named_shapes().size(), 60u); }

TEST(PolygonShapes, agree_with_far_in_double_precision) {
  for (const auto& [name, mesh] : named_shapes())
    expect_agreement<double>(name, by(shapes::with_values(mesh, 2, 1), "catmullClark"));
}

TEST(PolygonShapes, agree_with_far_in_single_precision) {
  for (const auto& [name, mesh] : named_shapes())
    expect_agreement<float>(name, by(shapes::with_values(mesh, 3, 2), "catmullClark"));
}

// Sharpness and the rule of triangles play no part.
TEST(PolygonShapes, agree_with_far_under_bilinear_subdivision) {
  for (const auto& [name, mesh] : named_shapes()) {
    const ControlMesh linear = by(shapes::with_values(mesh, 2, 3), "bilinear");
    EXPECT_EQ(disagreements<double>(linear, CreaseMethod::uniform, deepest(mesh)), "") << name;
    EXPECT_EQ(disagreements<float>(linear, CreaseMethod::uniform, deepest(mesh)), "") << name;
  }
}

TEST(PolygonShapes, agree_with_far_in_every_mode_of_face_varying_values) {
  for (const auto& [name, mesh] : named_shapes())
    for (int mode = 0; mode < 6; ++mode) {
      ControlMesh seamed = by(shapes::with_values(mesh, 1 + static_cast<Index>(mode) % 3, 4), "catmullClark");
      seamed.face_varying_linear_interpolation = static_cast<FaceVaryingInterpolation>(mode);
      EXPECT_EQ(disagreements<double>(seamed, CreaseMethod::uniform, 2), "") << name << ", mode " << mode;
    }
}

// Catmull and Clark's scheme takes triangles, if asked to.
TEST(TriangleShapes, agree_with_far_under_catmull_clark) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    if (mesh.face_count() > 300) continue;
    EXPECT_EQ(disagreements<double>(by(mesh, "catmullClark"), CreaseMethod::chaikin, 2), "") << name;
  }
}

// An exception that swallowed everything would pass every test above.
TEST(PolygonShapes, are_compared_for_the_most_part) {
  // Under bilinear subdivision Far has no tangents where pieces meet, and moves values at seams.
  for (const auto& [scheme, most_limits, most_normals] :
       {std::tuple{"catmullClark", 0.01, 0.02}, {"bilinear", 0.10, 0.45}}) {
    Coverage limits, normals, values;
    for (const auto& [name, mesh] : named_shapes()) {
      const Agreement agreed =
          agreement<double>(by(shapes::with_values(mesh, 1, 5), scheme), CreaseMethod::uniform, 3);
      for (auto [total, part] : {std::pair{&limits, &agreed.limits}, std::pair{&normals, &agreed.normals},
                                 std::pair{&values, &agreed.values}}) {
        total->compared += part->compared;
        total->excepted += part->excepted;
      }
    }
    const auto share = [](const Coverage& c) {
      return static_cast<double>(c.excepted) / static_cast<double>(c.compared + c.excepted);
    };
    RecordProperty(std::string(scheme) + "_limits_left_out", std::to_string(share(limits)));
    RecordProperty(std::string(scheme) + "_normals_left_out", std::to_string(share(normals)));
    RecordProperty(std::string(scheme) + "_values_left_out", std::to_string(share(values)));
    EXPECT_LT(share(values), 0.001);
    EXPECT_LT(share(limits), most_limits);
    EXPECT_LT(share(normals), most_normals);
  }
}

}  // namespace
}  // namespace subdivd::differential
