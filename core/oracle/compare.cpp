#include "core/oracle/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/lattice/split.h"
#include "core/oracle/correspondence.h"
#include "core/oracle/deviation_meter.h"
#include "core/oracle/vectors.h"

namespace subdivd::oracle {
namespace {

constexpr const char* kSemiSharp = "Far takes the sharpness that is left for infinite";
constexpr const char* kDart = "Far's limit masks at a dart leave the crease out of account";
constexpr const char* kIsolated = "unreferenced points have no surface";
constexpr const char* kNonManifold = "no common tangent plane at non-manifold vertices";
constexpr const char* kSides = "creases inside the surface have a tangent plane on either side";
constexpr const char* kCorner = "corners of several faces have no common tangent plane";
constexpr const char* kIrregularBorder =
    "Far's tangent across a border vertex of more than three faces (two where faces become quads) is no "
    "eigenvector of "
    "the subdivision";
constexpr const char* kTwoFaces = "Far leaves points of two faces where they are";
constexpr const char* kOtherFaces = "Far's limit masks are those of quads, also at points of other faces";
constexpr const char* kMovedSeams =
    "Far moves the limits of values at seams, which bilinear subdivision keeps";
constexpr const char* kFlatPieces = "Far's tangents where bilinear pieces meet are those of one of them";
constexpr const char* kNoNormal = "degenerate surface without a normal";
constexpr const char* kTorn = "Far tears a value that two separate groups of faces around a point share";

// Everything that one level's comparisons share.
template <class Real>
struct Sides {
  const ControlMesh& mesh;
  const RefinedMesh<Real>& ours;
  const FarLevel<Real>& far;
  const Correspondence& pairs;
  PointScale scale;
  const Pace& pace;
  double value_tolerance = 0;  // of primvars, and of positions near the origin

  DeviationMeter meter(std::string quantity, double unit_size, double tolerance) const {
    return {std::move(quantity), unit_size, tolerance, static_cast<double>(segments(far.level))};
  }
  Site site(Index our_vertex) const { return {our_vertex, ours.provenance[our_vertex]}; }
  // Calls visit(far vertex, our vertex) for every pair, in our order.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (Index v = 0; v < pairs.vertices.size(); ++v) {
      pace.spend(8);
      if (pairs.vertices[v] != kNoIndex) visit(v, pairs.vertices[v]);
    }
  }
};

// A quantity of which one side is incomplete.
Deviation incomparable(std::string quantity, double tolerance) {
  Deviation deviation;
  deviation.quantity = std::move(quantity);
  deviation.tolerance = tolerance;
  deviation.exception = "the two sides hold different numbers of values";
  deviation.verdict = Verdict::failed;
  return deviation;
}

// Why a limit by Far is no witness at this vertex; null when it is one.
const char* limit_objection(const FarVertex& vertex, FarScheme scheme) {
  // Both sides keep the point.
  if (vertex.faces == 0 || scheme == FarScheme::bilinear) return nullptr;
  if (vertex.semi_sharp) return kSemiSharp;
  if (vertex.rule == FarRule::dart) return kDart;
  if (scheme == FarScheme::loop || vertex.rule != FarRule::smooth) return nullptr;
  if (vertex.faces == 2) return kTwoFaces;
  return vertex.has_other_faces ? kOtherFaces : nullptr;
}

const char* bilinear_normal_objection(const FarVertex& vertex, Index level) {
  const Count n = segments(level);
  const Provenance& at = vertex.place;
  const bool inside_piece = at.i > 0 && at.i < n && at.j > 0 && at.j < n;
  return inside_piece || vertex.faces == 1 ? nullptr : kFlatPieces;
}

const char* normal_objection(const FarVertex& vertex, FarScheme scheme, Index level) {
  if (vertex.faces == 0) return kIsolated;
  if (vertex.non_manifold) return kNonManifold;
  if (scheme == FarScheme::bilinear) return bilinear_normal_objection(vertex, level);
  if (const char* reason = limit_objection(vertex, scheme)) return reason;
  if (vertex.rule == FarRule::corner && vertex.faces > 1) return kCorner;
  if (vertex.rule != FarRule::crease) return nullptr;
  if (!vertex.boundary) return kSides;
  if (vertex.faces > (scheme == FarScheme::loop ? 3u : 2u)) return kIrregularBorder;
  return vertex.has_other_faces ? kOtherFaces : nullptr;
}

