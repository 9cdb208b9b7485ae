#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "proto/decode.h"
#include "server/tasks/refine_task.h"
#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/payload_text.h"

namespace subdivd::test {
namespace {

using proto::Format;
using proto::Options;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

template <class T>
std::vector<T> read_accessor(const ParsedGlb& glb, const OrderedJson& reference, std::size_t width) {
  const OrderedJson& accessor = glb.json["accessors"][reference.get<std::size_t>()];
  const OrderedJson& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::vector<T> values(accessor["count"].get<std::size_t>() * width);
  std::memcpy(values.data(), glb.bin.data() + view.value("byteOffset", std::size_t{0}),
              values.size() * sizeof(T));
  return values;
}

const OrderedJson& primitive_of(const ParsedGlb& glb, std::size_t primitive = 0, std::size_t mesh = 0) {
  return glb.json["meshes"][mesh]["primitives"][primitive];
}

Options at_level(Index level) {
  Options options;
  options.level = level;
  return options;
}

ParsedGlb refined(const GltfBuilder& builder, const Options& options = {}) {
  return parse_glb(must_refine(builder.glb(), options).bytes);
}

TEST(WriteTriangles, returns_the_mesh_itself_at_level_0) {
  const ParsedGlb glb = refined(seamed_octahedron(), at_level(0));
  EXPECT_THAT(read_accessor<float>(glb, primitive_of(glb)["attributes"]["POSITION"], 3),
              ElementsAre(1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1));
  EXPECT_THAT(read_accessor<std::uint16_t>(glb, primitive_of(glb)["indices"], 1),
              ElementsAre(0, 1, 5, 1, 2, 5, 2, 3, 5, 3, 4, 5));
}

TEST(WriteTriangles, quadruples_triangles_at_every_level) {
  for (const Index level : {1u, 2u, 3u}) {
    const ParsedGlb glb = refined(seamed_octahedron(), at_level(level));
    EXPECT_EQ(glb.json["accessors"][primitive_of(glb)["indices"].get<std::size_t>()]["count"],
              12u << (2 * level));
  }
}

// Of a GLB the many indices of a large mesh are made while it is sent; in glTF they stand in the text.
TEST(WriteTriangles, makes_many_indices_late_and_the_same) {
  Options options = at_level(8);
  options.format = Format::glb;
  proto::RefineRequest request = must_read(seamed_octahedron().glb(), options);
  server::tasks::Phases phases;
  const auto payload = server::tasks::refine(request, {}, {}, phases);
  ASSERT_TRUE(payload.ok());
  std::size_t made = 0;
  for (const proto::Chunk& chunk : payload->chunks)
    if (chunk.maker != nullptr) {
      ++made;
      EXPECT_LT(chunk.maker->held_bytes(), chunk.size() / 4);
    }
  EXPECT_EQ(made, 2u);  // one for each primitive
  const std::string bytes = text_of(*payload);
  EXPECT_EQ(bytes.size(), payload->size());
  const ParsedGlb glb = parse_glb(bytes);

  options.format = Format::gltf;
  const auto embedded = OrderedJson::parse(must_refine(seamed_octahedron().glb(), options).bytes);
  const auto uri = embedded["buffers"][0]["uri"].get<std::string>();
  EXPECT_TRUE(uri.ends_with(base64(glb.bin)));
  EXPECT_EQ(embedded["accessors"], glb.json["accessors"]);
  EXPECT_EQ(embedded["bufferViews"], glb.json["bufferViews"]);
}

// What a stream keeps of the base mesh is more than a level 0 or 1 of it has indices.
TEST(WriteTriangles, makes_no_indices_late_where_that_takes_more_memory) {
  constexpr std::uint32_t kWide = 260;  // more vertices than 16 bits hold
  std::vector<float> points;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t j = 0; j <= kWide; ++j)
    for (std::uint32_t i = 0; i <= kWide; ++i)
      points.insert(points.end(), {static_cast<float>(i), static_cast<float>(j), 0});
  for (std::uint32_t j = 0; j < kWide; ++j)
    for (std::uint32_t i = 0; i < kWide; ++i) {
      const std::uint32_t a = j * (kWide + 1) + i, d = a + kWide + 1;
      corners.insert(corners.end(), {a, a + 1, d + 1, a, d + 1, d});
    }
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(points, 3)}}, builder.values(corners, 1));
  for (const Index level : {0u, 1u, 2u}) {
    Options options = at_level(level);
    options.format = Format::glb;
    server::tasks::Phases phases;
    const auto payload = server::tasks::refine(must_read(builder.glb(), options), {}, {}, phases);
    ASSERT_TRUE(payload.ok());
    std::size_t made = 0;
    for (const proto::Chunk& chunk : payload->chunks) made += chunk.maker != nullptr;
    EXPECT_EQ(made, level < 2 ? 0u : 1u) << level;
  }
}

