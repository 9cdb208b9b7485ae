#include "core/lattice/sources.h"

#include "core/lattice/numbering.h"

namespace subdivd {

Buffer<Index> vertex_sources(const Connectivity<Triangles>& part, const Connectivity<Triangles>& whole,
                             Index first_face, Index level, std::span<const unsigned char> holes,
                             const Pace& pace) {
  const Count n = segments(level);
  Buffer<Index> sources;
  pace.fill(sources, Numbering(part, level).vertex_count(), kNoIndex);
  for (Index face = 0; face < part.face_count(); ++face) {
    pace.spend(3 * n);
    if (holes[face] != 0) continue;
    const FaceNumbers to(part, n, face), from(whole, n, first_face + face);
    for (int k = 0; k < 3; ++k) {
      sources[to.corner[k]] = from.corner[k];
      for (Index p = 0; p + 1 < n; ++p)
        sources[static_cast<Index>(to.side[k] + p * to.step[k])] = from.side[k] + p * from.step[k];
    }
    pace.for_each(inner_points(n),
                  [&](Count p) { sources[to.inside + p] = static_cast<Index>(from.inside + p); });
  }
  return sources;
}

}  // namespace subdivd
