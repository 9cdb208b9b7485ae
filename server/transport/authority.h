#pragma once
#include <string_view>

namespace subdivd::server {

// Is this host[:port] as RFC 3986, 3.2 has it: a name, an IPv4 address or an IPv6 address in brackets, and a
// port below 65536? No user names, no blanks, no markup: a Host is echoed by whoever builds links from it.
bool is_authority(std::string_view text);

}  // namespace subdivd::server
