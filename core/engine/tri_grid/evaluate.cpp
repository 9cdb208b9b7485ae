// The engine of grids of triangles: core/engine/grid/evaluate.h.

#include <array>
#include <cmath>
#include <utility>

#include "core/engine/grid/evaluation.h"
#include "core/engine/tri_grid/kernels/tri_step.h"

namespace subdivd {
namespace {

// See GridEvaluation.
struct TriGrid {
  using Faces = Triangles;
  template <class Real>
  using Step = kernels::TriStep<Real>;
  template <class Real>
  using Limit = kernels::TriLimit<Real>;
  static constexpr Split kSplit = Split::triangles;

  template <class Real>
  static const kernels::TriKernels<Real>& kernels() {
    return kernels::tri_kernels<Real>();
  }
  static Count row_scratch(Count n) { return kernels::row_scratch(n); }

  template <class Real, class Scheme>
  static kernels::TriMasks<Real> masks(const Scheme& scheme, CreaseMethod method) {
    static_assert(Scheme::face_sizes == FaceSizes{3, 3} && Scheme::regular_valence == 6,
                  "grids of triangles serve no scheme that takes other faces");
    const std::array<float, 2> sharp{kInfiniteSharpness, kInfiniteSharpness};
    const VertexMask smooth = scheme.vertex_mask({6, method, 0, 0, {}, {}});
    const VertexMask crease = scheme.vertex_mask({1, method, 0, 0, sharp, sharp});
    const EdgeMask edge = scheme.edge_mask({2, 0, {0, 0}});
    const EdgeMask sharp_edge =
        scheme.edge_mask({2, kInfiniteSharpness, {kInfiniteSharpness, kInfiniteSharpness}});
    return {.vertex_self = static_cast<Real>(smooth.self),
            .vertex_each = static_cast<Real>(smooth.each),
            .edge_end = static_cast<Real>(edge.end),
            .edge_opposite = static_cast<Real>(edge.opposite),
            .crease_self = static_cast<Real>(crease.self),
            .crease_end = static_cast<Real>(crease.crease),
            .crease_edge = static_cast<Real>(sharp_edge.end)};
  }
  template <class Real>
  static kernels::TriMasks<Real> linear_masks() {
    return {.vertex_self = 1,
            .vertex_each = 0,
            .edge_end = Real(0.5),
            .edge_opposite = 0,
            .crease_self = 1,
            .crease_end = 0,
            .crease_edge = Real(0.5)};
  }

  template <class Real, class Scheme>
  static void set_limit_masks(kernels::TriLimit<Real>& limit, const Scheme& scheme) {
    const VertexMask mask = scheme.smooth_limit_mask(Scheme::regular_valence);
    limit.self = static_cast<Real>(mask.self);
    limit.each = static_cast<Real>(mask.each);
  }
  template <class Real>
  static void set_linear_limit_masks(kernels::TriLimit<Real>& limit) {
    limit.self = 1;
    limit.each = 0;
  }

  static kernels::FaceRow face_row(Count triangle, Count n, bool whole_faces) {
    kernels::FaceRow at{static_cast<Index>(triangle / (n * n)), 0};
    const Count rest = triangle % (n * n);
    if (!whole_faces) at.row = n - static_cast<Count>(std::sqrt(static_cast<double>(n * n - rest)));
    return at;
  }
  static bool has_inside(Count n) { return n >= 3; }
};

}  // namespace

#define SUBDIVD_DEFINE(Real)                                                                               \
  template <>                                                                                              \
  Result<void> evaluate(const Net<Triangles>& net, Index level, Buffer<Real>&& control, Index width,       \
                        Smoothing smoothing, const Evaluated<Real>& out, Index threads,                    \
                        const Budget& budget) {                                                            \
    return evaluate_on_grid<TriGrid, Real>(net, level, std::move(control), width, smoothing, out, threads, \
                                           budget);                                                        \
  }
SUBDIVD_DEFINE(float)
SUBDIVD_DEFINE(double)
#undef SUBDIVD_DEFINE

}  // namespace subdivd
