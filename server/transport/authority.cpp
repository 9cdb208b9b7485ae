#include "server/transport/authority.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "server/transport/grammar.h"

namespace subdivd::server {
namespace {

bool is_port(std::string_view text) {
  constexpr int kMost = 65535;
  if (text.size() > 5 || !std::all_of(text.begin(), text.end(), is_digit)) return false;
  int value = 0;
  for (const char c : text) value = value * 10 + (c - '0');
  return value <= kMost;
}

bool is_ipv6(std::string_view text) {
  std::array<char, INET6_ADDRSTRLEN> copy{};  // inet_pton wants a NUL at the end
  if (text.size() >= copy.size()) return false;
  text.copy(copy.data(), text.size());
  in6_addr address{};
  return ::inet_pton(AF_INET6, copy.data(), &address) == 1;
}

// reg-name = *( unreserved / pct-encoded / sub-delims ); an IPv4 address is one, too
bool is_name(std::string_view text) {
  constexpr std::string_view kMarks = "-._~!$&'()*+,;=";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_digit(c) || is_letter(c) || kMarks.find(c) != std::string_view::npos) continue;
    if (c != '%' || i + 2 >= text.size() || hex_digit(text[i + 1]) < 0 || hex_digit(text[i + 2]) < 0)
      return false;
    i += 2;
  }
  return !text.empty();
}

}  // namespace

bool is_authority(std::string_view text) {
  const bool bracketed = text.starts_with('[');
  const std::size_t end = bracketed ? text.find(']') : text.find(':');
  if (bracketed) {
    if (end == std::string_view::npos || !is_ipv6(text.substr(1, end - 1))) return false;
    text.remove_prefix(end + 1);
  } else {
    const std::string_view name = text.substr(0, end);
    if (!is_name(name)) return false;
    text.remove_prefix(name.size());
  }
  return text.empty() || (text.front() == ':' && is_port(text.substr(1)));
}

}  // namespace subdivd::server
