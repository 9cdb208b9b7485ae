// RFC 8259, strictly. The text is walked over twice: once to count what the tree will take (which is then
// asked for), once to make the tree, every array of its final size. Nothing is recursive, both walks can be
// stopped.

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "proto/gltf/caps.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/polled_sort.h"
#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;  // bytes between two looks at the clock
constexpr std::size_t kInPlace = 15;  // bytes that std::string holds without a block of its own

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
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

// What the first walk finds.
struct Shape {
  std::vector<Index> sizes;  // of every container, in the order of opening: as many elements or a few more
  Count values = 1;
  Count bytes = 0;  // that the tree will take
};

class Counter {
 public:
  Counter(std::string_view text, const JsonLimits& limits, Work& work)
      : text_(text), limits_(limits), work_(work) {}

  Result<Shape> count();

 private:
  struct Open {
    Count ordinal = 0;
    bool object = false, empty = true;
  };
  Result<void> open(bool object);
  void close();
  Result<void> element();
  void text_of(std::size_t size) {
    if (size > kInPlace) shape_.bytes += size + 1 + kBlockBytes;
  }
  Error too_many() const {
    return Error{ErrorCode::too_large,
                 "the glTF document has more than " + std::to_string(limits_.max_values) +
                     " JSON values; keep bulk data in buffers",
                 {},
                 shape_.values,
                 limits_.max_values};
  }

  std::string_view text_;
  const JsonLimits& limits_;
  Work& work_;
  Shape shape_;
  std::vector<Open> open_;
};

Result<void> Counter::open(bool object) {
  // 20,000 levels of nested extras overflow the stack of whoever walks or destroys them recursively.
  if (open_.size() >= limits_.max_depth)
    return Error{ErrorCode::too_large,
                 "JSON is nested deeper than the " + std::to_string(limits_.max_depth) + " levels allowed",
                 {},
                 open_.size() + 1,
                 limits_.max_depth};
  if (shape_.sizes.size() == shape_.sizes.capacity()) {
    // The old array lives until the new one is filled.
    const Count more = std::max<Count>(64, 2 * shape_.sizes.size());
    if (auto kept = work_.keep(more * sizeof(Index)); !kept) return kept;
    work_.drop(shape_.sizes.size() * sizeof(Index));
    shape_.sizes.reserve(more);
  }
  open_.push_back({shape_.sizes.size(), object, true});
  shape_.sizes.push_back(0);
  return {};
}

void Counter::close() {
  if (open_.empty()) return;  // the second walk will say so
  const Count size = shape_.sizes[open_.back().ordinal];
  shape_.bytes += size * (open_.back().object ? sizeof(Json::Member) : sizeof(Json)) + kBlockBytes;
  open_.pop_back();
}

// Something begins that is not the end of its container: the first makes an element, each comma one more.
Result<void> Counter::element() {
  if (open_.empty() || !open_.back().empty) return {};
  open_.back().empty = false;
  ++shape_.sizes[open_.back().ordinal];
  if (++shape_.values > limits_.max_values) return too_many();
  return {};
}

Result<Shape> Counter::count() {
  for (std::size_t at = 0; at < text_.size();) {
    if (auto stop = work_.spend(1)) return *stop;
    const char c = text_[at++];
    if (is_space(c)) continue;
    if (c == ']' || c == '}') {
      close();
      continue;
    }
    if (auto good = element(); !good) return good.error();
    if (c == '[' || c == '{') {
      if (auto good = open(c == '{'); !good) return good.error();
    } else if (c == ',') {
      if (open_.empty()) continue;
      ++shape_.sizes[open_.back().ordinal];
      if (++shape_.values > limits_.max_values) return too_many();
    } else if (c == '"') {
      const auto end = end_of_string(text_, at, work_);
      if (!end) return end.error();
      text_of(*end - at);
      if (auto stop = work_.spend_bytes(*end - at)) return *std::move(stop);
      at = std::min(*end + 1, text_.size());
    } else if (c != ':') {
      const std::size_t begin = at - 1;
      while (at < text_.size() && !is_structural(text_[at])) ++at;
      text_of(at - begin);
      if (auto stop = work_.spend(at - begin)) return *stop;
    }
  }
  while (!open_.empty()) close();
  return std::move(shape_);
}

