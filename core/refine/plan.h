#pragma once
// A control mesh made ready to be refined: everything about it that does not depend on values. A plan never
// changes; threads share it, and it is evaluated again (core/refine/evaluate.h) for every frame, morph target
// or attribute.

#include <memory>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/refine/net.h"
#include "core/refine/split.h"
#include "core/schemes/loop.h"

namespace subdivd {

struct PlanOptions {
  LoopWeights loop_weights = LoopWeights::loop;
  CreaseMethod crease_method = CreaseMethod::uniform;
  Index max_level = kMaxLevel;  // the plan serves levels 0 to this
};

class Plan {
 public:
  // `mesh` must have passed check(). Fails for an unknown scheme, when the points alone of max_level would
  // take more than budget.max_bytes, and when the budget says to stop. Linear in the size of the mesh.
  static Result<Plan> build(const ControlMesh& mesh, const PlanOptions& options, const Budget& budget);

  const Net& mesh() const { return *nets_[0]; }                      // points, vertex and varying primvars
  const Net& channel(std::size_t k) const { return *nets_[k + 1]; }  // the k-th face-varying primvar
  std::size_t channel_count() const { return nets_.size() - 1; }
  std::span<const unsigned char> holes() const { return holes_; }  // per base face: 1 = not output
  // Vertices and edges of the refined mesh; triangles: holes left out.
  LevelCounts counts(Index level) const;

 private:
  void add_channels(const ControlMesh& mesh, CreaseMethod method, const Pace& pace);

  std::vector<std::shared_ptr<const Net>> nets_;
  std::vector<unsigned char> holes_;
  Count output_faces_ = 0;
};

}  // namespace subdivd
