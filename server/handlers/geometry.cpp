#include "server/handlers/geometry.h"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "core/analysis/spectrum.h"
#include "proto/decode.h"
#include "proto/schemes.h"
#include "server/handlers/compute.h"
#include "server/handlers/compute_curves.h"
#include "server/negotiation.h"
#include "server/router.h"
#include "server/status.h"

namespace subdivd::server {
namespace {

using Clock = Budget::Clock;

// Peaks of resident memory over the bytes of the core's arrays, measured on glTF and JSON meshes at levels 5
// to 8 and rounded up: the engine's passing levels; OpenSubdiv keeps the topology of every level.
constexpr Count kRefineFactor = 2;
constexpr Count kOracleFactor = 6;

proto::Limits limits_of(const Config& config) {
  proto::Limits limits;
  limits.max_level = config.max_level;
  limits.max_output_bytes = config.max_output_bytes;
  limits.max_body_bytes = config.max_body_bytes;
  return limits;
}

Response payload_response(proto::Payload payload) {
  Response response;
  response.content_type = std::move(payload.content_type);
  for (proto::Chunk& chunk : payload.chunks) response.body.push_back({std::move(chunk.owner), chunk.bytes});
  return response;
}

Response not_acceptable(const char* kinds) {
  return problem_response(Refusal{406, "not_acceptable", std::string("Accept must admit ") + kinds});
}

Response not_admitted(Admission::Denied reason) {
  switch (reason) {
    case Admission::Denied::full:
      return problem_response(Refusal{503, "overloaded", "too many requests are waiting to be computed"});
    case Admission::Denied::too_late:
      return problem_response(Error{ErrorCode::deadline_exceeded,
                                    "the time allowed for this request ran out while it waited for others",
                                    {},
                                    0,
                                    0});
    case Admission::Denied::cancelled:
      break;
  }
  return problem_response(Error{ErrorCode::cancelled, "the caller went away", {}, 0, 0});
}

std::optional<Response> reserve(Quota& memory, Quota::Lease& lease, Count bytes) {
  if (lease.grow_to(bytes)) return std::nullopt;
  if (bytes <= memory.total())
    return problem_response(Refusal{503, "overloaded", "other requests take the memory that this one needs"});
  return problem_response(Error{ErrorCode::too_large,
                                "the request would take " + std::to_string(bytes) + " bytes of memory; " +
                                    std::to_string(memory.total()) +
                                    " are set aside: choose a lower level or a smaller mesh",
                                {},
                                bytes,
                                memory.total()});
}

// ?format= or the body's options over Accept over the kind that came in; false: Accept admits none.
bool choose_format(const Request& request, proto::RefineRequest& decoded) {
  if (decoded.options.format) return true;
  decoded.options.format = preferred_format(request, decoded.input);
  return decoded.options.format.has_value();
}

Result<proto::Payload> answer_curve_task(const proto::CurveRequest& request, const Budget& budget) {
  switch (request.task.kind) {
    case proto::CurveTaskKind::evaluate: {
      if (request.task.on_surfaces) {
        auto samples = compute_surface_samples(request, budget);
        if (!samples) return std::move(samples).error();
        return proto::encode_samples(request, *samples, budget);
      }
      auto samples = compute_samples(request, budget);
      if (!samples) return std::move(samples).error();
      return proto::encode_samples(request, *samples, budget);
    }
    case proto::CurveTaskKind::measure: {
      auto measures = compute_measures(request, budget);
      if (!measures) return std::move(measures).error();
      return proto::encode_measures(request, *measures, budget);
    }
    default: {
      auto edited = compute_edited(request, budget);
      if (!edited) return std::move(edited).error();
      return proto::encode_edited(request, *std::move(edited), budget);
    }
  }
}

}  // namespace

struct GeometryHandlers::Job {
  Admission::Ticket ticket;
  std::shared_ptr<Quota::Lease> memory;
  Budget budget;
  proto::RefineRequest request;
  proto::Timings timings;
};

GeometryHandlers::GeometryHandlers(const Config& config, Admission& admission, Quota& memory)
    : config_(config), limits_(limits_of(config)), admission_(admission), memory_(memory) {}

Budget GeometryHandlers::budget_for(const Request& request) const {
  Budget budget;
  budget.max_bytes = config_.max_memory_bytes;  // the sum over all meshes is predicted and reserved
  budget.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(config_.deadline_seconds));
  budget.cancelled = request.cancelled;
  return budget;
}

GeometryHandlers::Begun GeometryHandlers::begin(Request& request, bool verifying, Decode decode) {
  const Budget budget = budget_for(request);
  auto admitted = admission_.enter(budget.deadline, request.cancelled);
  if (const auto* denied = std::get_if<Admission::Denied>(&admitted)) return not_admitted(*denied);
  const Clock::time_point start = Clock::now();
  auto decoded = decode(request, limits_, budget);
  std::string().swap(request.body);
  if (!decoded) return problem_response(decoded.error());
  if (verifying ? !accepts_json(request) : !choose_format(request, *decoded))
    return not_acceptable(verifying ? "application/json"
                                    : "application/json, model/gltf-binary or model/gltf+json");
  const auto predicted = proto::predict_refine(*decoded, limits_, budget);
  if (!predicted) return problem_response(predicted.error());
  const bool with_oracle = verifying || decoded->options.verify;
  auto lease = std::make_shared<Quota::Lease>(memory_);
  const Count bytes = predicted->answer_bytes +
                      predicted->working_bytes * (with_oracle ? kOracleFactor : kRefineFactor) +
                      (with_oracle ? oracle_bytes(*decoded) : 0);
  if (auto refused = reserve(memory_, *lease, bytes)) return *std::move(refused);
  proto::Timings timings;
  timings.read = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return Job{std::get<Admission::Ticket>(std::move(admitted)), std::move(lease), budget,
             std::move(decoded).value(), timings};
}

