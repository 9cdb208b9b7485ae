#include "proto/gltf/floats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/base/pace.h"
#include "core/base/parallel.h"

namespace subdivd::proto::gltf {
namespace {

constexpr Count kPiece = Count{1} << 14;  // tuples between two looks at the clock
// Tuples that one thread goes through while another would wake up.
constexpr Count kWorthSharing = Count{1} << 18;

Index thread_count(Count total, const Budget& budget) { return total < kWorthSharing ? 1 : budget.threads(); }

// So many tuples side by side, that a loop over them fills whole vectors for any number of components.
constexpr Count kTuples = 8;

template <Index kComponents>
class Scanner {
 public:
  Scanner(bool bounds, Clamp clamp) : bounds_(bounds), clamp_(clamp) {
    least_.fill(std::numeric_limits<float>::infinity());
    most_.fill(-std::numeric_limits<float>::infinity());
  }

  void scan(std::span<float> values) {
    if (clamp_ == Clamp::unit)
      for (float& value : values) value = std::clamp(value, 0.0f, 1.0f);
    look_for_infinite(values);
    if (bounds_) widen(values);
  }
  bool finite() const { return any_ == 0; }
  void add_to(FloatScan& scan) const {
    scan.finite &= finite();
    if (!bounds_) return;
    for (Index lane = 0; lane < kLanes; ++lane) {
      float& least = scan.least[lane % kComponents];
      float& most = scan.most[lane % kComponents];
      least = std::min(least, least_[lane]);
      most = std::max(most, most_[lane]);
    }
  }

 private:
  static constexpr Index kLanes = kTuples * kComponents;

  // x - x is +0 for every number, and NaN for NaN and the infinities.
  void look_for_infinite(std::span<const float> values) {
    std::uint32_t any = 0;
    for (const float value : values) any |= std::bit_cast<std::uint32_t>(value - value);
    any_ |= any;
  }
  void widen(std::span<const float> values) {
    std::array<float, kLanes> least = least_, most = most_;
    Count k = 0;
    for (; k + kLanes <= values.size(); k += kLanes)
      for (Index lane = 0; lane < kLanes; ++lane) {
        const float value = values[k + lane];
        least[lane] = value < least[lane] ? value : least[lane];
        most[lane] = value > most[lane] ? value : most[lane];
      }
    for (Index lane = 0; k < values.size(); ++k, ++lane) {
      least[lane] = std::min(least[lane], values[k]);
      most[lane] = std::max(most[lane], values[k]);
    }
    least_ = least;
    most_ = most;
  }

  bool bounds_;
  Clamp clamp_;
  std::array<float, kLanes> least_{}, most_{};
  std::uint32_t any_ = 0;
};

template <Index kComponents>
Result<FloatScan> scan(std::span<float> values, bool bounds, Clamp clamp, const Budget& budget) {
  const Count tuples = values.size() / kComponents;
  const Index threads = thread_count(tuples, budget);
  std::vector<Scanner<kComponents>> scanners(threads, {bounds, clamp});
  const auto done = Team::run(threads, budget, [&](Worker& worker) {
    const Range share = worker.share(tuples);
    for (Count begin = share.begin; begin < share.end; begin += kPiece) {
      const Count count = std::min(kPiece, share.end - begin);
      if (!worker.go_on(count)) return;
      scanners[worker.index()].scan(values.subspan(begin * kComponents, count * kComponents));
    }
  });
  if (!done) return done.error();
  FloatScan all;
  if (bounds) {
    all.least.assign(kComponents, std::numeric_limits<float>::infinity());
    all.most.assign(kComponents, -std::numeric_limits<float>::infinity());
  }
  for (const Scanner<kComponents>& scanner : scanners) scanner.add_to(all);
  // Of two zeros either may have come first: which, must not depend on the threads.
  for (std::vector<float>* bound : {&all.least, &all.most})
    for (float& value : *bound) value += 0.0f;
  return all;
}

}  // namespace

Result<FloatScan> scan_floats(std::span<float> values, Index components, bool bounds, Clamp clamp,
                              Work& work) {
  switch (components) {
    case 1:
      return scan<1>(values, bounds, clamp, work.budget());
    case 2:
      return scan<2>(values, bounds, clamp, work.budget());
    case 3:
      return scan<3>(values, bounds, clamp, work.budget());
    default:
      return scan<4>(values, bounds, clamp, work.budget());
  }
}

Result<void> in_shared_blocks(Count total, Work& work, const std::function<void(Count, Count)>& f) {
  return Team::run(thread_count(total, work.budget()), work.budget(), [&](Worker& worker) {
    const Range share = worker.share(total);
    for (Count begin = share.begin; begin < share.end; begin += kPiece) {
      const Count end = std::min(begin + kPiece, share.end);
      if (!worker.go_on(end - begin)) return;
      f(begin, end);
    }
  });
}

}  // namespace subdivd::proto::gltf
