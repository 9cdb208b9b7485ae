#include "proto/gltf/read_triangles.h"

#include <algorithm>
#include <map>
#include <utility>

#include "proto/gltf/weld.h"

namespace subdivd::proto::gltf {
namespace {

// One triangle primitive after vertices that nothing uses have been taken out.
struct Part {
  Index primitive = 0;
  PrimitiveData data;
  Index first_vertex = 0;  // of the mesh's vertices
};

void compact(PrimitiveData& data, std::vector<Index>& original, Warnings& warnings, const Place& place) {
  std::vector<Index> renumbered(data.vertex_count, kNoIndex);
  for (const Index corner : data.corners) renumbered[corner] = 0;
  Index used = 0;
  for (Index vertex = 0; vertex < data.vertex_count; ++vertex) {
    if (renumbered[vertex] == kNoIndex) continue;
    renumbered[vertex] = used;
    original.push_back(vertex);
    const auto move_down = [&](std::vector<double>& values, Count width) {
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(vertex * width), width,
                  values.begin() + static_cast<std::ptrdiff_t>(used * width));
    };
    move_down(data.positions, 3);
    for (PrimitiveChannel& channel : data.channels) move_down(channel.values, channel.components);
    ++used;
  }
  if (used < data.vertex_count)
    warnings.add("Vertices that no triangle uses are left out: " + std::to_string(data.vertex_count - used),
                 place.pointer());
  data.vertex_count = used;
  data.positions.resize(Count{used} * 3);
  for (PrimitiveChannel& channel : data.channels) channel.values.resize(Count{used} * channel.components);
  for (Index& corner : data.corners) corner = renumbered[corner];
}

class MeshReader {
 public:
  MeshReader(const Asset& asset, Index mesh, const Options& options, const Limits& limits, const Place& place)
      : asset_(asset), options_(options), limits_(limits), place_(place), gltf_mesh_(mesh) {}

  Result<ReadMesh> read();

 private:
  Result<void> read_part(Index primitive, const Place& place);
  void connect();
  Result<void> check_channel_size() const;
  void add_channel(const std::string& name, Index width);

