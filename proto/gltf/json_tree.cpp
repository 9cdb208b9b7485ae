#include "proto/gltf/json_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

namespace subdivd::proto::gltf {
namespace {

constexpr Count kMaxExactInteger = Count{1} << 53;

// Where text goes: into a string, or only into its length.
class Text {
 public:
  explicit Text(std::string& out) : out_(out) {}
  void put(char c) { out_ += c; }
  void put(std::string_view text) { out_ += text; }

 private:
  std::string& out_;
};
class Length {
 public:
  void put(char) { ++bytes_; }
  void put(std::string_view text) { bytes_ += text.size(); }
  Count bytes() const { return bytes_; }

 private:
  Count bytes_ = 0;
};

bool is_plain(char c) { return c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 0x20; }

template <class Sink>
std::optional<Error> print_string(std::string_view value, Sink& sink, Work& work) {
  static constexpr char kHex[] = "0123456789abcdef";
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  sink.put('"');
  for (std::size_t at = 0; at < value.size();) {
    const std::string_view piece = value.substr(at, kPiece);
    const auto plain =
        static_cast<std::size_t>(std::find_if_not(piece.begin(), piece.end(), is_plain) - piece.begin());
    sink.put(piece.substr(0, plain));
    if (auto stop = work.spend_bytes(4 * plain)) return stop;
    at += plain;
    if (plain == piece.size()) continue;
    const char c = value[at++];
    if (c == '"' || c == '\\') {
      sink.put('\\'), sink.put(c);
    } else {
      const auto byte = static_cast<unsigned char>(c);
      sink.put("\\u00"), sink.put(kHex[byte >> 4]), sink.put(kHex[byte & 15]);
    }
  }
  sink.put('"');
  return std::nullopt;
}

// Of the block that a string has beside itself.
Count string_block(const std::string& text) { return text.size() > 15 ? text.size() + 1 + kBlockBytes : 0; }

}  // namespace

Json Json::number(Count value) { return raw(std::to_string(value)); }

Json Json::number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return raw(std::string(text.data(), end));
}

Json Json::raw(std::string text) {
  Json json;
  json.value_ = Number{std::move(text)};
  return json;
}

std::optional<Count> Json::integer() const {
  const Number* number = std::get_if<Number>(&value_);
  if (number == nullptr) return std::nullopt;
  if (number->text == "-0") return 0;
  Count value = 0;
  const char* const end = number->text.data() + number->text.size();
  const auto [stop, error] = std::from_chars(number->text.data(), end, value);
  if (error != std::errc() || stop != end || value > kMaxExactInteger) return std::nullopt;
  return value;
}

std::optional<double> Json::real() const {
  const Number* number = std::get_if<Number>(&value_);
  if (number == nullptr) return std::nullopt;
  double value = 0;
  const char* const end = number->text.data() + number->text.size();
  const auto [stop, error] = std::from_chars(number->text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

const Json* Json::find(std::string_view name) const {
  if (const Object* members = object())
    for (const Member& member : *members)
      if (member.name == name) return &member.value;
  return nullptr;
}

Json* Json::find(std::string_view name) { return const_cast<Json*>(std::as_const(*this).find(name)); }

Json& Json::set(std::string_view name, Json value) {
  if (is_null()) value_ = Object();
  assert(object() != nullptr);
  if (Json* found = find(name)) return *found = std::move(value);
  object()->push_back({std::string(name), std::move(value)});
  return object()->back().value;
}

void Json::erase(std::string_view name) {
  if (Object* members = object())
    std::erase_if(*members, [&](const Member& member) { return member.name == name; });
}

Json::Array& Json::array_member(std::string_view name) {
  Json* found = find(name);
  if (found == nullptr || found->array() == nullptr) found = &set(name, Json(Array()));
  return *found->array();
}

template <class Sink>
std::optional<Error> Json::print_to(Sink& sink, Work& work) const {
  if (auto stop = work.spend(4)) return stop;
  if (is_null()) {
    sink.put("null");
  } else if (const bool* flag = boolean()) {
    sink.put(*flag ? std::string_view("true") : std::string_view("false"));
  } else if (const Number* number = std::get_if<Number>(&value_)) {
    sink.put(number->text);
    return work.spend_bytes(number->text.size());
  } else if (const std::string* value = string()) {
    return print_string(*value, sink, work);
  } else if (const Array* elements = array()) {
    sink.put('[');
    for (const Json& element : *elements) {
      if (&element != elements->data()) sink.put(',');
      if (auto stop = element.print_to(sink, work)) return stop;
    }
    sink.put(']');
  } else {
    sink.put('{');
    for (const Member& member : *object()) {
      if (&member != object()->data()) sink.put(',');
      if (auto stop = print_string(member.name, sink, work)) return stop;
      sink.put(':');
      if (auto stop = member.value.print_to(sink, work)) return stop;
    }
    sink.put('}');
  }
  return std::nullopt;
}

Result<Count> Json::text_size(Work& work) const {
  Length length;
  if (auto stop = print_to(length, work)) return *std::move(stop);
  return length.bytes();
}

Result<void> Json::print(std::string& out, Work& work) const {
  const auto size = text_size(work);
  if (!size) return size.error();
  out.reserve(out.size() + *size);
  Text text(out);
  if (auto stop = print_to(text, work)) return *std::move(stop);
  return {};
}

std::string Json::text() const {
  const Budget unlimited;
  Work work(unlimited);
  std::string out;
  (void)print(out, work);
  return out;
}

std::optional<Error> Json::add_heap_bytes(Count& bytes, Work& work) const {
  if (auto stop = work.spend(4)) return stop;
  if (const Number* number = std::get_if<Number>(&value_)) {
    bytes += string_block(number->text);
  } else if (const std::string* value = string()) {
    bytes += string_block(*value);
  } else if (const Array* elements = array()) {
    bytes += elements->size() * sizeof(Json) + kBlockBytes;
    for (const Json& element : *elements)
      if (auto stop = element.add_heap_bytes(bytes, work)) return stop;
  } else if (const Object* members = object()) {
    bytes += members->size() * sizeof(Member) + kBlockBytes;
    for (const Member& member : *members) {
      bytes += string_block(member.name);
      if (auto stop = member.value.add_heap_bytes(bytes, work)) return stop;
    }
  }
  return std::nullopt;
}

Result<Count> Json::heap_bytes(Work& work) const {
  Count bytes = 0;
  if (auto stop = add_heap_bytes(bytes, work)) return *std::move(stop);
  return bytes;
}

std::optional<Error> Json::copy_to(Json& copy, Work& work) const {
  if (auto stop = work.spend(8)) return stop;
  if (const Array* elements = array()) {
    copy.value_ = Array(elements->size());
    for (std::size_t i = 0; i < elements->size(); ++i)
      if (auto stop = (*elements)[i].copy_to((*copy.array())[i], work)) return stop;
  } else if (const Object* members = object()) {
    copy.value_ = Object(members->size());
    for (std::size_t i = 0; i < members->size(); ++i) {
      Member& member = (*copy.object())[i];
      member.name = (*members)[i].name;
      if (auto stop = (*members)[i].value.copy_to(member.value, work)) return stop;
    }
  } else {
    if (const std::string* value = string())
      if (auto stop = work.spend_bytes(value->size())) return stop;
    copy = *this;
  }
  return std::nullopt;
}

Result<Json> Json::copy(Work& work) const {
  Json copy;
  if (auto stop = copy_to(copy, work)) return *std::move(stop);
  return copy;
}

}  // namespace subdivd::proto::gltf
