#include "proto/decode.h"

#include <algorithm>

#include "core/base/pace.h"
#include "core/refine/plan.h"
#include "proto/cut_faces.h"
#include "proto/gltf/gltf.h"
#include "proto/json/json.h"
#include "proto/json/survey.h"
#include "proto/options.h"
#include "proto/prepare.h"
#include "proto/text/kind.h"
#include "proto/text/text.h"
#include "proto/text/write.h"

namespace subdivd::proto {
namespace {

constexpr std::string_view kGlbMagic = "glTF";

Result<RefineRequest> read_gltf(std::string_view body, Format format, const QueryParameters& query,
                                const Limits& limits, const Budget& budget) {
  Options options;
  if (Result<void> done = set_parameters(options, query); !done) return done.error();
  return gltf::read(body, format, options, limits, budget);
}

// The query wins over what the body says.
Result<RefineRequest> with_parameters(Result<RefineRequest> request, const QueryParameters& query) {
  if (!request) return request;
  if (Result<void> done = set_parameters(request->options, query); !done) return done.error();
  return request;
}

// One look tells what the body is; then one reader reads it.
Result<RefineRequest> read_json(std::string_view body, BodyKind kind, const QueryParameters& query,
                                const Limits& limits, const Budget& budget) {
  const Result<json::Survey> survey = json::survey(body, budget);
  if (!survey) return survey.error();
  if (survey->has_asset && kind == BodyKind::unspecified)
    return read_gltf(body, Format::gltf, query, limits, budget);
  if (survey->has_asset)
    return Error{ErrorCode::unknown_field,
                 "the body has an \"asset\" and looks like glTF, whose content type is model/gltf+json",
                 {"asset"}};
  if (auto taken = budget.take_memory(survey->reading_bytes()); !taken) return taken.error();
  Result<RefineRequest> request =
      survey->is_curve() ? json::read_curve(body, limits, budget) : json::read(body, limits, budget);
  return with_parameters(std::move(request), query);
}

Result<RefineRequest> read_text(std::string_view body, BodyKind kind, const QueryParameters& query,
                                const Budget& budget) {
  return with_parameters(kind == BodyKind::off ? text::read_off(body, budget) : text::read_obj(body, budget),
                         query);
}

Result<RefineRequest> read_any(std::string_view body, BodyKind kind, const QueryParameters& query,
                               const Limits& limits, const Budget& budget) {
  const bool magic = is_glb(body);
  switch (kind) {
    case BodyKind::glb:
      return read_gltf(body, Format::glb, query, limits, budget);
    case BodyKind::unspecified:
      if (magic) return read_gltf(body, Format::glb, query, limits, budget);
      break;
    case BodyKind::obj:
    case BodyKind::off:
      return read_text(body, kind, query, budget);
    case BodyKind::json:
    case BodyKind::gltf:
      if (magic)
        return Error{ErrorCode::malformed,
                     "the body is a GLB, but its content type says JSON; send it as model/gltf-binary"};
      break;
  }
  if (kind == BodyKind::gltf) return read_gltf(body, Format::gltf, query, limits, budget);
  if (kind == BodyKind::unspecified) {
    const Result<text::TextKind> found = text::find_kind(body, budget);
    if (!found) return found.error();
    if (*found == text::TextKind::obj) return read_text(body, BodyKind::obj, query, budget);
    if (*found == text::TextKind::off) return read_text(body, BodyKind::off, query, budget);
  }
  return read_json(body, kind, query, limits, budget);
}

void override_meshes(RefineRequest& request) {
  const Options& options = request.options;
  for (ControlMesh& mesh : request.meshes) {
    if (options.subdivision_scheme) mesh.subdivision_scheme = kSchemeNames[*options.subdivision_scheme];
    if (options.interpolate_boundary) mesh.interpolate_boundary = *options.interpolate_boundary;
    if (options.face_varying_linear_interpolation)
      mesh.face_varying_linear_interpolation = *options.face_varying_linear_interpolation;
  }
}

// Refining curves and surfaces takes, beside what comes out, less than that again for the levels in between.
constexpr Count kPassingFactor = 2;

Result<std::vector<Plan>> plan_meshes(const RefineRequest& request, const Budget& budget) {
  std::vector<Plan> plans;
  plans.reserve(request.meshes.size());
  for (std::size_t i = 0; i < request.meshes.size(); ++i) {
    Result<Plan> plan = Plan::build(request.meshes[i], plan_options(mesh_options(request)), budget);
    if (!plan) return blame_input(request, plan.error(), "meshes", i);
    plans.push_back(*std::move(plan));
  }
  return plans;
}

template <class Real>
Result<Count> working_bytes(const RefineRequest& request, const std::vector<Plan>& plans,
                            std::vector<RefinedSize>& sizes, const Budget& budget) {
  Count bytes = 0;
  for (std::size_t i = 0; i < request.meshes.size(); ++i) {
    Result<RefinedSize> size = predict_size<Real>(request.meshes[i], plans[i], mesh_options(request), budget);
    if (!size) return blame_input(request, size.error(), "meshes", i);
    bytes += size->bytes + size->working_bytes;
    if (cuts_faces(request)) {
      RefinedSize cut = cut_size(*std::move(size));
      bytes += cutting_bytes(request.meshes[i], cut, sizeof(Real));
      sizes.push_back(std::move(cut));
      continue;
    }
    sizes.push_back(std::move(*size));
  }
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    if (auto stop = budget.poll()) return *stop;
    const Result<Count> size =
        predict_bytes<Real>(request.curves[i], curve_options(request, request.curves[i]), budget);
    if (!size) return blame_input(request, size.error(), "curves", i);
    bytes += kPassingFactor * *size;
  }
  for (std::size_t i = 0; i < request.surfaces.size(); ++i) {
    const ControlPatch& surface = request.surfaces[i];
    const Result<Count> size = predict_bytes<Real>(surface, patch_options(request, surface));
    if (!size) return blame_input(request, size.error(), "surfaces", i);
    bytes += kPassingFactor * *size;
  }
  return bytes;
}

Result<void> cut_all(AnyAnswer& answer, const Budget& budget) {
  return std::visit(
      [&](auto& typed) -> Result<void> {
        for (auto& mesh : typed.meshes)
          if (auto cut = cut_faces(mesh, budget); !cut) return cut;
        return {};
      },
      answer);
}

// Of the text or binary that will be sent, and of what is held of it.
Result<text::PredictedText> predict_answer(const RefineRequest& request,
                                           const std::vector<RefinedSize>& sizes, const Budget& budget) {
  const Format format = answer_format(request);
  if (is_text(format)) return text::predict(request, sizes, budget);
  const Result<Count> bytes = format == Format::json ? Result<Count>(json::predicted_bytes(request, sizes))
                                                     : gltf::predicted_bytes(request, sizes, budget);
  if (!bytes) return bytes.error();
  return text::PredictedText{*bytes, *bytes};
}

Error no_place_for(std::string message, std::string_view option, const QueryParameters& query) {
  const bool in_query = std::ranges::any_of(query, [&](const auto& one) { return one.first == option; });
  return {.code = ErrorCode::unsupported,
          .message = std::move(message),
          .where = in_query ? Path{"?" + std::string(option)} : Path{}};
}

}  // namespace

