#pragma once
// Which HTTP status says what.
//
//   400  bytes that are not JSON, GLB or glTF at all; a bad query parameter; malformed HTTP
//   413  a body larger than allowed
//   422  a well-formed body that breaks a rule; answers larger than allowed (predicted and allowed are given)
//   500  our own failure, without details
//   503  out of time, overloaded or shutting down
//   404, 405, 406, 408, 414, 415, 417, 431, 501, 505 as RFC 9110 says

#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "server/transport/message.h"
#include "server/transport/service.h"

namespace subdivd::server {

int status_of(const Error& error);

// What is the same for every occurrence of a code that is not an ErrorCode's; never empty.
std::string_view title_of_refusal(std::string_view code);

// All codes that title_of_refusal knows.
std::vector<std::string_view> refusal_codes();

// application/problem+json, RFC 9457. 503s say when to come again.
Response problem_response(const Error& error);
Response problem_response(const Refusal& refusal);

}  // namespace subdivd::server
