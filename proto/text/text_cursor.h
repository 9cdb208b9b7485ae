#pragma once
// Lines of words, as OBJ and OFF are written: one pass over the text, in order. It keeps the number of the
// line and the first fault; nothing is allocated.

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"

namespace subdivd::proto::text {

inline constexpr Count kMaxWordBytes = 4096;  // as of JSON's numbers; of a name, too

// A comment runs from a word that begins with '#' to the end of its line. Lines end with LF; a CR is a blank.
class TextCursor {
 public:
  enum class Continuation {
    none,
    backslash,  // of OBJ: a line that ends with '\' goes on in the next one
  };

  // Both must outlive the cursor. A byte order mark is left out. The pace throws where the work is to stop.
  TextCursor(std::string_view text, const Pace& pace, Continuation continuation);

  // Goes to the next line that has a word, whatever is left of this one. False at the end of the text, and
  // after a fault.
  bool next_line();
  // The next word of the line. Empty at its end and after a fault; a word longer than kMaxWordBytes is one.
  std::string_view word();
  // The next word as to_number() takes it: faster, where it is a short number.
  bool next_number(std::string_view what, double& out);
  // Words left in the line; it is behind them then. A word may have any length.
  Count skip_words();
  // What is left of the line, without blanks around it, '#' being a letter; where the line is continued, with
  // the marks of that (joined_line() takes them out).
  std::string_view rest();
  // Words left in the text, comments included.
  Count count_words() const;

  // Numbered from 1; of the last word.
  Count line() const { return line_; }
  Count bytes_left() const { return static_cast<Count>(end_ - at_); }

  // Always false. The first fault stays; "line 12: " is put in front of the message.
  bool fail(ErrorCode code, std::string_view message);
  bool failed() const { return failed_; }
  bool has_comment() const { return has_comment_; }  // before the present line, or before its end
  const Error& error() const { return error_; }

  // The word as a finite number, correctly rounded; as a whole number. `what` names it in messages.
  bool to_number(std::string_view word, std::string_view what, double& out);
  bool to_whole(std::string_view word, std::string_view what, std::int64_t& out);

 private:
  bool skip_blanks();
  const char* behind_continuation() const;  // null: the line ends as others do, or not here
  void skip_to_end_of_line();
  bool skip_word(const char* stop);

  const char* at_;
  const char* const end_;
  const Pace& pace_;
  const bool continues_;
  bool begun_ = false, failed_ = false, has_comment_ = false;
  Count line_ = 1;
  Error error_;
};

// A rest() that may run over several lines, as one line.
std::string joined_line(std::string_view rest);

// Whether a word has nothing but digits, and a sign before them.
bool is_whole(std::string_view word);

}  // namespace subdivd::proto::text
