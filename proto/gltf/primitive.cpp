#include "proto/gltf/primitive.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/base/all_finite.h"
#include "core/mesh/scan.h"
#include "proto/gltf/caps.h"
#include "proto/gltf/polled_sort.h"

namespace subdivd::proto::gltf {
namespace {

Result<std::vector<Index>> read_corners(const Asset& asset, const Json& primitive, Index vertex_count,
                                        const Place& place) {
  const Json* reference = primitive.find("indices");
  if (reference == nullptr) {
    if (auto kept = asset.work.keep(vertex_count * sizeof(Index) + kBlockBytes); !kept) return kept.error();
    std::vector<Index> corners(vertex_count);
    Index next = 0;
    const auto done = for_pieces(std::span(corners), asset.work, [&](std::span<Index> piece) {
      std::iota(piece.begin(), piece.end(), next);
      next += static_cast<Index>(piece.size());
      return true;
    });
    if (!done) return done.error();
    return corners;
  }
  const auto accessor = static_cast<Index>(*reference->integer());
  const tinygltf::Accessor& info = asset.elements.structure.accessor(accessor);
  if (auto kept = asset.work.keep(info.count * sizeof(Index) + kBlockBytes); !kept) return kept.error();
  auto corners = read_indices(asset.elements, accessor, asset.work);
  if (!corners) return corners;
  const Count size = component_size(static_cast<Count>(info.componentType));
  const Index restart = static_cast<Index>((Count{1} << (8 * size)) - 1);
  const auto good = for_pieces(
      std::span<const Index>(*corners), asset.work,
      [&](std::span<const Index> piece) { return all_below(piece, std::min(vertex_count, restart)); });
  if (!good) return good.error();
  if (*good) return corners;
  const auto bad = std::find_if(corners->begin(), corners->end(),
                                [&](Index index) { return index >= vertex_count || index == restart; });
  return error_at(
      place.at("indices"), ErrorCode::out_of_range,
      "index number " + std::to_string(bad - corners->begin()) + " is " + std::to_string(*bad) +
          (*bad == restart ? ", the primitive restart value, which glTF does not allow"
                           : "; the primitive has " + std::to_string(vertex_count) + " vertices"));
}

// Whether the attribute comes along; warns when it does not.
bool carries(std::string_view name, const tinygltf::Accessor& accessor, const Asset& asset,
             const Place& place) {
  switch (semantic_of(name)) {
    case Semantic::position:
    case Semantic::normal:
      return false;
    case Semantic::tangent:
      asset.warnings.add("TANGENT is dropped: viewers derive it from normals and texture coordinates", place);
      return false;
    case Semantic::skinning:
      asset.warnings.add("Joints and weights of skins are not carried over", place);
      return false;
    case Semantic::unknown:
      asset.warnings.add("An attribute of unknown meaning is dropped", place.at("attributes").at(name));
      return false;
    case Semantic::custom:
      if (accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
          accessor.type == TINYGLTF_TYPE_MAT4) {
        asset.warnings.add("A custom attribute of matrices is dropped", place.at("attributes").at(name));
        return false;
      }
      return true;
    case Semantic::texcoord:
    case Semantic::color:
      return true;
  }
  return false;
}

// The corners' vertices, each once, ascending.
Result<std::vector<Index>> used_vertices(const PrimitiveData& data, Work& work) {
  std::vector<Index> used;
  // A triangle of a long array looks for its own vertices; whoever uses a good part of it marks them.
  if (data.corners.size() < data.vertex_count / 4) {
    if (auto kept = work.keep(data.corners.size() * sizeof(Index) + kBlockBytes); !kept) return kept.error();
    used = data.corners;
    if (auto sorted = polled_sort(used, std::less<>(), work); !sorted) return sorted.error();
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }
  const auto held = work.hold(data.vertex_count + kBlockBytes);
  if (!held) return held.error();
  std::vector<unsigned char> is_used;
  if (auto grown = grow(is_used, data.vertex_count, work); !grown) return grown.error();
  auto done = for_pieces(std::span<const Index>(data.corners), work, [&](std::span<const Index> piece) {
    for (const Index corner : piece) is_used[corner] = 1;
    return true;
  });
  if (!done) return done.error();
  Count count = 0;
  done = for_pieces(std::span<const unsigned char>(is_used), work, [&](std::span<const unsigned char> piece) {
    count += std::accumulate(piece.begin(), piece.end(), Count{0});
    return true;
  });
  if (!done) return done.error();
  if (count == data.vertex_count) return used;
  if (auto kept = work.keep(count * sizeof(Index) + kBlockBytes); !kept) return kept.error();
  used.reserve(count);
  Index vertex = 0;
  done = for_pieces(std::span<const unsigned char>(is_used), work, [&](std::span<const unsigned char> piece) {
    for (const unsigned char flag : piece) {
      if (flag != 0) used.push_back(vertex);
      ++vertex;
    }
    return true;
  });
  if (!done) return done.error();
  return used;
}

}  // namespace

std::string short_name(const Json& mesh) {
  const Json* name = mesh.find("name");
  if (name == nullptr) return {};
  std::size_t size = std::min<std::size_t>(name->string()->size(), kMaxRepeatedName);
  const auto continues = [&](std::size_t at) {  // a character that began before
    return at < name->string()->size() && (static_cast<unsigned char>((*name->string())[at]) & 0xC0) == 0x80;
  };
  while (continues(size)) --size;
  return name->string()->substr(0, size);
}

Count mode_of(const Json& primitive) {
  const Json* mode = primitive.find("mode");
  return mode == nullptr ? Count{kTriangles} : *mode->integer();
}

Result<PrimitiveData> read_primitive(const Asset& asset, const Json& primitive, const Place& place) {
  PrimitiveData data;
  const Json::Object& attributes = *primitive.find("attributes")->object();
  if (auto stop = asset.work.spend(64)) return *std::move(stop);
  for (const Json::Member& attribute : attributes) {
    const auto accessor = static_cast<Index>(*attribute.value.integer());
    const tinygltf::Accessor& info = asset.elements.structure.accessor(accessor);
    if (attribute.name == "POSITION") {
      data.position_accessor = accessor;
      data.vertex_count = static_cast<Index>(info.count);
    }
    data.has_normals |= attribute.name == "NORMAL";
    if (carries(attribute.name, info, asset, place))
      data.channels.push_back({attribute.name, accessor, components_of(info)});
  }
  std::sort(data.channels.begin(), data.channels.end(),
            [](const PrimitiveChannel& a, const PrimitiveChannel& b) { return a.name < b.name; });
  auto corners = read_corners(asset, primitive, data.vertex_count, place);
  if (!corners) return corners.error();
  data.corners = *std::move(corners);
  return data;
}

Result<Index> leave_out_unused(PrimitiveData& data, Work& work) {
  auto used = used_vertices(data, work);
  if (!used) return used.error();
  if (used->empty()) return Index{0};
  const auto count = static_cast<Index>(used->size());
  // As above: few look for their new numbers, many look them up.
  const bool few = data.corners.size() < data.vertex_count / 4;
  const auto held = work.hold(few ? 0 : Count{data.vertex_count} * sizeof(Index) + kBlockBytes);
  if (!held) return held.error();
  std::vector<Index> renumbered;
  if (auto grown = grow(renumbered, few ? 0 : data.vertex_count, work); !grown) return grown.error();
  if (!few) {
    for (Index i = 0; i < count; ++i) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      renumbered[(*used)[i]] = i;
    }
  }
  for (Index& corner : data.corners) {
    if (auto stop = work.spend(few ? 8 : 1)) return *std::move(stop);
    corner = few ? static_cast<Index>(std::lower_bound(used->begin(), used->end(), corner) - used->begin())
                 : renumbered[corner];
  }
  const Index left_out = data.vertex_count - count;
  data.vertex_count = count;
  data.original = *std::move(used);
  return left_out;
}

Result<void> append_values(const Asset& asset, const PrimitiveData& data, Index accessor, const Place& place,
                           std::vector<double>& out) {
  const std::size_t begin = out.size();
  if (auto read = append_reals(asset.elements, accessor, data.original, out, asset.work); !read) return read;
  const std::span<const double> values = std::span<const double>(out).subspan(begin);
  const auto good =
      for_pieces(values, asset.work, [](std::span<const double> piece) { return all_finite(piece); });
  if (!good) return good.error();
  if (*good) return {};
  const auto bad = static_cast<Count>(
      std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }) -
      values.begin());
  const Count width = components_of(asset.elements.structure.accessor(accessor));
  const Count element = data.original.empty() ? bad / width : data.original[bad / width];
  return error_at(
      place, ErrorCode::not_finite,
      "scalar number " + std::to_string(element * width + bad % width) + " is not a finite number");
}

}  // namespace subdivd::proto::gltf
