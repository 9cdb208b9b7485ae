// Strings as the cursor reads them: escapes, and what is UTF-8.

#include <algorithm>
#include <charconv>

#include "core/base/buffer.h"
#include "proto/client_text.h"
#include "proto/json/cursor.h"
#include "proto/json/number.h"

namespace subdivd::proto::json {
namespace {

// Of a string that nobody asked for: enough to name a member in a pointer.
constexpr std::size_t kMostOfSkipped = 2 * kLongestClientText;
// At once: growing would copy what is there, in one go that nothing stops.
void reserve(std::string& text, std::size_t size) {
  text.reserve(size);
  large_blocks::prefer_huge_pages(text.data(), text.capacity());
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

bool Cursor::append(std::string_view text, std::string& out) {
  constexpr auto kPiece = static_cast<std::size_t>(kBytesPerPoll);
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), kPiece))) {
    out.append(text.substr(0, kPiece));
    if (text.size() > kPiece && !poll()) return false;
  }
  return !failed();
}

// Bytes up to the closing quote, or to the end of the body; what is malformed reading will find. 0 after a
// failure.
std::size_t Cursor::rest_of_string() {
  const char* p = at_;
  while (p < end_) {
    for (const char* const stop = p + std::min(kBytesPerPoll, end_ - p); p < stop; ++p) {
      if (*p == '"') return static_cast<std::size_t>(p - at_);
      if (*p == '\\') ++p;  // over the end at most by one, which ends both loops
    }
    if (p < end_ && !poll()) return 0;
  }
  return static_cast<std::size_t>(end_ - at_);
}

// A string with escapes, which begins at `begin`; the cursor stands on the first of them.
bool Cursor::read_long_string(std::string_view& out, const char* begin) {
  const std::size_t most = skipping_ ? kMostOfSkipped : std::string::npos;
  const auto plain = static_cast<std::size_t>(at_ - begin);
  unescaped_.clear();
  const std::size_t rest = rest_of_string();
  reserve(unescaped_, std::min(plain + rest, most));
  if (!append({begin, std::min(plain, most)}, unescaped_)) return false;
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
  return read_string(text) && copy(text, out);
}

bool Cursor::copy(std::string_view text, std::string& out) {
  out.clear();
  reserve(out, text.size());
  return append(text, out);
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

}  // namespace subdivd::proto::json
