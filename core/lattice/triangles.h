#pragma once
// The index buffer of refined triangles, by formula alone.

#include <cstring>
#include <span>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/lattice/split.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// Refined triangles of the faces whose `holes` flag is 0, in the order of split.h: 3 indices each, 3 * n^2
// per face, into `out`. `holes`: one flag per face of the connectivity. Independent of the number of threads.
Result<void> write_triangles(const Connectivity<Triangles>& connectivity, Index level,
                             std::span<const unsigned char> holes, Index* out, Index threads,
                             const Budget& budget);

// Writes the refined triangles of one base face after the other.
class TriangleWriter {
 public:
  TriangleWriter(const Connectivity<Triangles>& connectivity, Index level, const Pace& pace)
      : connectivity_(connectivity), n_(segments(level)), pace_(pace) {}

  // Whether rows are written one by one, for a face that is not written at once.
  bool has_rows() const { return n_ > 8; }
  static constexpr Count kRoomBehindRow = 18;  // that write_rows() may write to
  Count indices_of_row(Count row) const { return 3 * (2 * (n_ - row) - 1); }
  Count indices_of_face() const { return 3 * n_ * n_; }

  // Triangles of the rows [begin, end) of a face, of n; returns where they end.
  Index* write_rows(Index face, Count begin, Count end, Index* out) const;
  // Where a face has four triangles a call takes half as long as writing them.
  [[gnu::always_inline]] void write(Index face, Index* out) const {
    if (n_ == 2) return write_four(face, out);
    write_more(face, out);
  }

 private:
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
  void write_more(Index face, Index* out) const;

  const Connectivity<Triangles>& connectivity_;
  Count n_;
  const Pace& pace_;
};

}  // namespace subdivd