Result<void> check_format(const RefineRequest& request, const QueryParameters& query) {
  const Format format = answer_format(request);
  if (!is_text(format)) return {};
  if (request.options.verify)
    return no_place_for(
        "OBJ and OFF have no place for the report of verify; take format json, or ask /v1/verify for it "
        "alone",
        "verify", query);
  if (format == Format::off && !request.curves.empty())
    return no_place_for("an OFF holds faces and no curves; take format obj, json, glb or gltf", "format",
                        query);
  return {};
}

bool is_glb(std::string_view body) { return body.starts_with(kGlbMagic); }

Result<RefineRequest> read_refine(std::string_view body, BodyKind kind, const QueryParameters& query,
                                  const Limits& limits, const Budget& budget) {
  if (body.size() > limits.max_body_bytes)
    return Error{.code = ErrorCode::too_large,
                 .message = std::string("the body has ") + std::to_string(body.size()) + " bytes; " +
                            std::to_string(limits.max_body_bytes) + " are allowed",
                 .predicted = body.size(),
                 .allowed = limits.max_body_bytes};
  return read_any(body, kind, query, limits, budget);
}

Result<RefineRequest> decode_refine(std::string_view body, BodyKind kind, const QueryParameters& query,
                                    const Limits& limits, const Budget& budget) {
  Result<RefineRequest> request = read_refine(body, kind, query, limits, budget);
  if (!request) return request;
  if (Result<void> ready = make_ready(*request, query, limits, budget); !ready) return ready.error();
  return request;
}

