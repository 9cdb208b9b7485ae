#pragma once
// A caller's mistake is a value: an Error says which rule was broken (code), what is wrong and what would
// be right (message, for people), and where in the input it stands (where, for programs).
// Our own mistakes are asserts; nothing in the core prints, exits or throws across its interface.

#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/index.h"

namespace subdivd {

// The list of everything that can be wrong. Codes are public (they travel in answers): never rename one.
enum class ErrorCode {
  // shape of the input
  malformed,        // not JSON / GLB at all, truncated, bad UTF-8
  missing_field,    // a required member is absent
  unknown_field,    // a member, option or parameter that does not exist
  duplicate_field,  // the same member twice
  wrong_type,       // a string where a number must stand, …
  out_of_range,     // a number outside its range; an index past its array
  bad_enum,         // a word that is not in the list of valid words
  wrong_length,     // array lengths that contradict each other
  not_finite,       // NaN or infinity where a finite number must stand
  // meaning of a mesh or a curve
  not_a_triangle,  // nor a larger polygon: of fewer than three vertices, or with one twice
  not_an_edge,     // a crease runs between points that share no edge
  duplicate_tag,   // a corner or hole is given twice
  too_few_points,  // a curve with fewer points than its basis needs
  unsupported,     // valid input that this version cannot process
  // limits
  too_large,          // predicted size is over the allowed one
  deadline_exceeded,  // the time budget ran out
  cancelled,          // the caller went away
  overloaded,         // others use the memory that the work needs; or the system has none left
  // ours
  internal,
};

// snake_case name of a code as it travels on the wire, e.g. "out_of_range".
std::string_view name_of(ErrorCode code);

// One step into the input: a member's name or an array index.
using PathStep = std::variant<std::string, std::uint64_t>;
// From the outside inwards, e.g. {"primvars", "st", "indices", 17}. proto renders it as a JSON Pointer.
using Path = std::vector<PathStep>;

struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message = {};  // one sentence: what was wrong, what would be right; no trailing newline
  Path where = {};           // empty: the input as a whole
  // For too_large only: what was predicted and what is allowed, in the unit named by the message.
  Count predicted = 0;
  Count allowed = 0;
};

// Either a value or an Error. Result<void> carries no value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by design

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), std::get<0>(state_); }
  const T& value() const& { return assert(ok()), std::get<0>(state_); }
  T&& value() && { return assert(ok()), std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  Error& error() & { return assert(!ok()), std::get<1>(state_); }
  const Error& error() const& { return assert(!ok()), std::get<1>(state_); }
  Error&& error() && { return assert(!ok()), std::get<1>(std::move(state_)); }

 private:
  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT: implicit by design

  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  Error& error() & { return assert(!ok_), error_; }
  const Error& error() const& { return assert(!ok_), error_; }
  Error&& error() && { return assert(!ok_), std::move(error_); }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace subdivd
