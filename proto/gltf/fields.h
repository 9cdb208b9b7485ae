#pragma once
// Reading members of a glTF object with an answer to everything that may stand there instead.

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

// Where we are in the document: cheap to step, made into a Path only for an error. Keeps a pointer to the
// place it came from, which must live longer.
class Place {
 public:
  Place() = default;
  Place at(std::string_view name) const { return {this, name, 0, false}; }
  Place at(Count index) const { return {this, {}, index, true}; }
  Path path() const;
  // As people write it: /meshes/0/primitives/1. Names that are not plain words stand in quotes and are cut.
  std::string pointer() const;

 private:
  Place(const Place* parent, std::string_view name, Count index, bool is_index)
      : parent_(parent), name_(name), index_(index), is_index_(is_index) {}
  const Place* parent_ = nullptr;
  std::string_view name_;
  Count index_ = 0;
  bool is_index_ = false;
};

Error error_at(const Place& place, ErrorCode code, std::string message);
// too_large
Error over_limit(const Place& place, Count predicted, Count allowed, std::string message);

struct IntegerRange {
  Count min = 0, max = 0;
};

// A whole number in the range; empty when the member is absent.
Result<std::optional<Count>> optional_integer(const Json& object, std::string_view name, const Place& place,
                                              IntegerRange range);
Result<Count> required_integer(const Json& object, std::string_view name, const Place& place,
                               IntegerRange range);
// An index into the top-level array `array`, which has `size` elements.
Result<std::optional<Index>> optional_reference(const Json& object, std::string_view name, const Place& place,
                                                std::string_view array, Count size);
Result<Index> required_reference(const Json& object, std::string_view name, const Place& place,
                                 std::string_view array, Count size);
Result<Index> check_reference(const Json& value, const Place& place, std::string_view array, Count size);
Result<bool> optional_boolean(const Json& object, std::string_view name,
                              const Place& place);  // default false
Result<const std::string*> optional_string(const Json& object, std::string_view name, const Place& place);
// Array or object members; null when absent, refused when of another kind.
Result<const Json*> optional_array(const Json& object, std::string_view name, const Place& place);
Result<const Json*> optional_object(const Json& object, std::string_view name, const Place& place);
Result<const Json*> required_object(const Json& object, std::string_view name, const Place& place);
Result<void> expect_object(const Json& value, const Place& place);

}  // namespace subdivd::proto::gltf
