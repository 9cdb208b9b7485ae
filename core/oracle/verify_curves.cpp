#include <algorithm>

#include "core/base/pace.h"
#include "core/oracle/compare.h"
#include "core/oracle/far_curves.h"
#include "core/oracle/remarks.h"
#include "core/oracle/verify.h"

namespace subdivd::oracle {
namespace {

std::string remark(CurveWrap wrap) {
  switch (wrap) {
    case CurveWrap::periodic:
      return "periodic curves: compared as the border of a ring of triangles";
    case CurveWrap::nonperiodic:
      return "nonperiodic curves: compared as the inner part of a border";
    case CurveWrap::pinned:
      break;
  }
  return "pinned curves: compared as the border of a strip of triangles with sharp corners";
}

template <class Real>
Result<CurveReport> compare_levels(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget, const Pace& pace) {
  CurveReport report;
  report.name = curves.name;
  report.precision = sizeof(Real) == sizeof(float) ? "single" : "double";
  report.remarks.push_back(remark(curves.wrap));
  const PointScale scale = point_scale(curves.points, curves.width, pace);

  FarCurves far = far_control(curves);
  for (Index level = std::min<Index>(1, options.level); level <= options.level; ++level) {
    CurveOptions step = options;
    step.level = level;
    step.tangents = false;
    const auto ours = refine<Real>(curves, step, budget);
    if (!ours) return ours.error();
    auto next = far_refine_curves<Real>(far, std::min<Index>(1, level), options.limit, budget);
    if (!next) return next.error();
    far = std::move(*next);
    report.levels.push_back(compare(*ours, far, scale, pace));
  }
  remark_exceptions(report.levels, report.remarks);
  remark_remoteness("curve", scale.remoteness, report.remarks);
  report.verdict = verdict_of(report.levels);
  return report;
}

}  // namespace

template <class Real>
Result<CurveReport> verify(const ControlCurves& curves, const CurveOptions& options, const Budget& budget) {
  const UniformBSpline* bspline = std::get_if<UniformBSpline>(&curves.basis);
  if (bspline == nullptr || bspline->degree != 3)
    return Error{
        ErrorCode::unsupported,
        "OpenSubdiv knows uniform cubic B-splines only; verification needs basis \"bspline\" of degree 3",
        {"basis"}};
  if (const auto sizes = predict_bytes<Real>(curves, options); !sizes) return sizes.error();
  if (auto fits = check_far_curves(curves, options.level, budget); !fits) return fits.error();
  return stoppable(budget,
                   [&](const Pace& pace) { return compare_levels<Real>(curves, options, budget, pace); });
}

template Result<CurveReport> verify<float>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<CurveReport> verify<double>(const ControlCurves&, const CurveOptions&, const Budget&);

}  // namespace subdivd::oracle
