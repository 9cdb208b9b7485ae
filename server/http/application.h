#pragma once
// The service behind the transport: the list of routes, and what all answers have in common.

#include <atomic>
#include <optional>

#include "core/base/thread_pool.h"
#include "server/config.h"
#include "server/grants.h"
#include "server/http/cors.h"
#include "server/http/geometry_handlers.h"
#include "server/http/router.h"
#include "server/transport/service.h"

namespace subdivd::server {

class Application final : public Service {
 public:
  // `bytes` of memory are shared by all requests that are computed. `config` must outlive the application.
  Application(const Config& config, Count bytes);

  // Runs the self-test if the configuration wants it; /readyz tells the outcome.
  bool prepare();
  // From now on /readyz says no and new work is refused.
  void begin_drain() { draining_ = true; }

  Lane lane(const Request& head) override;
  std::optional<Response> screen(const Request& head) override;
  Response answer(Request& request) override;
  Response refuse(const Request& request, const Refusal& refusal) override;
  void record(const Exchange& exchange) override;

  const Router& router() const { return router_; }
  const Grants& grants() const { return grants_; }

 private:
  std::vector<Route> routes();
  std::optional<Response> screen_plainly(const Request& head);
  Response preflight(const Request& head) const;
  Response readiness() const;
  Response finished(const Request& request, Response response) const;

  const Config& config_;
  Grants grants_;
  ThreadPool helpers_;
  GeometryHandlers geometry_;
  const Cors cors_;
  const Router router_;
  std::atomic<bool> ready_ = false, draining_ = false;
};

}  // namespace subdivd::server
