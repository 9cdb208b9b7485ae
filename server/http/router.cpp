#include "server/http/router.h"

#include <algorithm>
#include <utility>

namespace subdivd::server {
namespace {

// One step of a pattern, perhaps with a place for a value between its letters, against one step of a path.
bool step_matches(std::string_view pattern, std::string_view step, std::vector<std::string>& values) {
  const std::size_t open = pattern.find('{'), close = pattern.find('}');
  if (open == std::string_view::npos || close == std::string_view::npos) return pattern == step;
  const std::string_view before = pattern.substr(0, open), after = pattern.substr(close + 1);
  if (step.size() <= before.size() + after.size()) return false;
  if (!step.starts_with(before) || !step.ends_with(after)) return false;
  values.emplace_back(step.substr(before.size(), step.size() - before.size() - after.size()));
  return true;
}

}  // namespace

bool matches(std::string_view route, std::string_view path, std::vector<std::string>* values) {
  std::vector<std::string> found;
  while (true) {
    const std::size_t end = std::min(route.find('/'), route.size()),
                      path_end = std::min(path.find('/'), path.size());
    if (!step_matches(route.substr(0, end), path.substr(0, path_end), found)) return false;
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
  std::vector<std::string_view> others;
  bool get = false;
  for (const Route& route : routes_) {
    if (path != "*" && !matches(route.path, path, nullptr)) continue;
    if (route.method == "GET")
      get = true;
    else if (std::ranges::find(others, route.method) == others.end())
      others.push_back(route.method);
  }
  if (!get && others.empty()) return {};
  std::ranges::sort(others);
  std::string all = get ? "GET, HEAD, " : "";
  for (const std::string_view method : others) all.append(method).append(", ");
  return all + "OPTIONS";
}

}  // namespace subdivd::server
