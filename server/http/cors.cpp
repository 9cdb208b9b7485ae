#include "server/http/cors.h"

#include <algorithm>
#include <utility>

namespace subdivd::server {

Cors::Cors(std::vector<std::string> origins)
    : origins_(std::move(origins)),
      any_(std::find(origins_.begin(), origins_.end(), "*") != origins_.end()) {}

bool Cors::allows(const Request& request) const {
  const std::string* origin = request.header("origin");
  return any_ ||
         (origin != nullptr && std::find(origins_.begin(), origins_.end(), *origin) != origins_.end());
}

void Cors::allow(const Request& request, Response& response) const {
  if (origins_.empty()) return;
  // The answer differs from origin to origin, so a cache must not give one page's answer to another.
  if (!any_) response.headers.emplace_back("Vary", "Origin");
  if (!allows(request)) return;
  response.headers.emplace_back("Access-Control-Allow-Origin", any_ ? "*" : *request.header("origin"));
  response.headers.emplace_back("Access-Control-Expose-Headers", "Retry-After, Server-Timing");
}

void Cors::answer_preflight(const Request& request, std::string_view methods, Response& response) const {
  if (!allows(request) || request.header("access-control-request-method") == nullptr) return;
  response.headers.emplace_back("Access-Control-Allow-Methods", methods);
  response.headers.emplace_back("Access-Control-Allow-Headers", "Content-Type, Accept");
  response.headers.emplace_back("Access-Control-Max-Age", "86400");
}

}  // namespace subdivd::server
