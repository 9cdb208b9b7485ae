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

// As doubles: the shortest text of a float is another number to readers that compare in double.
Json print_bound(const std::vector<float>& bound) {
  Json::Array numbers;
  for (const float value : bound) numbers.push_back(Json::number(static_cast<double>(value)));
  return Json(std::move(numbers));
}

void append_word(std::string& out, Count word) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(word >> (8 * i) & 0xff);
}

// Indices of fewer are written before the answer is sent: a request may have a hundred thousand small meshes.
constexpr Count kWorthMaking = Count{1} << 18;
constexpr Count kPieceIndices = Count{160}
                                << 10;  // what the processor's cache holds, and what is sent at once

// A refined mesh's indices, little-endian, 32 bits each.
class IndexMaker final : public ByteMaker {
 public:
  explicit IndexMaker(TriangleStream triangles)
      : triangles_(std::move(triangles)), piece_(std::max(kPieceIndices, triangles_.least_room())) {}

  Count size() const override { return sizeof(Index) * triangles_.index_count(); }
  Count held_bytes() const override { return sizeof(Index) * piece_.size() + triangles_.held_bytes(); }
  std::span<const std::byte> next() noexcept override {
    return std::as_bytes(std::span<const Index>(piece_).first(triangles_.next(piece_)));
  }

 private:
  TriangleStream triangles_;
  Buffer<Index> piece_;
};

std::string padding(Count size) { return std::string((4 - size % 4) % 4, '\0'); }

// Out of the document and back, so that nothing is looked up for each of a hundred thousand accessors.
Json::Array taken_out(Json& document, std::string_view name) {
  Json* found = document.find(name);
  return found == nullptr ? Json::Array() : std::move(*found->array());
}

void put_back(Json& document, std::string_view name, Json::Array elements) {
  if (!elements.empty()) document.set(name, Json(std::move(elements)));
}

}  // namespace

Output::Output(Json document, Chunk data, Format format, Work& work)
    : document_(std::move(document)), format_(format), work_(work), size_(data.bytes.size()) {
  if (!data.bytes.empty()) chunks_.push_back(std::move(data));
  views_ = taken_out(document_, "bufferViews");
  accessors_ = taken_out(document_, "accessors");
  if (Json* meshes = document_.find("meshes")) meshes_ = meshes->array();
}

Json& Output::primitive(Index mesh, Index primitive) {
  return (*(*meshes_)[mesh].find("primitives")->array())[primitive];
}

// Not yet into the document: another member might move those that pointers lead to.
void Output::use_extension(std::string_view name) {
  if (std::ranges::find(extensions_, name) == extensions_.end()) extensions_.emplace_back(name);
}

Index Output::add_accessor(Chunk data, Count count, Count component, std::string_view type, Target target,
                           Json bounds) {
  Json view;
  view.set("buffer", Json::number(Count{0}));
  view.set("byteOffset", Json::number(size_));
  view.set("byteLength", Json::number(data.size()));
  view.set("target", Json::number(static_cast<Count>(target)));
  views_.push_back(std::move(view));

  Json accessor;
  accessor.set("bufferView", Json::number(Count{views_.size() - 1}));
  accessor.set("componentType", Json::number(component));
  accessor.set("count", Json::number(count));
  accessor.set("type", std::string(type));
  for (const char* bound : {"min", "max"})
    if (Json* found = bounds.find(bound)) accessor.set(bound, std::move(*found));
  accessors_.push_back(std::move(accessor));

  size_ += data.size();
  chunks_.push_back(std::move(data));
  if (std::string pad = padding(size_); !pad.empty()) {
    size_ += pad.size();
    chunks_.push_back(Chunk::own(std::move(pad)));
  }
  return static_cast<Index>(accessors_.size() - 1);
}

Index Output::add_floats(Buffer<float> values, Index components, const FloatScan& bounds) {
  static constexpr std::array<std::string_view, 5> kTypes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  Json printed;
  if (!bounds.least.empty()) {
    printed.set("min", print_bound(bounds.least));
    printed.set("max", print_bound(bounds.most));
  }
  const Count count = values.size() / components;
  return add_accessor(Chunk::own(std::move(values)), count, kFloat, kTypes[components], Target::vertices,
                      std::move(printed));
}

Result<Index> Output::add_indices(Buffer<Index> values, Index vertex_count) {
  const Count count = values.size();
  if (vertex_count > kMaxShortVertices)
    return add_accessor(Chunk::own(std::move(values)), count, kUnsignedInt, "SCALAR", Target::indices, {});
  Buffer<std::uint16_t> narrow(values.size());
  const auto done = in_shared_blocks(count, work_, [&](Count begin, Count end) {
    std::transform(&values[begin], &values[begin] + (end - begin), &narrow[begin],
                   [](Index value) { return static_cast<std::uint16_t>(value); });
  });
  if (!done) return done.error();
  return add_accessor(Chunk::own(std::move(narrow)), count, kUnsignedShort, "SCALAR", Target::indices, {});
}

