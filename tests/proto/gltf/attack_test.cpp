// Small bodies that once took minutes, and that no deadline stopped: work is linear in the body, has caps,
// and ends when the budget says so.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "proto/decode.h"
#include "proto/gltf/caps.h"
#include "tests/proto/gltf/attacks.h"
#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {

void PrintTo(const Attack& attack, std::ostream* out) { *out << attack.name; }

namespace {

using proto::Format;

class SmallBody : public testing::TestWithParam<Attack> {};

// Not how fast, but that it ends: at these sizes what was quadratic took minutes, and what is linear takes a
// second, or ten under a sanitizer.
TEST_P(SmallBody, is_read_long_before_a_minute_has_passed) {
  const Attack& attack = GetParam();
  const std::string body = attack.body(attack.usual);
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::minutes(1);
  const auto request = proto::gltf::read(body, attack.format, {}, {}, budget);
  if (!request) {
    EXPECT_EQ(request.error().code, ErrorCode::too_large) << request.error().message;
    EXPECT_GT(request.error().predicted, request.error().allowed);
    EXPECT_NE(request.error().message.find(std::to_string(request.error().allowed)), std::string::npos);
  }
}

TEST_P(SmallBody, goes_through_the_whole_pipeline_when_it_is_smaller) {
  const Attack& attack = GetParam();
  proto::Options options;
  options.level = 1;
  const auto outcome = refine_gltf(attack.body(40), attack.format, options);
  if (outcome) {
    EXPECT_GE(outcome->predicted, outcome->bytes.size());
  } else {
    const ErrorCode code = outcome.error().code;  // zeros alone make no triangle
    EXPECT_TRUE(code == ErrorCode::too_large || code == ErrorCode::not_a_triangle) << outcome.error().message;
  }
}

TEST_P(SmallBody, is_left_when_nobody_waits_for_it) {
  const Attack& attack = GetParam();
  const std::string body = attack.body(attack.usual / 50);
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  const auto request = proto::gltf::read(body, attack.format, {}, {}, budget);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::cancelled);
}

INSTANTIATE_TEST_SUITE_P(Attacks, SmallBody, testing::ValuesIn(attacks()),
                         [](const auto& one) { return std::string(one.param.name); });

// Stops the work at its n-th look for memory, then at the next, … as a deadline might: what comes back is
// that reason and no other.
class Stopping : public MemoryGrant {
 public:
  explicit Stopping(int after) : left_(after) {}
  Result<void> take(Count) override {
    if (left_-- > 0) return {};
    return Error{ErrorCode::overloaded, "no memory now"};
  }

 private:
  int left_;
};

int looks_for_memory(const std::string& body, Format format) {
  for (int steps = 0;; ++steps) {
    Stopping grant(steps);
    Budget budget;
    budget.memory = &grant;
    const auto request = proto::gltf::read(body, format, {}, {}, budget);
    if (request || request.error().code == ErrorCode::too_large) return steps;
    if (request.error().code == ErrorCode::overloaded) continue;
    ADD_FAILURE() << request.error().message;
    return steps;
  }
}

// What one part has asked for serves the next, so that few of them ask anew: the largest differs from body to
// body.
TEST(Memory, that_is_refused_is_never_a_fault_of_the_body) {
  int steps = looks_for_memory(seamed_octahedron().glb(), Format::glb);
  for (const Attack& attack : attacks())
    if (attack.name != std::string("accessors_without_data"))
      steps += looks_for_memory(attack.body(60), attack.format);
  EXPECT_GT(steps, 500);
}

TEST(Budgets, end_every_part_of_the_work) {
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  proto::RefineRequest request = must_read(seamed_octahedron().glb());
  request.options.level = 1;
  const auto size = predict_size<float>(request.meshes[0], {.level = 1, .normals = true});
  const auto predicted = proto::gltf::predicted_bytes(request, {*size}, budget);
  ASSERT_FALSE(predicted.ok());
  EXPECT_EQ(predicted.error().code, ErrorCode::cancelled);
  proto::RefineAnswer<float> refined;
  refined.meshes.push_back(*refine<float>(request.meshes[0], {.level = 1, .normals = true}, Budget()));
  const auto written = proto::gltf::write(request, std::move(refined), Format::glb, "{}", budget);
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::cancelled);
  request.source = nullptr;
  request.meshes[0].render_meshes.clear();
  const auto added = proto::gltf::add_render_meshes(request, budget);
  ASSERT_FALSE(added.ok());
  EXPECT_EQ(added.error().code, ErrorCode::cancelled);
}

