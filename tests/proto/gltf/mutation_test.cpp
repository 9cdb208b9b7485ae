// Broken assets never crash, whatever is broken: believed under AddressSanitizer.

#include <gtest/gtest.h>

#include <random>

#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

constexpr unsigned kSeed = 20240117;
constexpr int kMutations = 100000;

std::vector<std::string> seeds() {
  GltfBuilder rich = seamed_octahedron();
  OrderedJson& document = rich.document();
  const int at = rich.view<std::uint16_t>({1, 4}), with = rich.view<float>({1, 2, 3, 4, 5, 6});
  document["accessors"][0]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", with}}}};
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      rich.values(std::vector<std::uint8_t>(24, 100), 4, true);
  rich.primitive({{"POSITION", 0}}, -1, 3);
  rich.primitive({{"POSITION", 0}}, rich.values<std::uint8_t>({0, 1, 2, 0, 2, 3, 1, 4, 5}, 1));
  document["meshes"].back()["primitives"].back()["extensions"]["FB_ngon_encoding"] = OrderedJson::object();
  document["nodes"].push_back({{"children", {0}}});
  document["animations"] = {
      {{"samplers", {{{"input", 2}, {"output", 1}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  return {rich.glb(), rich.gltf(), seamed_octahedron().glb()};
}

enum class Fate { answered, refused, blamed_on_us };

// Whatever comes back, an answer or a refusal, is right here: the point is that it comes.
Fate fate_of(const std::string& bytes, proto::Format format) {
  proto::Options options;
  options.level = 1;
  proto::Limits limits;
  limits.max_output_bytes = 1 << 24;
  const std::vector<char> exact(bytes.begin(), bytes.end());  // AddressSanitizer sees a read one past the end
  const auto outcome = refine_gltf({exact.data(), exact.size()}, format, options, limits);
  if (outcome) return Fate::answered;
  return outcome.error().code == ErrorCode::internal ? Fate::blamed_on_us : Fate::refused;
}

TEST(Hostile, every_truncation_of_a_glb_is_refused) {
  const std::string whole = seeds()[0];
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<char> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_FALSE(proto::gltf::read({cut.data(), cut.size()}, proto::Format::glb, {}, {}).ok()) << size;
  }
}

TEST(Hostile, every_truncation_of_a_gltf_is_refused) {
  const std::string whole = seeds()[1];
  for (std::size_t size = 0; size < whole.size(); ++size)
    ASSERT_FALSE(proto::gltf::read(whole.substr(0, size), proto::Format::gltf, {}, {}).ok()) << size;
}

TEST(Hostile, mutated_bytes_are_answered) {
  std::mt19937 random(kSeed);
  const auto assets = seeds();
  int answered = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::size_t which = random() % assets.size();
    std::string bytes = assets[which];
    for (unsigned changes = 1 + static_cast<unsigned>(random() % 4); changes > 0; --changes) {
      // Half of the changes hit the JSON, which is the smaller part.
      const std::size_t range = random() % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 2000);
      bytes[random() % range] = static_cast<char>(random() % 3 == 0 ? '0' + random() % 10 : random());
    }
    const Fate fate = fate_of(bytes, which == 1 ? proto::Format::gltf : proto::Format::glb);
    answered += fate == Fate::answered;
    ASSERT_NE(fate, Fate::blamed_on_us) << "seed " << kSeed << ", mutation " << i;
  }
  // Mutations that are all refused at the door would test the door alone.
  EXPECT_GT(answered, kMutations / 20);
}

void collect(OrderedJson& json, std::vector<OrderedJson*>& all) {
  all.push_back(&json);
  if (json.is_structured())
    for (OrderedJson& child : json) collect(child, all);
}

TEST(Hostile, mutated_documents_are_answered) {
  std::mt19937 random(kSeed);
  const auto assets = seeds();
  const OrderedJson values = OrderedJson::parse(
      R"([-1, 0, 1, 2, 3, 4, 255, 256, 65535, 4294967295, 9007199254740992, 0.5, 1e300, true, "x", "",
          "data:,", null, [], {}, "MAT3", "VEC2", "SCALAR", 5120, 5121, 5125, 5126])");
  int answered = 0;
  for (int i = 0; i < kMutations; ++i) {
    ParsedGlb asset = parse_glb(assets[random() % 2 == 0 ? 0 : 2]);
    for (unsigned changes = 1 + static_cast<unsigned>(random() % 3); changes > 0; --changes) {
      std::vector<OrderedJson*> all;
      collect(asset.json, all);
      OrderedJson& victim = *all[random() % all.size()];
      // Another part of the same document is a likelier way in than a random value.
      OrderedJson replacement =
          random() % 4 == 0 ? *all[random() % all.size()] : values[random() % values.size()];
      victim = std::move(replacement);
    }
    const Fate fate = fate_of(make_glb(asset.json.dump(), asset.bin), proto::Format::glb);
    answered += fate == Fate::answered;
    ASSERT_NE(fate, Fate::blamed_on_us)
        << "seed " << kSeed << ", mutation " << i << ": " << asset.json.dump();
  }
  EXPECT_GT(answered, kMutations / 20);
}

}  // namespace
}  // namespace subdivd::test
