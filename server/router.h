#pragma once
// Paths and methods. A step of a route's path in braces stands for any one step that is not empty.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/transport/message.h"

namespace subdivd::server {

using Handler = std::function<Response(Request&)>;

struct Route {
  std::string_view method;  // GET answers HEAD too
  std::string_view path;
  Handler handler;
  bool takes_gltf = false;  // POST: as a body, beside JSON
};

// Whether `path` is one of the route's; its steps in the places of braces come back in `values`, if it is not
// null.
bool matches(std::string_view route, std::string_view path, std::vector<std::string>* values);

class Router {
 public:
  explicit Router(std::vector<Route> routes) : routes_(std::move(routes)) {}

  // Null when path or method are not known; allowed_methods tells the two apart.
  const Route* find(std::string_view method, std::string_view path) const;
  // "GET, HEAD, OPTIONS" of a path; empty: no such path. "*": of all paths together.
  std::string allowed_methods(std::string_view path) const;
  const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
};

}  // namespace subdivd::server
