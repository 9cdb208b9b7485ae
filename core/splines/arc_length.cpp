#include "core/splines/arc_length.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/splines/bounds.h"
#include "core/splines/growing_memory.h"
#include "core/splines/measurement.h"
#include "core/splines/speed_piece.h"

namespace subdivd {
namespace {

// --- A curve in measured pieces ---------------------------------------------------------------------------

struct Measured {
  double begin, end;  // as of a SpeedPiece, whose numbers stand in a store
  double width;
  Index level;
  double* numbers;
  Interval length;
  // Of a heap whose front gains most by halving; the parameter makes the order unique.
  bool operator<(const Measured& other) const {
    const double mine = length.gain(), others = other.length.gain();
    return mine != others ? mine < others : begin > other.begin;
  }
};

// The numbers of speed pieces, in large blocks: millions of small arrays would take long to be given back.
class NumberStore {
 public:
  explicit NumberStore(const Spline& spline)
      : rows_(Count{spline.rational ? 2 * spline.degree - 1 : spline.degree} *
              (spline.dimension() + Count{1})),
        weights_(spline.rational ? spline.degree + Count{1} : 0) {}

  // For `pieces` more at once.
  void make_room(Count pieces) {
    blocks_.push_back(std::make_unique_for_overwrite<double[]>(pieces * (rows_ + weights_)));
    next_ = blocks_.back().get();
    room_ = pieces;
  }
  // In the place of what is not needed any more, or in a new one.
  Measured put(const SpeedPiece& piece, double* place = nullptr) {
    if (place == nullptr) {
      if (room_ == 0) make_room(std::clamp<Count>(kBlock / (rows_ + weights_), 1, kMostInBlock));
      place = next_;
      next_ += rows_ + weights_;
      --room_;
    }
    std::copy_n(piece.derivative.points.data(), rows_, place);
    std::copy_n(piece.weight.points.data(), weights_, place + rows_);
    return {piece.derivative.begin, piece.derivative.end, piece.width, piece.level, place, {}};
  }
  void get(const Measured& one, SpeedPiece& piece) const {
    piece.derivative.begin = piece.weight.begin = one.begin;
    piece.derivative.end = piece.weight.end = one.end;
    piece.derivative.points.assign(one.numbers, one.numbers + rows_);
    piece.weight.points.assign(one.numbers + rows_, one.numbers + rows_ + weights_);
    piece.width = one.width;
    piece.level = one.level;
  }

