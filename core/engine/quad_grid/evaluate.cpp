// The engine of grids of quads: core/engine/grid/evaluate.h.

#include <array>
#include <cmath>
#include <utility>

#include "core/engine/grid/evaluation.h"
#include "core/engine/quad_grid/kernels/quad_step.h"

namespace subdivd {
namespace {

// See GridEvaluation. Regular masks must be products of one along rows and the same across them, as those of bicubic
// splines are: the loops know no others.
struct QuadGrid {
  using Faces = Quads;
  template <class Real>
  using Step = kernels::QuadStep<Real>;
  template <class Real>
  using Limit = kernels::QuadLimit<Real>;
  static constexpr Split kSplit = Split::quads;

  template <class Real>
  static const kernels::QuadKernels<Real>& kernels() {
    return kernels::quad_kernels<Real>();
  }
  static Count row_scratch(Count n) { return kernels::quad_row_scratch(n); }

  template <class Real, class Scheme>
  static kernels::QuadMasks<Real> masks(const Scheme& scheme, CreaseMethod method) {
    static_assert(Scheme::regular_valence == 4);
    const std::array<float, 2> sharp{kInfiniteSharpness, kInfiniteSharpness};
    const VertexMask smooth = scheme.vertex_mask({4, method, 0, 0, {}, {}});
    const VertexMask crease = scheme.vertex_mask({1, method, 0, 0, sharp, sharp});
    // Four points of faces take mask.face / 4 of the vertex opposite: the square of what a row takes of the next point.
    const double side = std::sqrt(smooth.face / 4);
    return {.self = static_cast<Real>(1 - 2 * side),
            .side = static_cast<Real>(side),
            .middle = Real(0.5),
            .crease_self = static_cast<Real>(crease.self),
            .crease_side = static_cast<Real>(crease.crease)};
  }
  template <class Real>
  static kernels::QuadMasks<Real> linear_masks() {
    return {.self = 1, .side = 0, .middle = Real(0.5), .crease_self = 1, .crease_side = 0};
  }

  template <class Real, class Scheme>
  static void set_limit_masks(kernels::QuadLimit<Real>& limit, const Scheme& scheme) {
    const double side = std::sqrt(scheme.smooth_limit_mask(Scheme::regular_valence).face);
    const RingMask tangent = scheme.smooth_tangent_u(Scheme::regular_valence);
    limit.self = static_cast<Real>(1 - 2 * side);
    limit.side = static_cast<Real>(side);
    limit.tangent_self = static_cast<Real>(tangent.edges[0]);
    limit.tangent_side = static_cast<Real>(tangent.faces[0]);
  }
  template <class Real>
  static void set_linear_limit_masks(kernels::QuadLimit<Real>& limit) {
    limit.self = limit.tangent_self = 1;
    limit.side = limit.tangent_side = 0;
  }

  static kernels::FaceRow face_row(Count quad, Count n, bool whole_faces) {
    return {static_cast<Index>(quad / (n * n)), whole_faces ? 0 : quad % (n * n) / n};
  }
  static bool has_inside(Count n) { return n >= 2; }
};

}  // namespace

#define SUBDIVD_DEFINE(Real)                                                                                \
  template <>                                                                                               \
  Result<void> evaluate(const Net<Quads>& net, Index level, Buffer<Real>&& control, Index width,            \
                        Smoothing smoothing, const Evaluated<Real>& out, Index threads,                     \
                        const Budget& budget) {                                                             \
    return evaluate_on_grid<QuadGrid, Real>(net, level, std::move(control), width, smoothing, out, threads, \
                                            budget);                                                        \
  }
SUBDIVD_DEFINE(float)
SUBDIVD_DEFINE(double)
#undef SUBDIVD_DEFINE

}  // namespace subdivd
