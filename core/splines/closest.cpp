#include "core/splines/closest.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/splines/bezier.h"
#include "core/splines/bounds.h"
#include "core/splines/bspline.h"
#include "core/splines/growing_memory.h"
#include "core/splines/piece_store.h"

namespace subdivd {
namespace {

// Two distances that differ by less count as equal, in the unit of the larger of extent and distance. Far
// above the rounding of a bound (4 p roundings), well below the 1e-12 that are promised.
constexpr double kTie = 0x1p-43;

// --- Local coordinates ------------------------------------------------------------------------------------

// The curve about the point asked about, in a unit that neither of them exceeds.
struct Scene {
  Spline spline;  // homogeneous points of C - q; the weights as they are
  std::vector<double> product_weights;
};

// The point in the curve's local coordinates, times 2^-shift.
Result<Scene> scene_of(const Spline& spline, std::span<const double> point, const Budget& budget) {
  Result<LocalSpline> local = to_local_coordinates(spline, budget);
  if (!local) return local.error();
  const Index dimension = spline.dimension();
  // The difference of two doubles may outgrow one; half of it does not.
  std::vector<double> half(dimension);
  double largest = 0;
  for (Index k = 0; k < dimension; ++k) {
    half[k] = point[k] / 2 - local->centre[k] / 2;
    largest = std::max(largest, std::abs(half[k]));
  }
  int exponent = local->exponent;
  const bool point_like = local->control.low == local->control.high;
  if (largest > 0 && (point_like || std::ilogb(largest) + 2 > exponent)) exponent = std::ilogb(largest) + 2;
  Scene scene{std::move(local->spline), product_weights(spline.degree)};
  std::vector<double>& stored = scene.spline.points;
  const auto moved = stoppable(budget, [&](const Pace& pace) {
    for (Count i = 0; i < stored.size(); i += spline.width) {
      pace.spend(2 * Count{dimension});
      for (Index k = 0; k < dimension; ++k) {
        const double weight = spline.rational ? stored[i + dimension] : 1;
        const double away = std::ldexp(half[k], 1 - exponent);
        stored[i + k] = std::fma(-weight, away, std::ldexp(stored[i + k], local->exponent - exponent));
      }
    }
  });
  if (!moved) return moved.error();
  return scene;
}

// --- Pieces and their bounds ------------------------------------------------------------------------------

struct Candidate {
  double bound;     // no point of the piece is closer, as a square
  double distance;  // of the nearer of its ends
  double parameter;
  double begin, end;
  Count number;  // of the curve's pieces, or in the store
  bool stored;
  // For a heap whose front has the least bound; of equal ones the first on the curve.
  bool operator<(const Candidate& other) const {
    return bound != other.bound ? bound > other.bound : begin > other.begin;
  }
};

// What distances of the size of the scene may be off.
double rounding_of(const Spline& spline) { return 8 * (spline.degree + 1) * kRoundoff; }

double square_of(std::span<const double> stored, bool rational) {
  double square = 0;
  for (Count k = 0; k < stored.size() - (rational ? 1 : 0); ++k) {
    const double x = stored[k] / (rational ? stored.back() : 1);
    square += x * x;
  }
  return square;
}

// min_k n_k / v_k with n = |A|^2 and v = w^2 in the Bernstein basis of degree 2p: n >= bound v holds for
// coefficients, so it holds for the functions. Less the rounding of n_k: sums of products that may cancel.
double least_square(const Scene& scene, std::span<const double> points) {
  const Spline& spline = scene.spline;
  const Count p = spline.degree, dimension = spline.dimension(), width = spline.width;
  double least = HUGE_VAL;
  for (Count k = 0; k <= 2 * p; ++k) {
    double n = 0, v = 0, size = 0;
    // Both orders of a pair at once.
    for (Count i = k > p ? k - p : 0; 2 * i <= k; ++i) {
      const Count j = k - i;
      const double* a = &points[i * width];
      const double* b = &points[j * width];
      const double factor = scene.product_weights[i * (p + 1) + j] * (i == j ? 1 : 2);
      for (Count x = 0; x < dimension; ++x) {
        n += factor * (a[x] * b[x]);
        size += factor * std::abs(a[x] * b[x]);
      }
      v += factor * (spline.rational ? a[dimension] * b[dimension] : 1);
    }
    n -= static_cast<double>(4 * (p + dimension)) * kRoundoff * size;
    least = std::min(least, n / v);
  }
  return least;
}

// Of a piece over [begin, end] with the control points `points`; its number is not filled in.
Candidate candidate_of(const Scene& scene, double begin, double end, std::span<const double> points) {
  const Spline& spline = scene.spline;
  const double at_begin = std::sqrt(square_of(points.first(spline.width), spline.rational));
  const double at_end = std::sqrt(square_of(points.last(spline.width), spline.rational));
  // Equally far but for rounding: the first one.
  const bool nearer_end = at_end < at_begin * (1 - rounding_of(spline));
  const double bound = least_square(scene, points);
  return {bound, nearer_end ? at_end : at_begin, nearer_end ? end : begin, begin, end, 0, false};
}

// --- The search -------------------------------------------------------------------------------------------

struct Found {
  double distance = HUGE_VAL;
  std::vector<Candidate> pieces;  // none holds a point closer than its end by more than a tie; any order
};

// Whether the piece may hold a point at that distance or closer.
bool reaches(const Candidate& candidate, double distance) { return candidate.bound <= distance * distance; }

bool divisible(const Candidate& piece) {
  const double middle = piece.begin + (piece.end - piece.begin) / 2;
  return piece.begin < middle && middle < piece.end;
}

class Search {
 public:
  Search(const Scene& scene, const BezierPieces& pieces, const Budget& budget, const Pace& pace)
      : scene_(scene),
        pieces_(pieces),
        pace_(pace),
        width_(scene.spline.width),
        steps_((Count{scene.spline.degree} + 1) * (Count{scene.spline.degree} + 1) * width_),
        memory_(budget, sizeof(Candidate) + PieceStore::kBytes,
                kBytesPerBlock + (Count{scene.spline.degree} + 1) * width_ * sizeof(double)) {}

