#include "proto/json/cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/base/index.h"
#include "proto/client_text.h"
#include "proto/json/marks.h"
#include "proto/json/number.h"

namespace subdivd::proto::json {
namespace {

// Of a string that nobody asked for: enough to name a member in a pointer.
constexpr std::size_t kMostOfSkipped = 2 * kLongestClientText;
constexpr std::ptrdiff_t kBytesPerPoll = 1 << 18;  // some milliseconds of reading

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

bool is_hex_digit(char c) { return is_digit(c) || ((c | 0x20) >= 'a' && (c | 0x20) <= 'f'); }

bool continues(const char* p, const char* end, int count) {
  for (int k = 0; k < count; ++k)
    if (p + k >= end || (static_cast<unsigned char>(p[k]) & 0xC0) != 0x80) return false;
  return true;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0 | code >> 6);
  } else {
    if (code < 0x10000) {
      put(0xE0 | code >> 12);
    } else {
      put(0xF0 | code >> 18);
      put(0x80 | (code >> 12 & 0x3F));
    }
    put(0x80 | (code >> 6 & 0x3F));
  }
  put(0x80 | (code & 0x3F));
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
  Path where = path_;
  where.insert(where.end(), std::make_move_iterator(below.begin()), std::make_move_iterator(below.end()));
  error_ = Error{code, std::move(message), std::move(where), 0, 0};
  return false;
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
  const std::string_view before(begin_, static_cast<std::size_t>(at_ - begin_));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
  return fail(ErrorCode::malformed,
              "the body stops being valid JSON at line " + std::to_string(line) + ", column " +
                  std::to_string(column) + " (byte " + std::to_string(before.size()) + ")",
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

// What this finds malformed, reading will find, too.
Cursor::Ahead Cursor::look_ahead() {
  Ahead ahead{.values = 1, .brackets = 0};
  const char* p = at_;
  std::size_t depth = 1;
  bool quoted = false;
  while (p < end_) {
    const char* const stop = p + std::min(kBytesPerPoll, end_ - p);
    while (p < stop) {
      while (!quoted && stop - p >= Marks::kBytes) {
        const Marks marks = marks_in(p);
        if (marks.quote || marks.closing >= depth) break;
        ahead.values += marks.commas;
        ahead.brackets += marks.brackets + marks.braces;
        depth = depth + marks.brackets + marks.braces - marks.closing;
        p += Marks::kBytes;
      }
      // A block in which the order matters.
      for (const char* const block = p + std::min(Marks::kBytes, stop - p); p < block; ++p) {
        const char c = *p;
        if (quoted) {
          if (c == '\\')
            ++p;  // over the end at most by one, which ends all loops
          else
            quoted = c != '"';
          continue;
        }
        switch (c) {
          case ',':
            ++ahead.values;
            break;
          case '"':
            quoted = true;
            break;
          case '[':
          case '{':
            ++ahead.brackets;
            ++depth;
            break;
          case ']':
          case '}':
            if (--depth == 0) return ahead;
            break;
          default:
            break;
        }
      }
    }
    if (auto stopped = budget_.poll()) {
      fail_as(*std::move(stopped));
      return {};
    }
  }
  return ahead;
}

// --- Values -----------------------------------------------------------------------------------------------

bool Cursor::try_number(double& out) {
  skip_space();
  if (const char* const behind = read_short(at_, end_, out)) {
    at_ = behind;
    return at_ < stop_ || poll();
  }
  const auto [end, whole] = end_of_number(at_, end_);
  if (!whole || !convert(std::string_view(at_, static_cast<std::size_t>(end - at_)), out)) return false;
  at_ = end;
  return at_ < stop_ || poll();
}

bool Cursor::read_number(double& out, std::string_view right, Path below) {
  if (failed()) return false;
  if (try_number(out)) return true;
  if (failed()) return false;
  if (type() != Type::number) return fail_type(right, std::move(below));
  const auto [end, whole] = end_of_number(at_, end_);
  if (!whole) {
    at_ = end;
    return fail_syntax(std::move(below));
  }
  return fail(ErrorCode::not_finite,
              in_quotes(std::string_view(at_, static_cast<std::size_t>(end - at_))) +
                  " is beyond what a double can hold; it must be " + std::string(right),
              std::move(below));
}

bool Cursor::try_index(std::uint32_t& out) {
  skip_space();
  if (end_ - at_ > 8) {
    const Digits digits = digits_at(at_);
    const bool leading_zero = digits.count > 1 && *at_ == '0';
    if (digits.count > 0 && !leading_zero && ends_value(at_[digits.count])) {
      out = digits.value;
      at_ += digits.count;
      return at_ < stop_ || poll();
    }
  }
  const char* p = at_;
  std::uint64_t value = 0;
  while (p < end_ && is_digit(*p) && value < kNoIndex)
    value = 10 * value + static_cast<std::uint64_t>(*p++ - '0');
  const bool ends = p == end_ || ends_value(*p);
  const bool leading_zero = p - at_ > 1 && *at_ == '0';
  if (p > at_ && ends && !leading_zero) {
    if (value >= kNoIndex) return false;
    out = static_cast<std::uint32_t>(value);
    at_ = p;
    return at_ < stop_ || poll();
  }
  const char* const before = at_;
  double real = 0;
  if (!try_number(real)) return false;
  if (real >= 0 && real < kNoIndex && real == std::floor(real)) {
    out = static_cast<std::uint32_t>(real);
    return true;
  }
  at_ = before;
  return false;
}

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

// The end of the character of several bytes at p; null: it is not UTF-8.   [RFC 3629]
const char* Cursor::check_character(const char* p) const {
  const auto first = static_cast<unsigned char>(*p);
  const auto second = p + 1 < end_ ? static_cast<unsigned char>(p[1]) : 0u;
  if (first >= 0xC2 && first < 0xE0) return continues(p + 1, end_, 1) ? p + 2 : nullptr;
  if (first >= 0xE0 && first < 0xF0) {
    // Neither longer than needed nor half of a pair.
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0)) return nullptr;
    return continues(p + 1, end_, 2) ? p + 3 : nullptr;
  }
  if (first >= 0xF0 && first < 0xF5) {
    if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90)) return nullptr;
    return continues(p + 1, end_, 3) ? p + 4 : nullptr;
  }
  return nullptr;
}

