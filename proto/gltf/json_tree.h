#pragma once
// A JSON document as it was written: order of members kept, numbers kept as text.
//
// nlohmann's parser reads it (json_reader.cpp), but into this tree instead of ordered_json: that one prints
// numbers anew (an integer of 20 digits becomes a double), compares keys one by one (an object of 10^6 keys
// takes hours) and copies whole subtrees when an object grows.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

class Json {
 public:
  struct Member;
  using Array = std::vector<Json>;
  using Object = std::vector<Member>;

  Json();                   // null
  Json(bool value);         // NOLINT: implicit by design
  Json(std::string value);  // NOLINT: implicit by design
  Json(const char* value);  // NOLINT: implicit by design
  Json(Array value);        // NOLINT: implicit by design
  Json(Object value);       // NOLINT: implicit by design
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  static Json number(Count value);
  static Json number(double value);   // shortest text that reads back to the same double
  static Json raw(std::string text);  // printed as it is: the caller vouches for it

  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  bool is_number() const { return std::holds_alternative<Number>(value_); }
  const bool* boolean() const { return std::get_if<bool>(&value_); }
  const std::string* string() const { return std::get_if<std::string>(&value_); }
  const Array* array() const { return std::get_if<Array>(&value_); }
  Array* array() { return std::get_if<Array>(&value_); }
  const Object* object() const { return std::get_if<Object>(&value_); }
  Object* object() { return std::get_if<Object>(&value_); }
  // A whole number in 0..2^53 written without fraction or exponent, as glTF demands of its integers.
  std::optional<Count> integer() const;
  std::optional<double> real() const;

  // Of an object, linear in its members; null when absent or when this is no object.
  const Json* find(std::string_view name) const;
  Json* find(std::string_view name);
  // Replaces in place or appends. Turns null into an object; any other kind is the caller's mistake.
  Json& set(std::string_view name, Json value);
  void erase(std::string_view name);
  // The array member `name`, made when absent.
  Array& array_member(std::string_view name);

  std::string text() const;
  // The same, stopped when the budget says so. `out` is appended to; it grows once, to its final size.
  Result<void> print(std::string& out, Work& work) const;
  Result<Count> text_size(Work& work) const;
  // What a copy takes beyond its own sizeof.
  Result<Count> heap_bytes(Work& work) const;
  Result<Json> copy(Work& work) const;

 private:
  struct Number {
    std::string text;
  };
  template <class Sink>
  std::optional<Error> print_to(Sink& sink, Work& work) const;
  std::optional<Error> add_heap_bytes(Count& bytes, Work& work) const;
  std::optional<Error> copy_to(Json& copy, Work& work) const;
  std::variant<std::monostate, bool, Number, std::string, Array, Object> value_;
};

struct Json::Member {
  std::string name;
  Json value;
};

// Only here, where Member is complete.
inline Json::Json() = default;
inline Json::Json(bool value) : value_(value) {}
inline Json::Json(std::string value) : value_(std::move(value)) {}
inline Json::Json(const char* value) : value_(std::string(value)) {}
inline Json::Json(Array value) : value_(std::move(value)) {}
inline Json::Json(Object value) : value_(std::move(value)) {}
inline Json::Json(const Json& other) = default;
inline Json::Json(Json&& other) noexcept = default;
inline Json& Json::operator=(const Json& other) = default;
inline Json& Json::operator=(Json&& other) noexcept = default;
inline Json::~Json() = default;

struct JsonLimits {
  Index max_depth = 64;
  // A value costs up to some 100 bytes whatever its text: 8 MB of "[]," must not take 300 MB.
  Count max_values = Count{1} << 21;
};

// Refuses malformed text, bad UTF-8, duplicate members, and what exceeds the limits (too_large). The memory
// of the tree is kept with `work`.
Result<Json> parse_json(std::string_view text, const JsonLimits& limits, Work& work);

}  // namespace subdivd::proto::gltf