TEST(WriteTriangles, gives_both_sides_of_a_seam_the_same_positions) {
  const ParsedGlb glb = refined(seamed_octahedron(), at_level(2));
  // Every vertex on the equator of one half is one of the other half, to the bit.
  std::vector<std::array<float, 3>> equators[2];
  for (std::size_t half = 0; half < 2; ++half) {
    const auto points = read_accessor<float>(glb, primitive_of(glb, half)["attributes"]["POSITION"], 3);
    for (std::size_t i = 0; i < points.size(); i += 3)
      if (points[i + 2] == 0) equators[half].push_back({points[i], points[i + 1], points[i + 2]});
    std::sort(equators[half].begin(), equators[half].end());
  }
  EXPECT_THAT(equators[0], SizeIs(17));
  EXPECT_EQ(equators[0], equators[1]);
}

TEST(WriteTriangles, states_exact_bounds) {
  const ParsedGlb glb = refined(seamed_octahedron(), at_level(2));
  const auto& position = primitive_of(glb)["attributes"]["POSITION"];
  const OrderedJson& accessor = glb.json["accessors"][position.get<std::size_t>()];
  const auto points = read_accessor<float>(glb, position, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    float low = points[k], high = points[k];
    for (std::size_t i = k; i < points.size(); i += 3)
      low = std::min(low, points[i]), high = std::max(high, points[i]);
    EXPECT_EQ(accessor["min"][k].get<double>(), double{low});
    EXPECT_EQ(accessor["max"][k].get<double>(), double{high});
  }
}

TEST(WriteTriangles, writes_unit_normals_that_point_outwards) {
  const ParsedGlb glb = refined(seamed_octahedron(), at_level(2));
  const auto points = read_accessor<float>(glb, primitive_of(glb)["attributes"]["POSITION"], 3);
  const auto normals = read_accessor<float>(glb, primitive_of(glb)["attributes"]["NORMAL"], 3);
  ASSERT_EQ(points.size(), normals.size());
  for (std::size_t i = 0; i < points.size(); i += 3) {
    EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1, 1e-6);
    EXPECT_GT(points[i] * normals[i] + points[i + 1] * normals[i + 1] + points[i + 2] * normals[i + 2], 0);
  }
}

TEST(WriteTriangles, writes_normals_where_there_were_none_when_asked) {
  GltfBuilder builder = seamed_octahedron();
  for (OrderedJson& primitive : builder.document()["meshes"][0]["primitives"])
    primitive["attributes"].erase("NORMAL");
  EXPECT_FALSE(primitive_of(refined(builder))["attributes"].contains("NORMAL"));
  Options options;
  options.normals = true;
  EXPECT_TRUE(primitive_of(refined(builder, options))["attributes"].contains("NORMAL"));
}

TEST(WriteTriangles, writes_limit_points_when_asked) {
  Options options = at_level(1);
  options.limit = true;
  const ParsedGlb glb = refined(seamed_octahedron(), options);
  const auto points = read_accessor<float>(glb, primitive_of(glb)["attributes"]["POSITION"], 3);
  // Loop's limit of a vertex of valence 4 whose ring is symmetric about it: (1 - 4e) p with
  // e = 1 / (4 + 3 / (8 beta)), beta(4) = (5/8 - (3/8)^2) / 4 = 31/256; here 16/31 of the way along the axis.
  const double beta = 31.0 / 256, e = 1 / (4 + 3 / (8 * beta));
  EXPECT_NEAR(points[0], 1 - 4 * e, 1e-6);
}

TEST(WriteTriangles, uses_wide_indices_only_when_needed) {
  const ParsedGlb small = refined(seamed_octahedron(), at_level(6));  // 4 * 2145 vertices at most
  const ParsedGlb large = refined(seamed_octahedron(), at_level(8));
  const auto component = [](const ParsedGlb& glb) {
    return glb.json["accessors"][primitive_of(glb)["indices"].get<std::size_t>()]["componentType"].get<int>();
  };
  EXPECT_EQ(component(small), 5123);
  EXPECT_EQ(component(large), 5125);
}

