#include "core/refine/linear.h"

#include <algorithm>
#include <cassert>

#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"

namespace subdivd {
namespace {

// Parts of n by which the corners of a face weigh at its grid point (i, j); both are exact in Real.
template <class Real>
void add_point(const Connectivity<Triangles>&, Count n, Count i, Count j, const Real* const* corners,
               Index width, Real* out) {
  const Real unit = Real(1) / static_cast<Real>(n);
  const Real a = static_cast<Real>(n - i - j) * unit, b = static_cast<Real>(i) * unit,
             c = static_cast<Real>(j) * unit;
  for (Index k = 0; k < width; ++k) out[k] = a * corners[0][k] + b * corners[1][k] + c * corners[2][k];
}
template <class Real>
void add_point(const Connectivity<Quads>&, Count n, Count i, Count j, const Real* const* corners, Index width,
               Real* out) {
  const Real unit = Real(1) / static_cast<Real>(n);
  const Real u = static_cast<Real>(i) * unit, v = static_cast<Real>(j) * unit;
  const Real a = (1 - u) * (1 - v), b = u * (1 - v), c = u * v, d = (1 - u) * v;
  for (Index k = 0; k < width; ++k)
    out[k] = a * corners[0][k] + b * corners[1][k] + (c * corners[2][k] + d * corners[3][k]);
}

// `row_end(j)`: one past the last i of row j.
template <class Real, class Faces, class RowEnd>
void interpolate_faces(const Connectivity<Faces>& faces, Index level, std::span<const Real> control,
                       Index width, Real* out, const Pace& pace, RowEnd&& row_end) {
  const Numbering<Faces> numbering(faces, level);
  const Count n = numbering.segment_count();
  // Backwards: the lowest-numbered face decides about what several share.
  for (Index f = faces.face_count(); f-- > 0;) {
    const Real* corners[Faces::size];
    for (Index k = 0; k < Faces::size; ++k)
      corners[k] = &control[Count{faces.corner_vertices()[Count{f} * Faces::size + k]} * width];
    for (Count j = 0; j <= n; ++j) {
      pace.spend((n + 1) * (1 + width / 4));
      for (Count i = 0; i < row_end(n, j); ++i)
        add_point(faces, n, i, j, corners, width, out + Count{numbering.vertex(f, i, j)} * width);
    }
  }
}

}  // namespace

template <class Real>
void interpolate_linearly(const Lattice& lattice, Index level, std::span<const Real> control, Index width,
                          Real* out, const Pace& pace) {
  assert(lattice.first_level() == 0);
  if (lattice.has_triangles())
    interpolate_faces(lattice.triangles(), level, control, width, out, pace,
                      [](Count n, Count j) { return n + 1 - j; });
  else
    interpolate_faces(lattice.quads(), level, control, width, out, pace,
                      [](Count n, Count) { return n + 1; });
  // Exactly, whatever a face made of them; and those of no face.
  const Count kept = Count{lattice.base_vertex_count()} * width;
  pace.in_blocks(kept,
                 [&](Count begin, Count end) { std::copy_n(&control[begin], end - begin, out + begin); });
}

template void interpolate_linearly(const Lattice&, Index, std::span<const float>, Index, float*, const Pace&);
template void interpolate_linearly(const Lattice&, Index, std::span<const double>, Index, double*,
                                   const Pace&);

}  // namespace subdivd