 private:
  static constexpr Count kBlock = 4096, kMostInBlock = 64;
  Count rows_, weights_;
  std::vector<std::unique_ptr<double[]>> blocks_;
  double* next_ = nullptr;
  Count room_ = 0;
};

// Of N, of dimension + 1 scalars, and of the weights: two blocks.
Count bytes_elsewhere(const Spline& spline) {
  const Count p = spline.degree, rows = spline.rational ? 2 * p - 1 : p;
  return 2 * kBytesPerBlock + (rows * (spline.dimension() + Count{1}) + p + 1) * sizeof(double);
}

constexpr Count kStepsOfPiece = 200;  // at least

struct Survey {
  NumberStore numbers;
  std::vector<Measured> pieces{};  // a heap, until put in order
  int exponent = 0;                // lengths are times 2^exponent
  double length = 0, bound = 0;
};

void add_up(Survey& survey, const Pace& pace) {
  survey.length = survey.bound = 0;
  pace.for_each(survey.pieces.size(), [&](Count i) {
    const Interval& length = survey.pieces[i].length;
    survey.length += length.middle();
    survey.bound += length.half() + length.rounding;
  });
  survey.bound += static_cast<double>(survey.pieces.size()) * kRoundoff * (survey.length + survey.bound);
}

// The spans between a and b as they are, each in coordinates of its own, so that rounding is relative to it.
Result<Survey> first_survey(const Spline& spline, const Ruler& ruler, double a, double b,
                            const Budget& budget, const Pace& pace) {
  Survey survey{.numbers = NumberStore(spline)};
  std::vector<int> exponents;
  const Count first = find_span(spline, a), last = find_span(spline, b);
  const Count each = sizeof(Measured) + sizeof(int) + bytes_elsewhere(spline);
  if (auto taken = budget.take_memory((last - first + 1) * each); !taken) return taken.error();
  survey.pieces.reserve(last - first + 1);
  survey.numbers.make_room(last - first + 1);
  exponents.reserve(last - first + 1);
  for (Count span = first; span <= last; ++span) {
    pace.spend(1);
    const double begin = spline.knots[span], end = spline.knots[span + 1];
    const double from = std::max(a, begin), to = std::min(b, end);
    if (!(from < to)) continue;
    pace.spend(kStepsOfPiece);
    const Result<LocalSpline> local = to_local_coordinates(window(spline, span));
    if (!local) return local.error();
    SpeedPiece piece = ruler.piece_of(*local);
    if (from > begin || to < end) {
      piece = ruler.part(piece, (from - begin) / (end - begin), (to - begin) / (end - begin));
      piece.derivative.begin = from;
      piece.derivative.end = to;
      piece.width = (to - from) / (end - begin);
    }
    survey.pieces.push_back(survey.numbers.put(piece));
    exponents.push_back(local->exponent);
  }
  if (exponents.empty()) return survey;
  survey.exponent = *std::ranges::max_element(exponents);
  SpeedPiece piece;
  for (Count i = 0; i < exponents.size(); ++i) {
    pace.spend(kStepsOfPiece);
    Measured& one = survey.pieces[i];
    one.width = std::ldexp(one.width, exponents[i] - survey.exponent);
    survey.numbers.get(one, piece);
    one.length = ruler.measure(piece);
  }
  return survey;
}

Error not_reached(const Survey& survey, const LengthOptions& options, bool by_rounding) {
  const double reached = survey.bound / survey.length;
  std::string message = "the length is known to " + (std::isfinite(reached) ? brief(reached) : "no part") +
                        " of itself after " + std::to_string(survey.pieces.size()) + " pieces, ";
  message += by_rounding ? "and rounding allows no better"
                         : "and " + std::to_string(options.max_pieces) + " pieces are allowed";
  message += "; a tolerance of " + brief(options.tolerance) + " was asked for: choose a larger one";
  Error error = refusal(by_rounding ? ErrorCode::out_of_range : ErrorCode::too_large, std::move(message),
                        {"tolerance"});
  if (!by_rounding) {
    error.predicted = survey.pieces.size() + 1;
    error.allowed = options.max_pieces;
  }
  return error;
}

Result<Survey> survey_of(const Spline& spline, const Ruler& ruler, double a, double b,
                         const LengthOptions& options, const Budget& budget, const Pace& pace) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    return refusal(ErrorCode::out_of_range, "the tolerance must be a finite number above 0", {"tolerance"});
  Result<Survey> surveyed = first_survey(spline, ruler, a, b, budget, pace);
  if (!surveyed) return surveyed;
  Survey& survey = *surveyed;
  std::make_heap(survey.pieces.begin(), survey.pieces.end(), [&](const Measured& one, const Measured& other) {
    pace.spend(1);
    return one < other;
  });
  add_up(survey, pace);
  const Count at_first = survey.pieces.size();
  GrowingMemory memory(budget, sizeof(Measured), bytes_elsewhere(spline));
  bool moved = false;             // growing once moves the first ones, too
  double running = survey.bound;  // kept up to date piece by piece; add_up has the last word
  Count next_sum = 0;             // rarely: not more often than there are pieces to be added up
  SpeedPiece piece;
  for (Count steps = 1;; ++steps) {
    const bool due = steps % 4096 == 0 && steps >= next_sum;
    if (due) next_sum = steps + survey.pieces.size();
    if (running <= options.tolerance * survey.length || due) {
      add_up(survey, pace);
      running = survey.bound;
      if (survey.bound <= options.tolerance * survey.length) return surveyed;
    }
    // A piece that halving no longer helps has an interval of the size of its rounding.
    const Measured old = survey.pieces.front();
    const bool by_rounding = !old.length.uneven && old.length.half() <= old.length.rounding;
    if (by_rounding || survey.pieces.size() >= options.max_pieces) {
      add_up(survey, pace);
      if (survey.bound <= options.tolerance * survey.length) return surveyed;
      return not_reached(survey, options, by_rounding);
    }
    pace.spend(2 * kStepsOfPiece);
    if (auto taken = memory.hold(survey.pieces.size() + 1 - std::min(at_first, survey.pieces.size())); !taken)
      return taken.error();
    if (!std::exchange(moved, true))
      if (auto taken = budget.take_memory(2 * at_first * sizeof(Measured)); !taken) return taken.error();
    std::pop_heap(survey.pieces.begin(), survey.pieces.end());
    survey.pieces.pop_back();
    running -= old.length.half() + old.length.rounding;
    survey.length -= old.length.middle();
    survey.numbers.get(old, piece);
    double* place = old.numbers;
    for (const SpeedPiece& half : ruler.halves(piece)) {
      Measured one = survey.numbers.put(half, std::exchange(place, nullptr));
      one.length = ruler.measure(half);
      running += one.length.half() + one.length.rounding;
      survey.length += one.length.middle();
      pace.make_room(survey.pieces, 1);
      survey.pieces.push_back(one);
      std::push_heap(survey.pieces.begin(), survey.pieces.end());
    }
  }
}

// --- Parameters -------------------------------------------------------------------------------------------

// Pieces in the order of the curve, and how long it is up to the end of each.
struct Milestones {
  Survey survey;
  std::vector<double> ends;

