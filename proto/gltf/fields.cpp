#include "proto/gltf/fields.h"

#include <algorithm>

#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

std::string quoted(std::string_view name) { return "\"" + std::string(name) + "\""; }

bool is_plain(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  });
}

Error missing(std::string_view name, const Place& place) {
  return error_at(place, ErrorCode::missing_field, quoted(name) + " is missing");
}

Result<Count> check_integer(const Json& value, const Place& place, std::string_view name,
                            IntegerRange range) {
  const std::optional<Count> number = value.integer();
  const std::string wanted =
      "a whole number from " + std::to_string(range.min) + " to " + std::to_string(range.max) + " is needed";
  if (!number) {
    const std::optional<double> real = value.real();
    // Negative or beyond 2^53: a number indeed, but none that could be right.
    const bool whole = real && (*real < 0 || *real >= 0x1p53);
    return error_at(place, whole ? ErrorCode::out_of_range : ErrorCode::wrong_type,
                    quoted(name) + (whole ? " is out of range: " : " is no whole number: ") + wanted);
  }
  if (*number < range.min || *number > range.max)
    return error_at(place, ErrorCode::out_of_range,
                    quoted(name) + " is " + std::to_string(*number) + "; " + wanted);
  return *number;
}

Result<const Json*> optional_container(const Json& object, std::string_view name, const Place& place,
                                       bool array) {
  const Json* value = object.find(name);
  if (value == nullptr) return value;
  if (array ? value->array() != nullptr : value->object() != nullptr) return value;
  return error_at(place.at(name), ErrorCode::wrong_type,
                  quoted(name) + (array ? " must be an array" : " must be an object"));
}

}  // namespace

Path Place::path() const {
  Path path;
  for (const Place* step = this; step->parent_ != nullptr; step = step->parent_) {
    if (step->is_index_) {
      path.emplace_back(std::uint64_t{step->index_});
    } else {
      path.emplace_back(std::string(step->name_));
    }
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::string Place::pointer() const {
  if (parent_ == nullptr) return {};
  if (is_index_) return parent_->pointer() + "/" + std::to_string(index_);
  return parent_->pointer() + "/" + (is_plain(name_) ? std::string(name_) : in_quotes(name_));
}

Error error_at(const Place& place, ErrorCode code, std::string message) {
  return Error{code, std::move(message), place.path()};
}

Error over_limit(const Place& place, Count predicted, Count allowed, std::string message) {
  return Error{.code = ErrorCode::too_large,
               .message = std::move(message),
               .where = place.path(),
               .predicted = predicted,
               .allowed = allowed};
}

Result<std::optional<Count>> optional_integer(const Json& object, std::string_view name, const Place& place,
                                              IntegerRange range) {
  const Json* value = object.find(name);
  if (value == nullptr) return std::optional<Count>();
  auto number = check_integer(*value, place.at(name), name, range);
  if (!number) return number.error();
  return std::optional<Count>(*number);
}

Result<Count> required_integer(const Json& object, std::string_view name, const Place& place,
                               IntegerRange range) {
  const Json* value = object.find(name);
  if (value == nullptr) return missing(name, place);
  return check_integer(*value, place.at(name), name, range);
}

Result<Index> check_reference(const Json& value, const Place& place, std::string_view array, Count size) {
  const std::optional<Count> index = value.integer();
  if (!index && !value.is_number())
    return error_at(place, ErrorCode::wrong_type, "an index into " + quoted(array) + " is needed here");
  if (!index || *index >= size)
    return error_at(place, ErrorCode::out_of_range,
                    "there is no such element of " + quoted(array) + ": it has " + std::to_string(size));
  return static_cast<Index>(*index);
}

Result<std::optional<Index>> optional_reference(const Json& object, std::string_view name, const Place& place,
                                                std::string_view array, Count size) {
  const Json* value = object.find(name);
  if (value == nullptr) return std::optional<Index>();
  auto index = check_reference(*value, place.at(name), array, size);
  if (!index) return index.error();
  return std::optional<Index>(*index);
}

Result<Index> required_reference(const Json& object, std::string_view name, const Place& place,
                                 std::string_view array, Count size) {
  const Json* value = object.find(name);
  if (value == nullptr) return missing(name, place);
  return check_reference(*value, place.at(name), array, size);
}

Result<bool> optional_boolean(const Json& object, std::string_view name, const Place& place) {
  const Json* value = object.find(name);
  if (value == nullptr) return false;
  if (const bool* flag = value->boolean()) return *flag;
  return error_at(place.at(name), ErrorCode::wrong_type, quoted(name) + " must be true or false");
}

Result<const std::string*> optional_string(const Json& object, std::string_view name, const Place& place) {
  const Json* value = object.find(name);
  if (value == nullptr) return static_cast<const std::string*>(nullptr);
  if (const std::string* text = value->string()) return text;
  return error_at(place.at(name), ErrorCode::wrong_type, quoted(name) + " must be a string");
}

Result<const Json*> optional_array(const Json& object, std::string_view name, const Place& place) {
  return optional_container(object, name, place, true);
}

Result<const Json*> optional_object(const Json& object, std::string_view name, const Place& place) {
  return optional_container(object, name, place, false);
}

Result<const Json*> required_object(const Json& object, std::string_view name, const Place& place) {
  auto found = optional_object(object, name, place);
  if (found && *found == nullptr) return missing(name, place);
  return found;
}

Result<void> expect_object(const Json& value, const Place& place) {
  if (value.object() != nullptr) return {};
  return error_at(place, ErrorCode::wrong_type, "an object must stand here");
}

}  // namespace subdivd::proto::gltf