// Stands before what is no character; one that the end of the body cuts is not wrong.
bool Cursor::fail_character() {
  const auto first = static_cast<unsigned char>(*at_);
  const std::ptrdiff_t left = end_ - at_, whole = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (first >= 0xC2 && first < 0xF5 && left < whole && continues(at_ + 1, end_, static_cast<int>(left) - 1))
    at_ = end_;
  return fail_syntax();
}

bool Cursor::read_string(std::string_view& out) {
  if (type() != Type::string) return fail_type("a string");
  const char* const begin = ++at_;
  while (at_ < end_) {
    const auto c = static_cast<unsigned char>(*at_);
    if (c == '"') {
      out = {begin, static_cast<std::size_t>(at_ - begin)};
      ++at_;
      return at_ < stop_ || poll();
    }
    if (c == '\\') return read_long_string(out, begin);
    if (c < 0x20) return fail_syntax();
    if (c < 0x80) {
      ++at_;
    } else {
      const char* const next = check_character(at_);
      if (next == nullptr) return fail_character();
      at_ = next;
    }
    if (at_ >= stop_ && !poll()) return false;
  }
  return fail_syntax();
}

// A string with escapes, which begins at `begin`; the cursor stands on the first of them.
bool Cursor::read_long_string(std::string_view& out, const char* begin) {
  const std::size_t most = skipping_ ? kMostOfSkipped : std::string::npos;
  unescaped_.assign(begin, std::min(static_cast<std::size_t>(at_ - begin), most));
  while (at_ < end_) {
    if (unescaped_.size() > most) unescaped_.resize(most);
    const auto c = static_cast<unsigned char>(*at_);
    if (c == '"') {
      ++at_;
      out = unescaped_;
      return at_ < stop_ || poll();
    }
    if (c < 0x20) return fail_syntax();
    if (c == '\\') {
      if (!read_escape()) return false;
    } else {
      const char* const next = c < 0x80 ? at_ + 1 : check_character(at_);
      if (next == nullptr) return fail_character();
      unescaped_.append(at_, next);
      at_ = next;
    }
    if (at_ >= stop_ && !poll()) return false;
  }
  return fail_syntax();
}

