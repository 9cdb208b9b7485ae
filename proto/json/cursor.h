#pragma once
// Walks a JSON text forwards, once, knowing at every moment where it stands. Nothing is skipped: whatever the
// text holds has been looked at when the walk ends well, so a malformed tail cannot hide. The walk keeps
// nothing but its place: no index, no copy of the text, and it polls its budget on the way.
//
// Functions that read stand before a value and then behind it. They return false when they failed; the reason
// is then in error(). The first failure is kept, and everything after it fails, too.

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/suggest.h"

namespace subdivd::proto::json {

// Of a value, by its first character; none: no value begins here.
enum class Type { array, object, number, string, boolean, null, none };

class Cursor {
 public:
  // Both must outlive the cursor. The text need not be padded.
  Cursor(std::string_view text, const Budget& budget);
  Cursor(const Cursor&) = delete;
  Cursor& operator=(const Cursor&) = delete;

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

  // The elements of an array that open() has entered: next() stands before each, one after the other, and
  // returns false behind the closing bracket or after a failure.
  //   for (Cursor::Elements all(cursor); all.next();) …; return !cursor.failed();
  class Elements {
   public:
    explicit Elements(Cursor& cursor) : cursor_(cursor) {}
    bool next() {
      Cursor& c = cursor_;
      const bool plain = c.at_ + 1 < c.stop_ && *c.at_ == ',' && !is_space(c.at_[1]) && c.at_[1] != ']';
      if (!plain || count_ == 0 || c.failed()) return next_anyhow();
      ++c.at_;
      ++count_;
      return true;
    }
    std::uint64_t index() const { return count_ - 1; }  // of the present one

   private:
    bool next_anyhow();

    Cursor& cursor_;
    std::uint64_t count_ = 0;
  };

  // The same for an object. A name holds until the next string is read.
  class Members {
   public:
    explicit Members(Cursor& cursor) : cursor_(cursor) {}
    bool next(std::string_view& name);

   private:
    Cursor& cursor_;
    bool first_ = true;
  };

  const std::optional<Error>& error() const { return error_; }
  bool failed() const { return error_.has_value(); }
  const Path& path() const { return path_; }
  const Budget& budget() const { return budget_; }

  // Always false. `below` are further steps from where the cursor stands.
  bool fail(ErrorCode code, std::string message, Path below = {});
  bool fail_as(Error error);
  // The text stops being JSON here; or it ends here.
  bool fail_syntax(Path below = {});
  // "… is a string; it must be a number" — or fail_syntax() when there is no value at all.
  bool fail_type(std::string_view right, Path below = {});

  // Of the value that comes next.
  Type type();
  // Behind the last value; white space may follow it.
  bool at_end();

  // Enters an array or an object; `right` says what must stand here.
  bool open_array(std::string_view right, Path below = {});
  bool open_object(std::string_view right);
  // What the rest of an array holds, not looked into: for arrays that are to be allocated at once. 0 after a
  // failure.
  struct Ahead {
    std::size_t values = 0;    // commas and one: as many scalars as there can be
    std::size_t brackets = 0;  // opening ones
  };
  Ahead look_ahead();

  // `below` leads to the value. A number beyond a double is not_finite; one of more than kMaxNumberBytes is
  // too_large.
  bool read_number(double& out, std::string_view right, Path below = {});
  bool read_bool(bool& out, std::string_view right);
  bool read_null();
  // Without a copy where nothing is escaped; the view holds until the next string is read.
  bool read_string(std::string_view& out);
  bool read_string(std::string& out);
  // Of what has been read, which may be as long as the body.
  bool copy(std::string_view text, std::string& out);
  // The hot paths of arrays: false without a failure when the value is something else, and the cursor then
  // stands before it still.
  bool try_number(double& out);
  bool try_index(std::uint32_t& out);  // below kNoIndex; 3.0 and 1e2 are whole, too
  // Index of the word in `valid`.
  bool read_word(std::span<const std::string_view> valid, std::size_t& out);
  // Any value, depth-first, for members that are looked at but not used. `deepest`: how many arrays and
  // objects of the body may stand in each other; every step of path() leads into one of them.
  bool skip(std::size_t deepest);

  // Calls read() of the target for every member of the object, the cursor standing in the member. Unknown
  // names and names given twice are refused. `seen` comes back with one bit per member of the table.
  template <class Target>
  struct Member {
    std::string_view name;
    bool (Target::*read)();
  };

  template <class Target, std::size_t n>
  bool read_members(const std::array<Member<Target>, n>& table, Target& target, std::bitset<n>& seen) {
    std::string_view name;
    for (Members all(*this); all.next(name);) {
      std::size_t i = 0;
      while (i < n && table[i].name != name) ++i;
      if (i == n) return fail_unknown(name, names_of(table));
      if (seen[i]) return fail_twice(name);
      seen.set(i);
      const Step step(*this, table[i].name);
      if (!(target.*table[i].read)()) return false;
    }
    return !failed();
  }

  bool fail_unknown(std::string_view name, std::span<const std::string_view> valid);
  bool fail_twice(std::string_view name);

 private:
  static constexpr std::ptrdiff_t kBytesPerPoll = 1 << 18;  // some milliseconds of reading

  template <class Table>
  static auto names_of(const Table& table) {
    std::array<std::string_view, std::tuple_size_v<Table>> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = table[i].name;
    return names;
  }

  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  // Stands on the next character that is no white space, or at the end.
  void skip_space() {
    if (at_ < stop_ && !is_space(*at_)) return;
    skip_more_space();
  }
  void skip_more_space();
  bool at(char c) const { return at_ < end_ && *at_ == c; }
  bool poll();
  bool read_literal(std::string_view literal);
  bool read_long_string(std::string_view& out, const char* begin);
  bool append(std::string_view text, std::string& out);
  std::size_t rest_of_string();
  bool read_escape();
  bool fail_character();
  bool fail_long_number(Path below);
  Path path_to(Path below) const;
  bool skip_value(std::size_t depth, std::size_t deepest);
  const char* check_character(const char* p) const;

  const char* const begin_;
  const char* const end_;
  const char* at_;
  const char* stop_;  // where the budget is to be polled next
  const Budget& budget_;
  std::string unescaped_;
  bool skipping_ = false;  // of strings with escapes no more is kept than pointers show
  std::optional<Error> error_;
  Path path_;
};

}  // namespace subdivd::proto::json
