#include "proto/gltf/primitive.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/mesh/scan.h"
#include "proto/gltf/layout.h"

namespace subdivd::proto::gltf {
namespace {

Result<std::vector<double>> read_finite(const Asset& asset, Index accessor, const Place& place) {
  std::vector<double> values = read_reals(asset.model, asset.buffers, accessor);
  if (all_finite(values)) return values;
  const auto bad =
      std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  return error_at(place, ErrorCode::not_finite,
                  "scalar number " + std::to_string(bad - values.begin()) + " is not a finite number");
}

Result<std::vector<Index>> read_corners(const Asset& asset, const tinygltf::Primitive& primitive,
                                        Index vertex_count, const Place& place) {
  std::vector<Index> corners;
  if (primitive.indices < 0) {
    corners.resize(vertex_count);
    std::iota(corners.begin(), corners.end(), Index{0});
    return corners;
  }
  const auto accessor = static_cast<Index>(primitive.indices);
  corners = read_indices(asset.model, asset.buffers, accessor);
  const Count size = component_size(static_cast<Count>(asset.model.accessors[accessor].componentType));
  const Index restart = static_cast<Index>((Count{1} << (8 * size)) - 1);
  if (all_below(corners, std::min(vertex_count, restart))) return corners;
  const auto bad = std::find_if(corners.begin(), corners.end(),
                                [&](Index index) { return index >= vertex_count || index == restart; });
  return error_at(
      place.at("indices"), ErrorCode::out_of_range,
      "index number " + std::to_string(bad - corners.begin()) + " is " + std::to_string(*bad) +
          (*bad == restart ? ", the primitive restart value, which glTF does not allow"
                           : "; the primitive has " + std::to_string(vertex_count) + " vertices"));
}

// Whether the attribute comes along; warns when it does not.
bool carries(const std::string& name, const tinygltf::Accessor& accessor, const Asset& asset,
             const Place& place) {
  switch (semantic_of(name)) {
    case Semantic::position:
    case Semantic::normal:
      return false;
    case Semantic::tangent:
      asset.warnings.add("TANGENT is dropped: viewers derive it from normals and texture coordinates",
                         place.pointer());
      return false;
    case Semantic::skinning:
      asset.warnings.add("Joints and weights of skins are not carried over", place.pointer());
      return false;
    case Semantic::unknown:
      asset.warnings.add("An attribute of unknown meaning is dropped",
                         place.at("attributes").at(name).pointer());
      return false;
    case Semantic::custom:
      if (accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
          accessor.type == TINYGLTF_TYPE_MAT4) {
        asset.warnings.add("A custom attribute of matrices is dropped",
                           place.at("attributes").at(name).pointer());
        return false;
      }
      return true;
    case Semantic::texcoord:
    case Semantic::color:
      return true;
  }
  return false;
}

}  // namespace

Result<PrimitiveData> read_primitive(const Asset& asset, const tinygltf::Primitive& primitive,
                                     const Place& place) {
  PrimitiveData data;
  const Place attributes = place.at("attributes");
  data.position_accessor = static_cast<Index>(primitive.attributes.at("POSITION"));
  auto positions = read_finite(asset, data.position_accessor, attributes.at("POSITION"));
  if (!positions) return positions.error();
  data.positions = *std::move(positions);
  data.vertex_count = static_cast<Index>(data.positions.size() / 3);
  auto corners = read_corners(asset, primitive, data.vertex_count, place);
  if (!corners) return corners.error();
  data.corners = *std::move(corners);
  data.has_normals = primitive.attributes.contains("NORMAL");
  for (const auto& [name, index] : primitive.attributes) {
    const auto accessor = static_cast<Index>(index);
    if (!carries(name, asset.model.accessors[accessor], asset, place)) continue;
    auto values = read_finite(asset, accessor, attributes.at(name));
    if (!values) return values.error();
    const auto components = static_cast<Index>(values->size() / data.vertex_count);
    data.channels.push_back({name, components, *std::move(values)});
  }
  return data;
}

}  // namespace subdivd::proto::gltf
