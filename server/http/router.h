#pragma once
// Paths and methods. Braces in a route's path stand for a value that is not empty and ends with its step, or
// where the letters after them begin: "/v1/assets/{id}/refined.{format}". A step has one pair at most.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/transport/message.h"

namespace subdivd::server {

using Handler = std::function<Response(Request&)>;

struct Route {
  std::string_view method;  // any; GET answers HEAD too, OPTIONS is answered for all
  std::string_view path;
  Handler handler;
  bool takes_gltf = false;  // POST: as a body, beside JSON
};

// Whether `path` is one of the route's; what stands in the places of braces comes back in `values`, in order,
// if that is not null.
bool matches(std::string_view route, std::string_view path, std::vector<std::string>* values);

class Router {
 public:
  explicit Router(std::vector<Route> routes) : routes_(std::move(routes)) {}

  // Null when path or method are not known; allowed_methods tells the two apart. Of several the first in the
  // list.
  const Route* find(std::string_view method, std::string_view path) const;
  // "GET, HEAD, POST, OPTIONS" of a path, as Allow says it; empty: no such path. "*": of all paths together.
  std::string allowed_methods(std::string_view path) const;
  const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
};

}  // namespace subdivd::server
