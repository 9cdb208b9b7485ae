#include "core/lattice/provenance.h"

#include <algorithm>

#include "core/lattice/numbering.h"

namespace subdivd {

void write_provenance(const Connectivity<Triangles>& connectivity, Index level, std::span<Provenance> out,
                      const Pace& pace) {
  const Numbering numbering(connectivity, level);
  const Count n = numbering.segment_count();
  pace.for_each(connectivity.vertex_count(), [&](Index v) { out[v] = Provenance{}; });
  for (Index f = connectivity.face_count(); f-- > 0;)  // backwards: the lowest-numbered face wins
    for (Count j = 0; j <= n; ++j) {
      pace.spend(n + 1 - j);
      for (Count i = 0; i + j <= n; ++i)
        out[numbering.vertex(f, i, j)] = {f, static_cast<Index>(i), static_cast<Index>(j)};
    }
}

void write_triangle_faces(Index level, std::span<const unsigned char> holes, Index* out, const Pace& pace) {
  for (Index f = 0; f < holes.size(); ++f) {
    pace.spend(1);
    if (holes[f] != 0) continue;
    pace.in_blocks(triangles_per_face(level),
                   [&](Count begin, Count end) { out = std::fill_n(out, end - begin, f); });
  }
}

}  // namespace subdivd