  Milestones(Survey made, const Pace& pace) : survey(std::move(made)) {
    pace.sort(survey.pieces.begin(), survey.pieces.end(),
              [](const Measured& one, const Measured& other) { return one.begin < other.begin; });
    double sum = 0;
    ends.reserve(survey.pieces.size());
    pace.for_each(survey.pieces.size(),
                  [&](Count i) { ends.push_back(sum += survey.pieces[i].length.middle()); });
  }
  double total() const { return ends.empty() ? 0 : ends.back(); }
};

// Newton's method for the length from the begin of a piece, `whole` long, to u, with bisection where it would
// leave what brackets the answer. The part is measured as its piece has been: its chord and polygon are
// closer together than those of the whole; that its Gauss interval is no wider either is tested, not proved.
double share_at_length(const Ruler& ruler, const SpeedPiece& piece, double whole, double length,
                       double accuracy) {
  double low = 0, high = 1, u = std::clamp(length / whole, 0.0, 1.0);
  for (int step = 0; step < 100 && low < u && u < high; ++step) {
    const SpeedPiece part = ruler.part(piece, 0, u);
    const double excess = ruler.measure(part).middle() - length;
    if (std::abs(excess) <= accuracy) return u;
    (excess > 0 ? high : low) = u;
    const double slope = piece.width * ruler.speed_at_end(part);
    const double next = u - excess / slope;
    u = next > low && next < high ? next : low / 2 + high / 2;  // also where the slope is 0
  }
  return u;
}

double parameter_at(const Ruler& ruler, const Milestones& milestones, double length) {
  const auto found = std::ranges::lower_bound(milestones.ends, length);
  const Count i =
      std::min<Count>(static_cast<Count>(found - milestones.ends.begin()), milestones.ends.size() - 1);
  const Measured& one = milestones.survey.pieces[i];
  const double rest = length - (i == 0 ? 0 : milestones.ends[i - 1]);
  if (!(rest > 0)) return one.begin;
  if (length >= milestones.ends[i]) return one.end;
  SpeedPiece piece;
  milestones.survey.numbers.get(one, piece);
  const double u =
      share_at_length(ruler, piece, one.length.middle(), rest, 4 * kRoundoff * milestones.total());
  return std::clamp(one.begin + u * (one.end - one.begin), one.begin, one.end);
}

}  // namespace

