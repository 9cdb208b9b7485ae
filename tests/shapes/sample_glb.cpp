// The sample as a GLB: two meshes, four primitives, five nodes.
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>

#include "tests/shapes/sample.h"

namespace subdivd::shapes {
namespace {

using Point = std::array<double, 3>;

// Area-weighted, per point: seams do not show.
std::vector<Point> normals_of(const SampleSurface& surface) {
  std::vector<Point> normals(surface.points.size(), Point{});
  for (const SampleSurface::Face& face : surface.faces) {
    const Point &a = surface.points[face.corners[0].point], &b = surface.points[face.corners[1].point],
                &c = surface.points[face.corners[2].point];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const double component = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
      for (const SampleCorner& corner : face.corners) normals[corner.point][k] += component;
    }
  }
  for (Point& n : normals) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double& x : n) x /= length;
  }
  return normals;
}

class GlbWriter {
 public:
  // Appends one primitive and returns its JSON.
  std::string primitive(const SampleSurface& surface, const std::vector<Point>& normals,
                        std::size_t material) {
    std::vector<float> positions, normal, uvs, colours;
    std::vector<std::uint16_t> indices;
    std::map<std::tuple<Index, double, double>, std::uint16_t> vertex_of;
    for (const SampleSurface::Face& face : surface.faces)
      for (const SampleCorner& corner : face.corners) {
        if (face.material != material) continue;
        const auto [found, is_new] = vertex_of.try_emplace({corner.point, corner.u, corner.v},
                                                           static_cast<std::uint16_t>(vertex_of.size()));
        indices.push_back(found->second);
        if (!is_new) continue;
        append(positions, surface.points[corner.point]);
        append(normal, normals[corner.point]);
        if (!surface.colours.empty())
          append(colours, surface.colours[corner.point]);
        else
          append(uvs, std::array{corner.u, corner.v});
      }
    // One accessor a statement: operands of + are made in an order of the compiler's choice.
    std::string json = "{\"attributes\":{\"POSITION\":" + accessor(positions, "VEC3", true);
    json += ",\"NORMAL\":" + accessor(normal, "VEC3", false);
    if (colours.empty())
      json += ",\"TEXCOORD_0\":" + accessor(uvs, "VEC2", false);
    else
      json += ",\"COLOR_0\":" + accessor(colours, "VEC3", false);
    json += "},\"indices\":" + accessor(indices);
    return json + ",\"material\":" + std::to_string(material) + "}";
  }

  // Appends bytes without an accessor and returns the number of their buffer view.
  std::string view(const void* data, std::size_t size, int target) {
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    if (!views_.empty()) views_ += ",";
    views_ += std::string("{\"buffer\":0,\"byteOffset\":") + std::to_string(bin_.size()) +
              ",\"byteLength\":" + std::to_string(size) +
              (target != 0 ? ",\"target\":" + std::to_string(target) : "") + "}";
    bin_.append(static_cast<const char*>(data), size);
    return std::to_string(view_count_++);
  }

