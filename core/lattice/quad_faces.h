#pragma once
// The index buffer of refined quads, by formula alone: as quads, or cut into triangles for renderers.

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// How a quad (a, b, c, d) is written: itself, or as (a, b, c) (a, c, d).
enum class QuadForm { quads, triangles };
inline constexpr Count indices_per_quad(QuadForm form) { return form == QuadForm::quads ? 4 : 6; }

// Writes the refined quads of one base face after the other, in the order of quads.h.
template <QuadForm kForm>
class QuadWriter {
 public:
  QuadWriter(const Connectivity<Quads>& connectivity, Index level, const Pace& pace);

  bool has_rows() const { return true; }  // which may be written one by one
  Count indices_of_row(Count = 0) const { return n_ * indices_per_quad(kForm); }
  Count indices_of_face() const { return n_ * indices_of_row(); }
  // The rows [begin, end) of a face, of n; returns where they end.
  Index* write_rows(Index face, Count begin, Count end, Index* out) const;
  Index* write(Index face, Index* out) const { return write_rows(face, 0, n_, out); }

 private:
  const Connectivity<Quads>& connectivity_;
  Count n_;
  const Pace& pace_;
};

extern template class QuadWriter<QuadForm::quads>;
extern template class QuadWriter<QuadForm::triangles>;

}  // namespace subdivd
