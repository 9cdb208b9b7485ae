#pragma once
#include <string>

namespace subdivd::server {

// The page at "/": server/web/page.html with the version in it.
std::string web_page();

}  // namespace subdivd::server