  const Asset& asset_;
  const Options& options_;
  const Limits& limits_;
  const Place& place_;
  Index gltf_mesh_;
  std::vector<Part> parts_;
  std::vector<double> keys_;  // what vertices are welded by: their position, or where they come from
  Count key_width_ = 0;
  std::vector<Index> points_;            // point of every vertex of all parts
  std::map<std::string, Index> widths_;  // of every channel of the mesh
  ReadMesh result_;
};

Result<void> MeshReader::read_part(Index primitive, const Place& place) {
  const tinygltf::Primitive& structure = asset_.model.meshes[gltf_mesh_].primitives[primitive];
  auto data = read_primitive(asset_, structure, place);
  if (!data) return data.error();
  Part part{primitive, *std::move(data), static_cast<Index>(keys_.size() / key_width_)};
  part.data.corners = to_triangle_list(std::move(part.data.corners), static_cast<Count>(structure.mode));
  if (part.data.corners.empty()) {
    asset_.warnings.add("A primitive whose triangles all repeat a vertex is left as it is", place.pointer());
    return {};
  }
  std::vector<Index> original;
  compact(part.data, original, asset_.warnings, place);
  if (options_.weld == Weld::exact) {
    keys_.insert(keys_.end(), part.data.positions.begin(), part.data.positions.end());
  } else {
    for (const Index vertex : original)
      keys_.insert(keys_.end(), {double(part.data.position_accessor), double(vertex)});
  }
  for (const PrimitiveChannel& channel : part.data.channels) {
    Index& width = widths_[channel.name];
    width = std::max(width, channel.components);
  }
  result_.has_normals |= part.data.has_normals;
  parts_.push_back(std::move(part));
  return {};
}

// Points, faces and render meshes.
void MeshReader::connect() {
  const Welded weld = weld_tuples(keys_, key_width_);
  keys_ = {};
  ControlMesh& mesh = result_.mesh;
  mesh.points.resize(weld.first.size() * 3);
  for (const Part& part : parts_) {
    for (Index vertex = 0; vertex < part.data.vertex_count; ++vertex) {
      const Index point = weld.id[part.first_vertex + vertex];
      if (weld.first[point] == part.first_vertex + vertex)
        std::copy_n(part.data.positions.begin() + Count{vertex} * 3, 3,
                    mesh.points.begin() + Count{point} * 3);
    }
    RenderMesh& render = mesh.render_meshes.emplace_back();
    render.face_begin = static_cast<Index>(mesh.face_vertex_indices.size() / 3);
    for (const Index corner : part.data.corners)
      mesh.face_vertex_indices.push_back(weld.id[part.first_vertex + corner]);
    render.face_end = static_cast<Index>(mesh.face_vertex_indices.size() / 3);
    render.vertex_count = part.data.vertex_count;
    render.indices = part.data.corners;
  }
  points_ = weld.id;
}

// A channel has an index for every corner of the mesh, even if one small primitive has it: a thousand names
// for one vertex beside a large primitive would take a thousand times the input.
Result<void> MeshReader::check_channel_size() const {
  Count bytes = 0;
  for (const auto& [name, width] : widths_)
    bytes +=
        result_.mesh.face_vertex_indices.size() * sizeof(Index) + points_.size() * width * sizeof(double);
  if (bytes <= limits_.max_output_bytes) return {};
  Error error = error_at(place_, ErrorCode::too_large,
                         "the attributes of this mesh take " + std::to_string(bytes) + " bytes; " +
                             std::to_string(limits_.max_output_bytes) + " are allowed");
  error.predicted = bytes;
  error.allowed = limits_.max_output_bytes;
  return error;
}

// Values are welded when they belong to the same point and are bit-identical. Primitives that lack the
// attribute get a zero of their own at each point, apart from every value that was given.
void MeshReader::add_channel(const std::string& name, Index width) {
  const Count key_width = Count{width} + 2;
  std::vector<double> keys(points_.size() * key_width);
  const bool color = semantic_of(name) == Semantic::color;
  Count vertex = 0;
  for (const Part& part : parts_) {
    const auto& channels = part.data.channels;
    const auto found =
        std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == name; });
    for (Index v = 0; v < part.data.vertex_count; ++v, ++vertex) {
      double* key = &keys[vertex * key_width];
      key[0] = points_[vertex];
      key[1] = found == channels.end() ? 0 : 1;
      if (found == channels.end()) continue;
      std::copy_n(&found->values[Count{v} * found->components], found->components, key + 2);
      if (color && found->components == 3 && width == 4) key[5] = 1;  // opaque
    }
  }
  const Welded weld = weld_tuples(keys, key_width);
  Primvar primvar{name, Interpolation::face_varying, width, {}, {}};
  primvar.values.reserve(weld.first.size() * width);
  for (const Index first : weld.first) {
    const auto value = keys.begin() + static_cast<std::ptrdiff_t>(first * key_width + 2);
    primvar.values.insert(primvar.values.end(), value, value + width);
  }
  primvar.indices.reserve(result_.mesh.face_vertex_indices.size());
  for (const Part& part : parts_)
    for (const Index corner : part.data.corners)
      primvar.indices.push_back(weld.id[part.first_vertex + corner]);
  result_.mesh.primvars.push_back(std::move(primvar));
}

Result<ReadMesh> MeshReader::read() {
  const tinygltf::Mesh& structure = asset_.model.meshes[gltf_mesh_];
  result_.mesh.name = structure.name;
  key_width_ = options_.weld == Weld::exact ? 3 : 2;
  const Place all = place_.at("primitives");
  for (Index i = 0; i < structure.primitives.size(); ++i) {
    if (static_cast<Count>(structure.primitives[i].mode) < kTriangles) continue;
    if (auto read = read_part(i, all.at(i)); !read) return read.error();
  }
  connect();
  if (auto fits = check_channel_size(); !fits) return fits.error();
  for (const auto& [name, width] : widths_) add_channel(name, width);
  for (Index i = 0; i < parts_.size(); ++i) {
    TrianglesSlot slot{gltf_mesh_, parts_[i].primitive, 0, i, parts_[i].data.has_normals || options_.normals,
                       {}};
    for (const PrimitiveChannel& channel : parts_[i].data.channels) {
      const auto primvar = static_cast<Index>(std::distance(widths_.begin(), widths_.find(channel.name)));
      slot.attributes.push_back({channel.name, primvar, 0, channel.components});
    }
    result_.slots.push_back(std::move(slot));
  }
  return std::move(result_);
}

}  // namespace

std::vector<Index> to_triangle_list(std::vector<Index> corners, Count mode) {
  if (mode == kTriangles) return corners;
  std::vector<Index> list;
  list.reserve(corners.size() * 3);
  const auto add = [&](Index a, Index b, Index c) {
    if (a != b && b != c && c != a) list.insert(list.end(), {a, b, c});
  };
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == kTriangleFan) {
      add(corners[i + 1], corners[i + 2], corners[0]);
    } else {
      add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  }
  return list;
}

Result<ReadMesh> read_triangles(const Asset& asset, Index mesh, const Options& options, const Limits& limits,
                                const Place& place) {
  return MeshReader(asset, mesh, options, limits, place).read();
}

}  // namespace subdivd::proto::gltf
