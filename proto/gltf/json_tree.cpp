#include "proto/gltf/json_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <nlohmann/json.hpp>

namespace subdivd::proto::gltf {
namespace {

constexpr Count kMaxExactInteger = Count{1} << 53;

// Builds the tree from nlohmann's events; its parser keeps no stack of calls, so depth is ours to cap.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit TreeBuilder(const JsonLimits& limits) : limits_(limits) {}

  bool null() override { return put(Json()); }
  bool boolean(bool value) override { return put(Json(value)); }
  bool number_integer(number_integer_t value) override { return put(Json::raw(std::to_string(value))); }
  bool number_unsigned(number_unsigned_t value) override { return put(Json::raw(std::to_string(value))); }
  bool number_float(number_float_t, const string_t& text) override { return put(Json::raw(text)); }
  bool string(string_t& value) override { return put(Json(std::move(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json(Json::Object())); }
  bool start_array(std::size_t) override { return open(Json(Json::Array())); }
  bool end_array() override { return open_.pop_back(), true; }
  bool key(string_t& name) override {
    open_.back()->object()->push_back({std::move(name), Json()});
    return true;
  }
  bool end_object() override;
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& reason) override;

  Json take() { return std::move(root_); }
  const std::optional<Error>& error() const { return error_; }

 private:
  bool put(Json value) { return place(std::move(value)) != nullptr; }
  bool open(Json container);
  Json* place(Json value);
  Path path() const;
  bool fail(ErrorCode code, std::string message, Count predicted = 0, Count allowed = 0) {
    error_ = Error{code, std::move(message), path(), predicted, allowed};
    return false;
  }

  JsonLimits limits_;
  Json root_;
  Count values_ = 0;
  // Outermost first. A container's own vector does not move while one of its elements is open.
  std::vector<Json*> open_;
  std::optional<Error> error_;
};

Json* TreeBuilder::place(Json value) {
  if (++values_ > limits_.max_values) {
    fail(ErrorCode::too_large,
         "the glTF document has more than " + std::to_string(limits_.max_values) +
             " JSON values; keep bulk data in buffers",
         values_, limits_.max_values);
    return nullptr;
  }
  if (open_.empty()) {
    root_ = std::move(value);
    return &root_;
  }
  if (Json::Array* array = open_.back()->array()) return &array->emplace_back(std::move(value));
  Json& slot = open_.back()->object()->back().value;
  slot = std::move(value);
  return &slot;
}

bool TreeBuilder::open(Json container) {
  // 20,000 levels of nested extras overflow the stack of whoever walks or destroys them recursively.
  if (open_.size() >= limits_.max_depth)
    return fail(ErrorCode::too_large,
                "JSON is nested deeper than the " + std::to_string(limits_.max_depth) + " levels allowed",
                open_.size() + 1, limits_.max_depth);
  Json* slot = place(std::move(container));
  if (slot == nullptr) return false;
  open_.push_back(slot);
  return true;
}

bool TreeBuilder::end_object() {
  const Json::Object& members = *open_.back()->object();
  std::vector<const std::string*> names;
  names.reserve(members.size());
  for (const Json::Member& member : members) names.push_back(&member.name);
  const auto by_name = [](const std::string* a, const std::string* b) { return *a < *b; };
  std::sort(names.begin(), names.end(), by_name);
  // Readers disagree on which of two equal keys counts, so a file with both is two files.
  const auto twice =
      std::adjacent_find(names.begin(), names.end(), [](const auto* a, const auto* b) { return *a == *b; });
  open_.pop_back();
  if (twice == names.end()) return true;
  fail(ErrorCode::duplicate_field, "the member \"" + **twice + "\" appears twice; write it once");
  error_->where.emplace_back(**twice);
  return false;
}

bool TreeBuilder::parse_error(std::size_t position, const std::string&,
                              const nlohmann::json::exception& reason) {
  std::string what = reason.what();  // "[json.exception.parse_error.101] parse error at line …: …"
  if (const std::size_t end = what.find("] "); end != std::string::npos) what.erase(0, end + 2);
  what.resize(std::min<std::size_t>(what.size(), 200));
  for (char& c : what)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  error_ = Error{ErrorCode::malformed,
                 "the glTF JSON is broken at byte " + std::to_string(position) + ": " + what,
                 {},
                 0,
                 0};
  return false;
}

Path TreeBuilder::path() const {
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

void print_string(const std::string& value, std::string& out) {
  static constexpr char kHex[] = "0123456789abcdef";
  out += '"';
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\', out += c;
    } else if (byte < 0x20) {
      out += "\\u00", out += kHex[byte >> 4], out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

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

void Json::print(std::string& out) const {
  if (is_null()) {
    out += "null";
  } else if (const bool* flag = boolean()) {
    out += *flag ? "true" : "false";
  } else if (const Number* number = std::get_if<Number>(&value_)) {
    out += number->text;
  } else if (const std::string* value = string()) {
    print_string(*value, out);
  } else if (const Array* elements = array()) {
    out += '[';
    for (const Json& element : *elements) {
      if (&element != elements->data()) out += ',';
      element.print(out);
    }
    out += ']';
  } else {
    out += '{';
    for (const Member& member : *object()) {
      if (&member != object()->data()) out += ',';
      print_string(member.name, out);
      out += ':';
      member.value.print(out);
    }
    out += '}';
  }
}

std::string Json::text() const {
  std::string out;
  print(out);
  return out;
}

Result<Json> parse_json(std::string_view text, const JsonLimits& limits) {
  // The parser takes NUL for the end: what hides behind one would be read by others and not by us.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    if (text.find_first_not_of('\0', nul) != std::string_view::npos)
      return Error{ErrorCode::malformed, "the glTF JSON has a NUL at byte " + std::to_string(nul), {}, 0, 0};
    text = text.substr(0, nul);
  }
  TreeBuilder builder(limits);
  const bool complete = nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  if (builder.error()) return *builder.error();
  if (!complete) return Error{ErrorCode::malformed, "the glTF JSON is broken", {}, 0, 0};
  return builder.take();
}

}  // namespace subdivd::proto::gltf
