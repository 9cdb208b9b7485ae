// Writes answers to many kinds of assets into a folder, for Khronos' validator: answers FOLDER

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

using proto::Format;
using proto::Options;

// A wavy grid of (n + 1)^2 vertices in the plane, open on all sides.
struct Grid {
  std::vector<float> positions, normals, coordinates, colors;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint8_t> lines, strip;
};

Grid grid(unsigned n) {
  Grid grid;
  for (unsigned j = 0; j <= n; ++j)
    for (unsigned i = 0; i <= n; ++i) {
      const float x = float(i) / float(n), y = float(j) / float(n);
      grid.positions.insert(grid.positions.end(), {x, y, 0.1f * std::sin(7 * x + 3 * y)});
      grid.normals.insert(grid.normals.end(), {0, 0, 1});
      grid.coordinates.insert(grid.coordinates.end(), {x, 1 - y});
      grid.colors.insert(grid.colors.end(), {x, y, 1 - x, 1});
      const unsigned at = j * (n + 1) + i;
      grid.strip.push_back(static_cast<std::uint8_t>(at));
      if (i < n)
        grid.lines.insert(grid.lines.end(),
                          {static_cast<std::uint8_t>(at), static_cast<std::uint8_t>(at + 1)});
      if (i < n && j < n)
        grid.triangles.insert(grid.triangles.end(), {at, at + 1, at + n + 2, at, at + n + 2, at + n + 1});
    }
  return grid;
}

class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }

  void add(const std::string& name, const std::string& body, Options options = {}) {
    for (const Format format : {Format::glb, Format::gltf}) {
      options.format = format;
      write(name + (format == Format::glb ? ".glb" : ".gltf"), must_refine(body, options).bytes);
    }
  }
  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    std::printf("%s: %zu bytes\n", name.c_str(), bytes.size());
  }

 private:
  std::filesystem::path path_;
};

void add_modes(Folder& folder) {
  const Grid source = grid(4);
  for (int mode = 1; mode <= 6; ++mode) {
    GltfBuilder builder;
    const OrderedJson attributes = {{"POSITION", builder.values(source.positions, 3)},
                                    {"COLOR_0", builder.values(source.colors, 4)}};
    int indices = -1;
    if (mode == 1) indices = builder.values(source.lines, 1);
    if (mode == 2 || mode == 3) indices = builder.values(source.strip, 1);
    if (mode == 4) indices = builder.values(source.triangles, 1);
    if (mode == 5) indices = builder.values<std::uint16_t>({0, 1, 5, 6, 10, 11, 11, 12, 12, 13, 17, 18}, 1);
    if (mode == 6) indices = builder.values<std::uint8_t>({12, 11, 6, 7, 8, 13, 18, 17, 16, 11}, 1);
    builder.mesh(attributes, indices, mode);
    folder.add("mode_" + std::to_string(mode), builder.glb());
  }
}

void add_component_types(Folder& folder) {
  const Grid source = grid(3);
  {
    GltfBuilder builder;
    std::vector<std::uint16_t> indices(source.triangles.begin(), source.triangles.end());
    std::vector<std::uint16_t> coordinates;
    for (const float value : source.coordinates)
      coordinates.push_back(static_cast<std::uint16_t>(value * 65535));
    std::vector<std::uint8_t> colors;
    for (const float value : source.colors) colors.push_back(static_cast<std::uint8_t>(value * 255));
    builder.mesh({{"POSITION", builder.values(source.positions, 3)},
                  {"NORMAL", builder.values(source.normals, 3)},
                  {"TEXCOORD_0", builder.values(coordinates, 2, true)},
                  {"COLOR_0", builder.values(colors, 4, true)},
                  {"_WEIGHT", builder.values(std::vector<float>(16, 0.25f), 1)}},
                 builder.values(indices, 1));
    folder.add("normalized", builder.glb());
    Options options;
    options.limit = true;
    options.level = 3;
    folder.add("limit", builder.glb(), options);
    // Half of the grid's faces touch the border, and all faces of the next one do.
    options.interpolate_boundary = BoundaryInterpolation::none;
    folder.add("boundary_none", builder.glb(), options);
    GltfBuilder small;
    const Grid two = grid(1);
    small.mesh({{"POSITION", small.values(two.positions, 3)}, {"NORMAL", small.values(two.normals, 3)}},
               small.values(two.triangles, 1));
    folder.add("nothing_left", small.glb(), options);
  }
  {
    GltfBuilder builder;
    builder.document()["extensionsUsed"] = {"KHR_mesh_quantization"};
    builder.document()["extensionsRequired"] = {"KHR_mesh_quantization"};
    std::vector<std::int16_t> positions;
    for (std::size_t i = 0; i < source.positions.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k)
        positions.push_back(static_cast<std::int16_t>(source.positions[i + k] * 30000));
      positions.push_back(0);
    }
    const int accessor = builder.accessor(builder.view(positions, 8), 5122, positions.size() / 4, "VEC3");
    builder.document()["accessors"][0]["normalized"] = true;
    builder.mesh({{"POSITION", accessor}}, builder.values(source.triangles, 1));
    folder.add("quantized", builder.glb());
  }
  {
    GltfBuilder builder;
    const int accessor = builder.accessor(-1, 5126, 3, "VEC3");
    const int at = builder.view<std::uint8_t>({1, 2}), with = builder.view<float>({1, 0, 0, 0, 1, 0});
    builder.document()["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", at}, {"componentType", 5121}}},
        {"values", {{"bufferView", with}}}};
    builder.mesh({{"POSITION", accessor}});
    folder.add("sparse", builder.glb());
  }
}