  Result<Found> run() {
    for (Count i = 0; i < pieces_.size(); ++i) {
      pace_.spend(steps_);
      if (auto taken = hold(1); !taken) return taken.error();
      Candidate candidate = candidate_of(scene_, pieces_.begin(i), pieces_.end(i), pieces_.points(i));
      candidate.number = i;
      if (wanted(candidate)) put(candidate);
    }
    for (Count halved = 0; !heap_.empty(); ++halved) {
      pace_.spend(3 * steps_);
      std::pop_heap(heap_.begin(), heap_.end());
      const Candidate candidate = heap_.back();
      heap_.pop_back();
      if (!reaches(candidate, found_.distance + kTie)) break;  // nor does any behind it
      if (2 * halved > kMaxClosestPieces)
        return Error{.code = ErrorCode::too_large,
                     .message = "finding the closest point takes more than " +
                                std::to_string(kMaxClosestPieces) +
                                " pieces: too much of the curve is equally far from the point",
                     .where = {"point"},
                     .predicted = 2 * halved,
                     .allowed = kMaxClosestPieces};
      if (auto taken = hold(2); !taken) return taken.error();
      const BezierPiece piece = candidate.stored ? store_.take(candidate.number) : pieces_[candidate.number];
      for (BezierPiece& half : halves(piece, width_)) {
        Candidate next = candidate_of(scene_, half.begin, half.end, half.points);
        if (!wanted(next)) continue;
        next.number = store_.keep(std::move(half), pace_);
        next.stored = true;
        put(next);
      }
    }
    return std::move(found_);
  }

 private:
  Result<void> hold(Count more) { return memory_.hold(heap_.size() + found_.pieces.size() + more); }

  // Whether it must be halved; what is settled is kept at once.
  bool wanted(const Candidate& candidate) {
    found_.distance = std::min(found_.distance, candidate.distance);
    if (!reaches(candidate, found_.distance + kTie)) return false;
    // Halving would not find anything closer by more than a tie.
    const bool settled =
        candidate.distance <= kTie || !reaches(candidate, candidate.distance - kTie) || !divisible(candidate);
    if (!settled) return true;
    pace_.make_room(found_.pieces, 1);
    found_.pieces.push_back(candidate);
    return false;
  }

  void put(const Candidate& candidate) {
    pace_.make_room(heap_, 1);
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  const Scene& scene_;
  const BezierPieces& pieces_;
  const Pace& pace_;
  const Index width_;
  const Count steps_;  // to look at a piece
  GrowingMemory memory_;
  Found found_;
  std::vector<Candidate> heap_;
  PieceStore store_;
};

// --- The right angle --------------------------------------------------------------------------------------

// A stretch of parameters between which the distance has its first least value, and a parameter close to it.
struct Stretch {
  double begin, end, parameter;
};

// The settled pieces that are as close as the closest, from the first on as long as they follow one another;
// in it the first corner that is not farther than the closest but for rounding.
Stretch first_stretch(Found& found, double rounding, const Pace& pace) {
  std::vector<Candidate>& pieces = found.pieces;
  std::erase_if(pieces, [&](const Candidate& one) {
    pace.spend(1);
    return one.distance > found.distance + kTie;
  });
  pace.sort(pieces.begin(), pieces.end(),
            [](const Candidate& a, const Candidate& b) { return a.begin < b.begin; });
  Count count = 1;
  while (count < pieces.size() && pieces[count].begin == pieces[count - 1].end) ++count;
  double least = HUGE_VAL;
  for (Count i = 0; i < count; ++i) least = std::min(least, pieces[i].distance);
  Count i = 0;
  while (pieces[i].distance > least + rounding) ++i;
  return {pieces.front().begin, pieces[count - 1].end, pieces[i].parameter};
}

// The part of the curve that holds t, as a Bezier piece; the one before a knot where `before`.
class Slopes {
 public:
  explicit Slopes(const Scene& scene) : scene_(scene) {}

