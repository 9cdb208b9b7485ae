#include "proto/gltf/patch.h"

#include <algorithm>

#include "proto/gltf/deformation.h"
#include "proto/gltf/extensions.h"
#include "proto/gltf/ngons.h"
#include "proto/gltf/prune.h"

namespace subdivd::proto::gltf {
namespace {

// Attributes that will be written stay as null, so that they keep their place among the others. `slots` are
// in the order of their names.
void empty_attributes(Json& primitive, const std::vector<AttributeSlot>& slots, bool normals) {
  Json::Object kept;
  kept.reserve(primitive.find("attributes")->object()->size());
  for (Json::Member& member : *primitive.find("attributes")->object()) {
    const auto slot =
        std::lower_bound(slots.begin(), slots.end(), member.name,
                         [](const AttributeSlot& s, const std::string& name) { return s.name < name; });
    const bool written = member.name == "POSITION" || (normals && member.name == "NORMAL") ||
                         (slot != slots.end() && slot->name == member.name);
    if (written) kept.push_back({std::move(member.name), Json()});
  }
  primitive.set("attributes", Json(std::move(kept)));
}

Json& primitive_at(Json::Array& meshes, Index mesh, Index primitive) {
  return (*meshes[mesh].find("primitives")->array())[primitive];
}

void set_mode(Json& primitive, Count mode) {
  if (mode == kTriangles && primitive.find("mode") == nullptr) return;
  primitive.set("mode", Json::number(mode));
}

bool drop_draco(Json& primitive) {
  Json* extensions = primitive.find("extensions");
  if (extensions == nullptr || extensions->find("KHR_draco_mesh_compression") == nullptr) return false;
  extensions->erase("KHR_draco_mesh_compression");
  if (extensions->object()->empty()) primitive.erase("extensions");
  return true;
}

void forget_extension(Json& document, std::string_view name) {
  for (const std::string_view list : {"extensionsUsed", "extensionsRequired"}) {
    Json* names = document.find(list);
    if (names == nullptr) continue;
    std::erase_if(*names->array(), [&](const Json& json) { return *json.string() == name; });
    if (names->array()->empty()) document.erase(list);
  }
}

// Whether a primitive that stays as it is has it.
Result<bool> has_ngons(const Json::Array& meshes, Work& work) {
  for (const Json& mesh : meshes)
    for (const Json& primitive : *mesh.find("primitives")->array()) {
      if (auto stop = work.spend(4)) return *std::move(stop);
      if (ngon_encoding_of(primitive) != nullptr) return true;
    }
  return false;
}

}  // namespace

Result<void> patch(Source& source, const Buffers& buffers, bool only_append, Warnings& warnings, Work& work) {
  const auto before = collect_references(source.document, work);
  if (!before) return before.error();
  Json::Array& meshes = *source.document.find("meshes")->array();
  bool had_draco = false, had_ngons = false;
  std::vector<bool> refined_meshes(meshes.size());
  for (const TrianglesSlot& slot : source.triangles) {
    if (auto stop = work.spend(64)) return *std::move(stop);
    Json& primitive = primitive_at(meshes, slot.mesh, slot.primitive);
    empty_attributes(primitive, slot.attributes, slot.normals);
    if (primitive.find("indices") != nullptr) primitive.set("indices", Json());
    set_mode(primitive, kTriangles);
    had_draco |= drop_draco(primitive);
    had_ngons |= drop_ngon_encoding(primitive);
    refined_meshes[slot.mesh] = true;
  }
  for (const CurvesSlot& slot : source.curves) {
    if (auto stop = work.spend(64)) return *std::move(stop);
    Json& primitive = primitive_at(meshes, slot.mesh, slot.primitive);
    empty_attributes(primitive, slot.attributes, false);
    if (slot.mode == kLines && primitive.find("indices") != nullptr) {
      primitive.set("indices", Json());
    } else {
      primitive.erase("indices");
    }
    had_ngons |= drop_ngon_encoding(primitive);
    refined_meshes[slot.mesh] = true;
  }
  if (had_draco) forget_extension(source.document, "KHR_draco_mesh_compression");
  if (had_ngons) {
    const auto others = has_ngons(meshes, work);
    if (!others) return others.error();
    if (!*others) forget_extension(source.document, kNgonEncoding);
  }
  if (auto dropped = drop_deformation(source.document, refined_meshes, warnings, work); !dropped)
    return dropped;
  if (!only_append) {
    auto data = prune(source.document, *before, buffers, work);
    if (!data) return data.error();
    source.data = *std::move(data);
  } else if (!buffers.bytes.empty()) {
    const Bytes first = buffers.bytes[0];
    if (auto kept = work.keep(first.size() + 4 + kBlockBytes); !kept) return kept;
    source.data.reserve(first.size() + 4);
    if (auto copied = append_bytes(source.data, first, work); !copied) return copied;
  }
  source.data.resize((source.data.size() + 3) / 4 * 4);
  return {};
}

}  // namespace subdivd::proto::gltf
