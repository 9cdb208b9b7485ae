#pragma once
// Walks a JSON document forwards with simdjson, knowing at every moment where it stands. Nothing is skipped:
// whatever the document holds has been looked at when the walk ends well, so a malformed tail cannot hide.
//
// Functions return false when they failed; the reason is then in error(). The first failure is kept.

#include <simdjson.h>

#include <array>
#include <bitset>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "proto/suggest.h"

namespace subdivd::proto::json {

using Value = simdjson::ondemand::value;

// The number at `value`; false: none, or beyond a double (Cursor::fail_number explains). Numbers of 20 and
// more digits do not go through simdjson 3.0.1: its on-demand parser reads 0.50000000000000016653…
// as 1.8e-35.
bool get_number(Value& value, double& out);

class Cursor {
 public:
  // Stands inside a member or an element as long as it lives.
  class Step {
   public:
    Step(Cursor& cursor, std::string_view member);
    Step(Cursor& cursor, std::uint64_t element);
    ~Step() { cursor_.path_.pop_back(); }
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

   private:
    Cursor& cursor_;
  };

  const std::optional<Error>& error() const { return error_; }
  // simdjson found the text not to be JSON; error() says so without a reason.
  bool malformed() const { return malformed_; }
  const Path& path() const { return path_; }

  // Always false. `below` are further steps from where the cursor stands.
  bool fail(ErrorCode code, std::string message, Path below = {});
  bool fail_syntax();
  bool fail_as(Error error);
  // "… is a string; it must be a number" — or fail_syntax() when `value` is no value at all.
  bool fail_type(Value value, std::string_view right, Path below = {});
  // The same for what should have been a number: tells 1e999 (not_finite) from a wrong type.
  bool fail_number(Value value, std::string_view right, Path below = {});

  bool read_string(Value value, std::string& out);
  // Index of the word in `valid`.
  bool read_word(Value value, std::span<const std::string_view> valid, std::size_t& out);
  // Any value, depth-first, for members that are looked at but not used.
  bool skip(Value value, std::size_t depth_left);

  // Calls read(target, value) for every member of the object, the cursor standing in the member. Unknown
  // names and names given twice are refused. `seen` comes back with one bit per member of the table.
  template <class Target>
  struct Member {
    std::string_view name;
    bool (Target::*read)(Value value);
  };

  template <class Target, std::size_t n>
  bool read_members(simdjson::ondemand::object object, const std::array<Member<Target>, n>& table,
                    Target& target, std::bitset<n>& seen) {
    for (auto field : object) {
      std::string_view name;
      Value value;
      if (field.unescaped_key().get(name) || field.value().get(value)) return fail_syntax();
      std::size_t i = 0;
      while (i < n && table[i].name != name) ++i;
      if (i == n) return fail_unknown(name, names_of(table));
      if (seen[i]) return fail_twice(name);
      seen.set(i);
      const Step step(*this, name);
      if (!(target.*table[i].read)(value)) return false;
    }
    return true;
  }

  bool fail_unknown(std::string_view name, std::span<const std::string_view> valid);
  bool fail_twice(std::string_view name);

 private:
  template <class Table>
  static auto names_of(const Table& table) {
    std::array<std::string_view, std::tuple_size_v<Table>> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = table[i].name;
    return names;
  }

  std::optional<Error> error_;
  bool malformed_ = false;
  Path path_;
};

}  // namespace subdivd::proto::json
