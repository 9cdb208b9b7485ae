#pragma once
// A control mesh made ready to be refined: everything about it that does not depend on values, every
// adjacency that a request needs. A plan never changes; threads share it, sizes are predicted from it
// (refine.h), and values are refined by it again for every level, frame, morph target or attribute.

#include <memory>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/lattice/lattice.h"
#include "core/lattice/split.h"
#include "core/mesh/cage.h"
#include "core/refine/refinable.h"
#include "core/schemes/all.h"

namespace subdivd {

struct PlanOptions {
  AllSchemes schemes = {};  // the options of the one that the mesh names
  CreaseMethod crease_method = CreaseMethod::uniform;
  Index max_level = kMaxLevel;  // the plan serves levels 0 to this
  // Whether tangents and normals will be asked for: schemes that `plain` refines take rows of their own for them, and
  // those of the refined faces where they have none.
  bool frames = true;
};

// Refuses levels over kMaxLevel (out_of_range).
Result<void> check_level(Index level);

// The scheme that a mesh of these faces is refined by, with its options. Fails for a name that is not in the list
// (bad_enum), and for faces that the scheme does not take (unsupported), both at {"subdivisionScheme"}; and for
// sharpness that runs out where the scheme takes none such (unsupported, at its place).
Result<AnyScheme> scheme_of(const Cage& cage, const AllSchemes& schemes, const Pace& pace);

// What building a plan takes at most, and holding it: known before anything but the cage's sizes is.
Count plan_bytes(const Cage& cage, const PlanOptions& options, const Pace& pace);

class Plan {
 public:
  // Of a mesh that has passed check(). Fails for a level over kMaxLevel, as scheme_of() does, when the
  // points alone of max_level would take more than budget.max_bytes, and when the budget says to stop. Linear
  // in the size of the cage.
  static Result<Plan> build(const Cage& cage, const PlanOptions& options, const Budget& budget);

  const AnyScheme& scheme() const { return scheme_; }
  const Refinable& mesh() const { return *parts_[0]; }  // points, vertex and varying primvars
  const Refinable& channel(std::size_t k) const { return *parts_[k + 1]; }  // the k-th face-varying primvar
  std::size_t channel_count() const { return parts_.size() - 1; }
  // Of the k-th render mesh, over its own vertices: a seam of any attribute is a border. Where it connects
  // all faces as the mesh or a channel does, it is that one's, and vertices have the same numbers at every level.
  const std::shared_ptr<const Lattice>& render_lattice(std::size_t k) const { return render_lattices_[k]; }
  std::size_t render_mesh_count() const { return render_lattices_.size(); }
  std::span<const unsigned char> holes() const { return holes_; }  // per base face: 1 = not output
  // Vertices and edges of the refined mesh; faces, and their corners: holes left out.
  LevelCounts counts(Index level) const;
  Count corner_count(Index level) const;

 private:
  struct Builder;

  AnyScheme scheme_;
  std::vector<std::shared_ptr<const Refinable>> parts_;
  std::vector<std::shared_ptr<const Lattice>> render_lattices_;
  std::vector<unsigned char> holes_;
  Count output_faces_ = 0, output_corners_ = 0;
};

}  // namespace subdivd