  // The whole file; `json` has everything but accessors, bufferViews and buffers, and no closing brace.
  std::string file(std::string json) {
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    json += ",\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
            "],\"buffers\":[{\"byteLength\":" + std::to_string(bin_.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    for (const std::size_t word : {std::size_t{2}, 12 + 8 + json.size() + 8 + bin_.size(), json.size()})
      put(glb, word);
    glb += "JSON" + json;
    put(glb, bin_.size());
    return glb + std::string("BIN\0", 4) + bin_;
  }

 private:
  template <std::size_t N>
  static void append(std::vector<float>& to, const std::array<double, N>& values) {
    for (const double value : values) to.push_back(static_cast<float>(value));
  }
  static void put(std::string& out, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(word >> shift & 0xff);
  }

  std::string add(const std::string& json) {
    if (!accessors_.empty()) accessors_ += ",";
    accessors_ += json;
    return std::to_string(accessor_count_++);
  }

  std::string accessor(const std::vector<float>& values, const std::string& type, bool bounds) {
    const std::size_t width = type == "VEC2" ? 2 : 3;
    std::string json = "{\"bufferView\":" + view(values.data(), values.size() * sizeof(float), 34962) +
                       ",\"componentType\":5126,\"count\":" + std::to_string(values.size() / width) +
                       ",\"type\":\"" + type + "\"";
    if (bounds) json += ",\"min\":" + bound(values, -1) + ",\"max\":" + bound(values, 1);
    return add(json + "}");
  }

  std::string accessor(const std::vector<std::uint16_t>& indices) {
    return add("{\"bufferView\":" + view(indices.data(), indices.size() * sizeof(std::uint16_t), 34963) +
               ",\"componentType\":5123,\"count\":" + std::to_string(indices.size()) +
               ",\"type\":\"SCALAR\"}");
  }

  // Coordinates are multiples of 1/4096: six decimals may round, twelve are exact.
  static std::string bound(const std::vector<float>& values, float sign) {
    std::string json;
    for (std::size_t k = 0; k < 3; ++k) {
      float best = -std::numeric_limits<float>::infinity();
      for (std::size_t i = k; i < values.size(); i += 3) best = std::max(best, sign * values[i]);
      char text[32];
      std::snprintf(text, sizeof text, "%.12f", double{sign * best});
      json += k == 0 ? "[" : ",";
      json += text;
    }
    return json + "]";
  }

  std::string bin_, views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

constexpr const char* kMaterials =
    R"([{"name":"glaze","pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0,"roughnessFactor":0.25}},)"
    R"({"name":"clay","pbrMetallicRoughness":{"baseColorFactor":[0.62,0.32,0.18,1],"metallicFactor":0,"roughnessFactor":0.9}},)"
    R"({"name":"pear skin","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5}},)"
    R"({"name":"wood","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.8}}])";

constexpr const char* kNodes =
    R"([{"name":"still life","children":[1,2]},)"
    R"({"name":"jug","mesh":0,"rotation":[0,0.25881904510252074,0,0.9659258262890683]},)"
    R"({"name":"fruit","translation":[1.25,0,0.75],"children":[3,4]},)"
    R"({"name":"pear","mesh":1},)"
    R"({"name":"fallen pear","mesh":1,"translation":[-1.1,0.46,0.45],"rotation":[0.1900433598169559,-0.21106453377289855,-0.6415756305811937,0.7125419245329048],"scale":[0.8,0.8,0.8]}])";

}  // namespace

std::string sample_glb() {
  GlbWriter writer;
  const SampleSurface jug = sample_jug(), pear = sample_pear();
  const std::vector<Point> jug_normals = normals_of(jug), pear_normals = normals_of(pear);
  const std::string png = sample_texture_png();
  std::string json = R"({"asset":{"version":"2.0","generator":"subdivd tests/shapes/make_sample"},"scene":0,)"
                     R"("scenes":[{"name":"kitchen","nodes":[0]}],"nodes":)" +
                     std::string(kNodes);
  json += R"(,"meshes":[{"name":"jug","primitives":[)" + writer.primitive(jug, jug_normals, kGlaze);
  json += ',';
  json += writer.primitive(jug, jug_normals, kClay);
  json += R"(]},{"name":"pear","primitives":[)" + writer.primitive(pear, pear_normals, kPearSkin);
  json += ',';
  json += writer.primitive(pear, pear_normals, kWood) + "]}]";
  json += ",\"materials\":" + std::string(kMaterials);
  json += R"(,"textures":[{"sampler":0,"source":0}],"samplers":[{"magFilter":9729,"minFilter":9987}],)"
          R"("images":[{"name":"painted","mimeType":"image/png","bufferView":)" +
          writer.view(png.data(), png.size(), 0) + "}]";
  return writer.file(json);
}

}  // namespace subdivd::shapes
