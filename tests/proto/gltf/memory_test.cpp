// What reading holds at one time is asked for before it is allocated; and when there is none, nobody is
// blamed.

#include <gtest/gtest.h>

#include <cstdint>
#include <new>

#include "proto/gltf/json_tree.h"
#include "tests/proto/gltf/attacks.h"
#include "tests/proto/gltf/pipeline.h"
#include "tests/proto/gltf/unlimited.h"
#include "tests/support/allocations.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

using proto::Format;

class Adding : public MemoryGrant {
 public:
  Result<void> take(Count bytes) override {
    sum_ += bytes;
    return {};
  }
  Count sum() const { return sum_; }

 private:
  Count sum_ = 0;
};

struct Use {
  std::int64_t peak = 0, taken = 0;
  bool read = false;
};

Use use_of(const std::string& body, Format format, const proto::Options& options = {}) {
  Adding grant;
  Budget budget;
  budget.memory = &grant;
  Use use;
  const Allocations allocations;
  use.read = proto::gltf::read(body, format, options, {}, budget).ok();
  use.peak = allocations.peak_bytes();
  use.taken = static_cast<std::int64_t>(grant.sum());
  return use;
}

// A grid of `side` by `side` quads with seams, as exporters write it.
GltfBuilder grid(unsigned side, int attributes, int mode = 4) {
  GltfBuilder builder;
  std::vector<float> points, coordinates;
  for (unsigned y = 0; y <= side; ++y)
    for (unsigned x = 0; x <= side; ++x) {
      points.insert(points.end(),
                    {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y % 7)});
      coordinates.insert(coordinates.end(), {static_cast<float>(x), static_cast<float>(y)});
    }
  std::vector<std::uint32_t> corners;
  for (unsigned y = 0; y < side; ++y)
    for (unsigned x = 0; x < side; ++x) {
      const unsigned a = y * (side + 1) + x, b = a + side + 1;
      corners.insert(corners.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  OrderedJson names = {{"POSITION", builder.values(points, 3)}, {"NORMAL", builder.values(points, 3)}};
  for (int i = 0; i < attributes; ++i) names["_A" + std::to_string(i)] = builder.values(coordinates, 2);
  builder.mesh(names, builder.values(corners, 1), mode);
  return builder;
}

std::string interleaved(unsigned vertices) {
  GltfBuilder builder;
  std::vector<float> values;
  for (unsigned i = 0; i < vertices * 5; ++i) values.push_back(static_cast<float>(i % 1013));
  const int view = builder.view(values, 20);
  const int points = builder.accessor(view, 5126, vertices, "VEC3"),
            coordinates = builder.accessor(view, 5126, vertices, "VEC2");
  builder.document()["accessors"][1]["byteOffset"] = 12;
  builder.mesh({{"POSITION", points}, {"TEXCOORD_0", coordinates}});
  return builder.glb();
}

std::string sparse(unsigned vertices) {
  GltfBuilder builder;
  std::vector<std::uint32_t> places;
  for (unsigned i = 0; i < vertices; i += 2) places.push_back(i);
  const int at = builder.view(places), with = builder.view(std::vector<float>(places.size() * 3, 2.0f));
  const int points = builder.accessor(-1, 5126, vertices, "VEC3");
  builder.document()["accessors"][0]["sparse"] = {{"count", places.size()},
                                                  {"indices", {{"bufferView", at}, {"componentType", 5125}}},
                                                  {"values", {{"bufferView", with}}}};
  builder.mesh({{"POSITION", points}});
  return builder.glb();
}

std::string without_data(unsigned vertices) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.accessor(-1, 5126, vertices, "VEC3")}});
  return builder.glb();
}

struct Body {
  const char* name;
  std::string bytes;
  Format format = Format::glb;
  proto::Weld weld = proto::Weld::exact;
};

std::vector<Body> ordinary() {
  return {{"small", seamed_octahedron().glb()},
          {"plain", grid(300, 1).glb()},
          {"plain and larger", grid(1000, 1).glb()},
          {"many attributes", grid(200, 20).glb()},
          {"interleaved", interleaved(90000)},
          {"base64", grid(300, 1).gltf(), Format::gltf},
          {"strip", grid(200, 1, 5).glb()},
          {"not welded", grid(300, 1).glb(), Format::glb, proto::Weld::none},
          {"lines", grid(200, 1, 1).glb()},
          {"line strip", grid(200, 1, 3).glb()}};
}

TEST(Memory, of_ordinary_assets_is_asked_for_and_no_more_than_three_times) {
  for (const Body& body : ordinary()) {
    proto::Options options;
    options.weld = body.weld;
    const Use use = use_of(body.bytes, body.format, options);
    ASSERT_TRUE(use.read) << body.name;
    EXPECT_LE(use.peak, use.taken + 65536) << body.name;
    if (body.bytes.size() > 1000000) {
      EXPECT_LE(use.taken, 3 * use.peak) << body.name;
    }
  }
}

TEST(Memory, of_strange_assets_is_asked_for) {
  std::vector<Body> bodies = {{"sparse", sparse(90000)}, {"without data", without_data(300000)}};
  for (const Attack& attack : attacks()) bodies.push_back({attack.name, attack.body(2000), attack.format});
  for (const Body& body : bodies) {
    const Use use = use_of(body.bytes, body.format);
    EXPECT_LE(use.peak, use.taken + 65536) << body.name;
  }
}

// Reads it again and again, each time with a little more memory, until it is enough; returns how often.
int readings_until_enough(const Body& body, std::int64_t step) {
  for (int i = 0;; ++i) {
    try {
      const auto request = [&] {
        const Allocations allocations({.beyond = i * step});
        return proto::gltf::read(body.bytes, body.format, {}, {});
      }();
      EXPECT_TRUE(request.ok()) << request.error().message;
      return i;
    } catch (const std::bad_alloc&) {
    }
  }
}

// `ulimit -v` made "no JSON" of a valid body. tinygltf makes a fault of the file of it, or ends the program.
TEST(Memory, that_runs_out_is_no_fault_of_the_body) {
  GltfBuilder lines = seamed_octahedron();
  lines.primitive({{"POSITION", 0}}, -1, 3);
  for (const Body& body : {Body{"glb", lines.glb()}, Body{"gltf", lines.gltf(), Format::gltf}})
    EXPECT_GT(readings_until_enough(body, 32), 1000);
  EXPECT_GT(readings_until_enough({"sparse", sparse(42)}, 8), 1000);
  EXPECT_GT(readings_until_enough({"attack", attacks()[10].body(300)}, 4096), 100);
}

TEST(Memory, that_runs_out_at_any_place_is_no_fault_of_the_text) {
  const std::string text = R"({"a":[1,2.5,{"b":"a string that is longer than fifteen"}],"c":")" +
                           std::string(10000, 's') + R"(","d":{"e":null,"f":true}})";
  std::int64_t failures = 0;
  for (;; ++failures) {
    try {
      const auto parsed = [&] {
        Unlimited unlimited;
        const Allocations allocations({.at = failures});
        return proto::gltf::parse_json(text, {}, unlimited.work);
      }();
      ASSERT_TRUE(parsed.ok()) << parsed.error().message;
      break;
    } catch (const std::bad_alloc&) {
    }
  }
  EXPECT_GT(failures, 20);
}

}  // namespace
}  // namespace subdivd::test
