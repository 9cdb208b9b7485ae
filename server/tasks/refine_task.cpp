#include "server/tasks/refine_task.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/curves/subdivision.h"
#include "core/oracle/far.h"
#include "core/oracle/far_curves.h"
#include "core/oracle/far_surfaces.h"
#include "core/oracle/verify.h"
#include "core/refine/refine.h"
#include "proto/decode.h"
#include "proto/prepare.h"

namespace subdivd::server::tasks {
namespace {

// Waking a helper takes as long as refining some ten thousand points, and every array is shared anew: below
// this one thread is done sooner.
constexpr Count kPointsWorthHelp = Count{1} << 18;

RefineOptions mesh_options(const proto::RefineRequest& request, const Plan& plan, const Budget& budget) {
  RefineOptions options = proto::mesh_options(request);
  if (plan.counts(options.level).vertices >= kPointsWorthHelp) options.threads = budget.threads();
  return options;
}

template <class Real>
Result<proto::RefineAnswer<Real>> refine_all(const proto::RefineRequest& request,
                                             const std::vector<Plan>& plans, const Budget& budget) {
  proto::RefineAnswer<Real> answer;
  for (std::size_t i = 0; i < request.meshes.size(); ++i) {
    auto refined =
        subdivd::refine<Real>(request.meshes[i], plans[i], mesh_options(request, plans[i], budget), budget);
    if (!refined) return proto::blame_input(request, std::move(refined).error(), "meshes", i);
    answer.meshes.push_back(std::move(refined).value());
  }
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    auto refined =
        subdivd::refine<Real>(request.curves[i], proto::curve_options(request, request.curves[i]), budget);
    if (!refined) return proto::blame_input(request, std::move(refined).error(), "curves", i);
    answer.curves.push_back(std::move(refined).value());
  }
  for (std::size_t i = 0; i < request.surfaces.size(); ++i) {
    const ControlPatch& surface = request.surfaces[i];
    auto refined = subdivd::refine<Real>(surface, proto::patch_options(request, surface), budget);
    if (!refined) return proto::blame_input(request, std::move(refined).error(), "surfaces", i);
    answer.surfaces.push_back(std::move(refined).value());
  }
  return answer;
}

template <class Real>
Result<oracle::Report> verify_all(const proto::RefineRequest& request, const std::vector<Plan>& plans,
                                  const Budget& budget) {
  oracle::Report report;
  report.oracle = oracle::oracle_name();
  for (std::size_t i = 0; i < request.meshes.size(); ++i) {
    auto verified =
        oracle::verify<Real>(request.meshes[i], plans[i], mesh_options(request, plans[i], budget), budget);
    if (!verified) return proto::blame_input(request, std::move(verified).error(), "meshes", i);
    report.meshes.push_back(std::move(verified).value());
  }
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    auto verified =
        oracle::verify<Real>(request.curves[i], proto::curve_options(request, request.curves[i]), budget);
    if (!verified) return proto::blame_input(request, std::move(verified).error(), "curves", i);
    report.curves.push_back(std::move(verified).value());
  }
  for (std::size_t i = 0; i < request.surfaces.size(); ++i) {
    const ControlPatch& surface = request.surfaces[i];
    auto verified = oracle::verify<Real>(surface, proto::patch_options(request, surface), budget);
    if (!verified) return proto::blame_input(request, std::move(verified).error(), "surfaces", i);
    report.surfaces.push_back(std::move(verified).value());
  }
  return report;
}

template <class Real>
Result<proto::AnyAnswer> answer_in(const proto::RefineRequest& request, const std::vector<Plan>& plans,
                                   const Budget& budget, Phases& phases) {
  auto answer = refine_all<Real>(request, plans, budget);
  if (!answer) return std::move(answer).error();
  phases.end("refine");
  if (request.options.verify) {
    auto report = verify_all<Real>(request, plans, budget);
    if (!report) return std::move(report).error();
    answer->verification = std::move(report).value();
    phases.end("verify");
  }
  return proto::AnyAnswer(std::move(answer).value());
}

Result<proto::AnyAnswer> compute_refinement(const proto::RefineRequest& request,
                                            const std::vector<Plan>& plans, const Budget& budget,
                                            Phases& phases) {
  return proto::answer_precision(request) == proto::Precision::single_precision
             ? answer_in<float>(request, plans, budget, phases)
             : answer_in<double>(request, plans, budget, phases);
}

Count oracle_bytes(const proto::RefineRequest& request) {
  Count bytes = 0;
  for (const ControlMesh& mesh : request.meshes)
    bytes += oracle::far_mesh_bytes(mesh, request.options.level) +
             oracle::report_bytes(mesh, request.options.level);
  for (const ControlCurves& curves : request.curves)
    bytes += oracle::far_curve_bytes(curves, request.options.level);
  for (const ControlPatch& surface : request.surfaces)
    bytes += oracle::far_surface_bytes(surface, request.options.level);
  return bytes;
}

