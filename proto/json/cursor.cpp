#include "proto/json/cursor.h"

#include <algorithm>
#include <iterator>

#include "proto/client_text.h"
#include "proto/json/number.h"
#include "proto/json_limits.h"

namespace subdivd::proto::json {
namespace {

std::string_view name_of_type(Type type) {
  switch (type) {
    case Type::array:
      return "an array";
    case Type::object:
      return "an object";
    case Type::number:
      return "a number";
    case Type::string:
      return "a string";
    case Type::boolean:
      return "a boolean";
    case Type::null:
      return "null";
    case Type::none:
      break;
  }
  return "something else";
}

}  // namespace

Cursor::Cursor(std::string_view text, const Budget& budget)
    : begin_(text.data()), end_(text.data() + text.size()), at_(begin_), stop_(begin_), budget_(budget) {
  // A byte order mark is no JSON, but some editors write it.
  if (text.starts_with("\xEF\xBB\xBF")) at_ += 3;
  poll();
}

// --- Places and failures ----------------------------------------------------------------------------------

Cursor::Step::Step(Cursor& cursor, std::string_view member) : cursor_(cursor) {
  cursor_.path_.emplace_back(client_text(member));
}

Cursor::Step::Step(Cursor& cursor, std::uint64_t element) : cursor_(cursor) {
  cursor_.path_.emplace_back(element);
}

bool Cursor::fail(ErrorCode code, std::string message, Path below) {
  if (error_) return false;
  error_ = Error{code, std::move(message), path_to(std::move(below))};
  return false;
}

Path Cursor::path_to(Path below) const {
  Path where = path_;
  where.insert(where.end(), std::make_move_iterator(below.begin()), std::make_move_iterator(below.end()));
  return where;
}

bool Cursor::fail_as(Error error) {
  if (!error_) error_ = std::move(error);
  return false;
}

bool Cursor::fail_syntax(Path below) {
  if (error_) return false;
  if (at_ >= end_)
    return fail(ErrorCode::malformed, "the body ends in the middle of its JSON; is it cut short?",
                std::move(below));
  std::ptrdiff_t line = 1;
  const char* begin_of_line = begin_;
  for (const char* p = begin_; p < at_;) {
    const char* const end = p + std::min(kBytesPerPoll, at_ - p);
    line += std::count(p, end, '\n');
    const char* const behind = std::find(std::reverse_iterator(end), std::reverse_iterator(p), '\n').base();
    if (behind != p) begin_of_line = behind;
    p = end;
    if (auto stopped = budget_.poll()) return fail_as(*std::move(stopped));
  }
  return fail(ErrorCode::malformed,
              "the body stops being valid JSON at line " + std::to_string(line) + ", column " +
                  std::to_string(at_ - begin_of_line + 1) + " (byte " + std::to_string(at_ - begin_) + ")",
              std::move(below));
}

bool Cursor::fail_type(std::string_view right, Path below) {
  const Type found = type();
  if (found == Type::none) return fail_syntax(std::move(below));
  return fail(
      ErrorCode::wrong_type,
      std::string("this is ") + std::string(name_of_type(found)) + "; it must be " + std::string(right),
      std::move(below));
}

bool Cursor::fail_unknown(std::string_view name, std::span<const std::string_view> valid) {
  return fail(ErrorCode::unknown_field,
              std::string("there is no member ") + in_quotes(name) + " here" + hint(name, valid),
              {client_text(name)});
}

bool Cursor::fail_twice(std::string_view name) {
  return fail(ErrorCode::duplicate_field,
              std::string("the member ") + in_quotes(name) + " is given twice; give it once",
              {client_text(name)});
}

bool Cursor::poll() {
  stop_ = at_ + std::min(kBytesPerPoll, end_ - at_);
  if (error_) return false;
  auto stopped = budget_.poll();
  return stopped ? fail_as(*std::move(stopped)) : true;
}

// --- Between values ---------------------------------------------------------------------------------------

void Cursor::skip_more_space() {
  while (at_ < end_) {
    while (at_ < stop_ && is_space(*at_)) ++at_;
    if (at_ < stop_ || at_ == end_ || !poll()) return;
  }
}

Type Cursor::type() {
  skip_space();
  if (at_ >= end_) return Type::none;
  switch (*at_) {
    case '[':
      return Type::array;
    case '{':
      return Type::object;
    case '"':
      return Type::string;
    case 't':
    case 'f':
      return Type::boolean;
    case 'n':
      return Type::null;
    case '-':
      return Type::number;
    default:
      return is_digit(*at_) ? Type::number : Type::none;
  }
}

bool Cursor::at_end() {
  skip_space();
  return !failed() && at_ == end_;
}

bool Cursor::open_array(std::string_view right, Path below) {
  if (type() != Type::array) return fail_type(right, std::move(below));
  ++at_;
  return !failed();
}

bool Cursor::open_object(std::string_view right) {
  if (type() != Type::object) return fail_type(right);
  ++at_;
  return !failed();
}

bool Cursor::Elements::next_anyhow() {
  Cursor& c = cursor_;
  if (c.failed()) return false;
  c.skip_space();
  if (c.at(']')) {
    ++c.at_;
    return false;
  }
  if (count_ > 0) {
    if (!c.at(',')) return c.fail_syntax({count_});
    ++c.at_;
    c.skip_space();
    if (c.at(']')) return c.fail_syntax({count_});
  }
  ++count_;
  return !c.failed();
}

bool Cursor::Members::next(std::string_view& name) {
  Cursor& c = cursor_;
  if (c.failed()) return false;
  c.skip_space();
  if (c.at('}')) {
    ++c.at_;
    return false;
  }
  if (!std::exchange(first_, false)) {
    if (!c.at(',')) return c.fail_syntax();
    ++c.at_;
    c.skip_space();
  }
  if (!c.at('"')) return c.fail_syntax();
  if (!c.read_string(name)) return false;
  c.skip_space();
  if (!c.at(':')) return c.fail_syntax({client_text(name)});
  ++c.at_;
  return !c.failed();
}

// --- Values -----------------------------------------------------------------------------------------------

bool Cursor::read_literal(std::string_view literal) {
  const auto left = static_cast<std::size_t>(end_ - at_);
  const std::string_view found(at_, std::min(left, literal.size()));
  if (found != literal) {
    // Where it differs is where the text stops being JSON.
    at_ += std::mismatch(found.begin(), found.end(), literal.begin()).first - found.begin();
    return fail_syntax();
  }
  at_ += literal.size();
  return !failed();
}

bool Cursor::read_bool(bool& out, std::string_view right) {
  if (type() != Type::boolean) return fail_type(right);
  out = *at_ == 't';
  return read_literal(out ? "true" : "false");
}

bool Cursor::read_null() {
  if (type() != Type::null) return fail_type("null");
  return read_literal("null");
}

bool Cursor::skip(std::size_t deepest) {
  const bool before = std::exchange(skipping_, true);
  const bool fine = skip_value(path_.size(), deepest);
  skipping_ = before;
  return fine || (!failed() && fail_as(nested_too_deeply(path_, deepest)));
}

// The value stands in `depth` arrays and objects. False without a failure: it is nested too deeply.
bool Cursor::skip_value(std::size_t depth, std::size_t deepest) {
  if (failed()) return false;
  // The path to what is wrong is put together on the way out.
  const auto blame = [&](PathStep step) {
    if (!error_) return false;
    const ErrorCode code = error_->code;
    if (code == ErrorCode::malformed || code == ErrorCode::not_finite || code == ErrorCode::too_large)
      error_->where.insert(error_->where.begin() + static_cast<std::ptrdiff_t>(path_.size()),
                           std::move(step));
    return false;
  };
  const Type found = type();
  // A body of nothing but "[" would otherwise use up our stack.
  if ((found == Type::array || found == Type::object) && depth >= deepest) return false;
  switch (found) {
    case Type::array: {
      ++at_;
      for (Elements all(*this); all.next();)
        if (!skip_value(depth + 1, deepest)) return blame(all.index());
      return !failed();
    }
    case Type::object: {
      ++at_;
      std::string_view name;
      for (Members all(*this); all.next(name);) {
        std::string kept = client_text(name);
        if (!skip_value(depth + 1, deepest)) return blame(std::move(kept));
      }
      return !failed();
    }
    case Type::number: {
      double number = 0;
      return read_number(number, "a finite number");
    }
    case Type::string: {
      std::string_view text;
      return read_string(text);
    }
    case Type::boolean: {
      bool truth = false;
      return read_bool(truth, "true or false");
    }
    case Type::null:
      return read_null();
    case Type::none:
      break;
  }
  return fail_syntax();
}

}  // namespace subdivd::proto::json