// Distances of 3-vectors, one per vertex.
template <class Real>
Deviation compare_points(const Sides<Real>& sides, const char* quantity, std::span<const Real> ours,
                         std::span<const Real> far, bool limit) {
  const double tolerance = sides.value_tolerance * sides.scale.remoteness;
  if (ours.size() != 3 * sides.ours.provenance.size() || far.size() != 3 * sides.far.vertices.size())
    return incomparable(quantity, tolerance);
  DeviationMeter meter = sides.meter(quantity, sides.scale.diagonal, tolerance);
  sides.for_each_pair([&](Index f, Index v) {
    const char* objection = limit ? limit_objection(sides.far.vertices[f], sides.far.scheme) : nullptr;
    if (objection != nullptr) return meter.except(objection);
    Vector difference = vector_at<Real>(ours, v);
    const Vector other = vector_at<Real>(far, f);
    for (std::size_t k = 0; k < 3; ++k)
      difference[k] = difference[k] / sides.scale.diagonal - other[k] / sides.scale.diagonal;
    meter.add(std::sqrt(dot(difference, difference)), sides.site(v));
  });
  return meter.finish();
}

template <class Real>
Deviation compare_normals(const Sides<Real>& sides) {
  const FarLevel<Real>& far = sides.far;
  const std::size_t size = 3 * far.vertices.size();
  if (sides.ours.normals.size() != 3 * sides.ours.provenance.size() || far.tangents_u.size() != size ||
      far.tangents_v.size() != size)
    return incomparable("normals", normal_tolerance<Real>());
  DeviationMeter meter = sides.meter("normals", 1, normal_tolerance<Real>());
  // Tangents are differences of coordinates: they round by epsilon times the coordinates' size, which turns
  // the normal by about rounding (|u| + |v|) / |u x v|. Where that alone may be half the tolerance, nothing
  // is said.
  const double rounding = double{std::numeric_limits<Real>::epsilon()} * sides.scale.diagonal *
                          sides.scale.remoteness * 2 / (normal_tolerance<Real>() * std::numbers::pi / 180);
  sides.for_each_pair([&](Index f, Index v) {
    if (const char* objection = normal_objection(far.vertices[f], far.scheme, far.level))
      return meter.except(objection);
    const Vector ours = vector_at<Real>(sides.ours.normals, v);
    const Vector u = vector_at<Real>(far.tangents_u, f), v_across = vector_at<Real>(far.tangents_v, f);
    const Vector theirs = cross(unit(u), unit(v_across));
    const double sine = std::sqrt(dot(theirs, theirs));
    // |u x v| / (|u| + |v|) in a form that neither over- nor underflows.
    const double height = sine / (1 / length(u) + 1 / length(v_across));
    if (dot(ours, ours) == 0 || !(height > rounding)) return meter.except(kNoNormal);
    meter.add(degrees_between(ours, unit(theirs)), sides.site(v));
  });
  return meter.finish();
}

// The largest difference of a component, in units of `scale`. A NaN wins.
template <class Real>
double largest_difference(const Real* a, const Real* b, Index width, double scale) {
  double largest = 0;
  for (Index k = 0; k < width; ++k) {
    const double difference = std::abs(double{a[k]} / scale - double{b[k]} / scale);
    if (!(difference <= largest)) largest = difference;
    if (std::isnan(largest)) break;
  }
  return largest;
}

