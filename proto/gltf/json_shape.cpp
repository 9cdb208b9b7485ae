#include "proto/gltf/json_shape.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "proto/client_text.h"
#include "proto/json_limits.h"

namespace subdivd::proto::gltf {
namespace {

constexpr std::size_t kInPlace = 15;  // bytes that std::string holds without a block of its own

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
// Ends a number, a word or garbage.
bool is_structural(char c) {
  return c == '[' || c == ']' || c == '{' || c == '}' || c == ',' || c == ':' || c == '"' || is_space(c);
}

// Where the string that begins after its quote at `at` ends: its closing quote, or the end of the text.
Result<std::size_t> end_of_string(std::string_view text, std::size_t at, Work& work) {
  std::size_t quote = text.find('"', at);
  for (;;) {
    if (quote == std::string_view::npos) return text.size();
    const std::size_t slash = text.substr(0, quote).find('\\', at);
    if (slash == std::string_view::npos) return quote;
    at = slash + 2;
    if (at > quote) quote = text.find('"', at);
    if (auto stop = work.spend(1)) return *std::move(stop);
  }
}

class Counter {
 public:
  Counter(std::string_view text, const JsonLimits& limits, Work& work)
      : text_(text), limits_(limits), work_(work) {}

  Result<JsonShape> count();

 private:
  struct Open {
    Count ordinal = 0;
    bool object = false, empty = true;
    std::string_view name = {};  // of an object's present member, as it is written
  };
  Result<void> open(bool object);
  void close();
  Result<void> element();
  Result<void> one_more();
  Result<std::size_t> string(std::size_t begin);
  Result<std::size_t> white_space(std::size_t begin);
  Result<std::size_t> word(std::size_t begin);
  Path path() const;
  void text_of(std::size_t size) {
    if (size > kInPlace) shape_.bytes += size + 1 + kBlockBytes;
  }
  void long_text(std::size_t begin, std::size_t end, bool string) {
    if (end - begin >= kLongText) shape_.longs.push_back({begin, end, string});
  }

  std::string_view text_;
  const JsonLimits& limits_;
  Work& work_;
  JsonShape shape_;
  std::vector<Open> open_;
  std::string_view last_string_;
};

// What the text of a string says, as far as a pointer shows it.
std::string shown(std::string_view written) {
  const std::string_view begin =
      written.substr(0, 6 * kLongestClientText);  // escapes have 6 characters at most
  if (begin.find('\\') == std::string_view::npos) return client_text(begin);
  const auto read = nlohmann::json::parse('"' + std::string(begin) + '"', nullptr, false);
  return client_text(read.is_string() ? read.get_ref<const std::string&>() : std::string(begin));
}

// To what begins now. For refusals of what the parser is not to see.
Path Counter::path() const {
  Path path;
  for (const Open& container : open_) {
    if (container.object)
      path.emplace_back(shown(container.name));
    else
      path.emplace_back(std::uint64_t{shape_.sizes[container.ordinal]} - 1);
  }
  return path;
}

Result<void> Counter::open(bool object) {
  // 20,000 levels of nested extras overflow the stack of whoever walks or destroys them recursively.
  if (open_.size() >= limits_.max_depth) return nested_too_deeply(path(), limits_.max_depth);
  if (shape_.sizes.size() == shape_.sizes.capacity()) {
    // The old array lives until the new one is filled.
    const Count more = std::max<Count>(64, 2 * shape_.sizes.size());
    if (auto kept = work_.keep(more * sizeof(Index)); !kept) return kept;
    work_.drop(shape_.sizes.size() * sizeof(Index));
    shape_.sizes.reserve(more);
  }
  open_.push_back({.ordinal = shape_.sizes.size(), .object = object});
  shape_.sizes.push_back(0);
  return {};
}

void Counter::close() {
  if (open_.empty()) return;  // the parser will say so
  const Count size = shape_.sizes[open_.back().ordinal];
  shape_.bytes += size * (open_.back().object ? sizeof(Json::Member) : sizeof(Json)) + kBlockBytes;
  open_.pop_back();
}

Result<void> Counter::one_more() {
  ++shape_.sizes[open_.back().ordinal];
  if (++shape_.values <= limits_.max_values) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "the glTF document has more than " + std::to_string(limits_.max_values) +
                          " JSON values; keep bulk data in buffers",
               .predicted = shape_.values,
               .allowed = limits_.max_values};
}

// Something begins that is not the end of its container: the first makes an element, each comma one more.
Result<void> Counter::element() {
  if (open_.empty() || !open_.back().empty) return {};
  open_.back().empty = false;
  return one_more();
}

// Each returns where what begins at `begin` ends.
Result<std::size_t> Counter::string(std::size_t begin) {
  const auto end = end_of_string(text_, begin, work_);
  if (!end) return end;
  last_string_ = text_.substr(begin, *end - begin);
  text_of(*end - begin);
  long_text(begin, *end, true);
  if (auto stop = work_.spend_bytes(*end - begin)) return *std::move(stop);
  return std::min(*end + 1, text_.size());
}

Result<std::size_t> Counter::white_space(std::size_t begin) {
  std::size_t end = begin;
  for (; end < text_.size() && is_space(text_[end]); ++end)
    if (auto stop = work_.spend(1)) return *std::move(stop);
  long_text(begin + 1, end, false);  // one character keeps apart what stands before and behind
  return end;
}

Result<std::size_t> Counter::word(std::size_t begin) {
  std::size_t end = begin + 1;
  for (; end < text_.size() && !is_structural(text_[end]); ++end)
    if (auto stop = work_.spend(1)) return *std::move(stop);
  const std::size_t size = end - begin;
  text_of(size);
  if (size <= kMaxNumberBytes) return end;
  return number_too_long(path(), begin, size);
}

Result<JsonShape> Counter::count() {
  const Count longs = text_.size() / kLongText;
  if (auto kept = work_.keep(longs * sizeof(LongText)); !kept) return kept.error();
  shape_.longs.reserve(longs);
  for (std::size_t at = 0; at < text_.size();) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    const char c = text_[at];
    if (c == ']' || c == '}') {
      close();
      ++at;
      continue;
    }
    if (is_space(c)) {
      const auto end = white_space(at);
      if (!end) return end.error();
      at = *end;
      continue;
    }
    if (auto good = element(); !good) return good.error();
    if (c == '[' || c == '{') {
      if (auto good = open(c == '{'); !good) return good.error();
      ++at;
    } else if (c == ',') {
      if (!open_.empty())
        if (auto good = one_more(); !good) return good.error();
      ++at;
    } else if (c == ':') {
      if (!open_.empty()) open_.back().name = last_string_;
      ++at;
    } else {
      const auto end = c == '"' ? string(at + 1) : word(at);
      if (!end) return end.error();
      at = *end;
    }
  }
  while (!open_.empty()) close();
  return std::move(shape_);
}

}  // namespace

Result<JsonShape> shape_of(std::string_view text, const JsonLimits& limits, Work& work) {
  return Counter(text, limits, work).count();
}

Count memory_of(const JsonShape& shape) {
  return shape.sizes.capacity() * sizeof(Index) + shape.longs.capacity() * sizeof(LongText);
}

}  // namespace subdivd::proto::gltf
