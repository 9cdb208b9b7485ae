// Every kind of invalid asset, with the code and the place of its refusal.

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

using proto::RefineRequest;

using Change = std::function<void(OrderedJson&)>;

struct Refusal {
  const char* name;
  Change change;
  ErrorCode code;
  const char* pointer;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

constexpr double k2To53 = 9007199254740992.0;

// Accessors of the octahedron: 0 positions, 1 normals, 2 texture coordinates, 3 indices, then the same again.
// Views carry the same numbers.
const Refusal kRefusals[] = {
    {"no_asset", [](OrderedJson& d) { d.erase("asset"); }, ErrorCode::missing_field, ""},
    {"no_version", [](OrderedJson& d) { d["asset"] = OrderedJson::object(); }, ErrorCode::missing_field,
     "/asset"},
    {"version_1", [](OrderedJson& d) { d["asset"]["version"] = "1.0"; }, ErrorCode::unsupported,
     "/asset/version"},
    {"version_is_a_number", [](OrderedJson& d) { d["asset"]["version"] = 2; }, ErrorCode::wrong_type,
     "/asset/version"},
    {"min_version_2_1", [](OrderedJson& d) { d["asset"]["minVersion"] = "2.1"; }, ErrorCode::unsupported,
     "/asset/minVersion"},
    {"unknown_required_extension",
     [](OrderedJson& d) {
       d["extensionsRequired"] = {"KHR_texture_transform", "EXT_x"};
     },
     ErrorCode::unsupported, "/extensionsRequired/1"},
    {"required_draco", [](OrderedJson& d) { d["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     ErrorCode::unsupported, "/extensionsRequired/0"},
    {"meshes_is_an_object", [](OrderedJson& d) { d["meshes"] = OrderedJson::object(); },
     ErrorCode::wrong_type, "/meshes"},
    {"no_meshes",
     [](OrderedJson& d) { d.erase("meshes"), d.erase("nodes"), d.erase("scenes"), d.erase("scene"); },
     ErrorCode::missing_field, ""},
    {"empty_array", [](OrderedJson& d) { d["skins"] = OrderedJson::array(); }, ErrorCode::wrong_length,
     "/skins"},
    {"element_is_no_object", [](OrderedJson& d) { d["materials"] = {7}; }, ErrorCode::wrong_type,
     "/materials/0"},

    {"buffer_in_a_file",
     [](OrderedJson& d) {
       d["buffers"] = {{{"byteLength", 8}, {"uri", "../secret.bin"}}};
     },
     ErrorCode::unsupported, "/buffers/0/uri"},
    {"buffer_of_no_base64",
     [](OrderedJson& d) {
       d["buffers"] = {{{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,YQ="}}};
     },
     ErrorCode::malformed, "/buffers/0/uri"},
    {"buffer_of_percent_encoding",
     [](OrderedJson& d) {
       d["buffers"] = {{{"byteLength", 1}, {"uri", "data:application/octet-stream,a"}}};
     },
     ErrorCode::malformed, "/buffers/0/uri"},
    {"buffer_longer_than_bin",
     [](OrderedJson& d) {
       d["buffers"] = {{{"byteLength", 100000}}};
     },
     ErrorCode::out_of_range, "/buffers/0/byteLength"},
    {"buffer_of_length_0",
     [](OrderedJson& d) {
       d["buffers"] = {{{"byteLength", 0}}};
     },
     ErrorCode::out_of_range, "/buffers/0/byteLength"},
    {"second_buffer_without_uri",
     [](OrderedJson& d) {
       d["buffers"] = {{{"byteLength", 8}}, {{"byteLength", 8}}};
     },
     ErrorCode::missing_field, "/buffers/1"},

    {"view_of_no_buffer", [](OrderedJson& d) { d["bufferViews"][0]["buffer"] = 1; }, ErrorCode::out_of_range,
     "/bufferViews/0/buffer"},
    {"view_past_its_buffer", [](OrderedJson& d) { d["bufferViews"][0]["byteLength"] = 1000000; },
     ErrorCode::out_of_range, "/bufferViews/0"},
    {"view_of_length_0", [](OrderedJson& d) { d["bufferViews"][0]["byteLength"] = 0; },
     ErrorCode::out_of_range, "/bufferViews/0/byteLength"},
    {"view_of_negative_offset", [](OrderedJson& d) { d["bufferViews"][0]["byteOffset"] = -4; },
     ErrorCode::out_of_range, "/bufferViews/0/byteOffset"},
    {"view_of_stride_6", [](OrderedJson& d) { d["bufferViews"][0]["byteStride"] = 6; },
     ErrorCode::out_of_range, "/bufferViews/0/byteStride"},
    {"view_of_stride_256", [](OrderedJson& d) { d["bufferViews"][0]["byteStride"] = 256; },
     ErrorCode::out_of_range, "/bufferViews/0/byteStride"},
    {"view_offset_is_fractional", [](OrderedJson& d) { d["bufferViews"][0]["byteOffset"] = 0.5; },
     ErrorCode::wrong_type, "/bufferViews/0/byteOffset"},
    {"view_compressed",
     [](OrderedJson& d) { d["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["buffer"] = 0; },
     ErrorCode::unsupported, "/bufferViews/0"},

    {"accessor_of_no_view", [](OrderedJson& d) { d["accessors"][0]["bufferView"] = 99; },
     ErrorCode::out_of_range, "/accessors/0/bufferView"},
    {"accessor_of_component_5124", [](OrderedJson& d) { d["accessors"][0]["componentType"] = 5124; },
     ErrorCode::bad_enum, "/accessors/0/componentType"},
    {"accessor_of_type_vec5", [](OrderedJson& d) { d["accessors"][0]["type"] = "VEC5"; }, ErrorCode::bad_enum,
     "/accessors/0/type"},
    {"accessor_without_type", [](OrderedJson& d) { d["accessors"][0].erase("type"); },
     ErrorCode::missing_field, "/accessors/0"},
    {"accessor_without_count", [](OrderedJson& d) { d["accessors"][0].erase("count"); },
     ErrorCode::missing_field, "/accessors/0"},
    {"accessor_of_count_0", [](OrderedJson& d) { d["accessors"][0]["count"] = 0; }, ErrorCode::out_of_range,
     "/accessors/0/count"},
    {"accessor_of_count_2_to_53", [](OrderedJson& d) { d["accessors"][0]["count"] = k2To53; },
     ErrorCode::out_of_range, "/accessors/0/count"},
    {"accessor_whose_bytes_wrap_32_bits", [](OrderedJson& d) { d["accessors"][0]["count"] = 357913942; },
     ErrorCode::out_of_range, "/accessors/0"},
    {"accessor_one_element_too_long", [](OrderedJson& d) { d["accessors"][0]["count"] = 7; },
     ErrorCode::out_of_range, "/accessors/0"},
    {"accessor_past_its_view", [](OrderedJson& d) { d["accessors"][0]["byteOffset"] = 4; },
     ErrorCode::out_of_range, "/accessors/0"},
    {"accessor_unaligned",
     [](OrderedJson& d) { d["accessors"][3]["byteOffset"] = 1, d["accessors"][3]["count"] = 6; },
     ErrorCode::out_of_range, "/accessors/3/byteOffset"},
    {"accessor_wider_than_its_stride", [](OrderedJson& d) { d["bufferViews"][0]["byteStride"] = 8; },
     ErrorCode::out_of_range, "/accessors/0"},
    {"accessor_of_normalized_floats", [](OrderedJson& d) { d["accessors"][0]["normalized"] = true; },
     ErrorCode::wrong_type, "/accessors/0/normalized"},
    {"accessor_without_data_of_2_to_31_elements",
     [](OrderedJson& d) {
       for (int i : {0, 1, 2})
         d["accessors"][i].erase("bufferView"), d["accessors"][i]["count"] = 2147483648u;
       d["meshes"][0]["primitives"][0].erase("indices");
     },
     ErrorCode::too_large, "/meshes/0/primitives/0/attributes/POSITION"},

    {"sparse_count_over_count",
     [](OrderedJson& d) {
       d["accessors"][0]["sparse"] = {{"count", 7},
                                      {"indices", {{"bufferView", 3}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", 0}}}};
     },
     ErrorCode::out_of_range, "/accessors/0/sparse/count"},
    {"sparse_without_values",
     [](OrderedJson& d) {
       d["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", 3}, {"componentType", 5123}}}};
     },
     ErrorCode::missing_field, "/accessors/0/sparse"},
    {"sparse_indices_that_descend",
     [](OrderedJson& d) {
       d["accessors"][0]["sparse"] = {{"count", 4},
                                      {"indices", {{"bufferView", 3}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", 0}}}};
     },
     ErrorCode::out_of_range, "/accessors/0/sparse/indices"},
    {"sparse_indices_of_floats",
     [](OrderedJson& d) {
       d["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", 3}, {"componentType", 5122}}},
                                      {"values", {{"bufferView", 0}}}};
     },
     ErrorCode::bad_enum, "/accessors/0/sparse/indices/componentType"},
    {"sparse_values_past_their_view",
     [](OrderedJson& d) {
       d["accessors"][0]["sparse"] = {{"count", 2},
                                      {"indices", {{"bufferView", 3}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", 0}, {"byteOffset", 60}}}};
     },
     ErrorCode::out_of_range, "/accessors/0/sparse/values"},

    {"mesh_without_primitives", [](OrderedJson& d) { d["meshes"][0].erase("primitives"); },
     ErrorCode::missing_field, "/meshes/0"},
    {"primitive_without_attributes",
     [](OrderedJson& d) { d["meshes"][0]["primitives"][0].erase("attributes"); }, ErrorCode::missing_field,
     "/meshes/0/primitives/0"},
    {"primitive_without_position",
     [](OrderedJson& d) { d["meshes"][0]["primitives"][1]["attributes"].erase("POSITION"); },
     ErrorCode::missing_field, "/meshes/0/primitives/1/attributes"},
    {"primitive_of_mode_7", [](OrderedJson& d) { d["meshes"][0]["primitives"][0]["mode"] = 7; },
     ErrorCode::out_of_range, "/meshes/0/primitives/0/mode"},
    {"primitive_of_no_material", [](OrderedJson& d) { d["meshes"][0]["primitives"][0]["material"] = 0; },
     ErrorCode::out_of_range, "/meshes/0/primitives/0/material"},
    {"attribute_of_no_accessor",
     [](OrderedJson& d) { d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 8; },
     ErrorCode::out_of_range, "/meshes/0/primitives/0/attributes/NORMAL"},
    {"attribute_is_null",
     [](OrderedJson& d) { d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = nullptr; },
     ErrorCode::wrong_type, "/meshes/0/primitives/0/attributes/NORMAL"},
    {"attributes_of_two_lengths", [](OrderedJson& d) { d["accessors"][1]["count"] = 5; },
     ErrorCode::wrong_length, "/meshes/0/primitives/0/attributes/NORMAL"},
    {"position_of_vec2", [](OrderedJson& d) { d["accessors"][0]["type"] = "VEC2"; }, ErrorCode::wrong_type,
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"position_quantized_without_extension",
     [](OrderedJson& d) { d["accessors"][0]["componentType"] = 5122; }, ErrorCode::wrong_type,
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"indices_of_floats", [](OrderedJson& d) { d["meshes"][0]["primitives"][0]["indices"] = 0; },
     ErrorCode::wrong_type, "/meshes/0/primitives/0/indices"},
    {"indices_with_stride",
     [](OrderedJson& d) { d["bufferViews"][3]["byteStride"] = 4, d["accessors"][3]["count"] = 6; },
     ErrorCode::out_of_range, "/meshes/0/primitives/0/indices"},
    {"indices_without_view", [](OrderedJson& d) { d["accessors"][3].erase("bufferView"); },
     ErrorCode::unsupported, "/meshes/0/primitives/0/indices"},
    {"indices_of_half_a_triangle", [](OrderedJson& d) { d["accessors"][3]["count"] = 11; },
     ErrorCode::wrong_length, "/meshes/0/primitives/0/indices"},
    {"index_out_of_bounds",
     [](OrderedJson& d) {
       d["meshes"][0]["primitives"][0]["indices"] = 8, d["accessors"][8] = d["accessors"][3],
       d["accessors"][8]["componentType"] = 5121, d["accessors"][8]["bufferView"] = 2;
     },
     ErrorCode::out_of_range, "/meshes/0/primitives/0/indices"},
    {"only_points",
     [](OrderedJson& d) {
       for (auto& p : d["meshes"][0]["primitives"]) p["mode"] = 0;
     },
     ErrorCode::unsupported, "/meshes"},

    {"node_of_no_mesh", [](OrderedJson& d) { d["nodes"][0]["mesh"] = 5; }, ErrorCode::out_of_range,
     "/nodes/0/mesh"},
    {"node_that_is_its_own_child", [](OrderedJson& d) { d["nodes"][0]["children"] = {0}; },
     ErrorCode::out_of_range, "/nodes/0"},
    {"nodes_in_a_cycle",
     [](OrderedJson& d) {
       d["nodes"][1]["children"] = {2}, d["nodes"][2]["children"] = {3}, d["nodes"][3]["children"] = {1};
     },
     ErrorCode::out_of_range, "/nodes/1"},
    {"node_of_two_parents",
     [](OrderedJson& d) {
       d["nodes"][1]["children"] = {3}, d["nodes"][2]["children"] = {3}, d["nodes"][3]["name"] = "x";
     },
     ErrorCode::out_of_range, "/nodes/2/children/0"},
    {"scene_of_no_node", [](OrderedJson& d) { d["scenes"][0]["nodes"] = {9}; }, ErrorCode::out_of_range,
     "/scenes/0/nodes/0"},
    {"no_such_scene", [](OrderedJson& d) { d["scene"] = 1; }, ErrorCode::out_of_range, "/scene"},
    {"animation_of_no_accessor",
     [](OrderedJson& d) {
       d["animations"] = {{{"samplers", {{{"input", 99}, {"output", 0}}}}}};
     },
     ErrorCode::out_of_range, "/animations/0/samplers/0/input"},
    {"animation_channel_of_no_sampler",
     [](OrderedJson& d) {
       d["animations"] = {{{"samplers", {{{"input", 0}, {"output", 0}}}},
                           {"channels", {{{"sampler", 1}, {"target", {{"path", "weights"}}}}}}}};
     },
     ErrorCode::out_of_range, "/animations/0/channels/0/sampler"},
    {"skin_of_no_matrices",
     [](OrderedJson& d) {
       d["skins"] = {{{"inverseBindMatrices", 99}, {"joints", {0}}}};
     },
     ErrorCode::out_of_range, "/skins/0/inverseBindMatrices"},
    {"image_of_no_view",
     [](OrderedJson& d) {
       d["images"] = {{{"bufferView", 99}}};
     },
     ErrorCode::out_of_range, "/images/0/bufferView"},
};

class RefusesAsset : public testing::TestWithParam<Refusal> {};

TEST_P(RefusesAsset, with_its_code_and_place) {
  GltfBuilder builder = seamed_octahedron();
  for (int i = 0; i < 2; ++i) builder.document()["nodes"].push_back(OrderedJson::object());
  GetParam().change(builder.document());
  if (builder.document().contains("nodes"))
    for (OrderedJson& node : builder.document()["nodes"])
      if (node.is_null()) node = OrderedJson::object();
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(name_of(request.error().code), name_of(GetParam().code)) << request.error().message;
  EXPECT_EQ(to_pointer(request.error().where), GetParam().pointer) << request.error().message;
  EXPECT_FALSE(request.error().message.empty());
}

INSTANTIATE_TEST_SUITE_P(Assets, RefusesAsset, testing::ValuesIn(kRefusals),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Refuses, an_asset_that_is_valid_but_for_nothing) {
  // The table above changes one thing of this: it must be accepted as it is.
  EXPECT_TRUE(proto::gltf::read(seamed_octahedron().glb(), proto::Format::glb, {}, {}).ok());
}

std::string deep(int levels) {
  GltfBuilder builder = seamed_octahedron();
  std::string json = builder.document().dump();
  std::string nested;
  for (int i = 0; i < levels; ++i) nested += "{\"a\":";
  nested += "0" + std::string(static_cast<std::size_t>(levels), '}');
  return make_glb("{\"extras\":" + nested + "," + json.substr(1), "");
}

TEST(Refuses, extras_of_20000_levels) {
  const auto request = proto::gltf::read(deep(20000), proto::Format::glb, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
}

TEST(Refuses, duplicate_members) {
  const std::string json = R"({"asset":{"version":"2.0","version":"1.0"}})";
  const auto request = proto::gltf::read(json, proto::Format::gltf, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::duplicate_field);
  EXPECT_EQ(to_pointer(request.error().where), "/asset/version");
}

TEST(Refuses, positions_that_are_not_finite) {
  GltfBuilder builder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  builder.mesh({{"POSITION", builder.values<float>({0, 0, 0, 1, nan, 0, 1, 1, 0}, 3)}});
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::not_finite);
  EXPECT_EQ(to_pointer(request.error().where), "/meshes/0/primitives/0/attributes/POSITION");
}

// A triangle whose buffer is this URI; empty: it is accepted.
std::string refusal_of_uri(const std::string& uri) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values<float>({0, 0, 0, 1, 0, 0, 1, 1, 0}, 3)}});
  OrderedJson document = OrderedJson::parse(builder.gltf());
  const std::string given = document["buffers"][0]["uri"];
  document["buffers"][0]["uri"] = uri + given.substr(given.find(',') + 1);
  const auto request = proto::gltf::read(document.dump(), proto::Format::gltf, {}, {});
  return request ? std::string()
                 : std::string(name_of(request.error().code)) + ": " + request.error().message;
}

TEST(DataUri, may_be_written_in_any_case_and_with_parameters) {
  for (const char* uri :
       {"data:application/octet-stream;base64,", "DATA:application/gltf-buffer;base64,", "Data:;BASE64,",
        "data:text/plain;charset=utf-8;Base64,", "data:a/b;x=1;y=base64;base64,"})
    EXPECT_EQ(refusal_of_uri(uri), "") << uri;
}

TEST(DataUri, that_is_no_base64_is_told_what_is_wrong) {
  EXPECT_THAT(refusal_of_uri("data:application/octet-stream,"),
              testing::HasSubstr("malformed: the data URI is not marked as Base64"));
  EXPECT_THAT(refusal_of_uri("data:base64,"), testing::HasSubstr("percent-encoded"));
  EXPECT_THAT(refusal_of_uri("data:;base64"), testing::HasSubstr("no comma"));
  EXPECT_THAT(refusal_of_uri("data:;base64,="), testing::HasSubstr("no strict Base64"));
  EXPECT_THAT(refusal_of_uri("https://example.com/,"), testing::HasSubstr("other files are not read"));
}

TEST(Refuses, without_repeating_long_texts_of_the_asset) {
  const std::string long_name(50000, 'n');
  for (const std::string& json :
       {R"({"asset":{"version":"2.0"},"extensionsRequired":[")" + long_name + "\"]}",
        R"({"asset":{"version":"2.0"},")" + long_name + "\":1,\"" + long_name + "\":2}"}) {
    const auto request = proto::gltf::read(json, proto::Format::gltf, {}, {});
    ASSERT_FALSE(request.ok());
    EXPECT_LT(request.error().message.size(), 300u) << name_of(request.error().code);
  }
}

TEST(Warns, without_repeating_long_texts_of_the_asset) {
  GltfBuilder builder = seamed_octahedron();
  builder.document()["meshes"][0]["name"] = std::string(50000, 'm');
  builder.document()["meshes"][0]["primitives"][0]["attributes"][std::string(50000, 'a') + "\"\n"] = 1;
  const RefineRequest request = must_read(builder.glb());
  ASSERT_EQ(request.warnings.size(), 1u);
  EXPECT_LT(request.warnings[0].size(), 300u);
  EXPECT_EQ(request.meshes[0].name, std::string(256, 'm'));
}

TEST(Warns, once_of_vertices_that_are_left_out_and_adds_them_up) {
  GltfBuilder builder;
  const std::vector<float> nine(27, 1.0f);
  const int indices = builder.values<std::uint8_t>({0, 1, 2}, 1);
  builder.mesh({{"POSITION", builder.values(nine, 3)}}, indices);
  builder.primitive({{"POSITION", builder.values(std::vector<float>(15, 2.0f), 3)}}, indices);
  EXPECT_THAT(must_read(builder.glb()).warnings,
              testing::ElementsAre(
                  "Vertices that no triangle uses are left out: 8 (/meshes/0/primitives/0 and 1 more)."));
}

TEST(Refuses, more_attributes_than_allowed) {
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& first = builder.document()["meshes"][0]["primitives"][0]["attributes"];
  for (int i = 0; first.size() < 65; ++i) first["_A" + std::to_string(i)] = 2;
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
  EXPECT_EQ(request.error().allowed, 64u);
  EXPECT_EQ(to_pointer(request.error().where), "/meshes/0/primitives/0/attributes");
}

TEST(Refuses, more_different_attributes_in_a_mesh_than_allowed) {
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& primitives = builder.document()["meshes"][0]["primitives"];
  for (int i = 0; i < 40; ++i) {
    primitives[0]["attributes"]["_A" + std::to_string(i)] = 2;
    primitives[1]["attributes"]["_B" + std::to_string(i)] = 5;
  }
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
  EXPECT_EQ(to_pointer(request.error().where), "/meshes/0");
}

TEST(Refuses, accessors_without_data_that_stand_for_more_than_a_body_could_hold) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.accessor(-1, 5126, 3000000, "VEC3")}});
  proto::Limits limits;
  limits.max_body_bytes = 30 << 20;
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, limits);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
  EXPECT_EQ(request.error().allowed, limits.max_body_bytes);
}

TEST(Refuses, primitive_restart) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(std::vector<float>(3 * 256, 1.0f), 3)}},
               builder.values<std::uint8_t>({0, 1, 255}, 1));
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(to_pointer(request.error().where), "/meshes/0/primitives/0/indices");
}