bool Cursor::read_escape() {
  const auto unit = [&](std::uint32_t& code) {  // \uXXXX
    for (const char* const begin = at_; at_ < begin + 6; ++at_) {
      if (at_ == end_) return false;
      const bool fits = at_ == begin ? *at_ == '\\' : at_ == begin + 1 ? *at_ == 'u' : is_hex_digit(*at_);
      if (!fits) return false;
    }
    std::from_chars(at_ - 4, at_, code, 16);
    return true;
  };
  static constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
  if (at_ + 1 == end_) {
    ++at_;
    return fail_syntax();
  }
  if (at_[1] != 'u') {
    const std::size_t letter = kLetters.find(at_[1]);
    if (letter == std::string_view::npos) return fail_syntax();
    unescaped_ += kMeanings[letter];
    at_ += 2;
    return true;
  }
  std::uint32_t code = 0, second = 0;
  if (!unit(code)) return fail_syntax();
  if (code >= 0xDC00 && code < 0xE000) return fail_syntax();  // half of a pair
  if (code >= 0xD800 && code < 0xDC00) {
    if (!unit(second) || second < 0xDC00 || second >= 0xE000) return fail_syntax();
    code = 0x10000 + ((code - 0xD800) << 10) + (second - 0xDC00);
  }
  append_utf8(unescaped_, code);
  return true;
}

bool Cursor::read_string(std::string& out) {
  std::string_view text;
  if (!read_string(text)) return false;
  out = text;
  return true;
}

bool Cursor::read_word(std::span<const std::string_view> valid, std::size_t& out) {
  if (type() != Type::string) return fail_type(std::string("one of ") + either_of(valid));
  std::string_view text;
  if (!read_string(text)) return false;
  const auto found = std::find(valid.begin(), valid.end(), text);
  if (found == valid.end())
    return fail(ErrorCode::bad_enum, std::string("this is ") + in_quotes(text) + hint(text, valid));
  out = static_cast<std::size_t>(found - valid.begin());
  return true;
}

bool Cursor::skip(std::size_t depth_left) {
  const bool before = std::exchange(skipping_, true);
  const bool fine = skip_value(depth_left);
  skipping_ = before;
  return fine;
}

bool Cursor::skip_value(std::size_t depth_left) {
  if (failed()) return false;
  // A body of nothing but "[" would otherwise use up our stack.
  if (depth_left == 0) return fail(ErrorCode::too_large, "arrays and objects are nested too deeply");
  // The path to what is wrong is put together on the way out.
  const auto blame = [&](PathStep step) {
    const ErrorCode code = error_->code;
    if (code == ErrorCode::malformed || code == ErrorCode::not_finite)
      error_->where.insert(error_->where.begin() + static_cast<std::ptrdiff_t>(path_.size()),
                           std::move(step));
    return false;
  };
  switch (type()) {
    case Type::array: {
      ++at_;
      for (Elements all(*this); all.next();)
        if (!skip_value(depth_left - 1)) return blame(all.index());
      return !failed();
    }
    case Type::object: {
      ++at_;
      std::string_view name;
      for (Members all(*this); all.next(name);) {
        std::string kept = client_text(name);
        if (!skip_value(depth_left - 1)) return blame(std::move(kept));
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