void add_scenes(Folder& folder) {
  const Grid source = grid(3);
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& document = builder.document();
  const auto attributes = [&] {
    return OrderedJson{{"POSITION", builder.values(source.positions, 3)},
                       {"NORMAL", builder.values(source.normals, 3)},
                       {"TEXCOORD_0", builder.values(source.coordinates, 2)}};
  };
  builder.mesh(attributes(), builder.values(source.triangles, 1));
  const OrderedJson points = {{"POSITION", builder.values(source.positions, 3)}};
  OrderedJson& accessor = document["accessors"].back();
  accessor["min"] = {0, 0, 0}, accessor["max"] = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    float low = source.positions[k], high = low;
    for (std::size_t i = k; i < source.positions.size(); i += 3)
      low = std::min(low, source.positions[i]), high = std::max(high, source.positions[i]);
    accessor["min"][k] = double{low}, accessor["max"][k] = double{high};
  }
  builder.primitive(points, -1, 0);
  document["materials"] = {{{"name", "red"},
                            {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}},
                            {"extensions", {{"KHR_materials_unlit", OrderedJson::object()}}},
                            {"extras", {{"big", 12345678901234567}}}},
                           {{"doubleSided", true}}};
  document["extensionsUsed"] = {"KHR_materials_unlit", "KHR_lights_punctual"};
  document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["meshes"][1]["primitives"][0]["material"] = 1;
  document["nodes"][0]["children"] = {2};
  document["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const int times = builder.values<float>({0, 1}, 1);
  document["accessors"].back()["min"] = {0}, document["accessors"].back()["max"] = {1};
  const int moves = builder.values<float>({0, 0, 0, 1, 1, 1}, 3);
  document["animations"] = {
      {{"samplers", {{{"input", times}, {"output", moves}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  document["extras"] = {{"anything", {1, "two", nullptr}}};
  folder.add("scene", builder.glb());
  Options options;
  options.level = 0;
  folder.add("level_0", builder.glb(), options);
  options.weld = proto::Weld::none;
  options.level = 3;
  folder.add("not_welded", builder.glb(), options);

  document["extensionsUsed"].push_back("EXT_unheard_of");
  document["nodes"][1]["extensions"]["EXT_unheard_of"]["accessor"] = 1;
  folder.add("unknown_extension", builder.glb());
}

void add_deformed(Folder& folder) {
  const Grid source = grid(2);
  GltfBuilder builder;
  OrderedJson& document = builder.document();
  const int positions = builder.values(source.positions, 3);
  const OrderedJson attributes = {{"POSITION", positions},
                                  {"NORMAL", builder.values(source.normals, 3)},
                                  {"TANGENT", builder.values(std::vector<float>(36, 0.5f), 4)},
                                  {"JOINTS_0", builder.values(std::vector<std::uint8_t>(36), 4)},
                                  {"WEIGHTS_0", builder.values(std::vector<float>(36, 0.25f), 4)}};
  builder.mesh(attributes, builder.values(source.triangles, 1));
  document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", positions}}};
  document["meshes"][0]["weights"] = {0.5};
  document["nodes"].push_back({{"name", "joint"}});
  document["scenes"][0]["nodes"].push_back(1);
  document["skins"] = {{{"joints", {1}}}};
  document["nodes"][0]["skin"] = 0;
  const int times = builder.values<float>({0, 1}, 1), weights = builder.values<float>({0, 1}, 1);
  document["animations"] = {
      {{"samplers", {{{"input", times}, {"output", weights}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  folder.add("deformed", builder.glb());
}

// Normals at the tip of two cones that touch, and a triangle without area.
void add_degenerate(Folder& folder) {
  GltfBuilder builder;
  builder.mesh({{"POSITION",
                 builder.values<float>(
                     {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 1, 0, -1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2}, 3)},
                {"NORMAL", builder.values(std::vector<float>(27, 0.57735f), 3)}});
  builder.primitive({{"POSITION", builder.values(std::vector<float>(9, 1.0f), 3)}});
  folder.add("degenerate", builder.glb());
}

// Quads in, quads out, beside a primitive of the triangles that they are cut into.
void add_ngons(Folder& folder) {
  const Grid source = grid(3);
  GltfBuilder builder;
  const OrderedJson attributes = {{"POSITION", builder.values(source.positions, 3)},
                                  {"TEXCOORD_0", builder.values(source.coordinates, 2)}};
  const int indices = builder.values(source.triangles, 1);
  builder.mesh(attributes, indices);
  OrderedJson& primitive = builder.document()["meshes"][0]["primitives"][0];
  primitive["extensions"]["FB_ngon_encoding"] = OrderedJson::object();
  builder.document()["extensionsUsed"] = {"FB_ngon_encoding"};
  builder.primitive(attributes, indices);
  for (const Index level : {0u, 1u, 3u}) {
    Options options;
    options.level = level;
    folder.add("quads_" + std::to_string(level), builder.glb(), options);
    options.ngons = true;
    folder.add("ngons_" + std::to_string(level), builder.glb(), options);
  }
}

void add_fresh(Folder& folder) {
  proto::RefineRequest request;
  request.options.level = 2;
  request.options.normals = true;
  ControlMesh mesh;
  mesh.name = "square \"quoted\"";
  mesh.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.1};
  mesh.face_vertex_indices = {0, 1, 2, 0, 2, 3};
  mesh.primvars = {{"st", Interpolation::face_varying, 2, {0, 0, 1, 0, 1, 1, 0, 1, 5, 5}, {0, 1, 2, 4, 2, 3}},
                   {"displayColor", Interpolation::vertex, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, {}},
                   {"my weight", Interpolation::varying, 1, {1, 2, 3, 4}, {}}};
  request.meshes = {mesh, mesh};
  request.meshes[1].primvars.clear();
  request.meshes[1].hole_indices = {1};
  request.curves = {
      {"loop", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 9, 9, 9, 8, 8, 8, 7, 7, 9}, {3, 3}, CurveWrap::periodic},
      {"flat", 2, {0, 0, 1, 0, 1, 1}, {}, CurveWrap::pinned},
      {"", 4, {0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 1, 2, 1, 0, 1}, {}, CurveWrap::nonperiodic}};
  for (const bool split_late : {false, true})
    for (const Format format : {Format::glb, Format::gltf}) {
      proto::RefineRequest copy = request;
      copy.options.format = format;
      if (!split_late)
        if (auto added = proto::gltf::add_render_meshes(copy); !added)
          throw std::runtime_error(added.error().message);
      auto outcome = answer(std::move(copy));
      if (!outcome) throw std::runtime_error(outcome.error().message);
      folder.write(
          std::string(split_late ? "json_split_late" : "json") + (format == Format::glb ? ".glb" : ".gltf"),
          outcome->bytes);
    }
}

}  // namespace
}  // namespace subdivd::test

int main(int argc, char** argv) {
  using namespace subdivd::test;
  if (argc != 2) return std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]), 2;
  try {
    Folder folder(argv[1]);
    folder.add("octahedron", seamed_octahedron().glb());
    add_modes(folder);
    add_component_types(folder);
    add_scenes(folder);
    add_deformed(folder);
    add_degenerate(folder);
    add_ngons(folder);
    add_fresh(folder);
  } catch (const std::exception& exception) {
    return std::fprintf(stderr, "%s\n", exception.what()), 1;
  }
}
