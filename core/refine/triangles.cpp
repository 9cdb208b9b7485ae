#include "core/refine/triangles.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "core/base/parallel.h"
#include "core/refine/numbering.h"

namespace subdivd {
namespace {

// Up to here a face's triangles are looked up in one pattern for all faces.
constexpr Count kPatternSegments = 8;

// Local numbers of a face's points: row by row, borders included.
constexpr Index local(Count n, Count i, Count j) {
  return static_cast<Index>(j * (n + 1) - j * (j - 1) / 2 + i);
}

std::vector<unsigned char> pattern_of(Count n) {
  std::vector<unsigned char> pattern;
  const auto add = [&](Count i, Count j) { pattern.push_back(static_cast<unsigned char>(local(n, i, j))); };
  for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
    add(i0, j0);
    add(i1, j1);
    add(i2, j2);
  });
  return pattern;
}

class FaceWriter {
 public:
  FaceWriter(const Topology& topology, Index level) : topology_(topology), n_(segments(level)) {
    if (n_ <= kPatternSegments) pattern_ = pattern_of(n_);
  }

  void write(Index face, Index* out) {
    const FaceNumbers numbers(topology_, n_, face);
    if (n_ == 2)
      write_four(numbers, out);
    else if (!pattern_.empty())
      write_by_pattern(numbers, out);
    else
      write_by_rows(numbers, out);
  }

 private:
  static void write_four(const FaceNumbers& numbers, Index* out) {
    const Index *v = numbers.corner, *e = numbers.side;
    const Index four[12] = {v[0], e[0], e[2], e[0], e[1], e[2], e[0], v[1], e[1], e[2], e[1], v[2]};
    std::memcpy(out, four, sizeof four);
  }

  void write_by_pattern(const FaceNumbers& numbers, Index* out) {
    std::array<Index, local(kPatternSegments, 0, kPatternSegments) + 1> points;  // NOLINT: set below
    Index inside = numbers.inside, at = 0;
    for (Count i = 0; i <= n_; ++i) points[at++] = on_bottom(numbers, i);
    for (Count j = 1; j <= n_; ++j)
      for (Count i = 0; i + j <= n_; ++i)
        points[at++] = i == 0 ? left(numbers, j) : i + j == n_ ? right(numbers, j) : inside++;
    for (const unsigned char point : pattern_) *out++ = points[point];
  }

  // Points of row j: its ends, and between them numbers that follow one another (but for the bottom row's).
  Index on_bottom(const FaceNumbers& numbers, Count i) const {
    if (i == 0) return numbers.corner[0];
    if (i == n_) return numbers.corner[1];
    return numbers.side[0] + static_cast<Index>(i - 1) * numbers.step[0];
  }
  Index left(const FaceNumbers& numbers, Count j) const {  // side 2 runs down to corner 0
    return j == n_ ? numbers.corner[2] : numbers.side[2] + static_cast<Index>(n_ - j - 1) * numbers.step[2];
  }
  Index right(const FaceNumbers& numbers, Count j) const {
    return j == n_ ? numbers.corner[2] : numbers.side[1] + static_cast<Index>(j - 1) * numbers.step[1];
  }
  // Row j's points are left, first, first + step, ..., right.
  struct Row {
    Index left, first, step, right;
  };
  Row row(const FaceNumbers& numbers, Count j) const {
    if (j == 0) return {numbers.corner[0], numbers.side[0], numbers.step[0], numbers.corner[1]};
    return {left(numbers, j), static_cast<Index>(numbers.inside + inner_index(n_, 1, j)), 1,
            right(numbers, j)};
  }

  void write_by_rows(const FaceNumbers& numbers, Index* out) {
    Row low = row(numbers, 0);
    for (Count j = 0; j < n_; ++j) {
      const Row high = row(numbers, j + 1);
      out = write_row(low, high, n_ - j, out);
      low = high;
    }
  }

  // Triangles between a row of m segments and the one above it: two by two, (low i, low i+1, high i) and
  // (low i+1, high i+1, high i), and one more at the end.
  static Index* write_row(const Row& low, const Row& high, Count m, Index* out) {
    const auto square = [&](Index l0, Index l1, Index h0, Index h1) {
      const Index six[6] = {l0, l1, h0, l1, h1, h0};
      std::memcpy(out, six, sizeof six);
      out += 6;
    };
    const auto last = static_cast<Index>(m) - 2;  // the square at the end of the row
    const Index low_last = low.first + last * low.step;
    if (m == 1) {
      out = std::copy_n(std::array{low.left, low.right, high.left}.begin(), 3, out);
      return out;
    }
    if (m == 2) {
      square(low.left, low.first, high.left, high.right);
    } else {
      square(low.left, low.first, high.left, high.first);
      out = write_squares(low.first, low.step, high.first, last - 1, out);
      square(low_last - low.step, low_last, high.first + last - 1, high.right);
    }
    return std::copy_n(std::array{low_last, low.right, high.right}.begin(), 3, out);
  }

  // Inside a row numbers follow one another, so all that is stored is a pattern that grows by one (on the
  // bottom row, perhaps downwards) a square. Writes up to 3 squares too many: there is more to come of the
  // face behind them, which is written later.
  static Index* write_squares(Index a, Index a_step, Index b, Index count, Index* out) {
    constexpr Index kRun = 4;
    using Four = Index __attribute__((vector_size(16)));
    Index first[6 * kRun], grow[6 * kRun];
    for (Index i = 0; i < kRun; ++i) {
      const Index a0 = a + i * a_step, a1 = a0 + a_step, b0 = b + i, b1 = b0 + 1;
      const Index six[6] = {a0, a1, b0, a1, b1, b0};
      const Index steps[6] = {a_step, a_step, 1, a_step, 1, 1};
      for (Index k = 0; k < 6; ++k) {
        first[6 * i + k] = six[k];
        grow[6 * i + k] = kRun * steps[k];
      }
    }
    Four pattern[6], growth[6];
    std::memcpy(pattern, first, sizeof pattern);
    std::memcpy(growth, grow, sizeof growth);
    for (Index done = 0; done < count; done += kRun, out += 6 * kRun)
      for (int k = 0; k < 6; ++k) {
        std::memcpy(out + 4 * k, &pattern[k], sizeof pattern[k]);
        pattern[k] += growth[k];
      }
    return out - 6 * ((kRun - count % kRun) % kRun);
  }

  const Topology& topology_;
  Count n_;
  std::vector<unsigned char> pattern_;
};

}  // namespace

Result<void> write_triangles(const Topology& topology, Index level, std::span<const unsigned char> holes,
                             Index* out, Index threads, const Budget& budget) {
  const Count per_face = 3 * segments(level) * segments(level);
  return Team::run(threads, budget, [&](Worker& worker) {
    FaceWriter writer(topology, level);
    const Range share = worker.share(topology.face_count());
    Index* at =
        out + per_face * static_cast<Count>(std::count(
                             holes.begin(), holes.begin() + static_cast<std::ptrdiff_t>(share.begin), 0));
    constexpr Count kFacesPerPoll = 64;
    for (Count face = share.begin; face < share.end; ++face) {
      if (face % kFacesPerPoll == 0 && !worker.go_on(kFacesPerPoll * per_face / 8)) return;
      if (holes[face] != 0) continue;
      writer.write(static_cast<Index>(face), at);
      at += per_face;
    }
  });
}

}  // namespace subdivd
