#include "proto/gltf/structure.h"

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <new>
#include <string>
#include <utility>

#include "proto/gltf/fields.h"
#include "proto/gltf/primitive.h"

namespace subdivd::proto::gltf {
namespace {

// Elements of a slice: milliseconds of work.
constexpr std::size_t kSlice = 256;
// What an element of a slice takes while tinygltf reads it: the text, nlohmann's tree of it, and lists that
// grow by doubling (measured: 1,550 and 3,150 bytes).
constexpr Count kViewBytes = 2048, kAccessorBytes = 4096;
constexpr Count kReaderBytes = 2048;  // what does not depend on the slice

using Names = std::initializer_list<std::string_view>;

// Numbers of the document's elements that are used, and their places among these.
struct Used {
  std::vector<Index> places;   // kNoIndex: not used
  std::vector<Index> numbers;  // ascending
};

void pick(const Json& object, Names names, Json& picked) {
  for (const std::string_view name : names)
    if (const Json* value = object.find(name)) picked.set(name, *value);
}

void set_view(const Json& object, const Used& views, Json& reduced) {
  if (const Json* view = object.find("bufferView"))
    reduced.set("bufferView", Json::number(Count{views.places[*view->integer()]}));
}

Json reduce_view(const Json& view) {
  Json reduced{Json::Object()};
  pick(view, {"buffer", "byteOffset", "byteLength", "byteStride"}, reduced);
  return reduced;
}

Json reduce_accessor(const Json& accessor, const Used& views) {
  Json reduced{Json::Object()};
  set_view(accessor, views, reduced);
  pick(accessor, {"byteOffset", "componentType", "count", "type", "normalized"}, reduced);
  if (const Json* sparse = accessor.find("sparse")) {
    Json& copy = reduced.set("sparse", Json(Json::Object()));
    pick(*sparse, {"count"}, copy);
    for (const std::string_view name : {"indices", "values"}) {
      const Json& part = *sparse->find(name);
      Json& part_copy = copy.set(name, Json(Json::Object()));
      set_view(part, views, part_copy);
      pick(part, {"byteOffset", "componentType"}, part_copy);
    }
  }
  return reduced;
}

bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                  int, void*) {
  return true;
}

// Its own words stay here: the document has been checked, so whatever they are nobody else is to blame.
Result<void> load(const std::string& text, tinygltf::Model& model) {
  tinygltf::TinyGLTF loader;
  // Neither is ever called for a reduced document; were one to slip through, nothing is opened or decoded.
  loader.SetImageLoader(ignore_image, nullptr);
  loader.SetFsCallbacks({});
  std::string error, warning;
  bool loaded = false;
  try {
    loaded = loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                        static_cast<unsigned>(text.size()), "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    loaded = false;
  }
  if (loaded) return {};
  // It catches what nlohmann's parser throws, and keeps the words alone.
  if (error == std::bad_alloc().what()) throw std::bad_alloc();
  return Error{ErrorCode::internal, "the glTF reader refused a checked asset"};
}

Result<std::string> document_of(const char* array, Json::Array slice, Work& work) {
  Json document{Json::Object()};
  document.set("asset", Json(Json::Object())).set("version", "2.0");
  document.set(array, Json(std::move(slice)));
  std::string text;
  if (auto printed = document.print(text, work); !printed) return printed.error();
  return text;
}

// Reads `reduce(element)` of the elements `numbers` of document[array] into model.*list.
template <class T, class F>
Result<void> load_slices(const Json& document, const char* array, const std::vector<Index>& numbers,
                         std::vector<T> tinygltf::Model::*list, const F& reduce, Count element_bytes,
                         tinygltf::Model& model, Work& work) {
  if (auto kept = work.keep(numbers.size() * sizeof(T) + kBlockBytes); !kept) return kept;
  (model.*list).reserve(numbers.size());
  const Json::Array* const elements = numbers.empty() ? nullptr : document.find(array)->array();
  for (std::size_t begin = 0; begin < numbers.size(); begin += kSlice) {
    const std::size_t end = std::min(numbers.size(), begin + kSlice);
    const Count bytes = (end - begin) * element_bytes + kReaderBytes;
    const auto held = work.hold(bytes);
    if (!held) return held.error();
    // nlohmann's destructors allocate, and end the program when they cannot: where there is not enough
    // memory, this says so before. (A new expression could be optimized away.)
    ::operator delete(::operator new(bytes));
    Json::Array slice;
    slice.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) slice.push_back(reduce((*elements)[numbers[i]]));
    const auto text = document_of(array, std::move(slice), work);
    if (!text) return text.error();
    tinygltf::Model read;
    if (auto good = load(*text, read); !good) return good;
    (model.*list)
        .insert((model.*list).end(), std::make_move_iterator((read.*list).begin()),
                std::make_move_iterator((read.*list).end()));
    if (auto stop = work.spend(Pace::kBlock)) return *std::move(stop);
  }
  if ((model.*list).size() == numbers.size()) return {};
  return Error{ErrorCode::internal, "the glTF reader left something out"};
}

