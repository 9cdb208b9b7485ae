#include "proto/gltf/output.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "proto/gltf/base64.h"
#include "proto/gltf/container.h"
#include "proto/gltf/layout.h"

namespace subdivd::proto::gltf {
namespace {

// A vertex of number 65535 would read as primitive restart.
constexpr Index kMaxShortVertices = 65535;
// Printed raw where the text of the buffer goes; escaped everywhere else, so it is found without fail.
constexpr char kUriMark = '\x01';

Json bounds_of(std::span<const float> values, Index components) {
  std::vector<float> low(values.begin(), values.begin() + components), high = low;
  for (std::size_t i = 0; i < values.size(); i += components)
    for (Index k = 0; k < components; ++k) {
      low[k] = std::min(low[k], values[i + k]);
      high[k] = std::max(high[k], values[i + k]);
    }
  const auto print = [](const std::vector<float>& bound) {
    Json::Array numbers;
    // As doubles: the shortest text of a float is another number to readers that compare in double.
    for (const float value : bound) numbers.push_back(Json::number(static_cast<double>(value)));
    return Json(std::move(numbers));
  };
  Json bounds;
  bounds.set("min", print(low));
  bounds.set("max", print(high));
  return bounds;
}

void append_word(std::string& out, Count word) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(word >> (8 * i) & 0xff);
}

std::string padding(Count size) { return std::string((4 - size % 4) % 4, '\0'); }

}  // namespace

Output::Output(Json document, Chunk data) : document_(std::move(document)), size_(data.bytes.size()) {
  if (!data.bytes.empty()) chunks_.push_back(std::move(data));
}

Json& Output::primitive(Index mesh, Index primitive) {
  return (*(*document_.find("meshes")->array())[mesh].find("primitives")->array())[primitive];
}

Index Output::add_accessor(Chunk data, Count count, Count component, std::string_view type, Target target,
                           Json bounds) {
  Json view;
  view.set("buffer", Json::number(Count{0}));
  view.set("byteOffset", Json::number(size_));
  view.set("byteLength", Json::number(Count{data.bytes.size()}));
  view.set("target", Json::number(static_cast<Count>(target)));
  Json::Array& views = document_.array_member("bufferViews");
  views.push_back(std::move(view));

  Json accessor;
  accessor.set("bufferView", Json::number(Count{views.size() - 1}));
  accessor.set("componentType", Json::number(component));
  accessor.set("count", Json::number(count));
  accessor.set("type", std::string(type));
  for (const char* bound : {"min", "max"})
    if (Json* found = bounds.find(bound)) accessor.set(bound, std::move(*found));
  Json::Array& accessors = document_.array_member("accessors");
  accessors.push_back(std::move(accessor));

  size_ += data.bytes.size();
  chunks_.push_back(std::move(data));
  if (std::string pad = padding(size_); !pad.empty()) {
    size_ += pad.size();
    chunks_.push_back(Chunk::own(std::move(pad)));
  }
  return static_cast<Index>(accessors.size() - 1);
}

Index Output::add_floats(Buffer<float> values, Index components, bool with_bounds) {
  static constexpr std::array<std::string_view, 5> kTypes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  Json bounds = with_bounds ? bounds_of(values, components) : Json();
  const Count count = values.size() / components;
  return add_accessor(Chunk::own(std::move(values)), count, kFloat, kTypes[components], Target::vertices,
                      std::move(bounds));
}

Index Output::add_indices(Buffer<Index> values, Index vertex_count) {
  const Count count = values.size();
  if (vertex_count > kMaxShortVertices)
    return add_accessor(Chunk::own(std::move(values)), count, kUnsignedInt, "SCALAR", Target::indices, {});
  Buffer<std::uint16_t> narrow(values.size());
  std::transform(values.begin(), values.end(), narrow.begin(),
                 [](Index index) { return static_cast<std::uint16_t>(index); });
  return add_accessor(Chunk::own(std::move(narrow)), count, kUnsignedShort, "SCALAR", Target::indices, {});
}

Result<Payload> Output::finish(Format format, const std::vector<Source::Foreign>& foreign) && {
  if (size_ > 0) {
    Json::Array& buffers = document_.array_member("buffers");
    if (buffers.empty()) buffers.emplace_back();
    buffers.front().set("byteLength", Json::number(size_));
    if (format == Format::gltf) {
      buffers.front().set("uri", Json::raw(std::string(1, kUriMark)));
    } else {
      buffers.front().erase("uri");
    }
  }
  if (format == Format::gltf) return finish_gltf();
  return finish_glb(foreign);
}

Result<Payload> Output::finish_glb(const std::vector<Source::Foreign>& foreign) {
  std::string json = document_.text();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  Count total = kGlbHeaderSize + kChunkHeaderSize + json.size() + (size_ > 0 ? kChunkHeaderSize + size_ : 0);
  for (const Source::Foreign& chunk : foreign) total += kChunkHeaderSize + chunk.bytes.size();
  constexpr Count kMaxGlb = std::numeric_limits<std::uint32_t>::max();
  if (total > kMaxGlb)
    return Error{ErrorCode::too_large,
                 "the answer would have " + std::to_string(total) + " bytes; a GLB file holds at most " +
                     std::to_string(kMaxGlb),
                 {},
                 total,
                 kMaxGlb};
  std::string head;
  for (const Count word : {Count{kGlbMagic}, Count{2}, total, Count{json.size()}, Count{kJsonChunk}})
    append_word(head, word);
  head += json;
  if (size_ > 0) append_word(head, size_), append_word(head, kBinChunk);
  Payload payload{"model/gltf-binary", {}};
  payload.chunks.push_back(Chunk::own(std::move(head)));
  std::move(chunks_.begin(), chunks_.end(), std::back_inserter(payload.chunks));
  for (const Source::Foreign& chunk : foreign) {
    std::string header;
    append_word(header, chunk.bytes.size()), append_word(header, chunk.type);
    payload.chunks.push_back(Chunk::own(std::move(header)));
    payload.chunks.push_back(Chunk::own(std::vector<std::byte>(chunk.bytes)));
  }
  return payload;
}

Payload Output::finish_gltf() {
  const std::string json = document_.text();
  Payload payload{"model/gltf+json", {}};
  const std::size_t mark = json.find(kUriMark);
  if (mark == std::string::npos) {
    payload.chunks.push_back(Chunk::own(json));
    return payload;
  }
  payload.chunks.push_back(Chunk::own(json.substr(0, mark) + "\"data:application/octet-stream;base64,"));
  std::vector<Chunk> text = encode_base64(chunks_);
  std::move(text.begin(), text.end(), std::back_inserter(payload.chunks));
  payload.chunks.push_back(Chunk::own("\"" + json.substr(mark + 1)));
  return payload;
}

}  // namespace subdivd::proto::gltf
