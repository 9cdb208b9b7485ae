#include "proto/gltf/prune.h"

#include <algorithm>
#include <optional>

#include "proto/gltf/polled_sort.h"
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
  left.reserve(static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true)));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    renumbered[i] = left.size();
    left.push_back(std::move((*array)[i]));
  }
  *array = std::move(left);
  if (array->empty()) document.erase(name);
  return renumbered;
}

Result<void> renumber(Json& document, Referenced which, const std::vector<Count>& numbers, Work& work) {
  std::optional<Error> stop;
  visit_references(document, [&](Json& reference, Referenced kind, const Place&) {
    if (stop || (stop = work.spend(8))) return;
    if (kind == which) reference = Json::number(numbers[*reference.integer()]);
  });
  if (stop) return *std::move(stop);
  return {};
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
  views.reserve(array->size());
  for (Json& json : *array) {
    const Json* offset = json.find("byteOffset");
    views.push_back({&json, *json.find("buffer")->integer(), offset == nullptr ? 0 : *offset->integer(),
                     *json.find("byteLength")->integer()});
  }
  return views;
}

// The union of the views' byte ranges, in order. A range begins at a multiple of 4 in its buffer and in
// `data`, so every alignment that held still holds.
struct Range {
  Count buffer = 0, begin = 0, end = 0, target = 0;
};

Count padded(Count size) { return (size + 3) / 4 * 4; }

// Also moves the views to where their bytes will be.
Result<std::vector<Range>> lay_out(std::vector<View> views, Work& work) {
  const auto by_place = [](const View& a, const View& b) {
    return a.buffer != b.buffer ? a.buffer < b.buffer : a.offset < b.offset;
  };
  if (auto sorted = polled_sort(views, by_place, work); !sorted) return sorted.error();
  std::vector<Range> ranges;
  for (const View& view : views) {
    if (auto stop = work.spend(16)) return *std::move(stop);
    if (ranges.empty() || view.buffer != ranges.back().buffer || view.offset > ranges.back().end) {
      const Count begin = view.offset / 4 * 4;
      const Count target =
          ranges.empty() ? 0 : padded(ranges.back().target + ranges.back().end - ranges.back().begin);
      ranges.push_back({view.buffer, begin, begin, target});
    }
    Range& range = ranges.back();
    range.end = std::max(range.end, view.offset + view.length);
    view.json->set("buffer", Json::number(Count{0}));
    const Count offset = range.target + (view.offset - range.begin);
    if (offset != 0 || view.json->find("byteOffset") != nullptr)
      view.json->set("byteOffset", Json::number(offset));
  }
  return ranges;
}

Result<std::vector<std::byte>> gather(Json& document, const Buffers& buffers, Work& work) {
  const Count count = size_of(document, "bufferViews");
  // A view that is given an offset may need a longer list of members.
  if (auto kept = work.keep(count * 4 * sizeof(Json::Member)); !kept) return kept.error();
  // Ranges grow by doubling.
  const auto held = work.hold(count * (sizeof(View) + 3 * sizeof(Range)) + 2 * kBlockBytes);
  if (!held) return held.error();
  const auto ranges = lay_out(views_of(document), work);
  if (!ranges) return ranges.error();
  std::vector<std::byte> data;
  if (ranges->empty()) return data;
  const Count size = padded(ranges->back().target + ranges->back().end - ranges->back().begin);
  if (auto kept = work.keep(size + kBlockBytes); !kept) return kept.error();
  data.reserve(size);
  for (const Range& range : *ranges) {
    data.resize(range.target);
    const Bytes bytes = buffers.bytes[range.buffer].subspan(range.begin, range.end - range.begin);
    if (auto copied = append_bytes(data, bytes, work); !copied) return copied.error();
  }
  return data;
}

}  // namespace

Result<void> append_bytes(std::vector<std::byte>& out, Bytes bytes, Work& work) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), kPiece))) {
    const Bytes piece = bytes.first(std::min(bytes.size(), kPiece));
    out.insert(out.end(), piece.begin(), piece.end());
    if (auto stop = work.spend_bytes(piece.size())) return *std::move(stop);
  }
  return {};
}

Result<References> collect_references(const Json& document, Work& work) {
  References found;
  found.accessors.resize(size_of(document, "accessors"));
  found.views.resize(size_of(document, "bufferViews"));
  std::optional<Error> stop;
  visit_references(document, [&](const Json& reference, Referenced kind, const Place&) {
    if (stop || (stop = work.spend(8))) return;
    (kind == Referenced::accessors ? found.accessors : found.views)[*reference.integer()] = true;
  });
  if (stop) return *std::move(stop);
  return found;
}

Result<std::vector<std::byte>> prune(Json& document, const References& before, const Buffers& buffers,
                                     Work& work) {
  // What is kept of an array goes into a new one.
  const Count elements = before.accessors.size() + before.views.size();
  if (auto kept = work.keep(elements * (sizeof(Json) + sizeof(Count)) + 4 * kBlockBytes); !kept)
    return kept.error();
  const auto after = collect_references(document, work);
  if (!after) return after.error();
  const auto accessors = not_orphaned(before.accessors, after->accessors);
  if (auto done = renumber(document, Referenced::accessors, keep(document, "accessors", accessors), work);
      !done)
    return done.error();
  // Now the removed accessors hold no views any more.
  const auto left = collect_references(document, work);
  if (!left) return left.error();
  const auto views = not_orphaned(before.views, left->views);
  if (auto done = renumber(document, Referenced::buffer_views, keep(document, "bufferViews", views), work);
      !done)
    return done.error();
  auto data = gather(document, buffers, work);
  if (!data) return data;
  if (Json::Array* array = array_of(document, "buffers")) {
    array->resize(1);
    array->front().erase("uri");
  }
  return data;
}

}  // namespace subdivd::proto::gltf
