#pragma once
// Finds the end of a head while it arrives, and sees as early as can be that there will never be one.

#include <cstddef>
#include <string_view>

namespace subdivd::server {

class HeadScan {
 public:
  enum class Verdict {
    incomplete,
    complete,
    not_http,        // a byte that no head can hold there: a TLS hello, a bare LF, a NUL
    endless_target,  // the first line alone is longer than a head may be
    too_large
  };

  // `text` is what has arrived, from the head's first byte on: at each call what it was before, and more.
  Verdict read(std::string_view text);
  // Of a complete head, the empty line included.
  std::size_t size() const { return scanned_; }

 private:
  std::size_t scanned_ = 0;      // so a head that drips in is read once, not once for each drop
  std::size_t line_length_ = 0;  // of the line under way
  std::size_t lines_ = 0;        // that have ended
  bool after_cr_ = false;
};

}  // namespace subdivd::server
