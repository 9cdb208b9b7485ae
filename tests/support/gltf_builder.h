#pragma once
// Makes small glTF assets, right or wrong, for tests.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace subdivd::test {

using OrderedJson = nlohmann::ordered_json;

class GltfBuilder {
 public:
  GltfBuilder();  // an asset with nothing in it

  OrderedJson& document() { return document_; }

  // Appends bytes, aligned to 4, and a bufferView of them; returns its number.
  template <class T>
  int view(const std::vector<T>& values, int stride = 0) {
    return view_of(std::as_bytes(std::span(values)), stride);
  }
  int accessor(int view, int component, std::size_t count, const std::string& type);

  // A view and an accessor at once. `width` scalars per element.
  template <class T>
  int values(const std::vector<T>& scalars, int width, bool normalized = false) {
    const int made = accessor(view(scalars), component_of(T{}),
                              scalars.size() / static_cast<std::size_t>(width), type_of(width));
    if (normalized) document_["accessors"][static_cast<std::size_t>(made)]["normalized"] = true;
    return made;
  }

  // A mesh of one primitive (and a node that shows it); returns its number.
  int mesh(OrderedJson attributes, int indices = -1, int mode = 4);
  // One more primitive of the last mesh.
  void primitive(OrderedJson attributes, int indices = -1, int mode = 4);

  std::string glb() const;   // buffer 0 in the BIN chunk
  std::string gltf() const;  // buffer 0 as a data URI

  static int component_of(std::int8_t) { return 5120; }
  static int component_of(std::uint8_t) { return 5121; }
  static int component_of(std::int16_t) { return 5122; }
  static int component_of(std::uint16_t) { return 5123; }
  static int component_of(std::uint32_t) { return 5125; }
  static int component_of(float) { return 5126; }
  static std::string type_of(int width);

 private:
  int view_of(std::span<const std::byte> bytes, int stride);
  OrderedJson with_buffer() const;

  OrderedJson document_;
  std::string data_;
};

// A GLB of these two chunks as they are; `bin` may be empty. Lengths and padding are right.
std::string make_glb(std::string json, const std::string& bin);

// What an answer or a request holds.
struct ParsedGlb {
  OrderedJson json;
  std::string bin;
};
ParsedGlb parse_glb(const std::string& bytes);  // trusts the bytes
std::string base64(const std::string& bytes);

// An octahedron of two primitives whose texture coordinates have a seam: 8 triangles, valence 4 throughout.
GltfBuilder seamed_octahedron();

}  // namespace subdivd::test
