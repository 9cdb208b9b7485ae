#pragma once
// THE list of members that refer to accessors and bufferViews. Checking, pruning and renumbering all go
// through it, so none of them can forget a place.

#include "proto/gltf/fields.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

enum class Referenced { accessors, buffer_views };

namespace references {

template <class J, class F>
void each_element(J& object, std::string_view name, const Place& place, const F& visit) {
  auto* array = object.find(name);
  if (array == nullptr || array->array() == nullptr) return;
  const Place inside = place.at(name);
  Count i = 0;
  for (auto& element : *array->array()) visit(element, inside.at(i++));
}

template <class J, class F>
void each_member(J& object, std::string_view name, const Place& place, const F& visit) {
  auto* found = object.find(name);
  if (found == nullptr || found->object() == nullptr) return;
  const Place inside = place.at(name);
  for (auto& member : *found->object()) visit(member.value, inside.at(member.name));
}

template <class J, class F>
void one(J& object, std::string_view name, const Place& place, const F& visit) {
  if (auto* found = object.find(name); found != nullptr && !found->is_null()) visit(*found, place.at(name));
}

}  // namespace references

// visit(reference, kind, place) for every known reference that is present and not null, wherever the
// document has the expected shape. J is Json or const Json.
template <class J, class F>
void visit_references(J& document, const F& visit) {
  namespace r = references;
  const auto accessor = [&](J& value, const Place& at) {
    if (!value.is_null()) visit(value, Referenced::accessors, at);
  };
  const auto view = [&](J& value, const Place& at) { visit(value, Referenced::buffer_views, at); };
  const Place root;
  r::each_element(document, "meshes", root, [&](J& mesh, const Place& at_mesh) {
    r::each_element(mesh, "primitives", at_mesh, [&](J& primitive, const Place& at) {
      r::each_member(primitive, "attributes", at, accessor);
      r::one(primitive, "indices", at, accessor);
      r::each_element(primitive, "targets", at, [&](J& target, const Place& at_target) {
        if (target.object() == nullptr) return;
        for (auto& member : *target.object()) accessor(member.value, at_target.at(member.name));
      });
    });
  });
  r::each_element(document, "nodes", root, [&](J& node, const Place& at_node) {
    J* extensions = node.find("extensions");
    if (extensions == nullptr) return;
    const Place at_extensions = at_node.at("extensions");
    if (J* instancing = extensions->find("EXT_mesh_gpu_instancing"))
      r::each_member(*instancing, "attributes", at_extensions.at("EXT_mesh_gpu_instancing"), accessor);
  });
  r::each_element(document, "skins", root,
                  [&](J& skin, const Place& at) { r::one(skin, "inverseBindMatrices", at, accessor); });
  r::each_element(document, "animations", root, [&](J& animation, const Place& at_animation) {
    r::each_element(animation, "samplers", at_animation, [&](J& sampler, const Place& at) {
      r::one(sampler, "input", at, accessor);
      r::one(sampler, "output", at, accessor);
    });
  });
  r::each_element(document, "images", root,
                  [&](J& image, const Place& at) { r::one(image, "bufferView", at, view); });
  r::each_element(document, "accessors", root, [&](J& element, const Place& at) {
    r::one(element, "bufferView", at, view);
    J* sparse = element.find("sparse");
    if (sparse == nullptr) return;
    const Place at_sparse = at.at("sparse");
    for (const char* part : {"indices", "values"})
      if (J* found = sparse->find(part)) r::one(*found, "bufferView", at_sparse.at(part), view);
  });
}

}  // namespace subdivd::proto::gltf
