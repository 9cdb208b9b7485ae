#include "core/lattice/triangles.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "core/base/pace.h"
#include "core/base/parallel.h"
#include "core/lattice/numbering.h"

namespace subdivd {
namespace {

// The corners of a face's triangles, in their order, each as the number of its point on the face.
template <Count N>
constexpr auto pattern() {
  std::array<unsigned char, 3 * N * N> pattern{};
  std::size_t at = 0;
  const auto add = [&](Count i, Count j) {
    pattern[at++] = static_cast<unsigned char>(face_point_index(N, i, j));
  };
  for_each_triangle(N, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
    add(i0, j0);
    add(i1, j1);
    add(i2, j2);
  });
  return pattern;
}

template <Count N>
void write_by_pattern(const FaceNumbers& numbers, Index* out) {
  static constexpr auto kPattern = pattern<N>();
  Index points[face_points(N)];  // all set below
  const auto set = [&](Count i, Count j, Index number) { points[face_point_index(N, i, j)] = number; };
  set(0, 0, numbers.corner[0]);
  set(N, 0, numbers.corner[1]);
  set(0, N, numbers.corner[2]);
  for (Index p = 1; p < N; ++p) {
    set(p, 0, numbers.side[0] + (p - 1) * numbers.step[0]);
    set(N - p, p, numbers.side[1] + (p - 1) * numbers.step[1]);
    set(0, N - p, numbers.side[2] + (p - 1) * numbers.step[2]);
  }
  Index inside = numbers.inside;
  for (Count j = 1; j < N; ++j)
    for (Count i = 1; i + j < N; ++i) set(i, j, inside++);
#pragma GCC unroll 192
  for (std::size_t k = 0; k < 3 * N * N; ++k) out[k] = points[kPattern[k]];
}

// Ends of row j.
Index left(const FaceNumbers& numbers, Count n, Count j) {  // side 2 runs down to corner 0
  return j == n ? numbers.corner[2] : numbers.side[2] + static_cast<Index>(n - j - 1) * numbers.step[2];
}
Index right(const FaceNumbers& numbers, Count n, Count j) {
  return j == n ? numbers.corner[2] : numbers.side[1] + static_cast<Index>(j - 1) * numbers.step[1];
}
// Row j's points are left, first, first + step, ..., right.
struct Row {
  Index left, first, step, right;
};
Row row_of(const FaceNumbers& numbers, Count n, Count j) {
  if (j == 0) return {numbers.corner[0], numbers.side[0], numbers.step[0], numbers.corner[1]};
  return {left(numbers, n, j), static_cast<Index>(numbers.inside + inner_index(n, 1, j)), 1,
          right(numbers, n, j)};
}

// Inside a row numbers follow one another, so all that is stored is a pattern that grows by one (on the
// bottom row, perhaps downwards) a square. Writes up to 3 squares too many: there is more to come of the
// face behind them, which is written later.
Index* write_squares(Index a, Index a_step, Index b, Index count, Index* out) {
  constexpr Index kRun = 4;
  using Four = Index __attribute__((vector_size(16)));
  // Which of a run's numbers stem from a, and what to add, at a_step 1.
  constexpr Index kAll = ~Index{0};
  constexpr Four kOfA[3] = {{kAll, kAll, 0, kAll}, {0, 0, kAll, kAll}, {0, kAll, 0, 0}};
  constexpr Four kOffset[6] = {{0, 1, 0, 1}, {1, 0, 1, 2}, {1, 2, 2, 1},
                               {2, 3, 2, 3}, {3, 2, 3, 4}, {3, 4, 4, 3}};
  const Index down = a_step == 1 ? 0 : kAll;
  Four at[6], grow[6];
  for (int k = 0; k < 6; ++k) {
    const Four of_a = kOfA[k % 3], negate = of_a & down;
    at[k] = (of_a & a) + (~of_a & b) + ((kOffset[k] ^ negate) - negate);
    grow[k] = (Four{kRun, kRun, kRun, kRun} ^ negate) - negate;
  }
  for (Index done = 0; done < count; done += kRun, out += 6 * kRun)
    for (int k = 0; k < 6; ++k) {
      std::memcpy(out + 4 * k, &at[k], sizeof at[k]);
      at[k] += grow[k];
    }
  return out - 6 * ((kRun - count % kRun) % kRun);
}

// Triangles between a row of m segments and the one above it: two by two, (low i, low i+1, high i) and
// (low i+1, high i+1, high i), and one more at the end.
Index* write_row(const Row& low, const Row& high, Count m, Index* out) {
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

constexpr Count kWorthSharing = 1 << 16;  // indices: starting a thread takes as long

}  // namespace

Index* TriangleWriter::write_rows(Index face, Count begin, Count end, Index* out) const {
  const FaceNumbers numbers(connectivity_, n_, face);
  Row low = row_of(numbers, n_, begin);
  for (Count j = begin; j < end; ++j) {
    pace_.spend(n_ - j);
    const Row high = row_of(numbers, n_, j + 1);
    out = write_row(low, high, n_ - j, out);
    low = high;
  }
  return out;
}

void TriangleWriter::write_more(Index face, Index* out) const {
  switch (n_) {
    case 4:
      return write_by_pattern<4>(FaceNumbers(connectivity_, n_, face), out);
    case 8:
      return write_by_pattern<8>(FaceNumbers(connectivity_, n_, face), out);
    default:
      write_rows(face, 0, n_, out);
  }
}

Result<void> write_triangles(const Connectivity<Triangles>& connectivity, Index level,
                             std::span<const unsigned char> holes, Index* out, Index threads,
                             const Budget& budget) {
  const Count per_face = 3 * segments(level) * segments(level);
  if (per_face * connectivity.face_count() < kWorthSharing) threads = 1;
  return Team::run(threads, budget, [&](Worker& worker) {
    const Pace pace(worker);
    const TriangleWriter writer(connectivity, level, pace);
    const Range share = worker.share(connectivity.face_count());
    Index* at =
        out + per_face * static_cast<Count>(std::count(
                             holes.begin(), holes.begin() + static_cast<std::ptrdiff_t>(share.begin), 0));
    constexpr Count kFacesPerPoll = 64;
    for (Count face = share.begin; face < share.end; ++face) {
      if (face % kFacesPerPoll == 0) pace.spend(kFacesPerPoll * std::min<Count>(per_face, 192) / 8);
      if (holes[face] != 0) continue;
      writer.write(static_cast<Index>(face), at);
      at += per_face;
    }
  });
}

}  // namespace subdivd