TEST(WriteTriangles, leaves_attributes_out_of_primitives_that_lacked_them) {
  GltfBuilder builder = seamed_octahedron();
  builder.document()["meshes"][0]["primitives"][1]["attributes"].erase("TEXCOORD_0");
  const ParsedGlb glb = refined(builder);
  EXPECT_TRUE(primitive_of(glb, 0)["attributes"].contains("TEXCOORD_0"));
  EXPECT_FALSE(primitive_of(glb, 1)["attributes"].contains("TEXCOORD_0"));
}

TEST(WriteTriangles, keeps_colours_within_0_and_1) {
  GltfBuilder builder = seamed_octahedron();
  const int colors = builder.values<float>({0, 1, 2, 1, 0, 0, -1, 0, 0, 1, 1, 1, 0, 1, 2, 1, 1, 1}, 3);
  builder.document()["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  const ParsedGlb glb = refined(builder);
  for (const float value : read_accessor<float>(glb, primitive_of(glb)["attributes"]["COLOR_0"], 3)) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

TEST(WriteTriangles, puts_something_valid_where_no_triangle_is_left) {
  GltfBuilder builder = seamed_octahedron();
  // All vertices of the second primitive are one point after welding.
  builder.document()["meshes"][0]["primitives"][1]["attributes"] = {
      {"POSITION", builder.values(std::vector<float>(18, 1.0f), 3)},
      {"TEXCOORD_0", builder.values(std::vector<float>(12, 1.0f), 2)}};
  const ParsedGlb glb = refined(builder);
  EXPECT_EQ(glb.json["accessors"][primitive_of(glb, 1)["indices"].get<std::size_t>()]["count"], 3);
}

TEST(WriteCurves, doubles_segments_of_strips_and_loops) {
  GltfBuilder builder;
  const int positions = builder.values<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
  builder.mesh({{"POSITION", positions}}, -1, 3);
  builder.mesh({{"POSITION", positions}}, -1, 2);
  builder.mesh({{"POSITION", positions}}, builder.values<std::uint8_t>({0, 1, 1, 2}, 1), 1);
  const ParsedGlb glb = refined(builder, at_level(1));
  const auto count = [&](std::size_t mesh, const char* what) {
    const OrderedJson& primitive = primitive_of(glb, 0, mesh);
    const OrderedJson& reference =
        std::string(what) == "indices" ? primitive["indices"] : primitive["attributes"][what];
    return glb.json["accessors"][reference.get<std::size_t>()]["count"].get<int>();
  };
  EXPECT_EQ(count(0, "POSITION"), 7);
  EXPECT_EQ(count(1, "POSITION"), 8);
  EXPECT_EQ(count(2, "POSITION"), 5);
  EXPECT_EQ(count(2, "indices"), 8);
  EXPECT_EQ(primitive_of(glb, 0, 0)["mode"], 3);
  EXPECT_EQ(primitive_of(glb, 0, 1)["mode"], 2);
  EXPECT_EQ(primitive_of(glb, 0, 2)["mode"], 1);
}

// An asset with one of everything that must survive.
GltfBuilder rich_asset() {
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& document = builder.document();
  document["asset"]["generator"] = "a generator";
  document["asset"]["extras"] = {{"kept", 1}};
  document["materials"] = {{{"name", "red"},
                            {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 0.1}}}},
                            {"extensions", {{"KHR_materials_unlit", OrderedJson::object()}}},
                            {"extras", {{"big", 12345678901234567}, {"empty", OrderedJson::object()}}}}};
  document["extensionsUsed"] = {"KHR_materials_unlit"};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["nodes"][0]["name"] = "root";
  document["nodes"][0]["translation"] = {1, 2, 3};
  const int times = builder.values<float>({0, 1}, 1);
  const int moves = builder.values<float>({0, 0, 0, 1, 1, 1}, 3);
  document["accessors"][static_cast<std::size_t>(times)]["min"] = {0};
  document["accessors"][static_cast<std::size_t>(times)]["max"] = {1};
  document["animations"] = {
      {{"samplers", {{{"input", times}, {"output", moves}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  const std::string png = "\x89PNG\r\n\x1a\n not really";
  document["images"] = {
      {{"bufferView", builder.view(std::vector<char>(png.begin(), png.end()))}, {"mimeType", "image/png"}},
      {{"uri", "elsewhere.png"}}};
  return builder;
}

TEST(Patch, keeps_materials_nodes_animations_and_extras) {
  const GltfBuilder builder = rich_asset();
  const ParsedGlb before = parse_glb(builder.glb()), after = refined(builder);
  for (const char* name : {"materials", "nodes", "scenes", "scene", "extensionsUsed"})
    EXPECT_EQ(after.json[name].dump(), before.json[name].dump()) << name;
  EXPECT_EQ(after.json["asset"]["generator"], "a generator");
  EXPECT_EQ(after.json["asset"]["extras"]["kept"], 1);
  EXPECT_EQ(after.json["meshes"][0]["primitives"][0]["material"], 0);
  EXPECT_EQ(after.json["images"][1].dump(), before.json["images"][1].dump());
}

TEST(Patch, keeps_the_data_of_animations_and_images) {
  const ParsedGlb glb = refined(rich_asset());
  const OrderedJson& sampler = glb.json["animations"][0]["samplers"][0];
  EXPECT_THAT(read_accessor<float>(glb, sampler["input"], 1), ElementsAre(0, 1));
  EXPECT_THAT(read_accessor<float>(glb, sampler["output"], 3), ElementsAre(0, 0, 0, 1, 1, 1));
  const OrderedJson& view = glb.json["bufferViews"][glb.json["images"][0]["bufferView"].get<std::size_t>()];
  EXPECT_EQ(glb.bin.substr(view["byteOffset"].get<std::size_t>() + 1, 3), "PNG");
}

TEST(Patch, removes_what_it_replaced) {
  const ParsedGlb glb = refined(rich_asset());
  // 2 of the animation, 4 of each primitive; views likewise and one of the image.
  EXPECT_THAT(glb.json["accessors"], SizeIs(10));
  EXPECT_THAT(glb.json["bufferViews"], SizeIs(11));
  EXPECT_THAT(glb.json["buffers"], SizeIs(1));
}

TEST(Patch, removes_nothing_beside_an_unknown_extension) {
  GltfBuilder builder = rich_asset();
  builder.document()["extensionsUsed"].push_back("EXT_unheard_of");
  builder.document()["nodes"][0]["extensions"]["EXT_unheard_of"]["accessor"] = 1;
  const ParsedGlb before = parse_glb(builder.glb()), after = refined(builder);
  for (std::size_t i = 0; i < before.json["accessors"].size(); ++i)
    EXPECT_EQ(after.json["accessors"][i].dump(), before.json["accessors"][i].dump()) << i;
  EXPECT_EQ(after.bin.substr(0, before.bin.size()), before.bin);
  EXPECT_EQ(after.json["buffers"][0]["byteLength"], after.bin.size());
}

TEST(Patch, keeps_overlapping_views_overlapping) {
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& document = builder.document();
  const int view = builder.view(std::vector<float>(1000));
  for (int i = 0; i < 100; ++i) {
    OrderedJson copy = document["bufferViews"][static_cast<std::size_t>(view)];
    copy["byteOffset"] = copy["byteOffset"].get<int>() + 4 * i;
    copy["byteLength"] = 4000 - 4 * i;
    document["bufferViews"].push_back(copy);
    document["images"].push_back(
        {{"bufferView", document["bufferViews"].size() - 1}, {"mimeType", "image/png"}});
  }
  const ParsedGlb small = refined(seamed_octahedron(), at_level(0)), glb = refined(builder, at_level(0));
  EXPECT_EQ(glb.bin.size(), small.bin.size() + 4000);
}

TEST(Patch, takes_morph_targets_and_all_that_hangs_on_them_away) {
  GltfBuilder builder = rich_asset();
  OrderedJson& document = builder.document();
  const int offsets = builder.values(std::vector<float>(18), 3);
  for (OrderedJson& primitive : document["meshes"][0]["primitives"])
    primitive["targets"] = {{{"POSITION", offsets}}};
  document["meshes"][0]["weights"] = {0.5};
  document["nodes"][0]["weights"] = {0.5};
  const int weights = builder.values<float>({0, 1}, 1);
  OrderedJson& animation = document["animations"][0];
  const OrderedJson input = animation["samplers"][0]["input"];
  animation["samplers"].insert(animation["samplers"].begin(),
                               OrderedJson{{"input", input}, {"output", weights}});
  animation["channels"][0]["sampler"] = 1;
  animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}});
  document["animations"].push_back(
      {{"samplers", {{{"input", input}, {"output", weights}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  const Outcome outcome = must_refine(builder.glb());
  const ParsedGlb glb = parse_glb(outcome.bytes);
  EXPECT_FALSE(primitive_of(glb).contains("targets"));
  EXPECT_FALSE(glb.json["meshes"][0].contains("weights"));
  EXPECT_FALSE(glb.json["nodes"][0].contains("weights"));
  ASSERT_THAT(glb.json["animations"], SizeIs(1));
  EXPECT_THAT(glb.json["animations"][0]["samplers"], SizeIs(1));
  EXPECT_EQ(glb.json["animations"][0]["channels"][0]["sampler"], 0);
  EXPECT_THAT(outcome.request.warnings, Contains(HasSubstr("Morph targets")));
  EXPECT_THAT(outcome.request.warnings, Contains(HasSubstr("nothing but morph weights")));
}

TEST(Patch, takes_skins_off_nodes) {
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& document = builder.document();
  OrderedJson& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = builder.values(std::vector<std::uint8_t>(24), 4);
  attributes["WEIGHTS_0"] = builder.values(std::vector<float>(24, 0.25f), 4);
  document["nodes"].push_back({{"name", "joint"}});
  document["skins"] = {{{"joints", {1}}}};
  document["nodes"][0]["skin"] = 0;
  const Outcome outcome = must_refine(builder.glb());
  const ParsedGlb glb = parse_glb(outcome.bytes);
  EXPECT_FALSE(glb.json["nodes"][0].contains("skin"));
  EXPECT_FALSE(primitive_of(glb)["attributes"].contains("JOINTS_0"));
  EXPECT_THAT(outcome.request.warnings, Contains(HasSubstr("Skinning")));
}

TEST(Patch, carries_the_envelope_and_extras_that_are_no_object) {
  GltfBuilder builder = seamed_octahedron();
  builder.document()["asset"]["extras"] = "a string";
  const ParsedGlb glb = refined(builder);
  EXPECT_EQ(glb.json["asset"]["extras"]["original"], "a string");
  EXPECT_EQ(glb.json["asset"]["extras"]["subdivd"]["options"]["level"], 2);
}

TEST(Patch, carries_unknown_chunks_of_a_glb) {
  std::string bytes = seamed_octahedron().glb();
  bytes += std::string("\4\0\0\0XYZ1data", 12);
  for (std::size_t i = 0; i < 4; ++i) bytes[8 + i] = static_cast<char>(bytes.size() >> (8 * i));
  const std::string out = must_refine(bytes).bytes;
  EXPECT_EQ(out.substr(out.size() - 12), std::string("\4\0\0\0XYZ1data", 12));
}

TEST(Patch, leaves_point_primitives_as_they_are) {
  GltfBuilder builder = seamed_octahedron();
  const int points = builder.values<float>({1, 2, 3, 4, 5, 6}, 3);
  builder.primitive({{"POSITION", points}}, -1, 0);
  const ParsedGlb glb = refined(builder);
  EXPECT_EQ(primitive_of(glb, 2)["mode"], 0);
  EXPECT_THAT(read_accessor<float>(glb, primitive_of(glb, 2)["attributes"]["POSITION"], 3),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(WriteGltf, embeds_the_same_data_as_glb) {
  Options options;
  options.format = Format::gltf;
  const OrderedJson json = OrderedJson::parse(must_refine(rich_asset().glb(), options).bytes);
  const std::string uri = json["buffers"][0]["uri"];
  const ParsedGlb glb = refined(rich_asset());
  std::string data = glb.bin;
  data.resize(json["buffers"][0]["byteLength"].get<std::size_t>());
  EXPECT_EQ(uri, "data:application/octet-stream;base64," + base64(data));
}

TEST(WriteGltf, reads_back_what_it_wrote) {
  const std::string once = must_refine(rich_asset().glb(), at_level(1)).bytes;
  const ParsedGlb twice = parse_glb(must_refine(once, at_level(1)).bytes),
                  direct = refined(rich_asset(), at_level(2));
  EXPECT_EQ(twice.json["materials"].dump(), direct.json["materials"].dump());
  EXPECT_EQ(twice.json["accessors"].size(), direct.json["accessors"].size());
}

TEST(Prediction, is_exact_for_binary_data) {
  for (const Index level : {0u, 1u, 2u, 3u}) {
    const Outcome outcome = must_refine(rich_asset().glb(), at_level(level));
    const ParsedGlb glb = parse_glb(outcome.bytes);
    EXPECT_GE(outcome.predicted, outcome.bytes.size());
    // What grows from one level to the next is binary data alone, give or take digits of the JSON.
    const Outcome next = must_refine(rich_asset().glb(), at_level(level + 1));
    EXPECT_EQ(next.predicted - outcome.predicted, parse_glb(next.bytes).bin.size() - glb.bin.size()) << level;
  }
}

TEST(Prediction, bounds_embedded_gltf) {
  Options options = at_level(3);
  options.format = Format::gltf;
  const Outcome outcome = must_refine(rich_asset().glb(), options);
  EXPECT_GE(outcome.predicted, outcome.bytes.size());
  EXPECT_LE(outcome.predicted, outcome.bytes.size() + 40000);
}

proto::RefineRequest json_request() {
  proto::RefineRequest request;
  request.options.format = Format::glb;
  ControlMesh mesh;
  mesh.name = "square";
  mesh.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  mesh.face_vertex_indices = {0, 1, 2, 0, 2, 3};
  mesh.primvars = {{"st", Interpolation::face_varying, 2, {0, 0, 1, 0, 1, 1, 0, 1, 5, 5}, {0, 1, 2, 4, 2, 3}},
                   {"displayColor", Interpolation::vertex, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, {}},
                   {"my weight", Interpolation::varying, 1, {1, 2, 3, 4}, {}},
                   {"id", Interpolation::uniform, 1, {1, 2}, {}}};
  request.meshes.push_back(mesh);
  request.curves.push_back(
      {"loop", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 9, 9, 9, 8, 8, 8, 7, 7, 9}, {3, 3}, CurveWrap::periodic});
  return request;
}

TEST(Fresh, makes_a_document_for_a_json_request) {
  proto::RefineRequest request = json_request();
  ASSERT_TRUE(proto::gltf::add_render_meshes(request).ok());
  const auto outcome = answer(std::move(request));
  ASSERT_TRUE(outcome.ok());
  const ParsedGlb glb = parse_glb(outcome->bytes);
  EXPECT_EQ(glb.json["nodes"][0]["name"], "square");
  const OrderedJson& attributes = primitive_of(glb)["attributes"];
  for (const char* name : {"POSITION", "TEXCOORD_0", "COLOR_0", "_MY_WEIGHT"})
    EXPECT_TRUE(attributes.contains(name)) << name;
  EXPECT_EQ(attributes.size(), 4u);
  ASSERT_THAT(glb.json["meshes"][1]["primitives"], SizeIs(2));
  EXPECT_EQ(primitive_of(glb, 1, 1)["mode"], 2);
  EXPECT_THAT(glb.json["asset"]["extras"]["subdivd"]["warnings"], ElementsAre(HasSubstr("\"id\"")));
}

TEST(Fresh, splits_vertices_where_face_varying_values_differ) {
  proto::RefineRequest request = json_request();
  request.options.level = 0;
  ASSERT_TRUE(proto::gltf::add_render_meshes(request).ok());
  const ParsedGlb glb = parse_glb(answer(std::move(request))->bytes);
  EXPECT_EQ(read_accessor<float>(glb, primitive_of(glb)["attributes"]["POSITION"], 3).size(), 3 * 5u);
}

TEST(Fresh, splits_vertices_at_seams_beforehand) {
  proto::RefineRequest prepared = json_request();
  ASSERT_TRUE(proto::gltf::add_render_meshes(prepared).ok());
  ASSERT_FALSE(prepared.meshes[0].render_meshes.empty());
  const Outcome outcome = *answer(std::move(prepared));
  EXPECT_GE(outcome.predicted, outcome.bytes.size());
}

TEST(Fresh, a_json_request_for_a_glb_is_given_render_meshes) {
  const std::string body =
      R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"options":{"format":"glb"},)"
      R"("primvars":{"st":{"interpolation":"faceVarying","elementSize":2,"values":[0,0,1,0,0,1]}}})";
  const auto request = proto::decode_refine(body, proto::BodyKind::json, {}, {});
  ASSERT_TRUE(request.ok()) << request.error().message;
  EXPECT_EQ(request->meshes[0].render_meshes.size(), 1u);
}

TEST(Fresh, refuses_what_single_precision_cannot_hold) {
  proto::RefineRequest request = json_request();
  request.curves.clear();
  request.meshes[0].points[0] = 1e300;
  proto::RefineAnswer<double> refined;
  refined.meshes.push_back(*refine<double>(request.meshes[0], {.level = 1}, Budget()));
  const auto payload = proto::gltf::write(request, std::move(refined), Format::glb, "{}");
  ASSERT_FALSE(payload.ok());
  EXPECT_EQ(payload.error().code, ErrorCode::not_finite);
}

}  // namespace
}  // namespace subdivd::test
