#pragma once
// All POST requests: a grant, then a task (server/tasks) within it.

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "core/base/budget.h"
#include "core/base/helpers.h"
#include "core/base/result.h"
#include "proto/curve_task.h"
#include "proto/wire.h"
#include "server/config.h"
#include "server/grants.h"
#include "server/transport/message.h"

namespace subdivd::server {

class GeometryHandlers {
 public:
  // All must outlive the handlers.
  GeometryHandlers(const Config& config, Grants& grants, Helpers& helpers);

  Response refine(Request& request);
  Response verify(Request& request);
  // POST /v1/curves/... and /v1/evaluate.
  Response curves(Request& request, proto::CurveTaskKind kind);
  // GET of `route`, the path of a scheme and a valence.
  Response spectrum(Request& request, std::string_view route);

 private:
  // Computes the answer within a budget. Called again, with more memory, when the first was short of it.
  using Attempt = std::function<Result<Response>(const Budget& budget)>;
  using Decode = Result<proto::RefineRequest> (*)(const Request& request, const proto::Limits& limits,
                                                  const Budget& budget);

  Response granted(Request& request, const Attempt& attempt);
  Result<Response> refined(const Request& request, Decode decode, const Budget& budget) const;
  Budget budget_for(const Request& request) const;

  const Config& config_;
  const proto::Limits limits_;
  Grants& grants_;
  Helpers& helpers_;
};

// What a request's head already tells about its body: a refusal (415), or nothing.
std::optional<Response> screen_body(const Request& head, bool takes_gltf);

}  // namespace subdivd::server
