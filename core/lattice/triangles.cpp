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

class FaceWriter {
 public:
  FaceWriter(const Connectivity<Triangles>& connectivity, Index level, const Pace& pace)
      : connectivity_(connectivity), n_(segments(level)), pace_(pace) {}

  // Rows that are written one by one, for a face that is not written at once.
  static bool has_rows(Count n) { return n > 8; }
  static constexpr Count kRoomBehindRow = 18;  // that write_rows() may write to

  // Triangles of the rows [begin, end) of a face; returns where they end.
  Index* write_rows(Index face, Count begin, Count end, Index* out) const {
    return write_rows(FaceNumbers(connectivity_, n_, face), begin, end, out);
  }

  // Where a face has four triangles a call takes half as long as writing them.
  [[gnu::always_inline]] void write(Index face, Index* out) const {
    if (n_ == 2) return write_four(face, out);
    write_more(face, out);
  }

 private:
  [[gnu::noinline]] void write_more(Index face, Index* out) const {
    const FaceNumbers numbers(connectivity_, n_, face);
    switch (n_) {
      case 4:
        return write_by_pattern<4>(numbers, out);
      case 8:
        return write_by_pattern<8>(numbers, out);
      default:
        write_rows(numbers, 0, n_, out);
    }
  }

  // One point an edge: it makes no difference from which end they count.
  void write_four(Index face, Index* out) const {
    const Index *v = connectivity_.corner_vertices().data() + Count{3} * face,
                *e = connectivity_.half_edge_edges().data() + Count{3} * face,
                first = connectivity_.vertex_count();
    const Index four[12] = {v[0],         first + e[0], first + e[2], first + e[0],
                            first + e[1], first + e[2], first + e[0], v[1],
                            first + e[1], first + e[2], first + e[1], v[2]};
    std::memcpy(out, four, sizeof four);
  }

  template <Count N>
  static void write_by_pattern(const FaceNumbers& numbers, Index* out) {
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

  Index* write_rows(const FaceNumbers& numbers, Count begin, Count end, Index* out) const {
    Row low = row(numbers, begin);
    for (Count j = begin; j < end; ++j) {
      pace_.spend(n_ - j);
      const Row high = row(numbers, j + 1);
      out = write_row(low, high, n_ - j, out);
      low = high;
    }
    return out;
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

  const Connectivity<Triangles>& connectivity_;
  Count n_;
  const Pace& pace_;
};

constexpr Count indices_of_row(Count n, Count row) { return 3 * (2 * (n - row) - 1); }

constexpr Count kWorthSharing = 1 << 16;  // indices: starting a thread takes as long

}  // namespace

Result<void> write_triangles(const Connectivity<Triangles>& connectivity, Index level,
                             std::span<const unsigned char> holes, Index* out, Index threads,
                             const Budget& budget) {
  const Count per_face = 3 * segments(level) * segments(level);
  if (per_face * connectivity.face_count() < kWorthSharing) threads = 1;
  return Team::run(threads, budget, [&](Worker& worker) {
    const Pace pace(worker);
    FaceWriter writer(connectivity, level, pace);
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

TriangleStream::TriangleStream(std::shared_ptr<const Connectivity<Triangles>> connectivity, Index level,
                               std::span<const unsigned char> holes)
    : connectivity_(std::move(connectivity)),
      level_(level),
      holes_(holes.begin(), holes.end()),
      index_count_(3 * triangles_per_face(level) * static_cast<Count>(std::ranges::count(holes, 0))) {}

Count TriangleStream::least_room() const {
  const Count n = segments(level_);
  return FaceWriter::has_rows(n) ? indices_of_row(n, 0) + FaceWriter::kRoomBehindRow : 3 * n * n;
}

// A topology, if that is what the connectivity belongs to: corners, their edges and their places around
// vertices; ends, sides, kind and two places of every edge, with room for half as many more; two offsets of
// every vertex.
Count TriangleStream::held_bytes() const {
  if (!connectivity_) return 0;
  constexpr Count kOfFace = 36, kOfEdge = 34, kOfVertex = 16;
  return holes_.size() + kOfFace * connectivity_->face_count() + kOfEdge * connectivity_->edge_count() +
         kOfVertex * connectivity_->vertex_count();
}

Count TriangleStream::next(std::span<Index> out) {
  if (holes_.empty()) return 0;
  const Count n = segments(level_);
  const Pace unlimited;
  FaceWriter writer(*connectivity_, level_, unlimited);
  Count written = 0;
  const auto room = [&] { return out.size() - written; };
  for (; face_ < holes_.size(); ++face_) {
    if (holes_[face_] != 0) continue;
    if (!FaceWriter::has_rows(n)) {
      if (room() < 3 * n * n) break;
      writer.write(face_, &out[written]);
      written += 3 * n * n;
      continue;
    }
    Count end = row_, size = 0;
    while (end < n && room() >= size + indices_of_row(n, end) + FaceWriter::kRoomBehindRow)
      size += indices_of_row(n, end++);
    if (end > row_) writer.write_rows(face_, row_, end, &out[written]);
    written += size;
    row_ = end % n;
    if (end < n) break;
  }
  return written;
}

Result<Buffer<Index>> TriangleStream::all(Index threads, const Budget& budget) const {
  Buffer<Index> indices(index_count_);
  if (!holes_.empty())
    if (auto done = write_triangles(*connectivity_, level_, holes_, indices.data(), threads, budget); !done)
      return std::move(done).error();
  return indices;
}

}  // namespace subdivd
