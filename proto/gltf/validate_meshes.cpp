#include "proto/gltf/validate_meshes.h"

#include <algorithm>

#include "proto/gltf/caps.h"
#include "proto/gltf/fields.h"
#include "proto/gltf/ngons.h"
#include "proto/gltf/semantics.h"

namespace subdivd::proto::gltf {
namespace {

struct Checker {
  const Layout& layout;
  const Limits& limits;
  Work& work;
  Count materials = 0;
  bool quantized = false;  // KHR_mesh_quantization is in use
  Count primitive_count = 0;
  Count decoded_bytes = 0, empty_bytes = 0;

  Result<void> mesh(const Json& json, const Place& place);
  Result<void> primitive(const Json& json, const Place& place);
  Result<Count> attributes(const Json& json, const Place& place);  // how many vertices
  Result<void> attribute_type(std::string_view name, const AccessorInfo& info, const Place& place) const;
  Result<Count> indices(const Json& json, const Place& place);  // how many; 0 when not indexed
  Result<void> decode(const AccessorInfo& info, Count elements, const Place& place);
  Result<void> decode(Count bytes, const Place& place);
};

bool is_small_integer(const AccessorInfo& info) { return info.component < kUnsignedInt; }

Result<void> Checker::attribute_type(std::string_view name, const AccessorInfo& info,
                                     const Place& place) const {
  const Semantic semantic = semantic_of(name);
  const bool normalized_unsigned =
      info.normalized && (info.component == kUnsignedByte || info.component == kUnsignedShort);
  const bool real = info.component == kFloat;
  if (semantic == Semantic::position) {
    if (info.type != "VEC3" || !(real || (quantized && is_small_integer(info))))
      return error_at(
          place, ErrorCode::wrong_type,
          "POSITION must be VEC3 of float, or of 8 or 16 bit integers with KHR_mesh_quantization");
  } else if (semantic == Semantic::texcoord) {
    if (info.type != "VEC2" || !(real || normalized_unsigned || (quantized && is_small_integer(info))))
      return error_at(place, ErrorCode::wrong_type,
                      "TEXCOORD must be VEC2 of float or of normalized unsigned integers");
  } else if (semantic == Semantic::color) {
    if ((info.type != "VEC3" && info.type != "VEC4") || !(real || normalized_unsigned))
      return error_at(place, ErrorCode::wrong_type,
                      "COLOR must be VEC3 or VEC4 of float or of normalized unsigned integers");
  }
  return {};
}

Result<void> Checker::decode(Count bytes, const Place& place) {
  decoded_bytes += bytes;
  if (decoded_bytes <= limits.max_output_bytes) return {};
  return over_limit(place, decoded_bytes, limits.max_output_bytes,
                    "the primitives hold " + std::to_string(decoded_bytes) + " bytes or more; " +
                        std::to_string(limits.max_output_bytes) + " are allowed");
}

// Elements without data cost the caller nothing: they may be as many as a body could hold.
Result<void> Checker::decode(const AccessorInfo& info, Count elements, const Place& place) {
  if (!info.view) {
    empty_bytes += elements * info.components * component_size(info.component);
    if (empty_bytes > limits.max_body_bytes) {
      return over_limit(place, empty_bytes, limits.max_body_bytes,
                        "accessors without \"bufferView\" stand for " + std::to_string(empty_bytes) +
                            " bytes or more; " + std::to_string(limits.max_body_bytes) + " are allowed");
    }
  }
  return decode(elements * info.components * sizeof(double), place);
}

Result<Count> Checker::attributes(const Json& json, const Place& place) {
  const auto found = required_object(json, "attributes", place);
  if (!found) return found.error();
  const Place inside = place.at("attributes");
  const Json::Object& members = *(*found)->object();
  if (members.empty()) return error_at(inside, ErrorCode::missing_field, "\"POSITION\" is missing");
  if (members.size() > kMaxAttributes) {
    return over_limit(inside, members.size(), kMaxAttributes,
                      "the primitive has " + std::to_string(members.size()) + " attributes; " +
                          std::to_string(kMaxAttributes) + " are allowed");
  }
  // Of a long array that many primitives share each reads the vertices that it uses.
  const Json* indices = json.find("indices");
  const Count used =
      indices == nullptr || indices->is_null() ? kMaxIndexCount : layout.accessors[*indices->integer()].count;
  std::optional<Count> count;
  for (const Json::Member& member : members) {
    const Place here = inside.at(member.name);
    if (member.value.is_null())
      return error_at(here, ErrorCode::wrong_type, "an accessor's index is needed here");
    const AccessorInfo& info = layout.accessors[*member.value.integer()];
    if (count.value_or(info.count) != info.count)
      return error_at(here, ErrorCode::wrong_length,
                      "attributes of a primitive must have the same length: this one has " +
                          std::to_string(info.count) + " elements, the one before it " +
                          std::to_string(*count));
    count = info.count;
    if (auto good = attribute_type(member.name, info, here); !good) return good.error();
    if (auto good = decode(info, std::min(info.count, used), here); !good) return good.error();
  }
  return *count;
}

Result<Count> Checker::indices(const Json& json, const Place& place) {
  const Json* reference = json.find("indices");
  if (reference == nullptr) return Count{0};
  const Place here = place.at("indices");
  if (reference->is_null())
    return error_at(here, ErrorCode::wrong_type, "an accessor's index is needed here");
  const AccessorInfo& info = layout.accessors[*reference->integer()];
  const bool is_unsigned =
      info.component == kUnsignedByte || info.component == kUnsignedShort || info.component == kUnsignedInt;
  if (info.type != "SCALAR" || !is_unsigned || info.normalized)
    return error_at(here, ErrorCode::wrong_type,
                    "indices must be SCALAR of unsigned integers, not normalized");
  if (!info.view)
    return error_at(here, ErrorCode::unsupported,
                    "indices without \"bufferView\" are not read by this version");
  if (layout.views[*info.view].stride != 0)
    return error_at(here, ErrorCode::out_of_range, "the bufferView of indices must have no \"byteStride\"");
  if (auto good = decode(info.count * sizeof(Index), here); !good) return good.error();
  return info.count;
}

Result<void> Checker::primitive(const Json& json, const Place& place) {
  if (auto stop = work.spend(64)) return *std::move(stop);
  if (++primitive_count > kMaxPrimitives) {
    return over_limit(
        place, primitive_count, kMaxPrimitives,
        "the meshes have more than the " + std::to_string(kMaxPrimitives) + " primitives that are allowed");
  }
  if (auto is = expect_object(json, place); !is) return is.error();
  const auto material = optional_reference(json, "material", place, "materials", materials);
  if (!material) return material.error();
  const auto mode_number = optional_integer(json, "mode", place, {kPoints, kTriangleFan});
  if (!mode_number) return mode_number.error();
  const Count mode = mode_number->value_or(kTriangles);
  if (const Json* ngons = ngon_encoding_of(json)) {
    const Place extensions = place.at("extensions");
    if (auto is = expect_object(*ngons, extensions.at(kNgonEncoding)); !is) return is.error();
  }
  const auto vertices = attributes(json, place);
  if (!vertices) return vertices.error();
  const auto index_count = indices(json, place);
  if (!index_count) return index_count.error();
  const auto targets = optional_array(json, "targets", place);
  if (!targets) return targets.error();

  if (mode != kPoints && json.find("attributes")->find("POSITION") == nullptr)
    return error_at(place.at("attributes"), ErrorCode::missing_field, "\"POSITION\" is missing");
  const Count corners = *index_count != 0 ? *index_count : *vertices;
  const Count least = mode == kPoints ? 1 : mode < kTriangles ? 2 : 3;
  const Count unit = mode == kLines || mode == kTriangles ? least : 1;
  if (corners < least || corners % unit != 0)
    return error_at(place.at(*index_count != 0 ? "indices" : "attributes"), ErrorCode::wrong_length,
                    std::to_string(corners) + " vertices do not make primitives of mode " +
                        std::to_string(mode) + (unit > 1 ? ": a multiple of " : ": at least ") +
                        std::to_string(least) + " is needed");
  return {};
}

Result<void> Checker::mesh(const Json& json, const Place& place) {
  if (auto name = optional_string(json, "name", place); !name) return name.error();
  const auto primitives = optional_array(json, "primitives", place);
  if (!primitives) return primitives.error();
  const Place all = place.at("primitives");
  if (*primitives == nullptr || (*primitives)->array()->empty())
    return error_at(place, ErrorCode::missing_field, "the mesh has no \"primitives\"");
  Count i = 0;
  for (const Json& element : *(*primitives)->array())
    if (auto good = primitive(element, all.at(i++)); !good) return good.error();
  return {};
}

bool lists(const Json& document, std::string_view array, std::string_view name) {
  const Json* found = document.find(array);
  if (found == nullptr) return false;
  const Json::Array& names = *found->array();
  return std::any_of(names.begin(), names.end(), [&](const Json& json) { return *json.string() == name; });
}

}  // namespace

Result<void> check_meshes(const Json& document, const Layout& layout, const Limits& limits, Work& work) {
  Checker checker{layout, limits, work};
  if (const Json* materials = document.find("materials")) checker.materials = materials->array()->size();
  checker.quantized = lists(document, "extensionsUsed", "KHR_mesh_quantization") ||
                      lists(document, "extensionsRequired", "KHR_mesh_quantization");
  const Place root, all = root.at("meshes");
  const Json* meshes = document.find("meshes");
  if (meshes == nullptr)
    return error_at(root, ErrorCode::missing_field,
                    "the asset has no \"meshes\": there is nothing to refine");
  Count i = 0;
  for (const Json& json : *meshes->array())
    if (auto good = checker.mesh(json, all.at(i++)); !good) return good.error();
  return {};
}

}  // namespace subdivd::proto::gltf
