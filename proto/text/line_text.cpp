#include "proto/text/line_text.h"

#include <cstddef>

#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

unsigned char_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

// Bytes of the character of UTF-8 that begins at `i`; 0: none does.   [RFC 3629]
std::size_t character_size(std::string_view text, std::size_t i) {
  const unsigned first = char_at(text, i), second = char_at(text, i + 1);
  if (first < 0x80) return 1;
  std::size_t size = 0;
  if (first >= 0xC2 && first < 0xE0) size = 2;
  if (first >= 0xE0 && first < 0xF0) size = 3;
  if (first >= 0xF0 && first < 0xF5) size = 4;
  // Longer than needed, half of a pair, beyond the last character.
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
    return 0;
  for (std::size_t k = 1; k < size; ++k)
    if ((char_at(text, i + k) & 0xC0) != 0x80) return 0;
  return size;
}

bool may_end_line(std::string_view character) {
  const unsigned first = char_at(character, 0), second = char_at(character, 1);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  return (first == 0xC2 && second < 0xA0) || character == "\u2028" || character == "\u2029";
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

}  // namespace

std::string line_text(std::string_view text) {
  text = without_blanks(text);
  std::string line;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = character_size(text, i);
    const std::string_view character = text.substr(i, size);
    const bool kept = size > 0 && !may_end_line(character);
    if (line.size() + (kept ? size : 1) > kMaxWordBytes) break;
    line += kept ? character : "_";
    i += size > 0 ? size : 1;
  }
  while (line.ends_with(' ')) line.pop_back();  // where it was cut
  if (line.ends_with('\\')) line.back() = '_';
  return line;
}

}  // namespace subdivd::proto::text
