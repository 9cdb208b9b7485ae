#include "proto/client_text.h"

namespace subdivd::proto {
namespace {

constexpr std::string_view kMark = "…";

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

}  // namespace

std::string client_text(std::string_view text) {
  if (text.size() <= kLongestClientText) return std::string(text);
  std::size_t end = kLongestClientText - kMark.size();
  // A character has at most 3 continuing bytes; more of them are no UTF-8, and may be cut anywhere.
  for (std::size_t back = 0; back < 3 && end > 0 && continues(text[end]); ++back) --end;
  return std::string(text.substr(0, end)).append(kMark);
}

}  // namespace subdivd::proto
