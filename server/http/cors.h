#pragma once
// Which web pages may talk to this server (the Fetch standard's CORS).

#include <string>
#include <string_view>
#include <vector>

#include "server/transport/message.h"

namespace subdivd::server {

class Cors {
 public:
  // "*" among the origins allows all; no origin allows none.
  explicit Cors(std::vector<std::string> origins);

  // Adds what a browser needs in order to show `response` to the page that sent `request`.
  void allow(const Request& request, Response& response) const;
  // Adds the answer to a preflight; `methods` as in an Allow header.
  void answer_preflight(const Request& request, std::string_view methods, Response& response) const;

 private:
  bool allows(const Request& request) const;
  std::vector<std::string> origins_;
  bool any_ = false;
};

}  // namespace subdivd::server