// A million curves in one object of a JSON body would each look for their points from the first curve on.
TEST(Fresh, refuses_an_answer_of_more_primitives_than_allowed) {
  proto::RefineRequest request;
  request.options.format = Format::glb;
  ControlCurves curves;
  curves.points.assign(std::size_t{4} * 3 * 70000, 1.0);
  curves.vertex_counts.assign(70000, 4);
  request.curves.push_back(curves);
  const auto added = proto::gltf::add_render_meshes(request);
  ASSERT_FALSE(added.ok());
  EXPECT_EQ(added.error().code, ErrorCode::too_large);
  EXPECT_EQ(added.error().allowed, proto::gltf::kMaxPrimitives);
}

TEST(Fresh, writes_as_many_curves_as_allowed_long_before_a_minute_has_passed) {
  proto::RefineRequest request;
  request.options.format = Format::glb;
  request.options.level = 0;
  ControlCurves curves;
  for (std::size_t i = 0; i < 4 * 3 * proto::gltf::kMaxPrimitives; ++i)
    curves.points.push_back(static_cast<double>(i % 19));
  curves.vertex_counts.assign(proto::gltf::kMaxPrimitives, 4);
  request.curves.push_back(curves);
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::minutes(1);
  ASSERT_TRUE(proto::gltf::add_render_meshes(request, budget).ok());
  const auto predicted = proto::gltf::predicted_bytes(request, {}, budget);
  ASSERT_TRUE(predicted.ok()) << predicted.error().message;
  proto::RefineAnswer<float> refined;
  refined.curves.push_back(*refine<float>(request.curves[0], CurveOptions{.level = 0}, Budget()));
  const auto written = proto::gltf::write(request, std::move(refined), Format::glb, "{}", budget);
  ASSERT_TRUE(written.ok()) << written.error().message;
  EXPECT_GE(*predicted, written->size());
}

TEST(Fresh, numbers_equal_names_without_trying_all_numbers_again) {
  proto::RefineRequest request;
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.face_vertex_indices = {0, 1, 2};
  for (int i = 0; i < 20000; ++i) mesh.primvars.push_back({"a-", Interpolation::vertex, 1, {1, 2, 3}, {}});
  request.meshes.push_back(mesh);
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::minutes(1);
  const auto predicted = proto::gltf::predicted_bytes(request, {RefinedSize{}}, budget);
  EXPECT_TRUE(predicted.ok()) << predicted.error().message;
}

std::string with(const std::string& member, const std::string& value) {
  return R"({"asset":{"version":"2.0"},")" + member + "\":" + value + "}";
}

std::string many(const std::string& one, std::size_t count) {
  std::string list = "[" + one;
  for (std::size_t i = 1; i < count; ++i) list += "," + one;
  return list + "]";
}

ErrorCode code_of(const std::string& body, Count& allowed) {
  const auto request = proto::gltf::read(body, Format::gltf, {}, {});
  if (request) return ErrorCode::internal;
  allowed = request.error().allowed;
  return request.error().code;
}

TEST(Caps, say_what_is_allowed) {
  using namespace proto::gltf;
  Count allowed = 0;
  EXPECT_EQ(code_of(with("meshes", many("{}", kMaxMeshes + 1)), allowed), ErrorCode::too_large);
  EXPECT_EQ(allowed, kMaxMeshes);
  for (const char* array : {"accessors", "bufferViews", "buffers", "nodes", "materials"}) {
    EXPECT_EQ(code_of(with(array, many("{}", kMaxElements + 1)), allowed), ErrorCode::too_large) << array;
    EXPECT_EQ(allowed, kMaxElements);
  }
  EXPECT_EQ(code_of(with(std::string(kMaxNameBytes + 1, 'x'), "0"), allowed), ErrorCode::too_large);
  EXPECT_EQ(allowed, kMaxNameBytes);
}

}  // namespace
}  // namespace subdivd::test
