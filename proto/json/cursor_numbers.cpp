// Numbers as the cursor reads them, and how many of them an array can hold.

#include <algorithm>
#include <cmath>

#include "core/base/index.h"
#include "proto/json/cursor.h"
#include "proto/json/marks.h"
#include "proto/json/number.h"
#include "proto/json_limits.h"

namespace subdivd::proto::json {
namespace {

bool belongs_to_number(char c) {
  return is_digit(c) || c == '.' || c == 'e' || c == 'E' || c == '-' || c == '+';
}

// As end_of_number, but not further than one character too many.
NumberEnd end_of_capped(const char* p, const char* end) {
  constexpr auto kMost = static_cast<std::ptrdiff_t>(kMaxNumberBytes) + 1;
  return end_of_number(p, p + std::min(end - p, kMost));
}

bool is_too_long(const char* begin, const char* end) {
  return end - begin > static_cast<std::ptrdiff_t>(kMaxNumberBytes);
}

}  // namespace

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

bool Cursor::try_number(double& out) {
  skip_space();
  if (const char* const behind = read_short(at_, end_, out)) {
    at_ = behind;
    return at_ < stop_ || poll();
  }
  const auto [end, whole] = end_of_capped(at_, end_);
  if (!whole || is_too_long(at_, end) ||
      !convert(std::string_view(at_, static_cast<std::size_t>(end - at_)), out))
    return false;
  at_ = end;
  return at_ < stop_ || poll();
}

bool Cursor::read_number(double& out, std::string_view right, Path below) {
  if (failed()) return false;
  if (try_number(out)) return true;
  if (failed()) return false;
  if (type() != Type::number) return fail_type(right, std::move(below));
  const auto [end, whole] = end_of_capped(at_, end_);
  if (is_too_long(at_, end)) return fail_long_number(std::move(below));
  if (!whole) {
    at_ = end;
    return fail_syntax(std::move(below));
  }
  return fail(ErrorCode::not_finite,
              in_quotes(std::string_view(at_, static_cast<std::size_t>(end - at_))) +
                  " is beyond what a double can hold; it must be " + std::string(right),
              std::move(below));
}

// Stands before the number, which may be all of the body.
bool Cursor::fail_long_number(Path below) {
  const char* const begin = at_;
  while (at_ < end_ && belongs_to_number(*at_)) {
    ++at_;
    if (at_ >= stop_ && !poll()) return false;
  }
  return fail_as(number_too_long(path_to(std::move(below)), static_cast<Count>(begin - begin_),
                                 static_cast<Count>(at_ - begin)));
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
  while (p < end_ && is_digit(*p) && p - at_ < 11)  // one more than any index has
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

}  // namespace subdivd::proto::json