class Parser {
 public:
  Parser(std::string_view text, Shape shape, Work& work)
      : text_(text), sizes_(std::move(shape.sizes)), work_(work) {}

  Result<Json> parse();
  const std::optional<Error>& stopped() const { return stop_; }

 private:
  Result<void> value(Json& slot);
  Result<void> next_in_array(Json::Array& array);
  Result<void> next_in_object(Json::Object& object);
  Result<void> close();
  Result<void> check_names(const Json::Object& members);
  Result<void> string(std::string& out);
  Result<void> check_text(std::size_t begin, std::size_t end);
  Result<void> unescape(std::size_t begin, std::size_t end, std::string& out);
  Result<Index> hex(std::size_t at, std::size_t end) const;
  Result<void> number(Json& slot);

  // Stopped, it goes to the end of the text: whatever is expected there is missing, and parse() knows why.
  void skip_space() {
    for (std::size_t piece = kPiece; at_ < text_.size() && is_space(text_[at_]); ++at_) {
      if (--piece > 0) continue;
      piece = kPiece;
      if (auto stop = work_.spend(kPiece / 8)) {
        stop_ = std::move(stop);
        at_ = text_.size();
        return;
      }
    }
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool accept(char c) {
    if (peek() != c || at_ == text_.size()) return false;
    ++at_;
    return true;
  }
  Error broken(std::size_t at, const char* what) const {
    return Error{ErrorCode::malformed,
                 "the glTF JSON is broken at byte " + std::to_string(at) + ": " + what,
                 {},
                 0,
                 0};
  }
  Path path() const;

  std::string_view text_;
  std::vector<Index> sizes_;
  Work& work_;
  std::size_t at_ = 0;
  Count opened_ = 0;
  std::optional<Error> stop_;
  // Outermost first. A container's own array does not move while one of its elements is open.
  std::vector<Json*> open_;
};

Path Parser::path() const {
  Path path;
  for (const Json* container : open_) {
    if (const Json::Array* array = container->array()) {
      path.emplace_back(std::uint64_t{array->empty() ? 0 : array->size() - 1});
    } else if (const Json::Object* object = container->object(); !object->empty()) {
      path.emplace_back(object->back().name);
    }
  }
  return path;
}

// Bad UTF-8 and raw control characters are refused.  [RFC 3629, 4]
Result<void> Parser::check_text(std::size_t begin, std::size_t end) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text_[i]); };
  for (std::size_t at = begin; at < end;) {
    const std::size_t piece = std::min(end, at + kPiece);
    if (auto stop = work_.spend_bytes(8 * (piece - at))) return *stop;
    while (at < piece) {
      const unsigned char c = byte(at);
      if (c < 0x80) {
        if (c < 0x20) return broken(at, "a control character within a string must be escaped");
        ++at;
        continue;
      }
      const std::size_t more = c >= 0xC2 && c < 0xE0   ? 1
                               : c >= 0xE0 && c < 0xF0 ? 2
                               : c >= 0xF0 && c < 0xF5 ? 3
                                                       : 0;
      bool good = more > 0 && more < end - at;
      for (std::size_t k = 1; good && k <= more; ++k) good = (byte(at + k) & 0xC0) == 0x80;
      if (good && more > 1) {
        const unsigned char next = byte(at + 1);  // overlong forms, surrogates, beyond U+10FFFF
        good = !(c == 0xE0 && next < 0xA0) && !(c == 0xED && next >= 0xA0) && !(c == 0xF0 && next < 0x90) &&
               !(c == 0xF4 && next >= 0x90);
      }
      if (!good) return broken(at, "this is no UTF-8");
      at += more + 1;
    }
  }
  return {};
}

Result<Index> Parser::hex(std::size_t at, std::size_t end) const {
  Index value = 0;
  const char* const first = text_.data() + at;
  if (end - at < 4 || std::from_chars(first, first + 4, value, 16).ptr != first + 4)
    return broken(at, "four hexadecimal digits must follow \\u");
  return value;
}

