#pragma once
// What a subdivision rule does around one point in the end, as numbers: its local subdivision matrix S (the
// next ring = S times this ring), the eigenvalues of S, and the limit and tangent masks that its left
// eigenvectors are. All of it is computed from the rule's own masks; nothing is typed in.
//   [DooSabin78; BallStorry88; Reif95]

#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/eigen.h"
#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/schemes/all.h"

namespace subdivd {

inline constexpr Index kMaxSpectrumValence = 128;
inline constexpr Index kMaxSpectrumDegree = 15;

struct Spectrum {
  std::string scheme;
  Index valence = 2;  // edges at the point; 2 on curves
  // Of rows and columns: "c[-2]", ...; "v", "e0", ..., and where faces are quads "f0", ...: the vertex opposite to v in
  // the face between e0 and e1, and so on.
  std::vector<std::string> labels;
  std::vector<double> matrix;  // row major, labels.size() rows
  // By magnitude, descending, each as often as it is a root of the characteristic polynomial.
  std::vector<double> eigenvalues;
  Index defect = 0;  // rows less independent eigenvectors: 1 for each Jordan block of two rows

  // One weight per label. Limit weights sum to 1, tangent weights to 0.
  std::vector<double> limit_mask;
  // Curves: one, the derivative by the control parameter (label c[j] stands at j, or j - 1/2 around a span).
  // Smooth vertices: two, with weights cos and sin of the angles of the edges but for rounding: the first has
  // weight 1 at e0, the second 0 at e0 and more at e1, and both are equally long. Their cross product points
  // outwards. Border vertices: along the border, +1/2 at e0 and -1/2 at the last edge; across, into the
  // surface, with a sum of 1 over the inner edges (valence 2: the two border edges).
  std::vector<std::vector<double>> tangent_masks;

  double subdominant = 0;     // the largest eigenvalue below 1
  double subsubdominant = 0;  // the largest below that one; 0 where there is none
  // subsubdominant / subdominant^2: curvature stays bounded up to 1, vanishes below, grows without bound
  // above.
  double curvature_ratio = 0;
  // Steps that bring the control polygon or net around the point ten times closer together.
  double steps_per_digit = 0;
};

// The one-ring of a smooth inner vertex: rows v, e0, ..., e(n-1), counter-clockwise, f0, ... where faces are quads.
// Valence 3 to kMaxSpectrumValence (out_of_range at {"valence"}). With Loop's masks farther rings would add eigenvalues
// 1/8 and 1/16 only, which are subsubdominant at valence 3 alone: there the true one is 1/8, not this ring's
// 1/16.
Result<Spectrum> smooth_spectrum(const AnyGridScheme& scheme, Index valence, const Budget& budget);

// The same for a border vertex of 2 to kMaxSpectrumValence edges, e0 and e(n-1) on the border, which is also
// each side of a crease. Loop's tangents belong to 1/2 (along) and to 3/8 + cos(pi / (n-1)) / 4, or 1/4 at valence 2
// (across). From valence 8 on 3/8 + cos(2 pi / (n-1)) / 4 is above 1/2: the two are not the two largest below
// 1 any more, which is a known weakness of the rule.   [Biermann00]
Result<Spectrum> border_spectrum(const AnyGridScheme& scheme, Index valence, const Budget& budget);

// B-splines of degree p, 1 to kMaxSpectrumDegree (out_of_range at {"degree"}), around a control point (p odd)
// or around the middle of a span, between c[0] and c[1] (p even): p + 2 points. Masks binom(p+1, i) / 2^p;
// eigenvalues 1, 1/2, ..., 1/2^p and 1/2^p once more.   [LaneRiesenfeld80]
Result<Spectrum> lane_riesenfeld_spectrum(Index degree, const Budget& budget);

// The interpolating four-point rule, new points (1/2 + w)(c_0 + c_1) - w (c_{-1} + c_2), around a control
// point: 5 points, eigenvalues 1, 1/2, 2w, 1/4 +- sqrt(1/16 - w). At w = 1/16 those two are one with one
// eigenvector (defect 1), beyond they are complex. Tension w 0 to 1/16: not_finite, out_of_range below,
// unsupported above, at {"tension"}.   [DynGregoryLevin87]
Result<Spectrum> four_point_spectrum(double tension, const Budget& budget);

// --- By name ----------------------------------------------------------------------------------------------

struct SchemeParameter {
  std::string name;
  std::string type;                     // "integer", "number", "boolean" or "word"
  double least = 0, most = 0;           // of numbers
  double standard = 0;                  // of numbers and booleans
  std::vector<std::string> words = {};  // of words, the first being the standard
};

struct SchemeInfo {
  std::string name, kind;  // kind: "surface" or "curve"
  std::vector<SchemeParameter> parameters;
};

// All schemes that spectrum() knows, surfaces first.
std::vector<SchemeInfo> list_of_schemes();

// A scheme of the list and its parameters; those it does not have are not looked at.
struct SchemeChoice {
  std::string name;
  AllSchemes schemes = {};  // the options of surfaces' schemes
  Index valence = 6;
  bool border = false;
  Index degree = 3;
  double tension = 1.0 / 16;
};

// Sets a parameter of type "word" to the word of that number.
void set_word(SchemeChoice& choice, std::string_view parameter, std::size_t word);

// The spectrum of that scheme. Fails as its own function does, with bad_enum at {"scheme"} for a name that is not in
// the list, and with unsupported there for a scheme that sees further than a ring.
Result<Spectrum> spectrum(const SchemeChoice& choice, const Budget& budget);

}  // namespace subdivd