Result<oracle::Report> compute_report(const proto::RefineRequest& request, const std::vector<Plan>& plans,
                                      const Budget& budget) {
  return proto::answer_precision(request) == proto::Precision::single_precision
             ? verify_all<float>(request, plans, budget)
             : verify_all<double>(request, plans, budget);
}

// Plans a request's meshes, and sets aside what it will take: to refine and to encode the answer, and to
// verify, which refines both here and in OpenSubdiv.
Result<std::vector<Plan>> plan_and_take(const proto::RefineRequest& request, bool answers, bool verifies,
                                        const proto::Limits& limits, const Budget& budget) {
  auto predicted = proto::predict_refine(request, limits, budget);
  if (!predicted) return std::move(predicted).error();
  Count bytes = 0;
  if (answers) bytes += predicted->held_bytes + predicted->working_bytes;
  if (verifies) bytes += predicted->working_bytes + oracle_bytes(request);
  if (auto taken = budget.take_memory(bytes - std::min(bytes, predicted->taken_bytes)); !taken)
    return std::move(taken).error();
  return std::move(predicted->plans);
}

}  // namespace

Result<proto::Payload> refine(const proto::RefineRequest& request, const proto::Limits& limits,
                              const Budget& budget, Phases& phases) {
  const auto plans = plan_and_take(request, true, request.options.verify, limits, budget);
  if (!plans) return plans.error();
  phases.end("plan");
  auto answer = compute_refinement(request, *plans, budget, phases);
  if (!answer) return std::move(answer).error();
  auto payload = proto::encode_refine(request, *std::move(answer), budget);
  phases.end("write");
  return payload;
}

Result<proto::AnyAnswer> compute(const proto::RefineRequest& request, const proto::Limits& limits,
                                 const Budget& budget) {
  const auto plans = plan_and_take(request, true, request.options.verify, limits, budget);
  if (!plans) return plans.error();
  Phases phases;
  return compute_refinement(request, *plans, budget, phases);
}

Result<proto::Payload> verify(const proto::RefineRequest& request, const proto::Limits& limits,
                              const Budget& budget, Phases& phases) {
  const auto plans = plan_and_take(request, false, true, limits, budget);
  if (!plans) return plans.error();
  phases.end("plan");
  const auto report = compute_report(request, *plans, budget);
  if (!report) return report.error();
  phases.end("verify");
  auto payload = proto::encode_report(request, *report, budget);
  phases.end("write");
  return payload;
}

bool self_test() {
  // By Loop's scheme an open pyramid with a crease: an inner vertex of valence 5, a border, a semi-sharp
  // edge. By Catmull and Clark's a cube of quads with a crease, and a house of quads and pentagons whose
  // ridge is sharp.
  constexpr std::string_view kMeshes = R"({"meshes": [
    {"points": [[0,0,1], [1,0,0], [0.3,1,0], [-0.8,0.6,0], [-0.8,-0.6,0], [0.3,-1,0]],
     "faceVertexIndices": [[0,1,2], [0,2,3], [0,3,4], [0,4,5], [0,5,1]],
     "creaseIndices": [0,1], "creaseLengths": [2], "creaseSharpnesses": [1.5]},
    {"points": [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,1], [1,0,1], [1,1,1.2], [0,1,1]],
     "faceVertexIndices": [[0,3,2,1], [4,5,6,7], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]],
     "creaseIndices": [4,5,6], "creaseLengths": [3], "creaseSharpnesses": [1.5]},
    {"points": [[0,0,0], [4,0,0], [4,0,3], [0,0,3], [0,3,0], [4,3,0], [4,3,3], [0,3,3], [0,4.5,1.5], [4,4.5,1.5]],
     "faceVertexIndices": [[0,1,2,3], [0,4,5,1], [3,2,6,7], [1,5,9,6,2], [0,3,7,8,4], [4,8,9,5], [7,6,9,8]],
     "creaseIndices": [8,9], "creaseLengths": [2], "creaseSharpnesses": ["infinite"]}],
    "options": {"level": 3, "limit": true, "normals": true}})";
  const auto decoded = proto::decode_refine(kMeshes, proto::BodyKind::json, {}, proto::Limits{});
  if (!decoded) return false;
  const auto predicted = proto::predict_refine(*decoded, proto::Limits{});
  if (!predicted) return false;
  const auto report = compute_report(*decoded, predicted->plans, Budget{});
  return report.ok() && report->verdict() == oracle::Verdict::passed;
}

}  // namespace subdivd::server::tasks
