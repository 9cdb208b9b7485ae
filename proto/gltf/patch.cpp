#include "proto/gltf/patch.h"

#include <algorithm>
#include <set>

#include "proto/gltf/deformation.h"
#include "proto/gltf/extensions.h"
#include "proto/gltf/prune.h"

namespace subdivd::proto::gltf {
namespace {

// Attributes that will be written stay as null, so that they keep their place among the others.
void empty_attributes(Json& primitive, const std::vector<AttributeSlot>& slots, bool normals) {
  Json::Object kept;
  for (Json::Member& member : *primitive.find("attributes")->object()) {
    const bool written = member.name == "POSITION" || (normals && member.name == "NORMAL") ||
                         std::any_of(slots.begin(), slots.end(),
                                     [&](const AttributeSlot& s) { return s.name == member.name; });
    if (written) kept.push_back({std::move(member.name), Json()});
  }
  primitive.set("attributes", Json(std::move(kept)));
}

Json& primitive_at(Json& document, Index mesh, Index primitive) {
  return (*(*document.find("meshes")->array())[mesh].find("primitives")->array())[primitive];
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
  Json* used = document.find("extensionsUsed");
  if (used == nullptr) return;
  std::erase_if(*used->array(), [&](const Json& json) { return *json.string() == name; });
  if (used->array()->empty()) document.erase("extensionsUsed");
}

}  // namespace

void patch(Source& source, const Buffers& buffers, Warnings& warnings) {
  const bool only_append = has_unknown_extension(source.document);
  const References before = collect_references(source.document);
  bool had_draco = false;
  std::set<Index> refined_meshes;
  for (const TrianglesSlot& slot : source.triangles) {
    Json& primitive = primitive_at(source.document, slot.mesh, slot.primitive);
    empty_attributes(primitive, slot.attributes, slot.normals);
    if (primitive.find("indices") != nullptr) primitive.set("indices", Json());
    set_mode(primitive, kTriangles);
    had_draco |= drop_draco(primitive);
    refined_meshes.insert(slot.mesh);
  }
  for (const CurvesSlot& slot : source.curves) {
    Json& primitive = primitive_at(source.document, slot.mesh, slot.primitive);
    empty_attributes(primitive, slot.attributes, false);
    if (slot.mode == kLines && primitive.find("indices") != nullptr) {
      primitive.set("indices", Json());
    } else {
      primitive.erase("indices");
    }
    refined_meshes.insert(slot.mesh);
  }
  if (had_draco) forget_extension(source.document, "KHR_draco_mesh_compression");
  drop_deformation(source.document, refined_meshes, warnings);
  if (only_append) {
    if (!buffers.bytes.empty()) source.data.assign(buffers.bytes[0].begin(), buffers.bytes[0].end());
  } else {
    source.data = prune(source.document, before, buffers);
  }
  source.data.resize((source.data.size() + 3) / 4 * 4);
}

}  // namespace subdivd::proto::gltf
