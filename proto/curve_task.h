#pragma once
// The door for everything under /v1/curves (and /v1/evaluate): a body with curves and with what is asked
// about them in, an answer out. Always JSON.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/convergence.h"
#include "core/splines/arc_length.h"
#include "core/splines/bounds.h"
#include "core/splines/closest.h"
#include "core/splines/differential.h"
#include "core/splines/flatten.h"
#include "core/surfaces/patch.h"
#include "proto/decode.h"
#include "proto/wire.h"

namespace subdivd::proto {

enum class CurveTaskKind { refine, evaluate, insert_knot, remove_knot, convert, measure };

// What convert makes of a curve; the words on the wire are nurbs, bezier, bspline, catmullRom, hermite.
enum class CurveForm { nurbs, bezier, bspline, catmull_rom, hermite };

// Members beside the curves; which of them a task takes and needs, decode_curves() sees to.
struct CurveTask {
  CurveTaskKind kind = CurveTaskKind::refine;
  // evaluate: parameter k on curve number sample_curves[k], counted over all curves of the body
  std::vector<Index> sample_curves;
  std::vector<double> sample_ts;
  // evaluate: or parameters (us[k], vs[k]) on surface number sample_surfaces[k]
  bool on_surfaces = false;
  std::vector<Index> sample_surfaces;
  std::vector<double> sample_us, sample_vs;
  Index derivatives = 0;  // orders 1 to this
  bool frames = false;
  std::vector<double> insert;                 // insert_knot
  std::optional<std::vector<double>> remove;  // remove_knot; absent: whatever can be
  // remove_knot, convert: an absolute distance; measure: of the length, relative
  std::optional<double> tolerance;
  CurveForm to = CurveForm::nurbs;              // convert
  std::optional<Index> to_degree;               // convert
  std::optional<std::array<double, 2>> range;   // convert: the part that is kept
  std::optional<std::array<double, 2>> domain;  // convert: its parameters afterwards
  bool reversed = false;                        // convert
  bool join = false;                            // convert: all curves of the body become one
  std::vector<double> closest_to;               // measure: points as wide as the curves'
  Index closest_width = 0;
  std::optional<double> flatten;       // measure: chord tolerance
  std::optional<Index> equal_lengths;  // measure: how many parameters
  std::optional<Index> convergence;    // measure: levels
};

inline constexpr Index kMostDerivatives = 32;
inline constexpr Index kMostEqualLengths = 1'000'000;

struct CurveRequest {
  RefineRequest curves;  // no meshes; surfaces where a task takes them
  CurveTask task;
};

// As decode_refine; `kind` says which members the body may have.
Result<CurveRequest> decode_curves(std::string_view body, CurveTaskKind kind, const QueryParameters& query,
                                   const Limits& limits, const Budget& budget = {});

// What evaluate found at every sample on curves.
struct CurveSamples {
  std::vector<Index> curves;
  std::vector<double> ts;
  Index order = 0;
  std::vector<Index> widths;              // coordinates at every sample
  std::vector<std::vector<double>> rows;  // per sample: point and derivatives
  bool framed = false;
  std::vector<std::optional<FrenetFrame>> frames;
  std::vector<std::optional<double>> curvatures, torsions;
};

// What evaluate found at every sample on surfaces. Derivatives of order 1 are du, dv, of order 2 duu, duv,
// dvv.
struct SurfaceSamples {
  std::vector<PatchSample<double>> samples;
};

// What measure found about one curve. Of a subdivided curve without a formula a polyline alone is known.
struct CurveMeasure {
  std::optional<ArcLength> length;
  std::optional<Box> box;
  std::vector<ClosestPoint> closest;
  std::optional<Polyline> polyline;
  std::optional<std::vector<double>> equal_parameters;
  std::optional<Convergence> convergence;
};

// Curves on knots or in another basis, with what was done to each.
struct EditedCurves {
  RefineAnswer<double> answer;
  std::vector<Count> removed;        // remove_knot, per curve
  std::vector<double> error_bounds;  // remove_knot, convert: per curve
};

Result<Payload> encode_samples(const CurveRequest& request, const CurveSamples& samples,
                               const Budget& budget = {});
Result<Payload> encode_samples(const CurveRequest& request, const SurfaceSamples& samples,
                               const Budget& budget = {});
Result<Payload> encode_measures(const CurveRequest& request, const std::vector<CurveMeasure>& measures,
                                const Budget& budget = {});
Result<Payload> encode_edited(const CurveRequest& request, EditedCurves edited, const Budget& budget = {});

}  // namespace subdivd::proto
