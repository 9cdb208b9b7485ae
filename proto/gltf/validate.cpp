#include "proto/gltf/validate.h"

#include <algorithm>
#include <array>
#include <optional>

#include "proto/gltf/caps.h"
#include "proto/gltf/extensions.h"
#include "proto/gltf/fields.h"
#include "proto/gltf/references.h"
#include "proto/gltf/validate_meshes.h"
#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

constexpr auto kTopLevelArrays = std::to_array<std::string_view>(
    {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials", "meshes", "nodes",
     "samplers", "scenes", "skins", "textures"});

Count size_of(const Json& document, std::string_view array) {
  const Json* found = document.find(array);
  return found == nullptr ? 0 : found->array()->size();
}

Result<void> check_at_most(Count allowed, Count size, const std::string& what, const Place& place) {
  if (size <= allowed) return {};
  return over_limit(
      place, size, allowed,
      "there are " + std::to_string(size) + " " + what + "; " + std::to_string(allowed) + " are allowed");
}

Result<void> check_top_level(const Json& document, Work& work) {
  const Place root;
  if (auto few = check_at_most(kMaxRootMembers, document.object()->size(),
                               "members at the top of the document", root);
      !few)
    return few;
  for (const std::string_view name : kTopLevelArrays) {
    const auto array = optional_array(document, name, root);
    if (!array) return array.error();
    if (*array == nullptr) continue;
    const Place place = root.at(name);
    if ((*array)->array()->empty())
      return error_at(place, ErrorCode::wrong_length, "an empty array must be left out");
    if (auto few = check_at_most(name == "meshes" ? kMaxMeshes : kMaxElements, (*array)->array()->size(),
                                 std::string(name), place);
        !few)
      return few;
    if (auto stop = work.spend((*array)->array()->size())) return *std::move(stop);
    Count i = 0;
    for (const Json& element : *(*array)->array())
      if (auto is = expect_object(element, place.at(i++)); !is) return is.error();
  }
  return {};
}

Result<void> check_all_references(const Json& document, const Layout& layout, Work& work) {
  std::optional<Error> first;
  visit_references(document, [&](const Json& value, Referenced kind, const Place& place) {
    if (first || (first = work.spend(4))) return;
    const bool accessors = kind == Referenced::accessors;
    const auto index = check_reference(value, place, accessors ? "accessors" : "bufferViews",
                                       accessors ? layout.accessors.size() : layout.views.size());
    if (!index) first = index.error();
  });
  if (first) return *first;
  return {};
}

Result<void> check_index_array(const Json& object, std::string_view name, const Place& place,
                               std::string_view array, Count size, Work& work) {
  const auto indices = optional_array(object, name, place);
  if (!indices) return indices.error();
  if (*indices == nullptr) return {};
  const Place inside = place.at(name);
  Count i = 0;
  for (const Json& index : *(*indices)->array()) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    if (auto good = check_reference(index, inside.at(i++), array, size); !good) return good.error();
  }
  return {};
}

// Nodes form a forest: one parent each and no cycle, or whoever walks down the tree never returns.
Result<void> check_nodes(const Json& document, Work& work) {
  const Json* found = document.find("nodes");
  if (found == nullptr) return {};
  const Json::Array& nodes = *found->array();
  const Place root, all = root.at("nodes");
  struct Target {
    std::string_view member, array;
    Count size;
  };
  // Looked up once: a root object of a million members would be searched for every node.
  const std::array<Target, 3> targets{{{"mesh", "meshes", size_of(document, "meshes")},
                                       {"skin", "skins", size_of(document, "skins")},
                                       {"camera", "cameras", size_of(document, "cameras")}}};
  const auto held = work.hold(2 * (nodes.size() * sizeof(Index) + kBlockBytes));
  if (!held) return held.error();
  std::vector<Index> parent(nodes.size(), kNoIndex);
  for (Count i = 0; i < nodes.size(); ++i) {
    const Place place = all.at(i);
    if (auto stop = work.spend(16)) return *std::move(stop);
    for (const Target& target : targets) {
      const auto index = optional_reference(nodes[i], target.member, place, target.array, target.size);
      if (!index) return index.error();
    }
    if (auto good = check_index_array(nodes[i], "children", place, "nodes", nodes.size(), work); !good)
      return good.error();
    const Json* children = nodes[i].find("children");
    if (children == nullptr) continue;
    const Place inside = place.at("children");
    for (Count k = 0; k < children->array()->size(); ++k) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      Index& its_parent = parent[*(*children->array())[k].integer()];
      if (its_parent != kNoIndex)
        return error_at(inside.at(k), ErrorCode::out_of_range, "this node already has a parent");
      its_parent = static_cast<Index>(i);
    }
  }
  // Walking up from every node, each is entered once: `seen` holds the walk that came by.
  std::vector<Index> seen(nodes.size(), kNoIndex);
  for (Index start = 0; start < nodes.size(); ++start)
    for (Index node = start; node != kNoIndex; node = parent[node]) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      if (seen[node] == start)
        return error_at(all.at(node), ErrorCode::out_of_range, "this node is its own ancestor");
      if (seen[node] != kNoIndex) break;
      seen[node] = start;
    }
  return {};
}

