#include "tests/support/gltf_builder.h"

#include <cassert>

namespace subdivd::test {
namespace {

void append_word(std::string& out, std::size_t word) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(word >> (8 * i) & 0xff);
}

std::size_t read_word(const std::string& bytes, std::size_t at) {
  std::size_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::size_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return word;
}

}  // namespace

GltfBuilder::GltfBuilder() { document_["asset"]["version"] = "2.0"; }

int GltfBuilder::view_of(std::span<const std::byte> bytes, int stride) {
  data_.resize((data_.size() + 3) / 4 * 4);
  OrderedJson view = {{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", bytes.size()}};
  if (stride != 0) view["byteStride"] = stride;
  document_["bufferViews"].push_back(view);
  data_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return static_cast<int>(document_["bufferViews"].size()) - 1;
}

int GltfBuilder::accessor(int view, int component, std::size_t count, const std::string& type) {
  OrderedJson accessor;
  if (view >= 0) accessor["bufferView"] = view;
  accessor["componentType"] = component;
  accessor["count"] = count;
  accessor["type"] = type;
  document_["accessors"].push_back(accessor);
  return static_cast<int>(document_["accessors"].size()) - 1;
}

int GltfBuilder::mesh(OrderedJson attributes, int indices, int mode) {
  document_["meshes"].push_back({{"primitives", OrderedJson::array()}});
  primitive(std::move(attributes), indices, mode);
  const auto number = document_["meshes"].size() - 1;
  document_["nodes"].push_back({{"mesh", number}});
  document_["scene"] = 0;
  document_["scenes"][0]["nodes"].push_back(document_["nodes"].size() - 1);
  return static_cast<int>(number);
}

void GltfBuilder::primitive(OrderedJson attributes, int indices, int mode) {
  OrderedJson primitive = {{"attributes", std::move(attributes)}};
  if (indices >= 0) primitive["indices"] = indices;
  if (mode != 4) primitive["mode"] = mode;
  document_["meshes"].back()["primitives"].push_back(primitive);
}

OrderedJson GltfBuilder::with_buffer() const {
  OrderedJson document = document_;
  if (!data_.empty() && !document.contains("buffers"))
    document["buffers"].push_back({{"byteLength", data_.size()}});
  return document;
}

std::string GltfBuilder::glb() const { return make_glb(with_buffer().dump(), data_); }

std::string GltfBuilder::gltf() const {
  OrderedJson document = with_buffer();
  if (!data_.empty()) document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(data_);
  return document.dump();
}

std::string GltfBuilder::type_of(int width) { return width == 1 ? "SCALAR" : "VEC" + std::to_string(width); }

std::string make_glb(std::string json, const std::string& bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string padded = bin;
  padded.resize((padded.size() + 3) / 4 * 4);
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, 12 + 8 + json.size() + (bin.empty() ? 0 : 8 + padded.size()));
  append_word(out, json.size());
  out += "JSON" + json;
  if (!bin.empty()) {
    append_word(out, padded.size());
    out += std::string("BIN\0", 4) + padded;
  }
  return out;
}

ParsedGlb parse_glb(const std::string& bytes) {
  const std::size_t length = read_word(bytes, 12);
  ParsedGlb parsed{OrderedJson::parse(bytes.substr(20, length)), {}};
  if (bytes.size() > 20 + length) parsed.bin = bytes.substr(28 + length, read_word(bytes, 20 + length));
  return parsed;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      out += at + i <= bytes.size() ? kDigits[bits >> (18 - 6 * i) & 63] : '=';
  }
  return out;
}

GltfBuilder seamed_octahedron() {
  GltfBuilder builder;
  // Two halves that share the equator's four positions; each half is its own primitive and repeats its first
  // equator vertex with another texture coordinate.
  for (const float pole : {1.0f, -1.0f}) {
    const int positions =
        builder.values<float>({1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, pole}, 3);
    const int normals = builder.values<float>({1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, pole}, 3);
    const int coordinates = builder.values<float>(
        {0, 0.5f, 0.25f, 0.5f, 0.5f, 0.5f, 0.75f, 0.5f, 1, 0.5f, 0.5f, pole > 0 ? 1.0f : 0.0f}, 2);
    const std::vector<std::uint16_t> up = {0, 1, 5, 1, 2, 5, 2, 3, 5, 3, 4, 5};
    const std::vector<std::uint16_t> down = {1, 0, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5};
    const int indices = builder.values(pole > 0 ? up : down, 1);
    const OrderedJson attributes = {
        {"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", coordinates}};
    if (pole > 0) {
      builder.mesh(attributes, indices);
    } else {
      builder.primitive(attributes, indices);
    }
    OrderedJson& accessor = builder.document()["accessors"][static_cast<std::size_t>(positions)];
    accessor["min"] = {-1, -1, std::min(pole, 0.0f)};
    accessor["max"] = {1, 1, std::max(pole, 0.0f)};
  }
  return builder;
}

}  // namespace subdivd::test
