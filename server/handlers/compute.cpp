#include "server/handlers/compute.h"

#include <utility>

#include "core/curves/subdivision.h"
#include "core/oracle/far.h"
#include "core/oracle/far_curves.h"
#include "core/oracle/far_surfaces.h"
#include "core/oracle/verify.h"
#include "core/refine/refine.h"
#include "proto/prepare.h"

namespace subdivd::server {
namespace {

template <class Real>
Result<proto::RefineAnswer<Real>> refine_all(const proto::RefineRequest& request,
                                             const std::vector<Plan>& plans, const Budget& budget) {
  proto::RefineAnswer<Real> answer;
  for (std::size_t i = 0; i < request.meshes.size(); ++i) {
    auto refined = refine<Real>(request.meshes[i], plans[i], proto::mesh_options(request), budget);
    if (!refined) return proto::blame_input(request, std::move(refined).error(), "meshes", i);
    answer.meshes.push_back(std::move(refined).value());
  }
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    auto refined = refine<Real>(request.curves[i], proto::curve_options(request, request.curves[i]), budget);
    if (!refined) return proto::blame_input(request, std::move(refined).error(), "curves", i);
    answer.curves.push_back(std::move(refined).value());
  }
  for (std::size_t i = 0; i < request.surfaces.size(); ++i) {
    const ControlPatch& surface = request.surfaces[i];
    auto refined = refine<Real>(surface, proto::patch_options(request, surface), budget);
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
    auto verified = oracle::verify<Real>(request.meshes[i], plans[i], proto::mesh_options(request), budget);
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

}  // namespace

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

}  // namespace subdivd::server
