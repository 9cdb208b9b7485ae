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
  PrimitiveData data;      // positions and corners move on to the mesh
  Index first_vertex = 0;  // of the mesh's vertices
};

// Takes out the vertices that no corner uses. Returns the original number of every vertex left; empty when
// all are.
std::vector<Index> compact(PrimitiveData& data, Warnings& warnings, const Place& place) {
  std::vector<unsigned char> is_used(data.vertex_count, 0);
  for (const Index corner : data.corners) is_used[corner] = 1;
  if (std::find(is_used.begin(), is_used.end(), 0) == is_used.end()) return {};
  std::vector<Index> renumbered(data.vertex_count, kNoIndex), original;
  for (Index vertex = 0; vertex < data.vertex_count; ++vertex) {
    if (is_used[vertex] == 0) continue;
    const auto used = static_cast<Index>(original.size());
    renumbered[vertex] = used;
    original.push_back(vertex);
    const auto move_down = [&](std::vector<double>& values, Count width) {
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(vertex * width), width,
                  values.begin() + static_cast<std::ptrdiff_t>(used * width));
    };
    move_down(data.positions, 3);
    for (PrimitiveChannel& channel : data.channels) move_down(channel.values, channel.components);
  }
  warnings.add(
      "Vertices that no triangle uses are left out: " + std::to_string(data.vertex_count - original.size()),
      place.pointer());
  data.vertex_count = static_cast<Index>(original.size());
  data.positions.resize(original.size() * 3);
  for (PrimitiveChannel& channel : data.channels) channel.values.resize(original.size() * channel.components);
  for (Index& corner : data.corners) corner = renumbered[corner];
  return original;
}

// Appends; a first array is moved, so that the values of a mesh with one primitive are never copied.
void append(std::vector<double>& all, std::vector<double> more) {
  if (all.empty()) {
    all = std::move(more);
  } else {
    all.insert(all.end(), more.begin(), more.end());
  }
}

// Leaves the values that represent others, in order.
void keep_first(std::vector<double>& values, Count width, const Welded& weld) {
  if (weld.all_differ()) return;
  const auto move_down = [&](Count w) {
    for (Count id = 0; id < weld.first.size(); ++id)
      for (Count k = 0; k < w; ++k) values[id * w + k] = values[weld.first[id] * w + k];
  };
  if (width == 3) {
    move_down(3);
  } else {
    move_down(width);
  }
  values.resize(weld.first.size() * width);
}

// Tuples of `from` numbers as tuples of `to`, the last of which is `padding` and the others before it 0.
std::vector<double> widened(std::vector<double> values, Count from, Count to, double padding) {
  if (from == to) return values;
  const Count count = values.size() / from;
  std::vector<double> wide(count * to);
  for (Count i = 0; i < count; ++i) {
    std::copy_n(&values[i * from], from, &wide[i * to]);
    wide[i * to + to - 1] = padding;
  }
  return wide;
}

class MeshReader {
 public:
  MeshReader(const Asset& asset, Index mesh, const Options& options, const Limits& limits, const Place& place)
      : asset_(asset), options_(options), limits_(limits), place_(place), gltf_mesh_(mesh) {}

  Result<ReadMesh> read();

 private:
  Result<void> read_part(Index primitive, const Place& place);
  void connect();
  std::vector<Index> corner_ids(const Welded& weld) const;
  Result<void> check_channel_size() const;
  void add_channel(const std::string& name, Index width);

  const Asset& asset_;
  const Options& options_;
  const Limits& limits_;
  const Place& place_;
  Index gltf_mesh_;
  std::vector<Part> parts_;
  Index vertex_count_ = 0;               // of all parts
  std::vector<double> positions_;        // of all parts' vertices
  std::vector<Index> origins_;           // unless welding by position: accessor and number of every vertex
  Welded points_;                        // the points of the vertices
  std::map<std::string, Index> widths_;  // of every channel of the mesh
  ReadMesh result_;
};

