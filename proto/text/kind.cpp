#include "proto/text/kind.h"

#include <string>

#include "core/base/pace.h"
#include "proto/text/obj_words.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

// Of an OFF without its header: two or three counts stand alone.
bool is_counts(TextCursor& cursor, std::string_view word) {
  int words = 0;
  for (; !word.empty(); word = cursor.word())
    if (++words > 3 || !is_whole(word)) return false;
  return words >= 2;
}

TextKind kind_of(std::string_view body, const Pace& pace) {
  TextCursor cursor(body, pace, TextCursor::Continuation::none);
  const bool found = cursor.next_line(), commented = cursor.has_comment();
  if (!found) return commented ? TextKind::obj : TextKind::none;
  const std::string_view word = cursor.word();
  if (is_off_header(word)) return TextKind::off;
  if (is_obj_word(word)) return TextKind::obj;
  if (is_counts(cursor, word)) return TextKind::off;
  return commented ? TextKind::obj : TextKind::none;
}

}  // namespace

bool is_off_header(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

Result<TextKind> find_kind(std::string_view body, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return kind_of(body, pace); });
}

}  // namespace subdivd::proto::text