  // Cosine of the angle between C - q and the curve's direction: below 0 where going on brings it closer,
  // above 0 where going back does, 0 where that is no more than rounding.
  double at(double t, bool before) {
    const Spline& spline = scene_.spline;
    turn_to(t, before);
    std::vector<double> net = piece_.points;
    const Index width = spline.width, dimension = spline.dimension();
    const double u = (t - piece_.begin) / (piece_.end - piece_.begin);
    for (Count left = spline.degree; left > 1; --left)
      for (Count i = 0; i < left * width; ++i) net[i] = (1 - u) * net[i] + u * net[i + width];
    // The last two points of de Casteljau's triangle span the tangent, weights or not.   [Floater92]
    const double w0 = spline.rational ? net[dimension] : 1, w1 = spline.rational ? net[width + dimension] : 1;
    const double w = (1 - u) * w0 + u * w1;
    double product = 0, from = 0, direction = 0;
    for (Index k = 0; k < dimension; ++k) {
      const double a = net[k] / w0, b = net[width + k] / w1;
      const double c = ((1 - u) * net[k] + u * net[width + k]) / w;
      product += c * (b - a);
      from += c * c;
      direction += (b - a) * (b - a);
    }
    const double lengths = std::sqrt(from) * std::sqrt(direction);
    const double noise = 16 * (spline.degree + 1) * kRoundoff * (lengths + std::sqrt(from));
    return std::abs(product) <= noise ? 0 : product / lengths;
  }

 private:
  void turn_to(double t, bool before) {
    if (!piece_.points.empty() && t >= piece_.begin && t <= piece_.end &&
        (before ? t > piece_.begin : t < piece_.end))
      return;
    const Spline& spline = scene_.spline;
    Count span = find_span(spline, t);
    while (before && span > spline.degree && spline.knots[span] == t) --span;
    piece_ = bezier_pieces(window(spline, span)).front();
  }

  const Scene& scene_;
  BezierPiece piece_;
};

// Bisection for the sign of the slope, from where the distance falls to the nearest place where it rises.
double polished(const Scene& scene, const Stretch& stretch) {
  Slopes slopes(scene);
  const double t = stretch.parameter;
  double low = t, high = t;
  if (t < stretch.end && slopes.at(t, false) < 0)
    high = stretch.end;
  else if (t > stretch.begin && slopes.at(t, true) > 0)
    low = stretch.begin;
  else
    return t;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) break;
    const double slope = slopes.at(middle, false);
    if (slope == 0) return middle;
    (slope < 0 ? low : high) = middle;
  }
  return high == t ? high : low;
}

// |point - corner| without overflow on the way.
double distance_between(std::span<const double> a, std::span<const double> b) {
  double largest = 0, square = 0;
  for (Count k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] / 2 - b[k] / 2));
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  for (Count k = 0; k < a.size(); ++k) {
    const double x = std::ldexp(a[k] / 2 - b[k] / 2, -exponent);
    square += x * x;
  }
  return std::ldexp(std::sqrt(square), exponent + 1);
}

Result<ClosestPoint> point_at(const Spline& spline, double t, std::span<const double> point) {
  ClosestPoint closest{t, std::vector<double>(spline.dimension()), 0};
  if (auto done = evaluate(spline, t, closest.point); !done) return done.error();
  closest.distance = distance_between(closest.point, point);
  if (!std::isfinite(closest.distance)) return does_not_fit();
  return closest;
}

Result<void> check_point(const Spline& spline, std::span<const double> point) {
  if (point.size() != spline.dimension())
    return Error{ErrorCode::wrong_length,
                 "the point has " + std::to_string(point.size()) + " coordinates; those of the curve have " +
                     std::to_string(spline.dimension()),
                 {"point"}};
  for (Count k = 0; k < point.size(); ++k)
    if (!std::isfinite(point[k]))
      return Error{ErrorCode::not_finite,
                   "coordinate " + std::to_string(k) + " of the point is not a finite number",
                   {"point", std::uint64_t{k}}};
  return {};
}

}  // namespace

Result<ClosestPoint> closest_point(const Spline& spline, std::span<const double> point,
                                   const Budget& budget) {
  if (auto checked = check_point(spline, point); !checked) return checked.error();
  const Result<Scene> scene = scene_of(spline, point, budget);
  if (!scene) return scene.error();
  const auto pieces = bezier_pieces(scene->spline, budget);
  if (!pieces) return pieces.error();
  const Result<Stretch> stretch = stoppable(budget, [&](const Pace& pace) -> Result<Stretch> {
    Result<Found> found = Search(*scene, *pieces, budget, pace).run();
    if (!found) return found.error();
    return first_stretch(*found, rounding_of(spline), pace);
  });
  if (!stretch) return stretch.error();
  Result<ClosestPoint> rough = point_at(spline, stretch->parameter, point);
  if (!rough) return rough;
  Result<ClosestPoint> fine = point_at(spline, polished(*scene, *stretch), point);
  if (!fine) return fine;
  // At right angles but farther by more than the last bits of evaluate(): the polishing has met another
  // place.
  double size = rough->distance;
  for (const double x : rough->point) size = std::max(size, std::abs(x));
  const double rounding = rounding_of(spline) * size;
  return fine->distance <= rough->distance + rounding ? fine : rough;
}

}  // namespace subdivd
