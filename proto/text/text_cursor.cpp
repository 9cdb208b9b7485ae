#include "proto/text/text_cursor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include "proto/json/number.h"
#include "proto/suggest.h"

namespace subdivd::proto::text {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kPiece = std::size_t{1} << 16;  // bytes between two looks at the clock

// What a character is to a word; a table, for there are a hundred million of them.
enum Letter : unsigned char { kLetter, kBackslash, kBlank, kNewline };

constexpr std::array<Letter, 256> kLetters = [] {
  std::array<Letter, 256> letters{};
  for (const char c : {' ', '\t', '\r', '\v', '\f'}) letters[static_cast<unsigned char>(c)] = kBlank;
  letters['\n'] = kNewline;
  letters['\\'] = kBackslash;
  return letters;
}();

Letter letter(char c) { return kLetters[static_cast<unsigned char>(c)]; }
bool is_blank(char c) { return letter(c) == kBlank; }
bool ends_word(char c) { return letter(c) >= kBlank; }

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

bool is_whole(std::string_view word) {
  word = without_plus(word);
  if (word.starts_with('-')) word.remove_prefix(1);
  return !word.empty() && std::ranges::all_of(word, json::is_digit);
}

TextCursor::TextCursor(std::string_view text, const Pace& pace, Continuation continuation)
    : at_(without_mark(text).data()),
      end_(text.data() + text.size()),
      pace_(pace),
      continues_(continuation == Continuation::backslash) {}

const char* TextCursor::behind_continuation() const {
  if (!continues_ || at_ == end_ || *at_ != '\\') return nullptr;
  const char* next = at_ + 1;
  if (next < end_ && *next == '\r') ++next;
  return next < end_ && *next == '\n' ? next + 1 : nullptr;
}

// Whether a word of this line follows.
bool TextCursor::skip_blanks() {
  const char* begin = at_;
  for (;;) {
    while (at_ < end_ && is_blank(*at_)) {
      ++at_;
      if (static_cast<std::size_t>(at_ - begin) < kPiece) continue;
      pace_.spend(kPiece / 16);
      begin = at_;
    }
    const char* const next = behind_continuation();
    if (next == nullptr) break;
    at_ = next;
    ++line_;
    pace_.spend(1);
  }
  if (at_ < end_ && *at_ == '#') {
    has_comment_ = true;
    skip_to_end_of_line();
  }
  return at_ < end_ && *at_ != '\n';
}

void TextCursor::skip_to_end_of_line() {
  while (at_ < end_) {
    const auto size = std::min(kPiece, static_cast<std::size_t>(end_ - at_));
    const auto* found = static_cast<const char*>(std::memchr(at_, '\n', size));
    const char* const stop = found != nullptr ? found : at_ + size;
    pace_.spend(static_cast<Count>(stop - at_) / 32 + 1);
    at_ = stop;
    if (found != nullptr) return;
  }
}

// To the end of the word, or to `stop`, which is none.
bool TextCursor::skip_word(const char* stop) {
  for (; at_ < stop; ++at_) {
    const Letter found = letter(*at_);
    if (found == kLetter) continue;
    if (found != kBackslash || behind_continuation() != nullptr) return true;
  }
  return at_ == end_;
}

Count TextCursor::skip_words() {
  Count words = 0;
  for (; !failed_ && skip_blanks(); ++words) {
    while (!skip_word(at_ + std::min<std::size_t>(kPiece, bytes_left()))) pace_.spend(kPiece / 16);
    pace_.spend(1);
  }
  return words;
}

bool TextCursor::next_line() {
  if (failed_) return false;
  if (std::exchange(begun_, true))
    skip_words();
  else if (skip_blanks())
    return true;
  while (at_ < end_) {
    ++at_;  // the end of the line
    ++line_;
    pace_.spend(1);
    if (skip_blanks()) return true;
  }
  return false;
}

std::string_view TextCursor::word() {
  if (failed_ || !skip_blanks()) return {};
  const char* const begin = at_;
  skip_word(begin + std::min<std::size_t>(kMaxWordBytes + 1, bytes_left()));
  pace_.spend(4);
  const std::string_view word(begin, static_cast<std::size_t>(at_ - begin));
  if (word.size() <= kMaxWordBytes) return word;
  fail(ErrorCode::too_large, "a word has more than " + std::to_string(kMaxWordBytes) + " characters");
  return {};
}

std::string_view TextCursor::rest() {
  if (failed_) return {};
  const char* begin = at_;
  for (;;) {
    skip_to_end_of_line();
    const char* const mark = at_ - (at_ > begin && at_[-1] == '\r' ? 2 : 1);
    if (!continues_ || at_ == end_ || mark < begin || *mark != '\\') break;
    ++at_;
    ++line_;
  }
  const char* stop = at_;
  for (; begin < stop && is_blank(*begin); ++begin) pace_.spend(1);
  for (; stop > begin && is_blank(stop[-1]); --stop) pace_.spend(1);
  const std::string_view name(begin, static_cast<std::size_t>(stop - begin));
  if (name.size() <= kMaxWordBytes) return name;
  fail(ErrorCode::too_large, "a name has more than " + std::to_string(kMaxWordBytes) + " characters");
  return {};
}

std::string joined_line(std::string_view rest) {
  std::string line;
  line.reserve(rest.size());
  for (std::size_t at = 0; at < rest.size();) {
    const std::size_t end = std::min(rest.find('\n', at), rest.size());
    std::string_view part = rest.substr(at, end - at);
    at = end + 1;
    if (end < rest.size()) {
      if (part.ends_with('\r')) part.remove_suffix(1);
      part.remove_suffix(1);  // the backslash
    }
    line += part;
    if (end < rest.size()) line += ' ';
  }
  return line;
}

Count TextCursor::count_words() const {
  Count words = 0;
  bool inside = false;
  for (const char* p = at_; p < end_;) {
    const char* const stop = p + std::min(kPiece, static_cast<std::size_t>(end_ - p));
    pace_.spend(static_cast<Count>(stop - p) / 16 + 1);
    for (; p < stop; ++p) {
      const bool letter = !ends_word(*p);
      words += letter && !inside ? 1 : 0;
      inside = letter;
    }
  }
  return words;
}

bool TextCursor::fail(ErrorCode code, std::string_view message) {
  if (failed_) return false;
  failed_ = true;
  error_ = Error{code, "line " + std::to_string(line_) + ": " + std::string(message)};
  return false;
}

bool TextCursor::to_number(std::string_view word, std::string_view what, double& out) {
  const std::string_view number = without_plus(word);
  double value = 0;
  const auto [stopped, fault] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (word.empty())
    return fail(ErrorCode::wrong_length, "the line ends where " + std::string(what) + " must stand");
  if (fault == std::errc::invalid_argument || stopped != number.data() + number.size())
    return fail(ErrorCode::wrong_type,
                in_quotes(word) + " is no number, as " + std::string(what) + " must be");
  const bool finite =
      fault == std::errc::result_out_of_range ? json::convert(number, value) : std::isfinite(value);
  if (!finite)
    return fail(ErrorCode::not_finite,
                in_quotes(word) + " is not a finite number, as " + std::string(what) + " must be");
  out = value;
  return true;
}

bool TextCursor::next_number(std::string_view what, double& out) {
  if (failed_ || !skip_blanks()) return to_number({}, what, out);
  const char* const stop = json::read_short(at_, end_, out);
  if (stop == nullptr || !ends_word(*stop)) return to_number(word(), what, out);
  at_ = stop;
  pace_.spend(4);
  return true;
}

bool TextCursor::to_whole(std::string_view word, std::string_view what, std::int64_t& out) {
  constexpr std::size_t kSurelyFits = 18;  // digits in 63 bits
  std::int64_t value = 0;
  std::size_t digits = 0;
  for (; digits < word.size() && digits < kSurelyFits && json::is_digit(word[digits]); ++digits)
    value = 10 * value + (word[digits] - '0');
  if (digits > 0 && digits == word.size()) {
    out = value;
    return true;
  }
  if (word.empty())
    return fail(ErrorCode::wrong_length, "the line ends where " + std::string(what) + " must stand");
  if (!is_whole(word))
    return fail(ErrorCode::wrong_type,
                in_quotes(word) + " is no whole number, as " + std::string(what) + " must be");
  const std::string_view number = without_plus(word);
  if (std::from_chars(number.data(), number.data() + number.size(), out).ec == std::errc()) return true;
  return fail(ErrorCode::out_of_range,
              std::string(what) + " " + in_quotes(word) + " is larger than any number here can be");
}

}  // namespace subdivd::proto::text
