#include "proto/gltf/read_triangles.h"

#include <algorithm>
#include <map>
#include <utility>

#include "proto/gltf/caps.h"
#include "proto/gltf/ngons.h"
#include "proto/gltf/tuples.h"
#include "proto/gltf/weld.h"

namespace subdivd::proto::gltf {
namespace {

// One triangle primitive. Its corners move on to the mesh.
struct Part {
  Index primitive = 0;
  PrimitiveData data;
  bool has_ngons = false;  // its triangles are pieces of polygons
  Index first_vertex = 0;  // of the mesh's vertices
  Count next_channel = 0;  // of data.channels, while the mesh's channels are read by name
  Index face_end = 0;      // of the mesh's faces, those of this part end here
};

class MeshReader {
 public:
  MeshReader(const Asset& asset, Index mesh, const Options& options, const Limits& limits, const Place& place)
      : asset_(asset),
        work_(asset.work),
        options_(options),
        limits_(limits),
        place_(place),
        gltf_mesh_(mesh) {}

  Result<ReadMesh> read();

 private:
  // What the mesh's primitives have under one name.
  struct Channel {
    Index number = 0;  // of the mesh's primvars
    Index width = 0;
  };

  Result<void> read_part(Index primitive, const Json& json, const Place& place);
  Result<void> read_positions();
  Result<Welded> weld_points(const std::vector<double>& positions);
  Result<void> join_faces();
  Result<void> connect();
  Result<std::vector<Index>> corner_ids(const Welded& weld) const;
  Result<void> check_channels() const;
  Result<void> add_channel(std::string_view name, Index width);
  Result<void> append_part(Part& part, std::string_view name, Index width, Primvar& primvar,
                           std::vector<Index>& groups);
  void add_slots();

