#pragma once
// What refining the values of a net writes, whichever engine does it.

#include <algorithm>

#include "core/base/index.h"
#include "core/limit/limit.h"

namespace subdivd {

// Where an evaluation writes; what is null is not computed. Sizes: net.value_count(level) * width scalars.
// Limits, tangents and normals belong to the surface that refining for ever would lead to, at the refined
// vertices; tangents and normals are for width 3 only (which ones: core/limit). Tangents of a crease belong
// to the side of its lowest-numbered face.
template <class Real>
struct Evaluated {
  Real* values = nullptr;
  Real* limits = nullptr;
  Real *tangents_u = nullptr, *tangents_v = nullptr;
  Real* normals = nullptr;  // unit; (0,0,0) where the surface has none

  bool wants_frames() const { return tangents_u != nullptr || tangents_v != nullptr || normals != nullptr; }
  bool wants_limits() const { return limits != nullptr || wants_frames(); }
};

// Evaluation reads a little past the end of the control values: room for so many more spares a copy.
inline constexpr Count kSpareControl = 4;

// Writes what `out` asks for of one vertex's frames.
template <class Real>
void write_frames(const FrameMean<Real>& frames, const Evaluated<Real>& out, Count vertex) {
  if (out.tangents_u != nullptr) std::copy_n(frames.first().u, 3, out.tangents_u + 3 * vertex);
  if (out.tangents_v != nullptr) std::copy_n(frames.first().v, 3, out.tangents_v + 3 * vertex);
  if (out.normals != nullptr) frames.normal(out.normals + 3 * vertex);
}

}  // namespace subdivd
