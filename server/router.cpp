#include "server/router.h"

#include <algorithm>
#include <utility>

namespace subdivd::server {

bool matches(std::string_view route, std::string_view path, std::vector<std::string>* values) {
  std::vector<std::string> found;
  while (true) {
    const std::size_t end = std::min(route.find('/'), route.size()),
                      path_end = std::min(path.find('/'), path.size());
    const std::string_view step = route.substr(0, end), given = path.substr(0, path_end);
    if (step.starts_with('{')) {
      if (given.empty()) return false;
      found.emplace_back(given);
    } else if (step != given) {
      return false;
    }
    if (end == route.size() || path_end == path.size()) {
      if (end != route.size() || path_end != path.size()) return false;
      if (values != nullptr) *values = std::move(found);
      return true;
    }
    route.remove_prefix(end + 1);
    path.remove_prefix(path_end + 1);
  }
}

const Route* Router::find(std::string_view method, std::string_view path) const {
  if (method == "HEAD") method = "GET";
  for (const Route& route : routes_)
    if (route.method == method && matches(route.path, path, nullptr)) return &route;
  return nullptr;
}

std::string Router::allowed_methods(std::string_view path) const {
  bool get = false, post = false;
  for (const Route& route : routes_) {
    if (path != "*" && !matches(route.path, path, nullptr)) continue;
    (route.method == "GET" ? get : post) = true;
  }
  if (!get && !post) return {};
  return std::string(get ? "GET, HEAD, " : "") + (post ? "POST, " : "") + "OPTIONS";
}

}  // namespace subdivd::server