Result<void> MeshReader::read_part(Index primitive, const Place& place) {
  const tinygltf::Primitive& structure = asset_.model.meshes[gltf_mesh_].primitives[primitive];
  auto data = read_primitive(asset_, structure, place);
  if (!data) return data.error();
  Part part{primitive, *std::move(data), vertex_count_};
  part.data.corners = to_triangle_list(std::move(part.data.corners), static_cast<Count>(structure.mode));
  if (part.data.corners.empty()) {
    asset_.warnings.add("A primitive whose triangles all repeat a vertex is left as it is", place.pointer());
    return {};
  }
  const std::vector<Index> original = compact(part.data, asset_.warnings, place);
  vertex_count_ += part.data.vertex_count;
  append(positions_, std::move(part.data.positions));
  if (options_.weld == Weld::none)
    for (Index vertex = 0; vertex < part.data.vertex_count; ++vertex)
      origins_.insert(origins_.end(),
                      {part.data.position_accessor, original.empty() ? vertex : original[vertex]});
  for (const PrimitiveChannel& channel : part.data.channels) {
    Index& width = widths_[channel.name];
    width = std::max(width, channel.components);
  }
  result_.has_normals |= part.data.has_normals;
  parts_.push_back(std::move(part));
  return {};
}

// For every corner of the mesh the id of its vertex.
std::vector<Index> MeshReader::corner_ids(const Welded& weld) const {
  const std::vector<RenderMesh>& renders = result_.mesh.render_meshes;
  if (weld.all_differ() && parts_.size() == 1) return renders.front().indices;
  Count count = 0;
  for (const RenderMesh& render : renders) count += render.indices.size();
  std::vector<Index> ids(count);
  Index* out = ids.data();
  for (Count i = 0; i < parts_.size(); ++i) {
    const Index* id = weld.id.data() + parts_[i].first_vertex;
    for (const Index corner : renders[i].indices) *out++ = id[corner];
  }
  return ids;
}

// Points, faces and render meshes.
void MeshReader::connect() {
  points_ = options_.weld == Weld::exact ? weld_tuples(positions_, 3) : weld_tuples(origins_, 2);
  ControlMesh& mesh = result_.mesh;
  mesh.points = std::move(positions_);
  keep_first(mesh.points, 3, points_);
  Index face = 0;
  for (Part& part : parts_) {
    const auto faces = static_cast<Index>(part.data.corners.size() / 3);
    mesh.render_meshes.push_back({face, face + faces, part.data.vertex_count, std::move(part.data.corners)});
    face += faces;
  }
  mesh.face_vertex_indices = corner_ids(points_);
}

// A channel has an index for every corner of the mesh, even if one small primitive has it: a thousand names
// for one vertex beside a large primitive would take a thousand times the input.
Result<void> MeshReader::check_channel_size() const {
  Count bytes = 0;
  for (const auto& [name, width] : widths_)
    bytes += result_.mesh.face_vertex_indices.size() * sizeof(Index) +
             Count{vertex_count_} * width * sizeof(double);
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
  const double padding = semantic_of(name) == Semantic::color ? 1 : 0;  // a colour without alpha is opaque
  Primvar primvar{name, Interpolation::face_varying, width, {}, {}};
  std::vector<Index> groups = points_.all_differ() ? std::vector<Index>() : points_.id;
  for (Part& part : parts_) {
    auto& channels = part.data.channels;
    const auto found =
        std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == name; });
    if (found != channels.end()) {
      append(primvar.values, widened(std::move(found->values), found->components, width, padding));
      continue;
    }
    append(primvar.values, std::vector<double>(Count{part.data.vertex_count} * width));
    if (groups.empty()) continue;
    const auto first = groups.begin() + part.first_vertex;
    for (Index& group : std::span(first, part.data.vertex_count))
      group += static_cast<Index>(points_.first.size());
  }
  if (groups.empty()) {  // every vertex has a point, and so a value, of its own
    primvar.indices = corner_ids(points_);
  } else {
    const Welded weld = weld_tuples(primvar.values, width, groups);
    keep_first(primvar.values, width, weld);
    primvar.indices = corner_ids(weld);
  }
  result_.mesh.primvars.push_back(std::move(primvar));
}

Result<ReadMesh> MeshReader::read() {
  const tinygltf::Mesh& structure = asset_.model.meshes[gltf_mesh_];
  result_.mesh.name = structure.name;
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
