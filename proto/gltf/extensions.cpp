#include "proto/gltf/extensions.h"

#include <algorithm>
#include <array>

namespace subdivd::proto::gltf {
namespace {

constexpr auto kKnown = std::to_array<std::string_view>(
    {"EXT_lights_image_based", "EXT_mesh_gpu_instancing", "EXT_texture_avif", "EXT_texture_webp",
     "FB_ngon_encoding", "KHR_animation_pointer", "KHR_lights_punctual", "KHR_mesh_quantization",
     "KHR_node_visibility", "KHR_texture_basisu", "KHR_texture_transform", "KHR_xmp", "KHR_xmp_json_ld",
     "MSFT_lod", "MSFT_texture_dds"});

bool is_empty(const Json& value) {
  if (const Json::Object* members = value.object()) return members->empty();
  if (const Json::Array* elements = value.array()) return elements->empty();
  return value.is_null();
}

}  // namespace

bool is_known_extension(std::string_view name) {
  return name.starts_with("KHR_materials_") || std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
}

Result<bool> has_unknown_extension(const Json& document, Work& work) {
  if (auto stop = work.spend(4)) return *std::move(stop);
  if (const Json::Array* elements = document.array()) {
    for (const Json& element : *elements)
      if (auto unknown = has_unknown_extension(element, work); !unknown || *unknown) return unknown;
    return false;
  }
  const Json::Object* members = document.object();
  if (members == nullptr) return false;
  for (const Json::Member& member : *members) {
    if (member.name == "extras") continue;
    if (member.name == "extensions" && member.value.object() != nullptr) {
      for (const Json::Member& extension : *member.value.object()) {
        // Compressed copies of geometry that refinement replaces: their primitive loses them.
        if (extension.name == "KHR_draco_mesh_compression") continue;
        if (!is_known_extension(extension.name) && !is_empty(extension.value)) return true;
        if (auto unknown = has_unknown_extension(extension.value, work); !unknown || *unknown) return unknown;
      }
    } else if (auto unknown = has_unknown_extension(member.value, work); !unknown || *unknown) {
      return unknown;
    }
  }
  return false;
}

}  // namespace subdivd::proto::gltf