constexpr Index kUsed = 0;

// Gives what is marked its place.
Result<void> number(Used& used, Work& work) {
  const auto count = static_cast<Count>(std::count(used.places.begin(), used.places.end(), kUsed));
  if (auto kept = work.keep(count * sizeof(Index) + kBlockBytes); !kept) return kept;
  used.numbers.reserve(count);
  for (Index i = 0; i < used.places.size(); ++i) {
    if (used.places[i] != kUsed) continue;
    used.places[i] = static_cast<Index>(used.numbers.size());
    used.numbers.push_back(i);
  }
  return {};
}

Result<Used> used_accessors(const Json& document, const Layout& layout, Work& work) {
  Used used{std::vector<Index>(layout.accessors.size(), kNoIndex), {}};
  for (const Json& mesh : *document.find("meshes")->array()) {
    for (const Json& primitive : *mesh.find("primitives")->array()) {
      if (auto stop = work.spend(64)) return *std::move(stop);
      if (mode_of(primitive) == kPoints) continue;
      for (const Json::Member& attribute : *primitive.find("attributes")->object())
        used.places[*attribute.value.integer()] = kUsed;
      if (const Json* indices = primitive.find("indices")) used.places[*indices->integer()] = kUsed;
    }
  }
  if (auto good = number(used, work); !good) return good.error();
  return used;
}

Result<Used> used_views(const Json& document, const Used& accessors, const Layout& layout, Work& work) {
  Used used{std::vector<Index>(layout.views.size(), kNoIndex), {}};
  const auto mark = [&](const Json& object) {
    if (const Json* view = object.find("bufferView")) used.places[*view->integer()] = kUsed;
  };
  for (const Index number : accessors.numbers) {
    if (auto stop = work.spend(16)) return *std::move(stop);
    const Json& accessor = (*document.find("accessors")->array())[number];
    mark(accessor);
    if (const Json* sparse = accessor.find("sparse"))
      for (const std::string_view part : {"indices", "values"}) mark(*sparse->find(part));
  }
  if (auto good = number(used, work); !good) return good.error();
  return used;
}

}  // namespace

Result<Structure> load_structure(const Json& document, const Layout& layout, Work& work) {
  if (auto kept =
          work.keep((layout.accessors.size() + layout.views.size()) * sizeof(Index) + 2 * kBlockBytes);
      !kept)
    return kept.error();
  auto accessors = used_accessors(document, layout, work);
  if (!accessors) return accessors.error();
  const auto views = used_views(document, *accessors, layout, work);
  if (!views) return views.error();
  Structure structure;
  if (auto good = load_slices(document, "bufferViews", views->numbers, &tinygltf::Model::bufferViews,
                              reduce_view, kViewBytes, structure.model, work);
      !good)
    return good.error();
  const auto reduce = [&](const Json& accessor) { return reduce_accessor(accessor, *views); };
  if (auto good = load_slices(document, "accessors", accessors->numbers, &tinygltf::Model::accessors, reduce,
                              kAccessorBytes, structure.model, work);
      !good)
    return good.error();
  structure.accessor_places = std::move(accessors->places);
  work.drop((layout.views.size() + views->numbers.size() + accessors->numbers.size()) * sizeof(Index));
  return structure;
}

}  // namespace subdivd::proto::gltf
