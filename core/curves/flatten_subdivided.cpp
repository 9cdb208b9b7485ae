#include "core/curves/flatten_subdivided.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/all_finite.h"
#include "core/base/overloaded.h"
#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/curves/corner_cutting.h"
#include "core/curves/curve_window.h"
#include "core/curves/four_point.h"
#include "core/splines/bounds.h"
#include "core/splines/chord.h"
#include "core/splines/measurement.h"

namespace subdivd {
namespace {

// --- The curve at the origin ------------------------------------------------------------------------------

// global = centre + local * 2^exponent; local control points are within [-1, 1], where squares neither
// overflow nor vanish.
struct LocalCurve {
  std::vector<double> points, centre;
  int exponent = 0;
  double corner_rounding = 0;  // of a corner that is moved to its place, local
};

LocalCurve local_curve(const SubdividedCurve& curve, const Pace& pace) {
  const Index width = curve.dimension();
  LocalCurve local{{}, std::vector<double>(width), 0, 0};
  pace.copy(curve.points, local.points);
  std::vector<double> largest(width), radius(width);
  for (Index k = 0; k < width; ++k) {
    double low = curve.points[k], high = low;
    pace.for_each(curve.point_count(), [&](Count i) {
      low = std::min(low, curve.points[i * width + k]);
      high = std::max(high, curve.points[i * width + k]);
    });
    local.centre[k] = low / 2 + high / 2;
    largest[k] = std::max(std::abs(low), std::abs(high));
    // Halves: the difference of two doubles may outgrow one.
    radius[k] = std::max(high / 2 - local.centre[k] / 2, local.centre[k] / 2 - low / 2);
  }
  const double widest = *std::ranges::max_element(radius);
  if (widest > 0) local.exponent = std::ilogb(widest) + 2;
  pace.for_each(local.points.size(), [&](Count i) {
    local.points[i] = std::ldexp(local.points[i] / 2 - local.centre[i % width] / 2, 1 - local.exponent);
  });
  double square = 0;
  for (Index k = 0; k < width; ++k) {
    if (radius[k] == 0) continue;  // stays where it is
    const double last_bit = std::ldexp(largest[k], -local.exponent) * 2 * kRoundoff;
    square += last_bit * last_bit;
  }
  local.corner_rounding = std::sqrt(square);
  return local;
}

// --- Parts of it ------------------------------------------------------------------------------------------

// The points that the curve over [begin, end] depends on, after `level` halvings of a cell.
struct Part {
  double begin, end;
  Index level;
  std::vector<double> points;
};

// What the two schemes differ in. Their points are counted from the first one of a part.
struct FourPointParts {
  double w;
  Index width;
  static constexpr Index kPoints = 6, kBefore = 2;  // of them before the place where a cell begins
  static constexpr bool kInterpolates = true;

  std::vector<double> end(const std::vector<double>& points, bool last) const {
    const auto at = points.begin() + static_cast<std::ptrdiff_t>((last ? 3 : 2) * Count{width});
    return {at, at + width};
  }
  // Children -2 to 4 of the points -2 to 3.
  std::vector<double> children(const std::vector<double>& points) const {
    std::vector<double> first(3 * Count{width}), second(first.size()), all;
    FourPoint{w}.children(width, points.data() + width, first.size(), first.data(), second.data());
    for (Index i = 0; i < 3; ++i)
      for (const std::vector<double>* child : {&first, &second})
        all.insert(all.end(), child->begin() + i * width, child->begin() + (i + 1) * width);
    all.insert(all.end(), points.end() - 2 * static_cast<std::ptrdiff_t>(width), points.end() - width);
    return all;
  }
  bool is_polygon() const { return w == 0; }
  double shrinking() const { return std::max(0.5, 4 * w); }
  double off_chord(const std::vector<double>& points) const {
    double longest = 0;
    for (Count i = 1; i + 1 < kPoints; ++i) {
      double square = 0;
      for (Count k = i * width; k < (i + 1) * width; ++k) {
        const double bend = points[k - width] - 2 * points[k] + points[k + width];
        square += bend * bend;
      }
      longest = std::max(longest, square);
    }
    return 2 * w * std::sqrt(longest) / (1 - shrinking());
  }
  // How many times as large as the points of one level those of later ones can be: off_chord() with second
  // differences of 4 times their size.
  double growth() const { return 1 + 8 * w / (1 - shrinking()); }
};

struct CornerCuttingParts {
  double r;
  Index width;
  static constexpr Index kPoints = 3, kBefore = 1;
  static constexpr bool kInterpolates = false;

