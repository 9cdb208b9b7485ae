#include "proto/gltf/prune.h"

#include <algorithm>
#include <numeric>

#include "proto/gltf/references.h"

namespace subdivd::proto::gltf {
namespace {

Json::Array* array_of(Json& document, std::string_view name) {
  Json* found = document.find(name);
  return found == nullptr ? nullptr : found->array();
}

Count size_of(const Json& document, std::string_view name) {
  const Json* found = document.find(name);
  return found == nullptr ? 0 : found->array()->size();
}

// Keeps the elements whose flag is set; an array left empty is removed. Returns the new numbers.
std::vector<Count> keep(Json& document, std::string_view name, const std::vector<bool>& kept) {
  std::vector<Count> renumbered(kept.size(), kNoIndex);
  Json::Array* array = array_of(document, name);
  if (array == nullptr) return renumbered;
  Json::Array left;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    renumbered[i] = left.size();
    left.push_back(std::move((*array)[i]));
  }
  *array = std::move(left);
  if (array->empty()) document.erase(name);
  return renumbered;
}

void renumber(Json& document, Referenced which, const std::vector<Count>& numbers) {
  visit_references(document, [&](Json& reference, Referenced kind, const Place&) {
    if (kind == which) reference = Json::number(numbers[*reference.integer()]);
  });
}

std::vector<bool> not_orphaned(const std::vector<bool>& before, const std::vector<bool>& after) {
  std::vector<bool> kept(before.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = after[i] || !before[i];
  return kept;
}

struct View {
  Json* json = nullptr;
  Count buffer = 0, offset = 0, length = 0;
};

std::vector<View> views_of(Json& document) {
  std::vector<View> views;
  Json::Array* array = array_of(document, "bufferViews");
  if (array == nullptr) return views;
  for (Json& json : *array) {
    const Json* offset = json.find("byteOffset");
    views.push_back({&json, *json.find("buffer")->integer(), offset == nullptr ? 0 : *offset->integer(),
                     *json.find("byteLength")->integer()});
  }
  return views;
}

// Copies the union of the views' byte ranges and moves the views there. Ranges begin at multiples of 4, so
// every alignment that held still holds.
std::vector<std::byte> gather(Json& document, const Buffers& buffers) {
  std::vector<View> views = views_of(document);
  std::stable_sort(views.begin(), views.end(), [](const View& a, const View& b) {
    return a.buffer != b.buffer ? a.buffer < b.buffer : a.offset < b.offset;
  });
  std::vector<std::byte> data;
  Count buffer = kNoIndex, begin = 0, end = 0, target = 0;  // of the current range; target: of its begin
  for (const View& view : views) {
    if (view.buffer != buffer || view.offset > end) {
      data.resize((data.size() + 3) / 4 * 4);
      buffer = view.buffer;
      begin = end = view.offset / 4 * 4;
      target = data.size();
    }
    if (const Count stop = view.offset + view.length; stop > end) {
      const Bytes more = buffers.bytes[buffer].subspan(end, stop - end);
      data.insert(data.end(), more.begin(), more.end());
      end = stop;
    }
    view.json->set("buffer", Json::number(Count{0}));
    const Count offset = target + (view.offset - begin);
    if (offset != 0 || view.json->find("byteOffset") != nullptr)
      view.json->set("byteOffset", Json::number(offset));
  }
  return data;
}

}  // namespace

References collect_references(const Json& document) {
  References found;
  found.accessors.resize(size_of(document, "accessors"));
  found.views.resize(size_of(document, "bufferViews"));
  visit_references(document, [&](const Json& reference, Referenced kind, const Place&) {
    (kind == Referenced::accessors ? found.accessors : found.views)[*reference.integer()] = true;
  });
  return found;
}

std::vector<std::byte> prune(Json& document, const References& before, const Buffers& buffers) {
  const auto accessors = not_orphaned(before.accessors, collect_references(document).accessors);
  renumber(document, Referenced::accessors, keep(document, "accessors", accessors));
  // Now the removed accessors hold no views any more.
  const auto views = not_orphaned(before.views, collect_references(document).views);
  renumber(document, Referenced::buffer_views, keep(document, "bufferViews", views));
  std::vector<std::byte> data = gather(document, buffers);
  if (Json::Array* array = array_of(document, "buffers")) {
    array->resize(1);
    array->front().erase("uri");
  }
  return data;
}

}  // namespace subdivd::proto::gltf
