#include "server/http/geometry_handlers.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "core/analysis/spectrum.h"
#include "proto/decode.h"
#include "proto/schemes.h"
#include "server/http/negotiation.h"
#include "server/http/router.h"
#include "server/http/status.h"
#include "server/tasks/curve_task.h"
#include "server/tasks/phases.h"
#include "server/tasks/refine_task.h"

namespace subdivd::server {
namespace {

using Clock = Budget::Clock;
using tasks::Phases;

// What a body may have to begin in the lane of small requests.
constexpr std::size_t kSmallBody = std::size_t{64} << 10;

proto::Limits limits_of(const Config& config) {
  proto::Limits limits;
  limits.max_level = config.max_level;
  limits.max_output_bytes = config.max_output_bytes;
  limits.max_body_bytes = config.max_body_bytes;
  return limits;
}

Response payload_response(proto::Payload payload, const Phases& phases) {
  Response response;
  response.headers.emplace_back("Server-Timing", phases.header());
  response.content_type = std::move(payload.content_type);
  for (proto::Chunk& chunk : payload.chunks)
    response.body.push_back({std::move(chunk.owner), chunk.bytes, std::move(chunk.maker)});
  return response;
}

Response not_acceptable(const char* kinds) {
  return problem_response(Refusal{406, "not_acceptable", std::string("Accept must admit ") + kinds});
}

Response not_of_this_kind(bool takes_gltf) {
  Response response = problem_response(
      Refusal{415, "unsupported_media_type",
              takes_gltf ? "Content-Type must be application/json, model/gltf-binary, model/gltf+json, "
                           "model/obj, text/plain (OBJ and OFF), application/octet-stream or left out"
                         : "this request takes JSON: Content-Type must be application/json, "
                           "application/octet-stream or left out"});
  response.headers.emplace_back(
      "Accept-Post", takes_gltf
                         ? "application/json, model/gltf-binary, model/gltf+json, model/obj, text/plain"
                         : "application/json");
  return response;
}

Response denied(Grants::Denied reason, Count wanted, Count most) {
  switch (reason) {
    case Grants::Denied::full:
      return problem_response(Refusal{503, "overloaded", "too many requests are waiting to be computed"});
    case Grants::Denied::too_large:
      return problem_response(
          Error{.code = ErrorCode::too_large,
                .message = "the request takes more memory than the " + std::to_string(most) +
                           " bytes that are set aside: choose a lower level or a smaller input",
                .predicted = wanted,
                .allowed = most});
    case Grants::Denied::too_late:
      return problem_response(Error{ErrorCode::deadline_exceeded,
                                    "the time allowed for this request ran out while it waited for others"});
    case Grants::Denied::cancelled:
      break;
  }
  return problem_response(Error{ErrorCode::cancelled, "the caller went away"});
}

// ?format= or the body's options over Accept over the kind that came in; none where Accept admits none.
void choose_format(const Request& request, proto::RefineRequest& decoded) {
  if (!decoded.options.format) decoded.options.format = preferred_format(request, decoded.input);
}

// For an answer of any format, which must be chosen before the request is made ready for it.
Result<proto::RefineRequest> decode_negotiated(const Request& request, const proto::Limits& limits,
                                               const Budget& budget) {
  auto decoded = proto::read_refine(request.body, body_kind(request).value_or(proto::BodyKind::unspecified),
                                    request.query, limits, budget);
  if (!decoded) return decoded;
  choose_format(request, *decoded);
  if (auto ready = proto::make_ready(*decoded, request.query, limits, budget); !ready)
    return std::move(ready).error();
  return decoded;
}

Result<proto::RefineRequest> decode_any(const Request& request, const proto::Limits& limits,
                                        const Budget& budget) {
  return proto::decode_refine(request.body, body_kind(request).value_or(proto::BodyKind::unspecified),
                              request.query, limits, budget);
}

Result<proto::RefineRequest> decode_curves(const Request& request, const proto::Limits& limits,
                                           const Budget& budget) {
  auto decoded =
      proto::decode_curves(request.body, proto::CurveTaskKind::refine, request.query, limits, budget);
  if (!decoded) return std::move(decoded).error();
  return std::move(decoded->curves);
}

// Decodes a body and does its task.
template <class Decode, class Task>
Result<Response> computed(Decode&& decode, Task&& task) {
  Phases phases;
  const auto decoded = decode();
  if (!decoded) return decoded.error();
  phases.end("read");
  auto payload = task(*decoded, phases);
  if (!payload) return std::move(payload).error();
  return payload_response(*std::move(payload), phases);
}

}  // namespace

GeometryHandlers::GeometryHandlers(const Config& config, Grants& grants, Helpers& helpers)
    : config_(config), limits_(limits_of(config)), grants_(grants), helpers_(helpers) {}

Budget GeometryHandlers::budget_for(const Request& request) const {
  Budget budget;
  budget.max_bytes = config_.max_memory_bytes;  // the sum over all meshes is predicted and taken
  budget.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(config_.deadline_seconds));
  budget.cancelled = request.cancelled;
  if (helpers_.most() > 0) budget.helpers = &helpers_;
  return budget;
}

