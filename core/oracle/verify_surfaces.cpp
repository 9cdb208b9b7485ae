#include <algorithm>

#include "core/base/pace.h"
#include "core/oracle/compare.h"
#include "core/oracle/far_cost.h"
#include "core/oracle/far_surfaces.h"
#include "core/oracle/remarks.h"
#include "core/oracle/verify.h"

namespace subdivd::oracle {
namespace {

std::string remark(const std::string& direction, CurveWrap wrap) {
  switch (wrap) {
    case CurveWrap::periodic:
      return direction + " is periodic: compared on a grid that closes in that direction";
    case CurveWrap::nonperiodic:
      return direction + " is nonperiodic: compared as the inner part of a grid with a border";
    case CurveWrap::pinned:
      break;
  }
  return direction + " is pinned: compared on a grid that ends at a border";
}

Result<void> check_degree(Index degree, const char* field) {
  if (degree == 3) return {};
  return Error{ErrorCode::unsupported,
               "OpenSubdiv knows uniform cubic B-splines only; verification needs " + std::string(field) +
                   " 3, not " + std::to_string(degree),
               {field}};
}

// Our side of one level: what there is to compare and nothing else.
PatchOptions compared(const PatchOptions& options, Index level) {
  PatchOptions step = options;
  step.level = level;
  step.tangents = false;
  step.faces = PatchFaces::quads;
  return step;
}

template <class Real>
Result<void> check_surface(const ControlPatch& patch, const PatchOptions& options, const Budget& budget) {
  if (auto cubic = check_degree(patch.u_degree, "uDegree"); !cubic) return cubic;
  if (auto cubic = check_degree(patch.v_degree, "vDegree"); !cubic) return cubic;
  const auto bytes = predict_bytes<Real>(patch, compared(options, options.level));
  if (!bytes) return bytes.error();
  if (auto fits = check_far_corners(far_surface_corners(patch, options.level)); !fits) return fits;
  if (auto fits = check_far_grid_time(far_surface_corners(patch, options.level) / 4); !fits) return fits;
  return check_far_bytes(*bytes + far_surface_bytes(patch, options.level), budget);
}

template <class Real>
Result<SurfaceReport> compare_levels(const ControlPatch& patch, const PatchOptions& options,
                                     const Budget& budget, const Pace& pace) {
  SurfaceReport report;
  report.name = patch.name;
  report.precision = sizeof(Real) == sizeof(float) ? "single" : "double";
  report.remarks = {remark("u", patch.u_wrap), remark("v", patch.v_wrap)};

  FarSurface far = far_control(patch);
  for (Index level = std::min<Index>(1, options.level); level <= options.level; ++level) {
    const auto ours = refine<Real>(patch, compared(options, level), budget);
    if (!ours) return ours.error();
    const FarSurfaceOptions step{std::min<Index>(1, level), options.limit, options.normals};
    auto next = far_refine_surface<Real>(far, step, budget);
    if (!next) return next.error();
    far = std::move(*next);
    report.levels.push_back(compare(patch, *ours, far, pace));
  }
  remark_exceptions(report.levels, report.remarks);
  remark_remoteness("surface", point_scale(patch.points, patch.width, pace).remoteness, report.remarks);
  report.verdict = verdict_of(report.levels);
  return report;
}

}  // namespace

template <class Real>
Result<SurfaceReport> verify(const ControlPatch& patch, const PatchOptions& options, const Budget& budget) {
  if (auto fits = check_surface<Real>(patch, options, budget); !fits) return fits.error();
  return stoppable(budget,
                   [&](const Pace& pace) { return compare_levels<Real>(patch, options, budget, pace); });
}

template Result<SurfaceReport> verify<float>(const ControlPatch&, const PatchOptions&, const Budget&);
template Result<SurfaceReport> verify<double>(const ControlPatch&, const PatchOptions&, const Budget&);

}  // namespace subdivd::oracle
