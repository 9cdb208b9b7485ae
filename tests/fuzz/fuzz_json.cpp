// JSON bodies. What is accepted is JSON with the same numbers for another parser, and has passed check();
// small requests are refined, and their answers are valid requests again.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/refine/refine.h"
#include "core/schemes/all.h"
#include "proto/decode.h"
#include "proto/problem.h"
#include "server/tasks/refine_task.h"
#include "tests/support/payload_text.h"

namespace {

using namespace subdivd;

void require(bool fact) {
  if (!fact) std::abort();
}

// Every number of an array of any depth, by another parser.
void flatten(const nlohmann::json& array, std::vector<double>& numbers) {
  for (const nlohmann::json& element : array) {
    if (element.is_array())
      flatten(element, numbers);
    else
      numbers.push_back(element.get<double>());
  }
}

template <class Parts>
void require_same_points(const nlohmann::json& document, const char* member, bool at_top,
                         const Parts& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<double> expected;
    flatten((at_top ? document : document[member][i])["points"], expected);
    require(parts[i].points == expected);
  }
}

void require_same_points(const nlohmann::json& document, const proto::RefineRequest& request) {
  require_same_points(document, "meshes", request.single_mesh_at_top, request.meshes);
  require_same_points(document, "curves", request.single_curve_at_top, request.curves);
  require_same_points(document, "surfaces", request.single_surface_at_top, request.surfaces);
}

// A refusal late in the work (numbers that overflow) is an answer, too.
void refine_and_encode(const proto::RefineRequest& request, const proto::Limits& limits) {
  for (ControlMesh other : request.meshes)
    for (const std::string_view scheme : kSchemeNames) {
      if (scheme == other.subdivision_scheme) continue;
      other.subdivision_scheme = scheme;
      (void)refine<double>(other, proto::mesh_options(request), Budget{});
    }
  server::tasks::Phases phases;
  const auto payload = server::tasks::refine(request, limits, Budget{}, phases);
  if (!payload) return;
  const std::string text = test::text_of(*payload);
  require(nlohmann::json::accept(text));
  const auto again = proto::decode_refine(text, proto::BodyKind::json, {}, limits);
  // Holes and border faces may leave nothing; the answer of nothing is no request.
  require(again.ok() || again.error().code == ErrorCode::wrong_length ||
          again.error().code == ErrorCode::not_a_triangle);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  proto::Limits limits;
  limits.max_level = 2;
  limits.max_output_bytes = 1 << 20;
  const auto request = proto::decode_refine(body, proto::BodyKind::json, {}, limits);
  if (!request) {
    require(request.error().code != ErrorCode::internal);
    require(nlohmann::json::accept(proto::problem_json(proto::to_problem(request.error(), 422))));
    return 0;
  }
  const bool marked = body.starts_with("\xEF\xBB\xBF");
  const nlohmann::json document = nlohmann::json::parse(body.substr(marked ? 3 : 0), nullptr, false);
  require(!document.is_discarded());
  require_same_points(document, *request);
  for (const ControlMesh& mesh : request->meshes) require(mesh.check().ok());
  for (const ControlCurves& curves : request->curves) require(curves.check().ok());
  for (const ControlPatch& surface : request->surfaces) require(surface.check().ok());
  const bool plain = request->options.format.value_or(proto::Format::json) == proto::Format::json &&
                     !request->options.precision;
  if (plain && proto::predict_refine(*request, limits)) refine_and_encode(*request, limits);
  return 0;
}