TEST(Refuses, primitives_that_share_one_accessor_a_million_times_over) {
  GltfBuilder builder;
  const int positions = builder.values(std::vector<float>(30000, 1.0f), 3);
  builder.mesh({{"POSITION", positions}});
  for (int i = 0; i < 2000; ++i) builder.primitive({{"POSITION", positions}});
  proto::Limits limits;
  limits.max_output_bytes = 100 << 20;
  // 10,000 vertices are no multiple of 3: count them as a fan.
  for (OrderedJson& primitive : builder.document()["meshes"][0]["primitives"]) primitive["mode"] = 6;
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, limits);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
  EXPECT_EQ(request.error().allowed, limits.max_output_bytes);
}

TEST(Refuses, sixty_attributes_beside_a_large_primitive) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(std::vector<float>(90000, 1.0f), 3)}});
  const int one = builder.values(std::vector<float>(9, 1.0f), 3);
  OrderedJson attributes = {{"POSITION", one}};
  for (int i = 0; i < 60; ++i) attributes["_A" + std::to_string(i)] = one;
  builder.primitive(attributes);
  proto::Limits limits;
  limits.max_output_bytes = 10 << 20;
  const auto request = proto::gltf::read(builder.glb(), proto::Format::glb, {}, limits);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
  EXPECT_EQ(to_pointer(request.error().where), "/meshes/0");
}

}  // namespace
}  // namespace subdivd::test
