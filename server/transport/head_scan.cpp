#include "server/transport/head_scan.h"

#include "server/transport/grammar.h"
#include "server/transport/head.h"

namespace subdivd::server {

HeadScan::Verdict HeadScan::read(std::string_view text) {
  while (scanned_ < text.size()) {
    if (scanned_ == kMaxHeadBytes) return lines_ == 0 ? Verdict::endless_target : Verdict::too_large;
    const char c = text[scanned_];
    if (after_cr_) {
      if (c != '\n') return Verdict::not_http;
      ++scanned_;
      after_cr_ = false;
      if (line_length_ == 0) return Verdict::complete;
      line_length_ = 0;
      ++lines_;
      continue;
    }
    if (c == '\r') {
      after_cr_ = true;
    } else {
      if (!is_text_character(c) || (scanned_ == 0 && !is_token_character(c))) return Verdict::not_http;
      ++line_length_;
    }
    ++scanned_;
  }
  if (scanned_ < kMaxHeadBytes) return Verdict::incomplete;
  return lines_ == 0 ? Verdict::endless_target : Verdict::too_large;
}

}  // namespace subdivd::server
