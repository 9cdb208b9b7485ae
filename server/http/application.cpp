#include "server/http/application.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "proto/openapi.h"
#include "proto/schemes.h"
#include "server/http/status.h"
#include "server/log.h"
#include "server/tasks/refine_task.h"
#include "server/web/page.h"

namespace subdivd::server {
namespace {

constexpr std::string_view kSpectrumPath = "/v1/schemes/{name}/{valence}";

std::size_t processors() { return std::max(1u, std::thread::hardware_concurrency()); }

Grants::Shares shares_of(const Config& config, Count bytes) {
  Grants::Shares shares;
  shares.places = config.max_concurrent > 0 ? config.max_concurrent : processors();
  shares.small_places = std::max<std::size_t>(shares.places, 2);
  shares.max_waiting = config.max_waiting;
  shares.bytes = bytes;
  return shares;
}

// Beside the thread that answers a request.
Index helper_count(const Config& config) {
  return static_cast<Index>((config.request_threads > 0 ? config.request_threads : processors()) - 1);
}

// Processors that no request computes on.
Index spare_processors(const Grants& grants) {
  return static_cast<Index>(processors() - std::min(processors(), grants.running()));
}

Response text_response(std::string content_type, std::string text) {
  Response response;
  response.content_type = std::move(content_type);
  response.body.push_back(Bytes::of(std::move(text)));
  return response;
}

Response page_response() {
  Response response = text_response("text/html; charset=utf-8", web_page());
  response.headers.emplace_back("Content-Security-Policy",
                                "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; "
                                "form-action 'none'; frame-ancestors 'none'");
  return response;
}

}  // namespace

Application::Application(const Config& config, Count bytes)
    : config_(config),
      grants_(shares_of(config, bytes)),
      helpers_(helper_count(config), [this] { return spare_processors(grants_); }),
      geometry_(config, grants_, helpers_),
      cors_(config.cors_origins),
      router_(routes()) {}

// THE list of what there is.
std::vector<Route> Application::routes() {
  const auto curves = [this](proto::CurveTaskKind kind) {
    return [this, kind](Request& request) { return geometry_.curves(request, kind); };
  };
  return {
      {"POST", "/v1/refine", [this](Request& request) { return geometry_.refine(request); }, true},
      {"POST", "/v1/verify", [this](Request& request) { return geometry_.verify(request); }, true},
      {"POST", "/v1/evaluate", curves(proto::CurveTaskKind::evaluate)},
      {"POST", "/v1/curves/refine", curves(proto::CurveTaskKind::refine)},
      {"POST", "/v1/curves/evaluate", curves(proto::CurveTaskKind::evaluate)},
      {"POST", "/v1/curves/insert-knot", curves(proto::CurveTaskKind::insert_knot)},
      {"POST", "/v1/curves/remove-knot", curves(proto::CurveTaskKind::remove_knot)},
      {"POST", "/v1/curves/convert", curves(proto::CurveTaskKind::convert)},
      {"POST", "/v1/curves/measure", curves(proto::CurveTaskKind::measure)},
      {"GET", "/v1/schemes",
       [](Request&) { return text_response("application/json", proto::schemes_json()); }},
      {"GET", kSpectrumPath, [this](Request& request) { return geometry_.spectrum(request, kSpectrumPath); }},
      {"GET", "/livez", [](Request&) { return text_response("text/plain; charset=utf-8", "ok\n"); }},
      {"GET", "/readyz", [this](Request&) { return readiness(); }},
      {"GET", "/openapi.json",
       [](Request&) { return text_response("application/json", std::string(proto::openapi_json())); }},
      {"GET", "/", [](Request&) { return page_response(); }},
  };
}

bool Application::prepare() {
  ready_ = !config_.self_test || tasks::self_test();
  return ready_;
}

Response Application::readiness() const {
  if (draining_)
    return problem_response(Refusal{503, "shutting_down", "this server is finishing its last requests"});
  if (!ready_)
    return problem_response(Refusal{503, "not_ready", "the self-test against OpenSubdiv has not passed"});
  return text_response("text/plain; charset=utf-8", "ready\n");
}

Response Application::preflight(const Request& head) const {
  const std::string methods = router_.allowed_methods(head.path);
  Response response;
  response.status = 204;
  response.headers.emplace_back("Allow", methods);
  cors_.answer_preflight(head, methods, response);
  return response;
}

std::optional<Response> Application::screen_plainly(const Request& head) {
  const std::string methods = router_.allowed_methods(head.path);
  if (methods.empty())
    return problem_response(
        Refusal{404, "not_found", "there is nothing at this path; /openapi.json lists what there is"});
  if (head.method == "OPTIONS") return preflight(head);
  const Route* route = router_.find(head.method, head.path);
  if (route == nullptr) {
    Response response = problem_response(Refusal{405, "method_not_allowed", "this path answers " + methods});
    response.headers.emplace_back("Allow", methods);
    return response;
  }
  if (route->method == "GET" || route->method == "DELETE") return std::nullopt;
  if (draining_)
    return problem_response(Refusal{503, "shutting_down", "this server is finishing its last requests"});
  return screen_body(head, route->takes_gltf);
}

Lane Application::lane(const Request& head) {
  return head.path == "/livez" || head.path == "/readyz" ? Lane::health : Lane::general;
}

std::optional<Response> Application::screen(const Request& head) {
  auto response = screen_plainly(head);
  if (response) return finished(head, *std::move(response));
  return std::nullopt;
}

Response Application::answer(Request& request) {
  return finished(request, router_.find(request.method, request.path)->handler(request));
}

Response Application::refuse(const Request& request, const Refusal& refusal) {
  if (refusal.status == 500) log_error("failed: " + escaped(request.method) + " " + escaped(request.target));
  return finished(request, problem_response(refusal));
}

Response Application::finished(const Request& request, Response response) const {
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  cors_.allow(request, response);
  return response;
}

void Application::record(const Exchange& exchange) { log_info(access_line(exchange)); }

}  // namespace subdivd::server