Response GeometryHandlers::granted(Request& request, const Attempt& attempt) {
  Budget budget = budget_for(request);
  Grants::Wish wish{request.body.size() <= kSmallBody ? Grants::Lane::small : Grants::Lane::large, 0};
  for (;;) {
    auto entered = grants_.enter(wish, budget.deadline, request.cancelled);
    if (const auto* reason = std::get_if<Grants::Denied>(&entered))
      return denied(*reason, wish.bytes, grants_.most_bytes());
    auto grant = std::get<std::shared_ptr<Grants::Grant>>(std::move(entered));
    budget.memory = grant.get();
    auto answer = attempt(budget);
    if (answer) {
      // While a slow client reads, the answer's own bytes stay set aside; the work's are free for others.
      grant->keep_only(answer->held_bytes());
      answer->hold = std::move(grant);
      return *std::move(answer);
    }
    // Short of memory: everything made so far is dropped by now, and all of it is waited for.
    const Grants::Wish more = grant->wish();
    if (answer.error().code != ErrorCode::overloaded || (more.lane == wish.lane && more.bytes <= wish.bytes))
      return problem_response(answer.error());
    wish = more;
  }
}

Result<Response> GeometryHandlers::refined(const Request& request, Decode decode,
                                           const Budget& budget) const {
  Phases phases;
  auto decoded = decode(request, limits_, budget);
  if (!decoded) return std::move(decoded).error();
  choose_format(request, *decoded);
  if (!decoded->options.format)
    return not_acceptable("application/json, model/gltf-binary, model/gltf+json or model/obj");
  if (auto fine = proto::check_format(*decoded, request.query); !fine) return std::move(fine).error();
  phases.end("read");
  auto payload = tasks::refine(*decoded, limits_, budget, phases);
  if (!payload) return std::move(payload).error();
  return payload_response(*std::move(payload), phases);
}

Response GeometryHandlers::refine(Request& request) {
  return granted(request, [&](const Budget& budget) { return refined(request, decode_negotiated, budget); });
}

Response GeometryHandlers::verify(Request& request) {
  if (!accepts_json(request)) return not_acceptable("application/json");
  return granted(request, [&](const Budget& budget) {
    return computed(
        [&] { return decode_any(request, limits_, budget); },
        [&](const auto& decoded, Phases& phases) { return tasks::verify(decoded, limits_, budget, phases); });
  });
}

Response GeometryHandlers::curves(Request& request, proto::CurveTaskKind kind) {
  if (proto::is_glb(request.body)) return not_of_this_kind(false);  // its head did not say so
  if (kind == proto::CurveTaskKind::refine)
    return granted(request, [&](const Budget& budget) { return refined(request, decode_curves, budget); });
  if (!accepts_json(request)) return not_acceptable("application/json");
  return granted(request, [&](const Budget& budget) {
    return computed([&] { return proto::decode_curves(request.body, kind, request.query, limits_, budget); },
                    [&](const auto& decoded, Phases& phases) {
                      return tasks::answer_curves(decoded, limits_, budget, phases);
                    });
  });
}

Response GeometryHandlers::spectrum(Request& request, std::string_view route) {
  std::vector<std::string> steps;
  matches(route, request.path, &steps);
  const auto choice = proto::decode_scheme(steps[0], steps[1], request.query);
  if (!choice) return problem_response(choice.error());
  return granted(request, [&](const Budget& budget) -> Result<Response> {
    auto spectrum = subdivd::spectrum(*choice, budget);
    if (!spectrum) {
      // The valence is a step of the path, everything else a parameter.
      Path& where = spectrum.error().where;
      if (where == Path{"valence"} || where == Path{"scheme"}) where.clear();
      if (!where.empty()) where = {"?" + std::get<std::string>(where[0])};
      return std::move(spectrum).error();
    }
    Response response;
    response.content_type = "application/json";
    response.body.push_back(Bytes::of(proto::spectrum_json(*spectrum)));
    return response;
  });
}

std::optional<Response> screen_body(const Request& head, bool takes_gltf) {
  const std::string* encoding = head.header("content-encoding");
  if (encoding != nullptr && *encoding != "identity") {
    // A bomb of a few kilobytes would inflate to gigabytes.
    Response response = problem_response(
        Refusal{415, "unsupported_encoding", "the body must not be compressed (Content-Encoding: identity)"});
    response.headers.emplace_back("Accept-Encoding", "identity");
    return response;
  }
  const auto kind = body_kind(head);
  const bool other =
      kind == proto::BodyKind::glb || kind == proto::BodyKind::gltf || kind == proto::BodyKind::obj;
  if (!kind || (other && !takes_gltf)) return not_of_this_kind(takes_gltf);
  return std::nullopt;
}

}  // namespace subdivd::server
