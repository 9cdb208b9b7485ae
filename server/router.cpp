#include "server/router.h"

namespace subdivd::server {

const Route* Router::find(std::string_view method, std::string_view path) const {
  if (method == "HEAD") method = "GET";
  for (const Route& route : routes_)
    if (route.path == path && route.method == method) return &route;
  return nullptr;
}

std::string Router::allowed_methods(std::string_view path) const {
  bool get = false, post = false;
  for (const Route& route : routes_) {
    if (path != "*" && route.path != path) continue;
    (route.method == "GET" ? get : post) = true;
  }
  if (!get && !post) return {};
  return std::string(get ? "GET, HEAD, " : "") + (post ? "POST, " : "") + "OPTIONS";
}

}  // namespace subdivd::server