namespace {

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

}  // namespace

Response GeometryHandlers::refine(Request& request) { return refined(begin(request, false, decode_any)); }

Response GeometryHandlers::refined(Begun begun) {
  if (auto* refused = std::get_if<Response>(&begun)) return std::move(*refused);
  Job& job = std::get<Job>(begun);
  auto answer = compute_refinement(job.request, job.budget, job.timings);
  if (!answer) return problem_response(answer.error());
  auto payload = proto::encode_refine(job.request, std::move(answer).value(), job.budget);
  if (!payload) return problem_response(payload.error());
  Response response = payload_response(std::move(payload).value());
  // While a slow client reads, the answer's own bytes stay reserved; the work's are free for others.
  job.memory->shrink_to(response.size());
  response.hold = job.memory;
  return response;
}

Response GeometryHandlers::verify(Request& request) {
  Begun begun = begin(request, true, decode_any);
  if (auto* refused = std::get_if<Response>(&begun)) return std::move(*refused);
  Job& job = std::get<Job>(begun);
  const Clock::time_point start = Clock::now();
  const auto report = compute_report(job.request, job.budget);
  if (!report) return problem_response(report.error());
  job.timings.verify = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  auto payload = proto::encode_report(job.request, *report, job.timings);
  if (!payload) return problem_response(payload.error());
  return payload_response(std::move(payload).value());
}

Response GeometryHandlers::curves(Request& request, proto::CurveTaskKind kind) {
  if (kind == proto::CurveTaskKind::refine) return refined(begin(request, false, decode_curves));
  const Budget budget = budget_for(request);
  auto admitted = admission_.enter(budget.deadline, request.cancelled);
  if (const auto* denied = std::get_if<Admission::Denied>(&admitted)) return not_admitted(*denied);
  if (!accepts_json(request)) return not_acceptable("application/json");
  auto decoded = proto::decode_curves(request.body, kind, request.query, limits_, budget);
  std::string().swap(request.body);
  if (!decoded) return problem_response(decoded.error());
  const auto bytes = predict_curve_task(*decoded, limits_.max_output_bytes);
  if (!bytes) return problem_response(bytes.error());
  auto lease = std::make_shared<Quota::Lease>(memory_);
  if (auto refused = reserve(memory_, *lease, *bytes)) return *std::move(refused);
  auto payload = answer_curve_task(*decoded, budget);
  if (!payload) return problem_response(payload.error());
  Response response = payload_response(std::move(payload).value());
  lease->shrink_to(response.size());
  response.hold = std::move(lease);
  return response;
}

Response GeometryHandlers::spectrum(Request& request, std::string_view route) {
  std::vector<std::string> steps;
  matches(route, request.path, &steps);
  const auto choice = proto::decode_scheme(steps[0], steps[1], request.query);
  if (!choice) return problem_response(choice.error());
  const Budget budget = budget_for(request);
  auto admitted = admission_.enter(budget.deadline, request.cancelled);
  if (const auto* denied = std::get_if<Admission::Denied>(&admitted)) return not_admitted(*denied);
  auto spectrum = subdivd::spectrum(*choice, budget);
  if (!spectrum) {
    // The valence is a step of the path, everything else a parameter.
    Path& where = spectrum.error().where;
    if (where == Path{"valence"} || where == Path{"scheme"}) where.clear();
    if (!where.empty()) where = {"?" + std::get<std::string>(where[0])};
    return problem_response(spectrum.error());
  }
  Response response;
  response.content_type = "application/json";
  response.body.push_back(Bytes::of(proto::spectrum_json(*spectrum)));
  return response;
}

std::optional<Response> screen_body(const Request& head) {
  const std::string* encoding = head.header("content-encoding");
  if (encoding != nullptr && *encoding != "identity") {
    // A bomb of a few kilobytes would inflate to gigabytes.
    Response response = problem_response(
        Refusal{415, "unsupported_encoding", "the body must not be compressed (Content-Encoding: identity)"});
    response.headers.emplace_back("Accept-Encoding", "identity");
    return response;
  }
  if (body_kind(head)) return std::nullopt;
  Response response =
      problem_response(Refusal{415, "unsupported_media_type",
                               "Content-Type must be application/json, model/gltf-binary, model/gltf+json, "
                               "application/octet-stream or left out"});
  response.headers.emplace_back("Accept-Post", "application/json, model/gltf-binary, model/gltf+json");
  return response;
}

bool self_test() {
  // An open pyramid with a crease: an inner vertex of valence 5, a border, a semi-sharp edge.
  constexpr std::string_view kMesh = R"({
    "points": [[0,0,1], [1,0,0], [0.3,1,0], [-0.8,0.6,0], [-0.8,-0.6,0], [0.3,-1,0]],
    "faceVertexIndices": [0,1,2, 0,2,3, 0,3,4, 0,4,5, 0,5,1],
    "creaseIndices": [0,1], "creaseLengths": [2], "creaseSharpnesses": [1.5],
    "options": {"level": 3, "limit": true, "normals": true}})";
  const auto decoded = proto::decode_refine(kMesh, proto::BodyKind::json, {}, proto::Limits{});
  if (!decoded) return false;
  const auto report = compute_report(*decoded, Budget{});
  return report.ok() && report->verdict() == oracle::Verdict::passed;
}

}  // namespace subdivd::server