void append_utf8(Index code, std::string& out) {
  const auto put = [&](Index byte) { out += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6), put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12), put(0x80 | (code >> 6 & 0x3F)), put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | code >> 18), put(0x80 | (code >> 12 & 0x3F)), put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

Result<void> Parser::unescape(std::size_t begin, std::size_t end, std::string& out) {
  constexpr std::string_view kEscapes = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
  out.reserve(end - begin);
  for (std::size_t at = begin; at < end;) {
    const std::size_t piece = std::min(end, at + kPiece);
    const std::size_t plain = std::min(text_.substr(0, piece).find('\\', at), piece);
    out.append(text_, at, plain - at);
    if (auto stop = work_.spend_bytes(plain - at + 32)) return *stop;
    at = plain;
    if (at == end || text_[at] != '\\') continue;
    const char c = text_[at + 1];  // the closing quote at the latest
    if (const std::size_t k = kEscapes.find(c); k != std::string_view::npos) {
      out += kMeanings[k];
      at += 2;
      continue;
    }
    if (c != 'u') return broken(at, "there is no such escape");
    auto code = hex(at + 2, end);
    if (!code) return code.error();
    at += 6;
    if (*code >= 0xD800 && *code < 0xE000) {
      const bool pair = *code < 0xDC00 && end - at >= 6 && text_[at] == '\\' && text_[at + 1] == 'u';
      const auto low = pair ? hex(at + 2, end) : Result<Index>(Index{0});
      if (!low) return low.error();
      if (*low < 0xDC00 || *low >= 0xE000) return broken(at, "half of a surrogate pair is missing");
      *code = 0x10000 + ((*code - 0xD800) << 10) + (*low - 0xDC00);
      at += 6;
    }
    append_utf8(*code, out);
  }
  return {};
}

// From behind the opening quote to behind the closing one.
Result<void> Parser::string(std::string& out) {
  const std::size_t begin = at_;
  const auto found = end_of_string(text_, begin, work_);
  if (!found) return found.error();
  const std::size_t end = *found;
  if (end == text_.size()) return broken(text_.size(), "a string has no end");
  at_ = end + 1;
  if (auto good = check_text(begin, end); !good) return good;
  return unescape(begin, end, out);
}

Result<void> Parser::number(Json& slot) {
  const std::size_t begin = at_;
  const auto digits = [&] {
    const std::size_t first = at_;
    while (is_digit(peek())) ++at_;
    return at_ > first;
  };
  accept('-');
  const bool zero = peek() == '0';
  if (!(zero ? accept('0') : digits())) return broken(begin, "no value begins like this");
  if (accept('.') && !digits()) return broken(at_, "digits must follow the point");
  bool exponent = false;
  if (peek() == 'e' || peek() == 'E') {
    ++at_;
    exponent = true;
    if (!accept('-')) accept('+');
    if (!digits()) return broken(at_, "digits must follow the exponent's sign");
  }
  const std::string_view text = text_.substr(begin, at_ - begin);
  if (auto stop = work_.spend(text.size())) return *stop;
  if (exponent || text.size() > 300) {
    double value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
    if (parsed.ec == std::errc::result_out_of_range && !tiny)
      return broken(begin, "this number is too large for double precision");
  }
  slot = Json::raw(std::string(text));
  return {};
}

Result<void> Parser::value(Json& slot) {
  skip_space();
  const auto word = [&](std::string_view name, Json meaning) -> Result<void> {
    if (text_.substr(at_, name.size()) != name) return broken(at_, "no value begins like this");
    at_ += name.size();
    slot = std::move(meaning);
    return {};
  };
  switch (peek()) {
    case '{':
    case '[': {
      const Index size = opened_ < sizes_.size() ? sizes_[opened_] : 0;
      ++opened_;
      if (text_[at_++] == '{') {
        slot = Json(Json::Object());
        slot.object()->reserve(size);
      } else {
        slot = Json(Json::Array());
        slot.array()->reserve(size);
      }
      open_.push_back(&slot);
      return {};
    }
    case '"': {
      ++at_;
      std::string text;
      if (auto good = string(text); !good) return good;
      slot = Json(std::move(text));
      return {};
    }
    case 't':
      return word("true", Json(true));
    case 'f':
      return word("false", Json(false));
    case 'n':
      return word("null", Json());
    default:
      if (at_ == text_.size()) return broken(at_, "the text ends here");
      return number(slot);
  }
}