Result<ArcLength> arc_length(const Spline& spline, double a, double b, const LengthOptions& options,
                             const Budget& budget) {
  if (!(a >= spline.begin() && a <= spline.end()))
    return refusal(ErrorCode::out_of_range, "the length must be asked for from within the curve's domain",
                   {"from"});
  if (!(b >= a && b <= spline.end()))
    return refusal(
        ErrorCode::out_of_range,
        "the length must be asked for up to the same or a later parameter within the curve's domain", {"to"});
  return stoppable(budget, [&](const Pace& pace) -> Result<ArcLength> {
    const Ruler ruler(spline, pace);
    const Result<Survey> survey = survey_of(spline, ruler, a, b, options, budget, pace);
    if (!survey) return survey.error();
    const double length = std::ldexp(survey->length, survey->exponent);
    const double bound = std::ldexp(survey->bound, survey->exponent);
    if (!std::isfinite(length) || !std::isfinite(bound)) return does_not_fit();
    return ArcLength{length, bound, survey->pieces.size()};
  });
}

Result<ArcLength> arc_length(const Spline& spline, const LengthOptions& options, const Budget& budget) {
  return arc_length(spline, spline.begin(), spline.end(), options, budget);
}

Result<double> parameter_at_length(const Spline& spline, double length, const LengthOptions& options,
                                   const Budget& budget) {
  if (!std::isfinite(length))
    return refusal(ErrorCode::not_finite, "the length is not a finite number", {"length"});
  return stoppable(budget, [&](const Pace& pace) -> Result<double> {
    const Ruler ruler(spline, pace);
    Result<Survey> survey = survey_of(spline, ruler, spline.begin(), spline.end(), options, budget, pace);
    if (!survey) return survey.error();
    const double bound = survey->bound;
    const Milestones milestones(*std::move(survey), pace);
    const double wanted = std::ldexp(length, -milestones.survey.exponent);
    if (!(wanted >= 0 && wanted <= milestones.total() + bound))
      return refusal(ErrorCode::out_of_range,
                     "the length must be 0 to that of the curve, " +
                         brief(std::ldexp(milestones.total(), milestones.survey.exponent)),
                     {"length"});
    if (wanted >= milestones.total() && wanted > 0) return spline.end();
    return parameter_at(ruler, milestones, wanted);
  });
}

Result<std::vector<double>> equal_parameters(const Spline& spline, Count count, const LengthOptions& options,
                                             const Budget& budget) {
  const Count least = spline.periodic ? 1 : 2;
  if (count < least || count > kMaxIndexCount)
    return refusal(ErrorCode::out_of_range,
                   "there must be " + std::to_string(least) + " to " + std::to_string(kMaxIndexCount) +
                       " parameters; " + std::to_string(count) + " were asked for",
                   {"count"});
  if (auto allowed = budget.check_bytes(count * sizeof(double)); !allowed) return allowed.error();
  return stoppable(budget, [&](const Pace& pace) -> Result<std::vector<double>> {
    const Ruler ruler(spline, pace);
    Result<Survey> survey = survey_of(spline, ruler, spline.begin(), spline.end(), options, budget, pace);
    if (!survey) return survey.error();
    const Milestones milestones(*std::move(survey), pace);
    const double total = milestones.total(), begin = spline.begin(), end = spline.end();
    const double steps = static_cast<double>(spline.periodic ? count : count - 1);
    std::vector<double> parameters;
    parameters.reserve(count);
    for (Count i = 0; i < count; ++i) {
      pace.spend(kStepsOfPiece);
      const double share = static_cast<double>(i) / steps;
      if (i == 0)
        parameters.push_back(begin);
      else if (!spline.periodic && i + 1 == count)
        parameters.push_back(end);
      else
        parameters.push_back(total > 0 ? parameter_at(ruler, milestones, share * total)
                                       : begin + share * (end - begin));
    }
    // Neighbours closer than the accuracy may have come out in the wrong order.
    pace.for_each(count - 1,
                  [&](Count i) { parameters[i + 1] = std::max(parameters[i + 1], parameters[i]); });
    return parameters;
  });
}

}  // namespace subdivd
