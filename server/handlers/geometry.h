#pragma once
// All POST requests: decode, predict, reserve, compute, encode.

#include <optional>
#include <string_view>
#include <variant>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/curve_task.h"
#include "proto/wire.h"
#include "server/admission.h"
#include "server/config.h"
#include "server/transport/message.h"
#include "server/transport/quota.h"

namespace subdivd::server {

class GeometryHandlers {
 public:
  GeometryHandlers(const Config& config, Admission& admission, Quota& memory);

  Response refine(Request& request);
  Response verify(Request& request);
  // POST /v1/curves/... and /v1/evaluate.
  Response curves(Request& request, proto::CurveTaskKind kind);
  // GET of `route`, the path of a scheme and a valence.
  Response spectrum(Request& request, std::string_view route);

 private:
  struct Job;
  using Begun = std::variant<Job, Response>;  // a Response: the request came no further
  using Decode = Result<proto::RefineRequest> (*)(const Request& request, const proto::Limits& limits,
                                                  const Budget& budget);

  Begun begin(Request& request, bool verifying, Decode decode);
  Response refined(Begun begun);
  Budget budget_for(const Request& request) const;

  const Config& config_;
  const proto::Limits limits_;
  Admission& admission_;
  Quota& memory_;
};

// What a request's head already tells about its body: a refusal (415), or nothing.
std::optional<Response> screen_body(const Request& head);

// Sends a small mesh through decoding, refinement and the oracle; false when anything is not as it must be.
bool self_test();

}  // namespace subdivd::server
