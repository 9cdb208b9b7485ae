#pragma once
// Far phase by phase, for tests/bench: plain arrays in, plain arrays out, so that each phase is timed by
// itself and none does what the answer does not need. Verification uses core/oracle/far.h instead.

#include <cstdint>
#include <memory>
#include <span>

#include "core/mesh/control_mesh.h"

namespace subdivd::oracle {

// What Far's TopologyDescriptor points at. The arrays must outlive the FarTiming.
struct FarCage {
  int vertex_count = 0;
  int face_size = 3;             // 3: Loop's scheme; 4: Catmull and Clark's
  std::span<const int> corners;  // face_size per face
  std::span<const int> creases;  // 2 per creased edge
  std::span<const float> crease_sharpnesses;
  BoundaryInterpolation boundary = BoundaryInterpolation::edge_and_corner;
};

// Every method but the constructor and release() is one phase; call them in this order. Points, limits and
// tangents are x y z per vertex of the last level, in Far's order.
class FarTiming {
 public:
  explicit FarTiming(const FarCage& cage);
  ~FarTiming();
  FarTiming(const FarTiming&) = delete;
  FarTiming& operator=(const FarTiming&) = delete;

  // TopologyRefinerFactory::Create. False when Far refuses.
  bool create();
  // RefineUniform to `level` >= 1. Limits need the full topology in the last level; nothing else does.
  void refine(int level, bool full_last_level);
  std::size_t point_count() const;
  std::size_t face_count() const;
  // PrimvarRefiner::Interpolate through all levels, the last one straight into `points`.
  void interpolate(const float* control, float* points) const;
  void extract(std::uint32_t* corners) const;
  // PrimvarRefiner::Limit with two tangents.
  void limit(const float* points, float* limits, float* tangents_u, float* tangents_v) const;

  // For positions that change while the topology stays. build_stencils() needs refine().
  void build_stencils();
  void update_stencils(const float* control, float* points) const;    // StencilTable::UpdateValues
  void evaluate_stencils(const float* control, float* points) const;  // Osd::CpuEvaluator

  // Frees everything made so far; create() may follow.
  void release();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Unit normals from two tangents: what is left to do after Limit for what our engine calls normals.
void normals_of_tangents(std::size_t count, const float* tangents_u, const float* tangents_v, float* normals);

}  // namespace subdivd::oracle
