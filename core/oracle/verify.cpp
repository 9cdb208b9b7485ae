#include "core/oracle/verify.h"

#include <opensubdiv/version.h>

#include <algorithm>

#include "core/base/pace.h"
#include "core/oracle/compare.h"
#include "core/oracle/remarks.h"

namespace subdivd::oracle {
namespace {

void remark_sharpness(const ControlMesh& mesh, MeshReport& report, const Pace& pace) {
  if (sharpness_rounds(mesh, pace))
    report.remarks.push_back(
        "three or more semi-sharp edges meet: sharpness is single precision and its sums "
        "round by their order, so the tolerance of values is at least 1e-7");
}

Result<void> check_scheme(const AnyScheme& scheme) {
  const std::string_view reason = beyond_opensubdiv(scheme);
  if (reason.empty()) return {};
  return Error{ErrorCode::unsupported, "OpenSubdiv " + std::string(reason)};
}

template <class Real>
Result<MeshReport> compare_levels(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                                  const Budget& budget, const Pace& pace) {
  auto far_mesh = FarMesh::build(mesh, options.crease_method, options.level, budget);
  if (!far_mesh) return far_mesh.error();
  MeshReport report;
  report.name = mesh.name;
  report.precision = sizeof(Real) == sizeof(float) ? "single" : "double";
  for (Index level = std::min<Index>(1, options.level); level <= options.level; ++level) {
    RefineOptions step = options;
    step.level = level;
    step.tangents = false;
    step.connectivity = step.provenance = true;  // what is matched
    const auto far = far_mesh->refine<Real>(step, budget);
    if (!far) return far.error();
    const auto ours = refine<Real>(mesh, plan, step, budget);
    if (!ours) return ours.error();
    report.levels.push_back(compare(mesh, *ours, *far, pace));
  }
  remark_exceptions(report.levels, report.remarks);
  remark_sharpness(mesh, report, pace);
  remark_remoteness("mesh", point_scale(mesh.points, 3, pace).remoteness, report.remarks);
  report.verdict = verdict_of(report.levels);
  return report;
}

}  // namespace

std::string oracle_name() {
  constexpr int kNumber = OPENSUBDIV_VERSION_NUMBER;  // 30500
  return "OpenSubdiv " + std::to_string(kNumber / 10000) + "." + std::to_string(kNumber / 100 % 100) + "." +
         std::to_string(kNumber % 100) + " Far";
}

template <class Real>
Result<MeshReport> verify(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                          const Budget& budget) {
  if (auto known = check_scheme(plan.scheme()); !known) return std::move(known).error();
  return stoppable(budget,
                   [&](const Pace& pace) { return compare_levels<Real>(mesh, plan, options, budget, pace); });
}

template <class Real>
Result<MeshReport> verify(const ControlMesh& mesh, const RefineOptions& options, const Budget& budget) {
  if (auto fits = check_far_size(mesh, options.level, budget); !fits) return std::move(fits).error();
  const auto plan = Plan::build(mesh, plan_options(options), budget);
  if (!plan) return plan.error();
  return verify<Real>(mesh, *plan, options, budget);
}

template Result<MeshReport> verify<float>(const ControlMesh&, const Plan&, const RefineOptions&,
                                          const Budget&);
template Result<MeshReport> verify<double>(const ControlMesh&, const Plan&, const RefineOptions&,
                                           const Budget&);
template Result<MeshReport> verify<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<MeshReport> verify<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd::oracle