  const Asset& asset_;
  Work& work_;
  const Options& options_;
  const Limits& limits_;
  const Place& place_;
  Index gltf_mesh_;
  std::vector<Part> parts_;
  Count vertex_count_ = 0;                        // of all parts
  std::map<std::string_view, Channel> channels_;  // of the whole mesh
  Welded points_;                                 // the points of the vertices
  ReadMesh result_;
};

Result<void> MeshReader::read_part(Index primitive, const Json& json, const Place& place) {
  auto data = read_primitive(asset_, json, place);
  if (!data) return data.error();
  Count beside = sizeof(RenderMesh) + sizeof(TrianglesSlot) + 3 * kBlockBytes;
  for (const PrimitiveChannel& channel : data->channels)
    beside += 3 * sizeof(PrimitiveChannel) + sizeof(AttributeSlot) + channel.name.size() + kBlockBytes;
  if (auto kept = work_.keep(beside); !kept) return kept;
  auto triangles = to_triangle_list(std::move(data->corners), mode_of(json), work_);
  if (!triangles) return triangles.error();
  data->corners = *std::move(triangles);
  if (data->corners.empty()) {
    asset_.warnings.add("A primitive whose triangles all repeat a vertex is left as it is", place);
    return {};
  }
  const auto left_out = leave_out_unused(*data, work_);
  if (!left_out) return left_out.error();
  if (*left_out > 0) asset_.warnings.add("Vertices that no triangle uses are left out", place, *left_out);
  for (const PrimitiveChannel& channel : data->channels) {
    Index& width = channels_[channel.name].width;
    width = std::max(width, channel.components);
  }
  if (channels_.size() > kMaxAttributes)
    return over_limit(place_, channels_.size(), kMaxAttributes,
                      "the primitives of the mesh have more than the " + std::to_string(kMaxAttributes) +
                          " different attributes that are allowed");
  result_.has_normals |= data->has_normals;
  const auto first_vertex = static_cast<Index>(vertex_count_);
  vertex_count_ += data->vertex_count;
  if (vertex_count_ > kMaxIndexCount)
    return over_limit(place_, vertex_count_, kMaxIndexCount,
                      "the mesh has more vertices than indices of 32 bits can number");
  const bool has_ngons = mode_of(json) == kTriangles && ngon_encoding_of(json) != nullptr;
  parts_.push_back({primitive, *std::move(data), has_ngons, first_vertex, 0, 0});
  return {};
}

Result<void> MeshReader::read_positions() {
  const Place all = place_.at("primitives");
  std::vector<double>& points = result_.mesh.points;
  if (auto kept = work_.keep(vertex_count_ * 3 * sizeof(double) + kBlockBytes); !kept) return kept;
  points.reserve(vertex_count_ * 3);
  for (const Part& part : parts_) {
    const Place place = all.at(part.primitive), attributes = place.at("attributes");
    if (auto read =
            append_values(asset_, part.data, part.data.position_accessor, attributes.at("POSITION"), points);
        !read)
      return read;
  }
  return {};
}

// Unless by position, vertices are the same when their accessor and their number in it are.
Result<Welded> MeshReader::weld_points(const std::vector<double>& positions) {
  if (options_.weld == Weld::exact) return weld_tuples(positions, 3, {}, work_);
  const auto held = work_.hold(vertex_count_ * 2 * sizeof(Index) + kBlockBytes);
  if (!held) return held.error();
  std::vector<Index> origins;
  origins.reserve(vertex_count_ * 2);
  for (const Part& part : parts_)
    for (Index vertex = 0; vertex < part.data.vertex_count; ++vertex) {
      if (auto stop = work_.spend(1)) return *std::move(stop);
      origins.push_back(part.data.position_accessor);
      origins.push_back(part.data.original.empty() ? vertex : part.data.original[vertex]);
    }
  return weld_tuples(origins, 2, work_);
}

// For every corner of the mesh the id of its vertex.
Result<std::vector<Index>> MeshReader::corner_ids(const Welded& weld) const {
  const std::vector<RenderMesh>& renders = result_.mesh.render_meshes;
  Count count = 0;
  for (const RenderMesh& render : renders) count += render.indices.size();
  if (auto kept = work_.keep(count * sizeof(Index) + kBlockBytes); !kept) return kept.error();
  std::vector<Index> ids;
  ids.reserve(count);
  for (Count i = 0; i < parts_.size(); ++i) {
    if (auto stop = work_.spend(16)) return *std::move(stop);
    const Index* const id = weld.id.data() + parts_[i].first_vertex;
    const bool is_vertex = weld.all_differ() && parts_[i].first_vertex == 0;
    const auto done = for_pieces(std::span(renders[i].indices), work_, [&](std::span<const Index> piece) {
      const std::size_t begin = ids.size();
      ids.insert(ids.end(), piece.begin(), piece.end());
      if (!is_vertex)
        for (Index& corner : std::span(ids).subspan(begin)) corner = id[corner];
      return true;
    });
    if (!done) return done.error();
  }
  return ids;
}

// Makes polygons of the triangles of parts that say so. How many corners faces have is told where any has more than 3.
Result<void> MeshReader::join_faces() {
  Count triangles = 0;
  for (Part& part : parts_) {
    triangles += part.data.corners.size() / 3;
    part.face_end = static_cast<Index>(triangles);
  }
  if (std::ranges::none_of(parts_, &Part::has_ngons)) return {};
  if (auto kept = work_.keep(triangles * sizeof(Index) + kBlockBytes); !kept) return kept;
  const auto held = work_.hold(points_.first.size() * sizeof(Index) + kBlockBytes);
  if (!held) return held.error();
  std::vector<Index> faces_of, sizes;
  if (auto grown = grow(faces_of, points_.first.size(), work_, kNoIndex); !grown) return grown;
  sizes.reserve(triangles);
  for (Part& part : parts_) {
    if (part.has_ngons) {
      const auto points = std::span(points_.id).subspan(part.first_vertex, part.data.vertex_count);
      if (auto joined = join_triangles(part.data.corners, points, faces_of, sizes, work_); !joined)
        return joined;
    } else if (auto grown = grow(sizes, sizes.size() + part.data.corners.size() / 3, work_, 3); !grown) {
      return grown;
    }
    part.face_end = static_cast<Index>(sizes.size());
  }
  if (sizes.size() < triangles) result_.mesh.face_vertex_counts = std::move(sizes);
  return {};
}

// Points, faces and render meshes.
Result<void> MeshReader::connect() {
  ControlMesh& mesh = result_.mesh;
  if (auto read = read_positions(); !read) return read;
  auto points = weld_points(mesh.points);
  if (!points) return points.error();
  points_ = *std::move(points);
  if (auto moved = keep_first(mesh.points, 3, points_, work_); !moved) return moved;
  if (auto joined = join_faces(); !joined) return joined;
  Index face = 0;
  mesh.render_meshes.reserve(parts_.size());
  for (Part& part : parts_) {
    mesh.render_meshes.push_back({face, part.face_end, part.data.vertex_count, std::move(part.data.corners)});
    face = part.face_end;
  }
  auto ids = corner_ids(points_);
  if (!ids) return ids.error();
  mesh.face_vertex_indices = *std::move(ids);
  return {};
}

// A channel has an index for every corner of the mesh, even if one small primitive has it: a few names for
// one vertex beside a large primitive take many times the input.
Result<void> MeshReader::check_channels() const {
  Count bytes = 0;
  for (const auto& [name, channel] : channels_)
    bytes += result_.mesh.face_vertex_indices.size() * sizeof(Index) +
             vertex_count_ * channel.width * sizeof(double);
  if (bytes <= limits_.max_output_bytes) return {};
  return over_limit(place_, bytes, limits_.max_output_bytes,
                    "the attributes of this mesh take " + std::to_string(bytes) + " bytes; " +
                        std::to_string(limits_.max_output_bytes) + " are allowed");
}

// Appends the part's values. Primitives that lack the attribute get zeros, and groups of their own.
Result<void> MeshReader::append_part(Part& part, std::string_view name, Index width, Primvar& primvar,
                                     std::vector<Index>& groups) {
  if (auto stop = work_.spend(8)) return *std::move(stop);
  const auto& channels = part.data.channels;
  if (part.next_channel < channels.size() && channels[part.next_channel].name == name) {
    const PrimitiveChannel& channel = channels[part.next_channel++];
    const Place all = place_.at("primitives"), place = all.at(part.primitive),
                attributes = place.at("attributes");
    if (auto read = append_values(asset_, part.data, channel.accessor, attributes.at(name), primvar.values);
        !read)
      return read;
    const double padding = semantic_of(name) == Semantic::color ? 1 : 0;  // a colour without alpha is opaque
    return widen_last(primvar.values, part.data.vertex_count, channel.components, width, padding, work_);
  }
  for (Index vertex = 0; vertex < part.data.vertex_count; ++vertex) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    primvar.values.insert(primvar.values.end(), width, 0.0);
    if (!groups.empty()) groups[part.first_vertex + vertex] += static_cast<Index>(points_.first.size());
  }
  return {};
}

// Values are welded when they belong to the same point and are bit-identical. Primitives that lack the
// attribute get a zero of their own at each point, apart from every value that was given.
Result<void> MeshReader::add_channel(std::string_view name, Index width) {
  if (auto kept = work_.keep(vertex_count_ * width * sizeof(double) + name.size() + 2 * kBlockBytes); !kept)
    return kept;
  Primvar primvar{std::string(name), Interpolation::face_varying, width, {}, {}};
  primvar.values.reserve(vertex_count_ * width);
  const bool split = !points_.all_differ();
  const auto held = work_.hold(split ? vertex_count_ * sizeof(Index) + kBlockBytes : 0);
  if (!held) return held.error();
  std::vector<Index> groups = split ? points_.id : std::vector<Index>();
  for (Part& part : parts_)
    if (auto appended = append_part(part, name, width, primvar, groups); !appended) return appended;
  Welded weld;
  if (split) {
    auto welded = weld_tuples(primvar.values, width, groups, work_);
    if (!welded) return welded.error();
    weld = *std::move(welded);
    if (auto moved = keep_first(primvar.values, width, weld, work_); !moved) return moved;
  }
  // Without groups every vertex has a point, and so a value, of its own.
  auto ids = corner_ids(split ? weld : points_);
  if (!ids) return ids.error();
  primvar.indices = *std::move(ids);
  result_.mesh.primvars.push_back(std::move(primvar));
  return {};
}

void MeshReader::add_slots() {
  result_.slots.reserve(parts_.size());
  for (Index i = 0; i < parts_.size(); ++i) {
    TrianglesSlot slot{
        gltf_mesh_, parts_[i].primitive, 0, i, parts_[i].data.has_normals || options_.normals, options_.ngons,
        {}};
    slot.attributes.reserve(parts_[i].data.channels.size());
    for (const PrimitiveChannel& channel : parts_[i].data.channels)
      slot.attributes.push_back(
          {std::string(channel.name), channels_.find(channel.name)->second.number, 0, channel.components});
    result_.slots.push_back(std::move(slot));
  }
}

Result<ReadMesh> MeshReader::read() {
  const Json& json = asset_.meshes[gltf_mesh_];
  result_.mesh.name = short_name(json);
  const Json::Array& primitives = *json.find("primitives")->array();
  const Place all = place_.at("primitives");
  Count triangles = 0;
  for (Index i = 0; i < primitives.size(); ++i) {
    if (auto stop = work_.spend(8)) return *std::move(stop);
    triangles += mode_of(primitives[i]) >= kTriangles;
    if (mode_of(primitives[i]) != kTriangles && ngon_encoding_of(primitives[i]) != nullptr)
      asset_.warnings.add("FB_ngon_encoding tells of lists of triangles alone and is ignored elsewhere",
                          all.at(i));
  }
  if (triangles == 0) return std::move(result_);
  const auto held = work_.hold(triangles * sizeof(Part) + kBlockBytes);
  if (!held) return held.error();
  parts_.reserve(triangles);
  for (Index i = 0; i < primitives.size(); ++i) {
    if (mode_of(primitives[i]) < kTriangles) continue;
    if (auto read = read_part(i, primitives[i], all.at(i)); !read) return read.error();
  }
  if (auto connected = connect(); !connected) return connected.error();
  if (auto fits = check_channels(); !fits) return fits.error();
  Index number = 0;
  result_.mesh.primvars.reserve(channels_.size());
  for (auto& [name, channel] : channels_) {
    channel.number = number++;
    if (auto added = add_channel(name, channel.width); !added) return added.error();
  }
  add_slots();
  return std::move(result_);
}

}  // namespace

Result<std::vector<Index>> to_triangle_list(std::vector<Index> corners, Count mode, Work& work) {
  if (mode == kTriangles) return corners;
  if (auto kept = work.keep(corners.size() * 3 * sizeof(Index) + kBlockBytes); !kept) return kept.error();
  std::vector<Index> list;
  list.reserve(corners.size() * 3);
  const auto add = [&](Index a, Index b, Index c) {
    if (a != b && b != c && c != a) list.insert(list.end(), {a, b, c});
  };
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    if (mode == kTriangleFan) {
      add(corners[i + 1], corners[i + 2], corners[0]);
    } else {
      add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  }
  work.drop(corners.size() * sizeof(Index));
  return list;
}

Result<ReadMesh> read_triangles(const Asset& asset, Index mesh, const Options& options, const Limits& limits,
                                const Place& place) {
  return MeshReader(asset, mesh, options, limits, place).read();
}

}  // namespace subdivd::proto::gltf