Result<void> check_scenes(const Json& document, Work& work) {
  const Place root;
  const auto scene = optional_reference(document, "scene", root, "scenes", size_of(document, "scenes"));
  if (!scene) return scene.error();
  std::optional<Error> first;
  const Count nodes = size_of(document, "nodes");
  references::each_element(document, "scenes", root, [&](const Json& element, const Place& place) {
    if (first || (first = work.spend(8))) return;
    if (auto good = check_index_array(element, "nodes", place, "nodes", nodes, work); !good)
      first = good.error();
  });
  if (first) return *first;
  return {};
}

Result<void> check_animation(const Json& animation, const Place& place, Count nodes, Work& work) {
  const auto samplers = optional_array(animation, "samplers", place);
  if (!samplers) return samplers.error();
  const auto channels = optional_array(animation, "channels", place);
  if (!channels) return channels.error();
  if (*channels == nullptr) return {};
  const Place all = place.at("channels");
  Count i = 0;
  for (const Json& channel : *(*channels)->array()) {
    const Place here = all.at(i++);
    if (auto stop = work.spend(16)) return *std::move(stop);
    if (auto is = expect_object(channel, here); !is) return is.error();
    const auto sampler = required_reference(channel, "sampler", here, "samplers",
                                            *samplers == nullptr ? 0 : (*samplers)->array()->size());
    if (!sampler) return sampler.error();
    const auto target = required_object(channel, "target", here);
    if (!target) return target.error();
    const auto node = optional_reference(**target, "node", here.at("target"), "nodes", nodes);
    if (!node) return node.error();
  }
  return {};
}

Result<void> check_animations_and_skins(const Json& document, Work& work) {
  const Place root;
  std::optional<Error> first;
  const Count nodes = size_of(document, "nodes");
  references::each_element(document, "animations", root, [&](const Json& animation, const Place& place) {
    if (first || (first = work.spend(8))) return;
    if (auto good = check_animation(animation, place, nodes, work); !good) first = good.error();
  });
  references::each_element(document, "skins", root, [&](const Json& skin, const Place& place) {
    if (first || (first = work.spend(8))) return;
    if (auto good = check_index_array(skin, "joints", place, "nodes", nodes, work); !good)
      first = good.error();
  });
  if (first) return *first;
  return {};
}

}  // namespace

Result<void> check_asset(const Json& document, Work& work) {
  const Place root;
  if (document.object() == nullptr)
    return error_at(root, ErrorCode::wrong_type, "a glTF document is a JSON object");
  if (auto good = check_top_level(document, work); !good) return good.error();
  const auto asset = required_object(document, "asset", root);
  if (!asset) return asset.error();
  const Place place = root.at("asset");
  const auto version = optional_string(**asset, "version", place);
  if (!version) return version.error();
  if (*version == nullptr) return error_at(place, ErrorCode::missing_field, "\"version\" is missing");
  const auto minimum = optional_string(**asset, "minVersion", place);
  if (!minimum) return minimum.error();
  if (!(*version)->starts_with("2.") || (*minimum != nullptr && **minimum != "2.0"))
    return error_at(place.at(*minimum != nullptr && (*version)->starts_with("2.") ? "minVersion" : "version"),
                    ErrorCode::unsupported, "only glTF 2.0 is read");
  for (const std::string_view list : {"extensionsUsed", "extensionsRequired"}) {
    const auto names = optional_array(document, list, root);
    if (!names) return names.error();
    if (*names == nullptr) continue;
    const Place inside = root.at(list);
    Count i = 0;
    for (const Json& name : *(*names)->array()) {
      const Place here = inside.at(i++);
      if (auto stop = work.spend(8)) return *std::move(stop);
      if (name.string() == nullptr)
        return error_at(here, ErrorCode::wrong_type, "the name of an extension must stand here");
      if (list == "extensionsRequired" && !is_known_extension(*name.string()))
        return error_at(
            here, ErrorCode::unsupported,
            "the asset requires " + in_quotes(*name.string()) + ", which this version does not know");
    }
  }
  return {};
}

Result<void> check_structure(const Json& document, const Layout& layout, const Limits& limits, Work& work) {
  if (auto good = check_all_references(document, layout, work); !good) return good.error();
  if (auto good = check_nodes(document, work); !good) return good.error();
  if (auto good = check_scenes(document, work); !good) return good.error();
  if (auto good = check_animations_and_skins(document, work); !good) return good.error();
  return check_meshes(document, layout, limits, work);
}

}  // namespace subdivd::proto::gltf
