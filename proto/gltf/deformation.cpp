#include "proto/gltf/deformation.h"

#include <optional>

#include "proto/gltf/fields.h"
#include "proto/gltf/references.h"
#include "proto/gltf/semantics.h"

namespace subdivd::proto::gltf {
namespace {

// Whether morph targets were lost.
Result<bool> drop_from_mesh(Json& mesh, const Place& place, Warnings& warnings, Work& work) {
  bool targets = false;
  std::optional<Error> stop;
  references::each_element(mesh, "primitives", place, [&](Json& primitive, const Place& here) {
    if (stop || (stop = work.spend(64))) return;
    if (primitive.find("targets") != nullptr) {
      targets = true;
      primitive.erase("targets");
      warnings.add("Morph targets are not carried over", here);
    }
    // A point primitive beside refined ones: skinned without a skin it would be invalid.
    std::erase_if(*primitive.find("attributes")->object(),
                  [](const Json::Member& member) { return semantic_of(member.name) == Semantic::skinning; });
  });
  if (stop) return *std::move(stop);
  mesh.erase("weights");
  return targets;
}

// Whether an animation channel moves weights of what was dropped.
bool is_dead(const Json& channel, const std::vector<bool>& nodes) {
  const Json* target = channel.find("target");
  const Json* path = target->find("path");
  if (path == nullptr || path->string() == nullptr) return false;
  if (*path->string() == "weights") {
    const Json* node = target->find("node");
    return node != nullptr && nodes[*node->integer()];
  }
  if (const Json* extensions = target->find("extensions"))
    if (const Json* pointing = extensions->find("KHR_animation_pointer"))
      if (const Json* pointer = pointing->find("pointer"); pointer != nullptr && pointer->string() != nullptr)
        return pointer->string()->find("/weights") != std::string::npos;
  return false;
}

// Removes samplers that no channel uses any more. `was_used`: before channels were removed.
void drop_idle_samplers(Json& animation, const std::vector<bool>& was_used) {
  Json::Array& samplers = *animation.find("samplers")->array();
  Json::Array& channels = *animation.find("channels")->array();
  std::vector<bool> used(samplers.size());
  for (const Json& channel : channels) used[*channel.find("sampler")->integer()] = true;
  std::vector<Count> renumbered(samplers.size());
  Json::Array kept;
  for (std::size_t i = 0; i < samplers.size(); ++i) {
    renumbered[i] = kept.size();
    if (used[i] || !was_used[i]) kept.push_back(std::move(samplers[i]));
  }
  samplers = std::move(kept);
  for (Json& channel : channels)
    channel.set("sampler", Json::number(renumbered[*channel.find("sampler")->integer()]));
}

// False when nothing is left of the animation.
Result<bool> drop_channels(Json& animation, const std::vector<bool>& nodes, Work& work) {
  Json* found = animation.find("channels");
  Json* samplers = animation.find("samplers");
  if (found == nullptr || samplers == nullptr) return true;
  Json::Array& channels = *found->array();
  std::vector<bool> was_used(samplers->array()->size());
  for (const Json& channel : channels) was_used[*channel.find("sampler")->integer()] = true;
  std::optional<Error> stop;
  const auto dropped = std::erase_if(channels, [&](const Json& channel) {
    if (stop || (stop = work.spend(32))) return false;
    return is_dead(channel, nodes);
  });
  if (stop) return *std::move(stop);
  if (dropped == 0) return true;
  if (channels.empty()) return false;
  // Samplers that are kept go into a new array, which grows by doubling.
  if (auto kept = work.keep(samplers->array()->size() * 4 * sizeof(Json)); !kept) return kept.error();
  drop_idle_samplers(animation, was_used);
  return true;
}

}  // namespace

Result<void> drop_deformation(Json& document, const std::vector<bool>& meshes, Warnings& warnings,
                              Work& work) {
  const Place root, all_meshes = root.at("meshes");
  bool targets_lost = false;
  Json::Array& mesh_array = *document.find("meshes")->array();
  for (Count mesh = 0; mesh < meshes.size(); ++mesh) {
    if (!meshes[mesh]) continue;
    const auto lost = drop_from_mesh(mesh_array[mesh], all_meshes.at(mesh), warnings, work);
    if (!lost) return lost.error();
    targets_lost |= *lost;
  }

  std::vector<bool> affected;
  std::optional<Error> stop;
  references::each_element(document, "nodes", root, [&](Json& node, const Place& place) {
    if (stop || (stop = work.spend(16))) return;
    const Json* mesh = node.find("mesh");
    affected.push_back(mesh != nullptr && meshes[*mesh->integer()]);
    if (!affected.back()) return;
    if (node.find("skin") != nullptr) {
      warnings.add("Skinning is not carried over: the node's mesh stands in its bind pose", place);
      node.erase("skin");
    }
    node.erase("weights");
  });

  if (stop) return *std::move(stop);
  Json* animations = document.find("animations");
  if (animations == nullptr || !targets_lost) return {};
  const Place all_animations = root.at("animations");
  Count i = 0;
  Json::Array kept;
  for (Json& animation : *animations->array()) {
    const Place place = all_animations.at(i++);
    const auto left = drop_channels(animation, affected, work);
    if (!left) return left.error();
    if (*left) {
      kept.push_back(std::move(animation));
    } else {
      warnings.add("An animation of nothing but morph weights is dropped", place);
    }
  }
  if (kept.empty()) {
    document.erase("animations");
  } else {
    *animations = Json(std::move(kept));
  }
  return {};
}

}  // namespace subdivd::proto::gltf