Result<void> Parser::next_in_array(Json::Array& array) {
  if (accept(']')) return close();
  if (!array.empty() && !accept(',')) return broken(at_, "a comma or the end of the array must stand here");
  array.emplace_back();
  return value(array.back());
}

Result<void> Parser::next_in_object(Json::Object& object) {
  if (accept('}')) return close();
  if (!object.empty() && !accept(',')) return broken(at_, "a comma or the end of the object must stand here");
  skip_space();
  if (!accept('"')) return broken(at_, "a member's name in quotes must stand here");
  Json::Member& member = object.emplace_back();
  if (auto good = string(member.name); !good) return good;
  if (member.name.size() > kMaxNameBytes) {
    const Count size = member.name.size();
    object.pop_back();
    return Error{ErrorCode::too_large,
                 "the name of a member has " + std::to_string(size) + " bytes; " +
                     std::to_string(kMaxNameBytes) + " are allowed",
                 path(), size, kMaxNameBytes};
  }
  skip_space();
  if (!accept(':')) return broken(at_, "a colon must follow the member's name");
  return value(member.value);
}

// Readers disagree on which of two equal names counts, so a file with both is two files.
Result<void> Parser::check_names(const Json::Object& members) {
  if (members.size() < 2) return {};
  auto held = work_.hold(members.size() * sizeof(void*));
  if (!held) return held.error();
  std::vector<const std::string*> names;
  names.reserve(members.size());
  Count bytes = 0;
  for (const Json::Member& member : members) {
    names.push_back(&member.name);
    bytes += member.name.size();
  }
  // Names may begin alike for as long as they are.
  const Count cost = 1 + bytes / members.size() / 64;
  const auto by_name = [](const std::string* a, const std::string* b) { return *a < *b; };
  if (auto sorted = polled_sort(names, by_name, work_, cost); !sorted) return sorted;
  const auto twice =
      std::adjacent_find(names.begin(), names.end(), [](const auto* a, const auto* b) { return *a == *b; });
  if (twice == names.end()) return {};
  Error error{ErrorCode::duplicate_field,
              "the member " + in_quotes(**twice) + " appears twice; write it once", path(), 0, 0};
  error.where.back() = **twice;
  return error;
}

Result<void> Parser::close() {
  const Json* closed = open_.back();
  if (const Json::Object* members = closed->object())
    if (auto good = check_names(*members); !good) return good;
  open_.pop_back();
  return {};
}

Result<Json> Parser::parse() {
  Json root;
  if (auto good = value(root); !good) return good.error();
  while (!open_.empty()) {
    if (auto stop = work_.spend(4)) return *stop;
    skip_space();
    Json& container = *open_.back();
    Json::Array* const array = container.array();
    if (auto good = array != nullptr ? next_in_array(*array) : next_in_object(*container.object()); !good)
      return good.error();
  }
  skip_space();
  if (at_ < text_.size()) return broken(at_, "the document has ended before this");
  return root;
}

}  // namespace

Result<Json> parse_json(std::string_view text, const JsonLimits& limits, Work& work) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  // Others take NUL for the end: what hides behind one would be read by some and not by others.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    for (std::size_t at = nul; at < text.size(); at += kPiece) {
      if (text.substr(at, kPiece).find_first_not_of('\0') != std::string_view::npos)
        return Error{
            ErrorCode::malformed, "the glTF JSON has a NUL at byte " + std::to_string(nul), {}, 0, 0};
      if (auto stop = work.spend(kPiece / 8)) return *std::move(stop);
    }
    text = text.substr(0, nul);
  }
  auto shape = Counter(text, limits, work).count();
  if (!shape) return shape.error();
  if (auto kept = work.keep(shape->bytes); !kept) return kept.error();
  const Count sizes = shape->sizes.capacity() * sizeof(Index);
  Parser parser(text, *std::move(shape), work);
  auto tree = parser.parse();
  if (parser.stopped()) tree = *parser.stopped();
  work.drop(sizes);
  return tree;
}

}  // namespace subdivd::proto::gltf
