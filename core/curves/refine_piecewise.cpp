#include <algorithm>
#include <span>
#include <utility>
#include <variant>

#include "core/base/pace.h"
#include "core/curves/bases.h"
#include "core/curves/piecewise.h"
#include "core/splines/bspline.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

// Parameters at which the points of a refined curve are taken to stand.
std::vector<double> greville_abscissae(const Spline& spline, const Pace& pace) {
  std::vector<double> ts;
  ts.reserve(spline.point_count());
  for (Count i = 0; i < spline.point_count(); ++i) {
    pace.spend(spline.degree);
    double mean = 0;
    for (Index k = 1; k <= spline.degree; ++k) mean += spline.knots[i + k] / spline.degree;
    ts.push_back(std::clamp(mean, spline.begin(), spline.end()));
  }
  return ts;
}

std::vector<double> thirds_of_pieces(const Spline& spline, const Pace& pace) {
  std::vector<double> ts;
  // The ends of its Bezier pieces are knots.
  for (Count i = spline.degree; i < spline.point_count(); ++i) {
    pace.spend(3);
    const double begin = spline.knots[i], end = spline.knots[i + 1];
    if (!(begin < end)) continue;
    pace.make_room(ts, 4);
    for (Index k = 0; k < 3; ++k) ts.push_back(begin + (end - begin) * k / 3);
  }
  ts.push_back(spline.end());
  return ts;
}

Result<void> add_limits(const Spline& refined, const CurveOptions& options, const Pace& pace,
                        RefinedPiecewise& all) {
  if (!options.limit && !options.tangents) return {};
  const Index dimension = refined.dimension();
  std::vector<double> rows(2 * std::size_t{dimension});
  const Count order = refined.degree + Count{1};
  const auto add = [&](std::span<const double> row, std::vector<double>& to) {
    pace.make_room(to, dimension);
    to.insert(to.end(), row.begin(), row.end());
  };
  const bool on_knots = std::holds_alternative<Nurbs>(all.basis);
  for (const double t : on_knots ? greville_abscissae(refined, pace) : thirds_of_pieces(refined, pace)) {
    pace.spend(64 + 2 * order * (order + refined.width));
    if (auto done = derivatives(refined, t, 1, rows); !done) return done;
    if (options.limit) add(std::span(rows).first(dimension), all.limit_points);
    if (options.tangents) add(std::span(rows).last(dimension), all.tangents);
  }
  return {};
}

Result<void> add_refined(const Spline& spline, const CurveOptions& options, const Budget& budget,
                         const Pace& pace, RefinedPiecewise& all) {
  const auto refined = refine_spans(spline, options.level, budget);
  if (!refined) return refined.error();
  const Count before = all.points.size();
  if (Nurbs* on_knots = std::get_if<Nurbs>(&all.basis)) {
    pace.append(control_points_of(*refined, pace), all.points);
    pace.append(weights(*refined, pace), on_knots->weights);
    pace.append(refined->knots, on_knots->knots);
    on_knots->orders.push_back(refined->degree + 1);
  } else {
    const auto points = bezier_points(*refined, budget);
    if (!points) return points.error();
    pace.append(*points, all.points);
  }
  all.vertex_counts.push_back(static_cast<Index>((all.points.size() - before) / refined->dimension()));
  return add_limits(*refined, options, pace, all);
}

}  // namespace

Result<RefinedPiecewise> refine_piecewise(const ControlCurves& curves, const CurveOptions& options,
                                          const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<RefinedPiecewise> {
    RefinedPiecewise all;
    if (family_of(curves.basis) == CurveFamily::on_knots) all.basis = Nurbs{};
    CurvePlace place;
    for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
      const auto spline = spline_of(curves, c, place, budget);
      if (!spline) return spline.error();
      if (auto done = add_refined(*spline, options, budget, pace, all); !done) return std::move(done).error();
    }
    return all;
  });
}

}  // namespace subdivd
