#include "tests/properties/curves/kinds.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "core/base/overloaded.h"
#include "core/curves/piecewise.h"
#include "tests/shapes/random.h"

namespace subdivd::testing {
namespace {

constexpr std::pair<const char*, CurveWrap> kWraps[] = {{"nonperiodic", CurveWrap::nonperiodic},
                                                        {"periodic", CurveWrap::periodic},
                                                        {"pinned", CurveWrap::pinned}};
constexpr std::pair<const char*, double> kTensions[] = {
    {"0", 0}, {"a_32nd", 1.0 / 32}, {"a_16th", 1.0 / 16}, {"largest", 0.19}};
constexpr std::pair<const char*, double> kRatios[] = {
    {"a_100th", 0.01}, {"a_quarter", 0.25}, {"a_third", 1.0 / 3}, {"largest", 0.49}};
constexpr std::pair<const char*, Spacing> kSpacings[] = {
    {"uniform", Spacing::uniform}, {"centripetal", Spacing::centripetal}, {"chordal", Spacing::chordal}};

void add_on_knots(std::vector<CurveKind>& kinds) {
  for (const Index degree : {1u, 2u, 3u, 5u, 9u})
    for (const bool rational : {false, true})
      for (const bool clamped : {false, true}) {
        CurveKind kind{"nurbs_" + std::to_string(degree) + (rational ? "_rational" : "_plain") +
                           (clamped ? "_clamped" : "_open"),
                       {},
                       clamped,
                       rational};
        kind.rule.wrap = CurveWrap::nonperiodic;
        kind.rule.basis = Nurbs{.orders = {degree + 1}};
        kinds.push_back(kind);
      }
}

// Knots for `count` points: `count - degree - 1` of them inside the domain.
std::vector<double> random_knots(const CurveKind& kind, Index degree, Count count, shapes::Random& random) {
  std::vector<double> knots;
  double t = random.centred();
  const auto next = [&] { return t += 0.25 + random.unit(); };
  const auto put_end = [&] {
    next();
    for (Index k = 0; k <= degree; ++k) knots.push_back(kind.clamped || k == 0 ? t : next());
  };
  put_end();
  for (Count left = count - degree - 1; left > 0;) {
    const Count times = std::min<Count>(left, 1 + random.below(degree));
    knots.insert(knots.end(), times, next());
    left -= times;
  }
  put_end();
  return knots;
}

Count points_needed(const ControlCurves& rule, Count more) {
  const bool closed = rule.wrap == CurveWrap::periodic;
  return std::visit(Overloaded{
                        [&](const Bezier&) { return 3 * (more + 1) + (closed ? 0 : 1); },
                        [&](const Hermite&) { return 2 * (more + 2); },
                        [&](const CatmullRom&) {
                          return more + (closed ? 3 : rule.wrap == CurveWrap::pinned ? 2 : 4);
                        },
                        [&](const Nurbs& nurbs) { return more + nurbs.orders[0]; },
                        [&](const SubdividedKind auto&) { return more + least_points(rule); },
                    },
                    rule.basis);
}

std::vector<double> greville_abscissae(const ControlCurves& curves) {
  const Nurbs& nurbs = std::get<Nurbs>(curves.basis);
  const Index degree = nurbs.orders[0] - 1;
  const Count count = curves.point_count();
  std::vector<double> ts;
  for (Count i = 0; i < count; ++i) {
    double mean = 0;
    for (Index k = 1; k <= degree; ++k) mean += nurbs.knots[i + k] / degree;
    ts.push_back(std::clamp(mean, nurbs.knots[degree], nurbs.knots[count]));
  }
  return ts;
}

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::vector<CurveKind> all_curve_kinds() {
  std::vector<CurveKind> kinds;
  for (const auto& [wrap_name, wrap] : kWraps) {
    ControlCurves rule;
    rule.wrap = wrap;
    const auto add = [&, suffix = std::string("_") + wrap_name](const std::string& name,
                                                                const CurveBasis& basis) {
      rule.basis = basis;
      kinds.push_back({name + suffix, rule});
    };
    for (Index degree = 1; degree <= kMaxCurveDegree; ++degree)
      add("bspline_" + std::to_string(degree), UniformBSpline{degree});
    for (const auto& [name, tension] : kTensions) add(std::string("four_point_") + name, FourPoint{tension});
    for (const auto& [name, ratio] : kRatios)
      add(std::string("corner_cutting_") + name, CornerCutting{ratio});
    for (const auto& [name, spacing] : kSpacings)
      add(std::string("catmull_rom_") + name, CatmullRom{spacing});
    add("bezier", Bezier{});
    add("hermite", Hermite{});
  }
  add_on_knots(kinds);
  return kinds;
}

std::ostream& operator<<(std::ostream& out, const CurveKind& kind) { return out << kind.name; }

ControlCurves random_curve(const CurveKind& kind, Count more, Index width, std::uint64_t seed) {
  shapes::Random random(seed);
  ControlCurves curves = kind.rule;
  curves.width = width;
  const Count count = points_needed(kind.rule, more);
  for (Count k = 0; k < count * width; ++k) curves.points.push_back(random.centred());
  Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  if (nurbs == nullptr) return curves;
  nurbs->knots = random_knots(kind, nurbs->orders[0] - 1, count, random);
  if (kind.rational)
    for (Count k = 0; k < count; ++k) nurbs->weights.push_back(0.5 + 1.5 * random.unit());
  return curves;
}

ControlCurves together(const ControlCurves& one, const ControlCurves& two) {
  ControlCurves both = one;
  both.vertex_counts = {static_cast<Index>(one.point_count()), static_cast<Index>(two.point_count())};
  append(both.points, two.points);
  if (Nurbs* nurbs = std::get_if<Nurbs>(&both.basis)) {
    append(nurbs->knots, std::get<Nurbs>(two.basis).knots);
    append(nurbs->weights, std::get<Nurbs>(two.basis).weights);
  }
  return both;
}

Answer refined(const ControlCurves& curves, Index level) {
  const CurveOptions options{.level = level, .limit = true, .tangents = true};
  const auto fine = refine<double>(curves, options, Budget{});
  if (!fine) {
    ADD_FAILURE() << fine.error().message;
    return {};
  }
  Answer answer;
  answer.limits.assign(fine->limit_points.begin(), fine->limit_points.end());
  answer.tangents.assign(fine->tangents.begin(), fine->tangents.end());
  ControlCurves& next = answer.curves;
  next = curves;
  next.wrap = fine->wrap;
  next.basis = fine->basis;
  next.points.assign(fine->points.begin(), fine->points.end());
  next.vertex_counts = fine->vertex_counts;
  return answer;
}

std::vector<double> parameters(const ControlCurves& curves, Index level, const Answer& fine) {
  if (std::holds_alternative<Nurbs>(curves.basis)) return greville_abscissae(fine.curves);
  const Count count = fine.curves.point_count();
  // The first piece of a nonperiodic Catmull-Rom curve begins at its second point.
  const bool second =
      std::holds_alternative<CatmullRom>(curves.basis) && curves.wrap == CurveWrap::nonperiodic;
  std::vector<double> ts;
  for (Count j = 0; j < count; ++j)
    ts.push_back(is_subdivided(curves.basis)
                     ? point_parameter(curves, curves.point_count(), level, j)
                     : (second ? 1 : 0) + std::ldexp(static_cast<double>(j) / 3, -static_cast<int>(level)));
  return ts;
}

Inside inside(const ControlCurves& curves, Count points) {
  if (!is_subdivided(curves.basis) || curves.wrap != CurveWrap::nonperiodic) return {0, points};
  const Count outer = split_of(curves).lost / 2;
  return {outer, points - outer};
}

std::optional<Spline> formula_of(const ControlCurves& curves) {
  const CornerCutting* cutting = std::get_if<CornerCutting>(&curves.basis);
  if (std::holds_alternative<FourPoint>(curves.basis) || (cutting != nullptr && cutting->ratio != 0.25))
    return std::nullopt;
  auto spline = spline_of(curves, 0, {});
  if (spline) return std::move(*spline);
  ADD_FAILURE() << spline.error().message;
  return std::nullopt;
}

ControlCurves reverse(const ControlCurves& curves) {
  const Index width = curves.width;
  const bool hermite = std::holds_alternative<Hermite>(curves.basis);
  // A point and its tangent stay together; a closed curve keeps its first point.
  const Count row = width * (hermite ? 2 : 1), rows = curves.points.size() / row;
  const Count last = curves.wrap == CurveWrap::periodic ? rows : rows - 1;
  ControlCurves back = curves;
  for (Count i = 0; i < rows; ++i)
    for (Count k = 0; k < row; ++k) {
      const double value = curves.points[(last - i) % rows * row + k];
      back.points[i * row + k] = hermite && k >= width ? -value : value;
    }
  if (Nurbs* nurbs = std::get_if<Nurbs>(&back.basis)) {
    std::ranges::reverse(nurbs->weights);
    std::ranges::reverse(nurbs->knots);
    for (double& knot : nurbs->knots) knot = -knot;
  }
  return back;
}

ControlCurves coordinate(const ControlCurves& curves, Index k) {
  ControlCurves one = curves;
  one.width = 1;
  one.points.clear();
  for (Count i = 0; i < curves.point_count(); ++i) one.points.push_back(curves.points[i * curves.width + k]);
  return one;
}

}  // namespace subdivd::testing