Result<Index> Output::add_indices(TriangleStream triangles, Index vertex_count) {
  const Count count = triangles.index_count();
  // Below level 2 what they are made from is larger than they are.
  const bool saves_memory = triangles.held_bytes() < sizeof(Index) * count;
  if (format_ == Format::glb && vertex_count > kMaxShortVertices && count >= kWorthMaking && saves_memory) {
    const Chunk made{nullptr, {}, std::make_shared<IndexMaker>(std::move(triangles))};
    return add_accessor(made, count, kUnsignedInt, "SCALAR", Target::indices, {});
  }
  auto indices = triangles.all(work_.budget().threads(), work_.budget());
  if (!indices) return indices.error();
  return add_indices(*std::move(indices), vertex_count);
}

Result<Payload> Output::finish(const std::shared_ptr<const void>& source,
                               const std::vector<Source::Foreign>& foreign) && {
  put_back(document_, "bufferViews", std::move(views_));
  put_back(document_, "accessors", std::move(accessors_));
  for (const std::string& name : extensions_) {
    Json::Array& used = document_.array_member("extensionsUsed");
    const auto is_it = [&](const Json& json) { return json.string() != nullptr && *json.string() == name; };
    if (std::ranges::none_of(used, is_it)) used.emplace_back(name);
  }
  if (size_ > 0) {
    Json::Array& buffers = document_.array_member("buffers");
    if (buffers.empty()) buffers.emplace_back();
    buffers.front().set("byteLength", Json::number(size_));
    if (format_ == Format::gltf) {
      buffers.front().set("uri", Json::raw(std::string(1, kUriMark)));
    } else {
      buffers.front().erase("uri");
    }
  }
  if (format_ == Format::gltf) return finish_gltf();
  return finish_glb(source, foreign);
}

Result<Payload> Output::finish_glb(const std::shared_ptr<const void>& source,
                                   const std::vector<Source::Foreign>& foreign) {
  const auto text_size = document_.text_size(work_);
  if (!text_size) return text_size.error();
  const Count json_size = (*text_size + 3) / 4 * 4;
  Count total = kGlbHeaderSize + kChunkHeaderSize + json_size + (size_ > 0 ? kChunkHeaderSize + size_ : 0);
  for (const Source::Foreign& chunk : foreign) total += kChunkHeaderSize + chunk.bytes.size();
  constexpr Count kMaxGlb = std::numeric_limits<std::uint32_t>::max();
  if (total > kMaxGlb)
    return Error{.code = ErrorCode::too_large,
                 .message = "the answer would have " + std::to_string(total) +
                            " bytes; a GLB file holds at most " + std::to_string(kMaxGlb),
                 .predicted = total,
                 .allowed = kMaxGlb};
  const Count head_size = kGlbHeaderSize + kChunkHeaderSize + json_size + kChunkHeaderSize;
  std::string head;
  head.reserve(head_size);
  for (const Count word : {Count{kGlbMagic}, Count{2}, total, json_size, Count{kJsonChunk}})
    append_word(head, word);
  if (auto printed = document_.print(head, work_); !printed) return printed.error();
  head.append(json_size - *text_size, ' ');
  document_ = Json();
  if (size_ > 0) append_word(head, size_), append_word(head, kBinChunk);
  Payload payload{"model/gltf-binary", {}};
  payload.chunks.reserve(1 + chunks_.size() + 2 * foreign.size());
  payload.chunks.push_back(Chunk::own(std::move(head)));
  std::move(chunks_.begin(), chunks_.end(), std::back_inserter(payload.chunks));
  for (const Source::Foreign& chunk : foreign) {
    std::string header;
    append_word(header, chunk.bytes.size()), append_word(header, chunk.type);
    payload.chunks.push_back(Chunk::own(std::move(header)));
    payload.chunks.push_back(Chunk{source, std::as_bytes(std::span(chunk.bytes))});
  }
  return payload;
}

Result<Payload> Output::finish_gltf() {
  // The answer's own bytes were predicted. Beside them stand the arrays until they are text, and the
  // document's text until it is cut in two.
  const auto text_size = document_.text_size(work_);
  if (!text_size) return text_size.error();
  if (auto kept = work_.keep(size_ + *text_size + 2 * kBlockBytes); !kept) return kept.error();
  std::string json;
  if (auto printed = document_.print(json, work_); !printed) return printed.error();
  document_ = Json();
  Payload payload{"model/gltf+json", {}};
  const std::size_t mark = json.find(kUriMark);
  if (mark == std::string::npos) {
    payload.chunks.push_back(Chunk::own(std::move(json)));
    return payload;
  }
  std::string rest = "\"" + json.substr(mark + 1);
  json.resize(mark);
  payload.chunks.push_back(Chunk::own(std::move(json) + "\"data:application/octet-stream;base64,"));
  auto text = encode_base64(std::move(chunks_), work_);
  if (!text) return text.error();
  std::move(text->begin(), text->end(), std::back_inserter(payload.chunks));
  payload.chunks.push_back(Chunk::own(std::move(rest)));
  return payload;
}

}  // namespace subdivd::proto::gltf