Result<void> make_ready(RefineRequest& request, const QueryParameters& query, const Limits& limits,
                        const Budget& budget) {
  override_meshes(request);
  if (Result<void> fine = check_options(request, limits, query, budget); !fine) return fine;
  if (Result<void> fine = prepare(request, budget); !fine) return fine;
  if (!is_gltf(answer_format(request))) return {};
  return gltf::add_render_meshes(request, budget);
}

Result<Prediction> predict_refine(const RefineRequest& request, const Limits& limits, const Budget& budget) {
  std::vector<RefinedSize> sizes;
  Prediction prediction;
  const Result<void> summed = stoppable(budget, [&](const Pace& pace) {
    for (const ControlMesh& mesh : request.meshes)
      prediction.taken_bytes += plan_bytes(mesh, plan_options(mesh_options(request)), pace);
  });
  if (!summed) return summed.error();
  if (Result<void> taken = budget.take_memory(prediction.taken_bytes); !taken) return taken.error();
  Result<std::vector<Plan>> plans = plan_meshes(request, budget);
  if (!plans) return plans.error();
  prediction.plans = *std::move(plans);
  const Result<Count> working = answer_precision(request) == Precision::single_precision
                                    ? working_bytes<float>(request, prediction.plans, sizes, budget)
                                    : working_bytes<double>(request, prediction.plans, sizes, budget);
  if (!working) return working.error();
  prediction.working_bytes = *working;
  const auto answer = predict_answer(request, sizes, budget);
  if (!answer) return answer.error();
  prediction.answer_bytes = answer->bytes;
  prediction.held_bytes = answer->held_bytes;
  if (prediction.answer_bytes > limits.max_output_bytes)
    return Error{.code = ErrorCode::too_large,
                 .message = std::string("the answer would take up to ") +
                            std::to_string(prediction.answer_bytes) + " bytes; " +
                            std::to_string(limits.max_output_bytes) +
                            " are allowed: choose a lower level or a smaller input",
                 .predicted = prediction.answer_bytes,
                 .allowed = limits.max_output_bytes};
  return prediction;
}

Result<Payload> encode_refine(const RefineRequest& request, AnyAnswer answer, const Budget& budget) {
  const Format format = answer_format(request);
  if (cuts_faces(request))
    if (auto cut = cut_all(answer, budget); !cut) return cut.error();
  if (format == Format::json) return json::write(request, std::move(answer), budget);
  if (is_text(format)) {
    if (auto fine = check_format(request, {}); !fine) return std::move(fine).error();
    return text::write(request, std::move(answer), json::answer_warnings(request), budget);
  }
  const Result<std::string> members = json::envelope(request, answer, budget);
  if (!members) return members.error();
  return gltf::write(request, std::move(answer), format, *members, budget);
}

Result<Payload> encode_report(const RefineRequest& request, const oracle::Report& report,
                              const Budget& budget) {
  Result<std::string> text = json::report_envelope(request, report, budget);
  if (!text) return text.error();
  Payload payload;
  payload.content_type = "application/json";
  payload.chunks.push_back(Chunk::own(*std::move(text)));
  return payload;
}

}  // namespace subdivd::proto
