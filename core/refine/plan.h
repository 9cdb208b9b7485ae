#pragma once
// A control mesh made ready to be refined: everything about it that does not depend on values, every
// adjacency that a request needs. A plan never changes; threads share it, sizes are predicted from it
// (refine.h), and it is evaluated again (evaluate.h) for every level, frame, morph target or attribute.

#include <memory>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/engine/net.h"
#include "core/lattice/split.h"
#include "core/mesh/cage.h"
#include "core/mesh/connectivity.h"
#include "core/schemes/all.h"

namespace subdivd {

struct PlanOptions {
  AllSchemes schemes = {};  // the options of the one that the mesh names
  CreaseMethod crease_method = CreaseMethod::uniform;
  Index max_level = kMaxLevel;  // the plan serves levels 0 to this
};

// Refuses levels over kMaxLevel (out_of_range).
Result<void> check_level(Index level);

// What building a plan takes at most, and holding it: known before anything but the cage's sizes is.
Count plan_bytes(const Cage& cage, const PlanOptions& options);

class Plan {
 public:
  // Of a mesh that has passed check(). Fails for a level over kMaxLevel, for an unknown scheme, when the
  // points alone of max_level would take more than budget.max_bytes, and when the budget says to stop. Linear
  // in the size of the cage.
  static Result<Plan> build(const Cage& cage, const PlanOptions& options, const Budget& budget);

  const Net& net() const { return *nets_[0]; }  // of points, vertex and varying primvars
  const Net& channel_net(std::size_t k) const { return *nets_[k + 1]; }  // of the k-th face-varying primvar
  std::size_t channel_count() const { return nets_.size() - 1; }
  // Of the k-th render mesh, over its own vertices: a seam of any attribute is a border. Where it connects
  // all faces as a net does, it is that net's topology, and vertices have the same numbers at every level.
  const Connectivity<Triangles>& render_mesh(std::size_t k) const { return *render_meshes_[k]; }
  // The same, to be kept.
  const std::shared_ptr<const Connectivity<Triangles>>& shared_render_mesh(std::size_t k) const {
    return render_meshes_[k];
  }
  std::size_t render_mesh_count() const { return render_meshes_.size(); }
  std::span<const unsigned char> holes() const { return holes_; }  // per base face: 1 = not output
  // Vertices and edges of the refined mesh; triangles: holes left out.
  LevelCounts counts(Index level) const;

 private:
  void add_channels(const Cage& cage, CreaseMethod method, const Pace& pace);
  std::shared_ptr<const Connectivity<Triangles>> connectivity_of(const RenderMesh& render,
                                                                 const Pace& pace) const;
  void add_render_meshes(const Cage& cage, const Pace& pace);

  std::vector<std::shared_ptr<const Net>> nets_;
  std::vector<std::shared_ptr<const Connectivity<Triangles>>> render_meshes_;
  std::vector<unsigned char> holes_;
  Count output_faces_ = 0;
};

}  // namespace subdivd