  std::vector<double> end(const std::vector<double>& points, bool last) const {
    std::vector<double> middle(width);
    const double* edge = points.data() + (last ? width : 0);
    for (Index k = 0; k < width; ++k) middle[k] = edge[k] / 2 + edge[width + k] / 2;
    return middle;
  }
  // The second of the first point to the first of the third. What lies beyond these is not looked at.
  std::vector<double> children(const std::vector<double>& points) const {
    std::vector<double> padded(points.begin(), points.begin() + width);
    padded.insert(padded.end(), points.begin(), points.end());
    padded.insert(padded.end(), points.end() - width, points.end());
    std::vector<double> first(3 * Count{width}), second(first.size()), all;
    CornerCutting{r}.children(width, padded.data() + width, first.size(), first.data(), second.data());
    for (Index i = 0; i < 2; ++i) {
      all.insert(all.end(), second.begin() + i * width, second.begin() + (i + 1) * width);
      all.insert(all.end(), first.begin() + (i + 1) * width, first.begin() + (i + 2) * width);
    }
    return all;
  }
  double off_chord(const std::vector<double>& points) const {
    return std::sqrt(
        square_from_segment(std::span(points).subspan(width, width), end(points, false), end(points, true)));
  }
  bool is_polygon() const { return false; }
  double growth() const { return 1; }  // points stay in the hull of those before
};

template <class Parts>
std::array<Part, 2> halves(const Parts& parts, const Part& part) {
  const double middle = part.begin + (part.end - part.begin) / 2;
  std::vector<double> left = parts.children(part.points);
  std::vector<double> right(left.begin() + parts.width, left.end());
  left.resize(part.points.size());
  return {Part{part.begin, middle, part.level + 1, std::move(left)},
          Part{middle, part.end, part.level + 1, std::move(right)}};
}

// --- The polyline -----------------------------------------------------------------------------------------

// Points begin with 4 roundings, and every step adds 8 of what they can have grown to; a point that is off
// moves the points of later levels by growth() times as much.
template <class Parts>
double rounding(const Parts& parts, Index level, double largest) {
  const double growth = parts.growth();
  return (8.0 * level + 20) * kRoundoff * growth * growth * growth * largest * std::sqrt(parts.width);
}

struct Limits {
  FlattenOptions options;
  double tolerance;  // local
  Count most;        // corners
};

// Adds the corners behind the begin of one cell, in local coordinates. `waiting`: cells still to come.
template <class Parts>
Result<void> add_cell(const Parts& parts, Part cell, const LocalCurve& local, const Limits& limits,
                      Count waiting, const Pace& pace, Polyline& polyline) {
  double largest = 1;  // of the curve's points; those that continue it can be larger
  for (const double x : cell.points) largest = std::max(largest, std::abs(x));
  std::vector<Part> ahead;  // the next one last; never more than one per level
  ahead.push_back(std::move(cell));
  while (!ahead.empty()) {
    pace.spend(16 * (Count{parts.width} + 4));
    const Part part = std::move(ahead.back());
    ahead.pop_back();
    const double rounded = 2 * rounding(parts, part.level, largest) + local.corner_rounding;
    if (parts.off_chord(part.points) + rounded <= limits.tolerance) {
      const Count corners = polyline.parameters.size() + 1 + ahead.size() + waiting;
      if (corners > limits.most) return too_many_corners(corners, limits.most);
      pace.make_room(polyline.parameters, 1);
      polyline.parameters.push_back(part.end);
      pace.make_room(polyline.points, parts.width);
      const std::vector<double> corner = parts.end(part.points, true);
      polyline.points.insert(polyline.points.end(), corner.begin(), corner.end());
      continue;
    }
    if (rounded >= limits.tolerance) return too_fine(limits.options, std::ldexp(rounded, local.exponent));
    auto both = halves(parts, part);
    ahead.push_back(std::move(both[1]));
    ahead.push_back(std::move(both[0]));
  }
  return {};
}

// Corners to their places; `of_cells`: the numbers of those between cells.
template <class Parts>
Result<void> finish(const SubdividedCurve& curve, const LocalCurve& local, std::span<const Count> of_cells,
                    const Pace& pace, Polyline& polyline) {
  const Index width = curve.dimension();
  std::vector<double>& points = polyline.points;
  pace.for_each(points.size(), [&](Count i) {
    points[i] = local.centre[i % width] + std::ldexp(points[i], local.exponent);
  });
  const auto put = [&](Count corner, Count control) {
    const std::span<const double> from = curve.points.subspan(control % curve.point_count() * width, width);
    std::ranges::copy(from, points.begin() + static_cast<std::ptrdiff_t>(corner * width));
  };
  if (Parts::kInterpolates) {
    const auto first = static_cast<Count>(curve.begin());
    pace.in_blocks(
        of_cells.size(),
        [&](Count begin, Count end) {
          for (Count i = begin; i < end; ++i) put(of_cells[i], first + i);
        },
        width);
  } else if (curve.rule->wrap == CurveWrap::pinned) {
    put(0, 0);
    put(of_cells.back(), curve.point_count() - 1);
  }
  bool finite = true;
  pace.in_blocks(points.size(), [&](Count begin, Count end) {
    finite = finite && all_finite(std::span<const double>(points).subspan(begin, end - begin));
  });
  if (!finite) return does_not_fit();
  return {};
}

template <class Parts>
Result<Polyline> flatten_by(const Parts& parts, const SubdividedCurve& curve, const FlattenOptions& options,
                            const Budget& budget, const Pace& pace) {
  const Index width = curve.dimension();
  const auto cells = static_cast<Count>(curve.end() - curve.begin());
  const Count fitting = budget.max_bytes / ((Count{width} + 1) * sizeof(double));
  const LocalCurve local = local_curve(curve, pace);
  // Exact: a curve that is but a point, and the polygon that tension 0 gives.
  const bool exact = local.corner_rounding == 0 || parts.is_polygon();
  const Limits limits{options, exact ? HUGE_VAL : std::ldexp(options.tolerance, -local.exponent),
                      std::min(options.max_points, fitting)};
  if (cells + 1 > limits.most) return too_many_corners(cells + 1, limits.most);

  const Curve<double> whole = curve_of<double>(*curve.rule, local.points);
  const std::span<const double> core = core_of(whole, local.points);
  Window<double> window;
  Polyline polyline;
  std::vector<Count> of_cells{0};
  for (Count k = 0; k < cells; ++k) {
    const double begin = curve.begin() + static_cast<double>(k);
    const Place first = static_cast<Place>(std::ceil(begin)) - Parts::kBefore;
    load(whole, core.data(), static_cast<Place>(core.size() / width), {first, first + Parts::kPoints},
         window);
    Part cell{begin, begin + 1, 0, {window.scalars.begin(), window.scalars.begin() + Parts::kPoints * width}};
    if (k == 0) {
      polyline.parameters = {begin};
      polyline.points = parts.end(cell.points, false);
    }
    const auto added = add_cell(parts, std::move(cell), local, limits, cells - 1 - k, pace, polyline);
    if (!added) return added.error();
    pace.make_room(of_cells, 1);
    of_cells.push_back(polyline.parameters.size() - 1);
  }
  if (auto done = finish<Parts>(curve, local, of_cells, pace, polyline); !done) return done.error();
  return polyline;
}

}  // namespace

Result<Polyline> flatten(const SubdividedCurve& curve, const FlattenOptions& options, const Budget& budget) {
  if (auto checked = check_tolerance(options); !checked) return checked.error();
  return stoppable(budget, [&](const Pace& pace) {
    const Index width = curve.dimension();
    return std::visit(
        Overloaded{[&](const FourPoint& kind) {
                     return flatten_by(FourPointParts{kind.tension, width}, curve, options, budget, pace);
                   },
                   [&](const CornerCutting& kind) {
                     return flatten_by(CornerCuttingParts{kind.ratio, width}, curve, options, budget, pace);
                   }},
        curve.scheme);
  });
}

}  // namespace subdivd
