#include "core/lattice/sources.h"

#include <type_traits>

#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"

namespace subdivd {
namespace {

template <class Faces>
using NumbersOf = std::conditional_t<std::is_same_v<Faces, Triangles>, FaceNumbers, QuadNumbers>;

// On grids of n segments.
template <class Faces>
void add_sources(const Connectivity<Faces>& part, const Connectivity<Faces>& whole, Index first_face, Count n,
                 std::span<const unsigned char> holes, Buffer<Index>& sources, const Pace& pace) {
  const Count inside = Faces::size == 3 ? inner_points(n) : inner_quad_points(n);
  for (Index face = 0; face < part.face_count(); ++face) {
    pace.spend(Faces::size * n);
    if (holes[face] != 0) continue;
    const NumbersOf<Faces> to(part, n, face), from(whole, n, first_face + face);
    for (Index k = 0; k < Faces::size; ++k) {
      sources[to.corner[k]] = from.corner[k];
      for (Index p = 0; p + 1 < n; ++p)
        sources[static_cast<Index>(to.side[k] + p * to.step[k])] = from.side[k] + p * from.step[k];
    }
    pace.for_each(inside, [&](Count p) { sources[to.inside + p] = static_cast<Index>(from.inside + p); });
  }
}

void add_sources_of_polygons(const Connectivity<Polygons>& part, const Connectivity<Polygons>& whole,
                             Index first_face, std::span<const unsigned char> holes, Buffer<Index>& sources,
                             const Pace& pace) {
  for (Index face = 0; face < part.face_count(); ++face) {
    const Index begin = part.faces().begin(face), size = part.faces().begin(face + 1) - begin,
                begin_whole = whole.faces().begin(first_face + face);
    pace.spend(size);
    if (holes[face] != 0) continue;
    for (Index k = 0; k < size; ++k)
      sources[part.corner_vertex(begin + k)] = whole.corner_vertex(begin_whole + k);
  }
}

}  // namespace

Buffer<Index> vertex_sources(const Lattice& part, const Lattice& whole, Index first_face, Index level,
                             std::span<const unsigned char> holes, const Pace& pace) {
  Buffer<Index> sources;
  pace.fill(sources, part.vertex_count(level), kNoIndex);
  if (part.has_triangles()) {
    add_sources(part.triangles(), whole.triangles(), first_face, segments(level), holes, sources, pace);
  } else if (!part.shared_polygons()) {
    add_sources(part.quads(), whole.quads(), first_face, segments(level), holes, sources, pace);
  } else if (level == 0) {
    add_sources_of_polygons(*part.shared_polygons(), *whole.shared_polygons(), first_face, holes, sources,
                            pace);
  } else {
    const Index first_quad = whole.shared_polygons()->faces().begin(first_face);
    add_sources(part.quads(), whole.quads(), first_quad, segments(level - 1),
                holes_of_grids(part, holes, pace), sources, pace);
  }
  return sources;
}

}  // namespace subdivd
