#include "core/analysis/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/control_mesh.h"
#include "core/mesh/rings.h"

namespace subdivd {
namespace {

using Row = std::vector<double>;

constexpr std::string_view kLaneRiesenfeld = "bspline", kFourPoint = "fourPoint";

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

void scale(Row& row, double factor) {
  for (double& x : row) x *= factor;
}

void subtract(Row& row, double factor, const Row& other) {
  for (std::size_t k = 0; k < row.size(); ++k) row[k] -= factor * other[k];
}

// --- What holds for every matrix --------------------------------------------------------------------------

// The left eigenvectors of a space, orthonormal.
std::vector<Row> left_vectors(const EigenSpace& space) {
  std::vector<Row> rows;
  const std::size_t n = space.left.size() / space.dimension;
  for (std::size_t begin = 0; begin < space.left.size(); begin += n) {
    Row row(space.left.begin() + static_cast<std::ptrdiff_t>(begin),
            space.left.begin() + static_cast<std::ptrdiff_t>(begin + n));
    for (int pass = 0; pass < 2; ++pass) {
      for (const Row& other : rows) subtract(row, dot(row, other), other);
      scale(row, 1 / std::sqrt(dot(row, row)));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// The part of `target` in the space of those vectors: a left eigenvector too, and whatever symmetry target
// and matrix share it has as well. So every choice among vectors of one eigenvalue is made.
Row project(const Row& target, const std::vector<Row>& vectors) {
  Row sum(target.size());
  for (const Row& vector : vectors) subtract(sum, -dot(target, vector), vector);
  return sum;
}

Error unexpected(const std::string& what) { return Error{ErrorCode::internal, what}; }

// Fills everything but the tangent masks; returns the eigenvectors for those.
Result<EigenSystem> analyse(Spectrum& s, const Budget& budget) {
  Result<EigenSystem> system = eigen_system(s.matrix, static_cast<Index>(s.labels.size()), budget);
  if (!system) return system;
  const std::vector<EigenSpace>& spaces = system->spaces;
  if (spaces.size() < 2 || spaces[0].dimension != 1 || std::abs(spaces[0].value - 1) > 1e-9)
    return unexpected("the rule has no limit: 1 is not its one largest eigenvalue");
  for (const EigenSpace& space : spaces) {
    s.eigenvalues.insert(s.eigenvalues.end(), space.multiplicity, space.value);
    s.defect += space.multiplicity - space.dimension;
  }
  s.limit_mask = spaces[0].left;
  double sum = 0;
  for (const double weight : s.limit_mask) sum += weight;
  scale(s.limit_mask, 1 / sum);
  s.subdominant = spaces[1].value;
  s.subsubdominant = spaces.size() > 2 ? spaces[2].value : 0;
  s.curvature_ratio = std::abs(s.subsubdominant) / (s.subdominant * s.subdominant);
  s.steps_per_digit = std::log(10.0) / -std::log(std::abs(s.subdominant));
  return system;
}

// --- Surfaces ---------------------------------------------------------------------------------------------

Result<void> check_valence(Index valence, Index least) {
  if (valence >= least && valence <= kMaxSpectrumValence) return {};
  return Error{ErrorCode::out_of_range,
               "the valence is " + std::to_string(valence) + "; " + std::to_string(least) + " to " +
                   std::to_string(kMaxSpectrumValence) + " are possible",
               {"valence"}};
}

// A vertex, its edges counter-clockwise, and the faces between them: as many, or one less where the ring is open.
template <class S>
class LocalRing {
 public:
  LocalRing(const S& scheme, Index edges, bool open)
      : scheme_(scheme), edges_(edges), faces_(open ? edges - 1 : edges) {
    spectrum_.scheme = S::name;
    spectrum_.valence = edges;
    spectrum_.labels = {"v"};
    for (Index k = 0; k < edges; ++k) spectrum_.labels.push_back("e" + std::to_string(k));
    for (Index k = 0; kHasFacePoints && k < faces_; ++k) spectrum_.labels.push_back("f" + std::to_string(k));
    size_ = spectrum_.labels.size();
    spectrum_.matrix.resize(size_ * size_);
  }

  // With all masks of the rule; `sharpness`: of every edge, 0 or infinite.
  Spectrum with_matrix(const std::vector<float>& sharpness) {
    set_vertex_row(scheme_.vertex_mask({faces_, CreaseMethod::uniform, 0, 0, sharpness, sharpness}));
    for (Index k = 0; k < edges_; ++k) set_edge_row(k, sharpness[k]);
    for (Index k = 0; kHasFacePoints && k < faces_; ++k) add_face_point(row(1 + edges_ + k), k, 1);
    return std::move(spectrum_);
  }

 private:
  // Where faces are quads the point of a face takes the place of the vertex opposite to v.
  static constexpr bool kHasFacePoints = S::split == Split::quads;

  double* row(Index number) { return &spectrum_.matrix[number * size_]; }
  void add_face_point(double* to, Index face, double weight) const {
    for (const Index corner : {Index{0}, 1 + face, 1 + (face + 1) % edges_, 1 + edges_ + face})
      to[corner] += weight / 4;
  }
  void set_vertex_row(const VertexMask& mask) {
    double* const to = row(0);
    to[0] += mask.self;
    for (Index k = 0; k < edges_; ++k) to[1 + k] += mask.each;
    if (mask.crease != 0)
      for (const Index end : mask.crease_ends) to[1 + end] += mask.crease;
    for (Index k = 0; kHasFacePoints && mask.face != 0 && k < faces_; ++k) add_face_point(to, k, mask.face);
  }
  // The new neighbour on edge k: the edge point between v and e_k.
  void set_edge_row(Index k, float sharpness) {
    std::vector<Index> faces;
    if (k < faces_) faces.push_back(k);
    if (k > 0 || faces_ == edges_) faces.push_back((k + edges_ - 1) % edges_);
    const EdgeMask mask =
        scheme_.edge_mask({static_cast<Index>(faces.size()), sharpness, {sharpness, sharpness}});
    double* const to = row(1 + k);
    to[0] += mask.end;
    to[1 + k] += mask.end;
    for (const Index f : faces) {
      if (kHasFacePoints)
        add_face_point(to, f, mask.face);
      else
        to[1 + (f == k ? (k + 1) % edges_ : f)] += mask.opposite;
    }
  }

  S scheme_;
  Index edges_, faces_;
  std::size_t size_ = 0;
  Spectrum spectrum_;
};

// Two left eigenvectors of one eigenvalue: what cosine and sine of the edges' angles have in its space, turned so that
// e0 lies on the first one's axis and e1 on the second one's side.
std::optional<Error> set_smooth_tangents(Spectrum& s, const EigenSpace& space) {
  const std::vector<Row> plane = left_vectors(space);
  if (plane.size() < 2) return unexpected("the rule has no tangent plane: two vectors should belong to it");
  Row cosine(s.labels.size()), sine(s.labels.size());
  for (Index k = 0; k < s.valence; ++k) {
    cosine[1 + k] = std::cos(2 * std::numbers::pi * k / s.valence);
    sine[1 + k] = std::sin(2 * std::numbers::pi * k / s.valence);
  }
  Row u = project(cosine, plane), v = project(sine, plane);
  scale(u, 1 / u[1]);
  subtract(v, dot(v, u) / dot(u, u), u);
  scale(v, std::sqrt(dot(u, u) / dot(v, v)));
  s.tangent_masks = {std::move(u), std::move(v)};
  return std::nullopt;
}

// The border is a curve of its own: v and its two ends depend on nothing else, and a left eigenvector of
// their three rows is one of all rows, with zeros elsewhere.
std::optional<Error> add_tangent_along(Spectrum& s, const Budget& budget) {
  const std::size_t size = s.labels.size(), kept[] = {1, 0, s.valence};
  Row part;
  for (const std::size_t i : kept)
    for (const std::size_t j : kept) part.push_back(s.matrix[i * size + j]);
  const Result<EigenSystem> system = eigen_system(part, 3, budget);
  if (!system) return system.error();
  const Row along = project({1, 0, -1}, left_vectors(system->spaces[1]));
  Row mask(size);
  for (std::size_t k = 0; k < 3; ++k) mask[kept[k]] = along[k] / (along[0] - along[2]);
  s.tangent_masks.push_back(std::move(mask));
  return std::nullopt;
}

// The first left eigenvector behind the limit mask that is symmetric about the middle of the fan.
std::optional<Error> add_tangent_across(Spectrum& s, const EigenSystem& system) {
  const std::size_t size = s.labels.size();
  const bool inner = s.valence > 2;
  Row target(size);
  for (std::size_t k = 1; k <= s.valence; ++k) target[k] = !inner || (k > 1 && k < s.valence) ? 1 : 0;
  for (std::size_t i = 1; i < system.spaces.size(); ++i) {
    Row mask = project(target, left_vectors(system.spaces[i]));
    const double sum = dot(mask, target);
    // What is antisymmetric has no part of the target but rounding errors.
    if (sum < 1e-12 * dot(target, target)) continue;
    scale(mask, 1 / sum);
    s.tangent_masks.push_back(std::move(mask));
    return std::nullopt;
  }
  return unexpected("the border rule has no tangent across the border");
}

template <RunsOnGrids S>
Result<Spectrum> smooth_spectrum_of(const S& scheme, Index valence, const Budget& budget) {
  if (auto checked = check_valence(valence, 3); !checked) return checked.error();
  Spectrum s = LocalRing<S>(scheme, valence, false).with_matrix(std::vector<float>(valence, 0.0f));
  const Result<EigenSystem> system = analyse(s, budget);
  if (!system) return system.error();
  if (auto fault = set_smooth_tangents(s, system->spaces[1])) return *fault;
  return s;
}

template <RunsOnGrids S>
Result<Spectrum> border_spectrum_of(const S& scheme, Index valence, const Budget& budget) {
  if (auto checked = check_valence(valence, 2); !checked) return checked.error();
  std::vector<float> sharp(valence, 0.0f);
  sharp.front() = sharp.back() = kInfiniteSharpness;
  Spectrum s = LocalRing<S>(scheme, valence, true).with_matrix(sharp);
  const Result<EigenSystem> system = analyse(s, budget);
  if (!system) return system.error();
  if (auto fault = add_tangent_along(s, budget)) return *fault;
  if (auto fault = add_tangent_across(s, *system)) return *fault;
  return s;
}

}  // namespace

Result<Spectrum> smooth_spectrum(const AnyGridScheme& scheme, Index valence, const Budget& budget) {
  return std::visit([&](const auto& one) { return smooth_spectrum_of(one, valence, budget); }, scheme);
}

Result<Spectrum> border_spectrum(const AnyGridScheme& scheme, Index valence, const Budget& budget) {
  return std::visit([&](const auto& one) { return border_spectrum_of(one, valence, budget); }, scheme);
}

// --- Curves -----------------------------------------------------------------------------------------------

namespace {

double binomial(Index n, Index k) {
  double product = 1;  // every intermediate value is a binomial itself, so the divisions are exact
  for (Index i = 1; i <= k; ++i) product = product * (n - k + i) / i;
  return product;
}

// Of `points` points in a row around the parameter 0, one apart, the derivative: the tangent mask that takes
// the points' own places to 1. Where the subdominant eigenvalue is double (a polygon's corner) the one that
// is antisymmetric.
void set_derivative(Spectrum& s, const EigenSpace& space) {
  const std::size_t n = s.labels.size();
  Row places(n);
  for (std::size_t k = 0; k < n; ++k) places[k] = static_cast<double>(k) - static_cast<double>(n - 1) / 2;
  Row mask = project(places, left_vectors(space));
  scale(mask, 1 / dot(mask, places));
  s.tangent_masks = {std::move(mask)};
}

Spectrum points_in_a_row(std::string_view scheme, Index count) {
  Spectrum s;
  s.scheme = scheme;
  for (Index k = 0; k < count; ++k)
    s.labels.push_back("c[" + std::to_string(static_cast<int>(k) - static_cast<int>((count - 1) / 2)) + "]");
  s.matrix.resize(std::size_t{count} * count);
  return s;
}

}  // namespace

// Old point k stands at k - (p + 1) / 2, a span being 1, and new point j at half of j - (p + 1) / 2. Entry i
// of the mask leads from an old point to the new one (i - (p + 1) / 2) / 2 away from it, so i = j - 2 k + p
// + 1.
Result<Spectrum> lane_riesenfeld_spectrum(Index degree, const Budget& budget) {
  if (degree < 1 || degree > kMaxSpectrumDegree)
    return Error{ErrorCode::out_of_range,
                 "the degree is " + std::to_string(degree) + "; 1 to " + std::to_string(kMaxSpectrumDegree) +
                     " are possible",
                 {"degree"}};
  const Index p = degree, n = p + 2;
  Spectrum s = points_in_a_row(kLaneRiesenfeld, n);
  for (Index j = 0; j < n; ++j)
    for (Index k = 0; k < n; ++k)
      if (2 * k <= j + p + 1 && j <= 2 * k)
        s.matrix[j * n + k] = std::ldexp(binomial(p + 1, j + p + 1 - 2 * k), -static_cast<int>(p));
  const Result<EigenSystem> system = analyse(s, budget);
  if (!system) return system.error();
  set_derivative(s, system->spaces[1]);
  return s;
}

Result<Spectrum> four_point_spectrum(double tension, const Budget& budget) {
  const double w = tension;
  if (!std::isfinite(w)) return Error{ErrorCode::not_finite, "the tension is not finite", {"tension"}};
  if (w < 0)
    return Error{ErrorCode::out_of_range,
                 "the tension is " + std::to_string(w) + "; 0 to 1/16 are possible",
                 {"tension"}};
  if (w > 1.0 / 16)
    return Error{
        ErrorCode::unsupported,
        "the tension is " + std::to_string(w) +
            ", and beyond 1/16 two eigenvalues are complex, which is not supported: choose 0 to 1/16",
        {"tension"}};
  Spectrum s = points_in_a_row(kFourPoint, 5);
  // New points -2 to 2: old ones at the even places, between them the mask.
  const double near = 1.0 / 2 + w;
  s.matrix = {0,  1,    0,    0,    0,   //
              -w, near, near, -w,   0,   //
              0,  0,    1,    0,    0,   //
              0,  -w,   near, near, -w,  //
              0,  0,    0,    1,    0};
  const Result<EigenSystem> system = analyse(s, budget);
  if (!system) return system.error();
  set_derivative(s, system->spaces[1]);
  return s;
}

// --- By name ----------------------------------------------------------------------------------------------

namespace {

template <RunsOnGrids S>
SchemeInfo info_of() {
  SchemeInfo info{std::string(S::name), "surface", {}};
  for (const SchemeOption<S>& option : S::options())
    info.parameters.push_back({.name = std::string(option.short_name),
                               .type = "word",
                               .words = std::vector<std::string>(option.words.begin(), option.words.end())});
  info.parameters.push_back({.name = "valence",
                             .type = "integer",
                             .least = 3,
                             .most = kMaxSpectrumValence,
                             .standard = S::regular_valence});
  info.parameters.push_back({.name = "border", .type = "boolean", .most = 1});
  return info;
}

}  // namespace

std::vector<SchemeInfo> list_of_schemes() {
  std::vector<SchemeInfo> list;
  for_each_scheme(AllSchemes(), [&]<class S>(const S&) {
    if constexpr (RunsOnGrids<S>) list.push_back(info_of<S>());
  });
  list.push_back(
      {std::string(kLaneRiesenfeld),
       "curve",
       {{.name = "degree", .type = "integer", .least = 1, .most = kMaxSpectrumDegree, .standard = 3}}});
  list.push_back({std::string(kFourPoint),
                  "curve",
                  {{.name = "tension", .type = "number", .most = 1.0 / 16, .standard = 1.0 / 16}}});
  return list;
}

void set_word(SchemeChoice& choice, std::string_view parameter, std::size_t word) {
  for_each_scheme(choice.schemes, [&]<class S>(S& scheme) {
    if (S::name != choice.name) return;
    for (const SchemeOption<S>& option : S::options())
      if (option.short_name == parameter) option.set(scheme, word);
  });
}

Result<Spectrum> spectrum(const SchemeChoice& choice, const Budget& budget) {
  if (const auto scheme = find_scheme(choice.name, choice.schemes)) {
    const auto on_grids = as_one_of<AnyGridScheme>(*scheme);
    if (!on_grids)
      return Error{ErrorCode::unsupported,
                   "no spectrum of this scheme is computed yet: its masks see further than a ring",
                   {"scheme"}};
    return choice.border ? border_spectrum(*on_grids, choice.valence, budget)
                         : smooth_spectrum(*on_grids, choice.valence, budget);
  }
  if (choice.name == kLaneRiesenfeld) return lane_riesenfeld_spectrum(choice.degree, budget);
  if (choice.name == kFourPoint) return four_point_spectrum(choice.tension, budget);
  std::string known;
  for (const SchemeInfo& scheme : list_of_schemes()) known += (known.empty() ? "" : ", ") + scheme.name;
  return Error{
      ErrorCode::bad_enum, "there is no scheme \"" + choice.name + "\"; there are " + known, {"scheme"}};
}

}  // namespace subdivd
