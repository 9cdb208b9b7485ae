#include "proto/gltf/structure.h"

#include <exception>
#include <initializer_list>
#include <limits>

namespace subdivd::proto::gltf {
namespace {

using Names = std::initializer_list<std::string_view>;

Json pick(const Json& object, Names names) {
  Json picked{Json::Object()};
  for (const std::string_view name : names)
    if (const Json* value = object.find(name)) picked.set(name, *value);
  return picked;
}

template <class F>
Json each(const Json& document, std::string_view array, const F& reduce) {
  Json::Array reduced;
  if (const Json* found = document.find(array))
    for (const Json& element : *found->array()) reduced.push_back(reduce(element));
  return Json(std::move(reduced));
}

Json reduce_accessor(const Json& accessor) {
  Json reduced = pick(accessor, {"bufferView", "byteOffset", "componentType", "count", "type", "normalized"});
  if (const Json* sparse = accessor.find("sparse")) {
    Json& copy = reduced.set("sparse", pick(*sparse, {"count"}));
    for (const std::string_view part : {"indices", "values"})
      copy.set(part, pick(*sparse->find(part), {"bufferView", "byteOffset", "componentType"}));
  }
  return reduced;
}

Json reduce_mesh(const Json& mesh) {
  Json reduced = pick(mesh, {"name"});
  reduced.set("primitives", each(mesh, "primitives", [](const Json& primitive) {
                return pick(primitive, {"mode", "indices", "material", "attributes"});
              }));
  return reduced;
}

Json reduce(const Json& document) {
  Json reduced{Json::Object()};
  reduced.set("asset", Json()).set("version", "2.0");
  reduced.set("bufferViews", each(document, "bufferViews", [](const Json& view) {
                return pick(view, {"buffer", "byteOffset", "byteLength", "byteStride"});
              }));
  reduced.set("accessors", each(document, "accessors", reduce_accessor));
  reduced.set("meshes", each(document, "meshes", reduce_mesh));
  return reduced;
}

Error failed(const std::string& why) {
  return Error{ErrorCode::internal, "the glTF reader refused a checked asset: " + why, {}, 0, 0};
}

bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                  int, void*) {
  return true;
}

}  // namespace

Result<tinygltf::Model> load_structure(const Json& document) {
  const std::string text = reduce(document).text();
  if (text.size() > std::numeric_limits<unsigned>::max()) return failed("text over 4 GiB");
  tinygltf::TinyGLTF loader;
  // Neither is ever called for a reduced document; were one to slip through, nothing is opened or decoded.
  loader.SetImageLoader(ignore_image, nullptr);
  loader.SetFsCallbacks({});
  tinygltf::Model model;
  std::string error, warning;
  try {
    if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                    ""))
      return failed(error);
  } catch (const std::exception& exception) {
    return failed(exception.what());
  }
  return model;
}

}  // namespace subdivd::proto::gltf