double primvar_scale(const Primvar& primvar, const Pace& pace) {
  double largest = 0;
  for (const double value : primvar.values) {
    pace.spend(1);
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0 ? largest : 1;
}

// Calls visit(site, far vertex or kNoIndex, our value, Far's value) for every pair of values of a primvar.
template <class Real, class Visit>
void for_each_value(const Sides<Real>& sides, const RefinedPrimvar<Real>& ours, const FarPrimvar<Real>& far,
                    Visit&& visit) {
  switch (ours.interpolation) {
    case Interpolation::constant:
      visit(Site{}, kNoIndex, Index{0}, Index{0});
      break;
    case Interpolation::vertex:
    case Interpolation::varying:
      sides.for_each_pair([&](Index f, Index v) { visit(sides.site(v), f, v, f); });
      break;
    case Interpolation::uniform:
      for (Index f = 0; f < sides.pairs.faces.size(); ++f) {
        sides.pace.spend(8);
        if (const Index face = sides.pairs.faces[f]; face != kNoIndex)
          visit(Site{kNoIndex, sides.far.place(f, sides.far.rows.begin(f))}, kNoIndex, face, f);
      }
      break;
    case Interpolation::face_varying:
      for (Index f = 0; f < sides.pairs.faces.size(); ++f)
        for (Count c = sides.far.rows.begin(f); c < sides.far.rows.end(f); ++c) {
          sides.pace.spend(8);
          if (const Index corner = sides.pairs.corners[c]; corner != kNoIndex)
            visit(Site{sides.ours.faces[corner], sides.far.place(f, c)}, sides.far.faces[c],
                  ours.indices[corner], far.indices[c]);
        }
      break;
  }
}

// Every index that for_each_value will use is within its array.
template <class Real>
bool complete(const Sides<Real>& sides, const RefinedPrimvar<Real>& ours, std::span<const Real> our_values,
              std::span<const Real> far_values) {
  const Count width = ours.element_size;
  const auto holds = [&](Count count) { return our_values.size() == count * width; };
  switch (ours.interpolation) {
    case Interpolation::constant:
      return holds(1) && far_values.size() == width;
    case Interpolation::vertex:
    case Interpolation::varying:
      return holds(sides.ours.provenance.size());
    case Interpolation::uniform:
      return holds(sides.ours.base_faces.size());
    case Interpolation::face_varying:
      break;
  }
  return ours.indices.size() == sides.ours.faces.size() &&
         std::all_of(ours.indices.begin(), ours.indices.end(), [&](Index index) {
           sides.pace.spend(1);
           return index < our_values.size() / width;
         });
}

template <class Real>
Deviation compare_primvar(const Sides<Real>& sides, std::size_t p, bool limit) {
  const Primvar& control = sides.mesh.primvars[p];
  const bool face_varying = control.interpolation == Interpolation::face_varying;
  const std::string quantity = "primvars/" + control.name + (limit ? "/limit" : "");
  double tolerance = sides.value_tolerance;
  if (limit && face_varying) tolerance = std::max(tolerance, face_varying_limit_tolerance<Real>());
  if (p >= sides.ours.primvars.size()) return incomparable(quantity, tolerance);
  const RefinedPrimvar<Real>& ours = sides.ours.primvars[p];
  const FarPrimvar<Real>& far = sides.far.primvars[p];
  const std::span<const Real> our_values = limit ? ours.limit_values : ours.values;
  const std::span<const Real> far_values = limit ? far.limit_values : far.values;
  if (ours.interpolation != control.interpolation || ours.element_size != control.element_size ||
      !complete(sides, ours, our_values, far_values))
    return incomparable(quantity, tolerance);

  const double scale = primvar_scale(control, sides.pace);
  DeviationMeter meter = sides.meter(quantity, scale, tolerance);
  const std::size_t width = control.element_size;
  for_each_value(sides, ours, far, [&](const Site& site, Index far_vertex, Index v, Index f) {
    const char* objection = limit && far_vertex != kNoIndex
                                ? limit_objection(sides.far.vertices[far_vertex], sides.far.scheme)
                                : nullptr;
    if (limit && sides.far.scheme == FarScheme::bilinear &&
        !std::ranges::equal(far_values.subspan(f * width, width),
                            std::span(far.values).subspan(f * width, width)))
      objection = kMovedSeams;
    if (!far.torn_faces.empty() && far.torn_faces[site.place.face] != 0) objection = kTorn;
    if (objection != nullptr) return meter.except(objection);
    sides.pace.spend(width);
    meter.add(largest_difference(&our_values[v * width], &far_values[f * width], control.element_size, scale),
              site);
  });
  return meter.finish();
}

}  // namespace

template <class Real>
LevelReport compare(const ControlMesh& mesh, const RefinedMesh<Real>& ours, const FarLevel<Real>& far,
                    const Pace& pace) {
  const Correspondence pairs = match(connectivity_of(ours, pace), far, pace);
  Sides<Real> sides{mesh, ours, far, pairs, point_scale(mesh.points, 3, pace), pace, value_tolerance<Real>()};
  if (sharpness_rounds(mesh, pace))
    sides.value_tolerance = std::max(sides.value_tolerance, kSharpnessRounding);
  LevelReport report;
  report.level = far.level;
  report.connectivity_identical = pairs.identical;
  report.vertices = ours.provenance.size();
  report.faces = ours.base_faces.size();
  report.deviations.push_back(compare_points<Real>(sides, "points", ours.points, far.points, false));
  if (!ours.limit_points.empty())
    report.deviations.push_back(
        compare_points<Real>(sides, "limitPoints", ours.limit_points, far.limit_points, true));
  if (!ours.normals.empty()) report.deviations.push_back(compare_normals(sides));
  for (std::size_t p = 0; p < mesh.primvars.size(); ++p) {
    report.deviations.push_back(compare_primvar(sides, p, false));
    if (!far.primvars[p].limit_values.empty()) report.deviations.push_back(compare_primvar(sides, p, true));
  }
  return report;
}

template LevelReport compare(const ControlMesh&, const RefinedMesh<float>&, const FarLevel<float>&,
                             const Pace&);
template LevelReport compare(const ControlMesh&, const RefinedMesh<double>&, const FarLevel<double>&,
                             const Pace&);

}  // namespace subdivd::oracle
