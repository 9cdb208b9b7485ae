#pragma once
// A control mesh, or one face-varying channel of it, ready to be refined: its lattice, and its values by the engine
// that serves its faces. Never changes; threads share it.

#include <memory>
#include <span>
#include <utility>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/engine/grid/evaluate.h"
#include "core/engine/grid/evaluated.h"
#include "core/engine/net.h"
#include "core/lattice/lattice.h"
#include "core/refine/first_step.h"
#include "core/refine/steps.h"

namespace subdivd {

class Refinable {
 public:
  virtual ~Refinable() = default;

  const std::shared_ptr<const Lattice>& lattice() const { return lattice_; }
  Count value_count(Index level) const { return lattice_->vertex_count(level); }
  // Which of the values that were given each of the control values takes. Empty: its own number.
  virtual std::span<const Index> value_indices() const = 0;

  // Refines values to `level`, at most that of the plan: `control` holds width scalars per control value, and may be
  // used up. It is copied if it has no room for kSpareControl more. What is written depends neither on `threads`
  // (at least 1) nor on the processor.
  virtual Result<void> evaluate(Index level, Buffer<float>&& control, Index width, Smoothing smoothing,
                                const Evaluated<float>& out, Index threads, const Budget& budget) const = 0;
  virtual Result<void> evaluate(Index level, Buffer<double>&& control, Index width, Smoothing smoothing,
                                const Evaluated<double>& out, Index threads, const Budget& budget) const = 0;

  // Bytes: what it holds, and what building it takes beside that, at most; what evaluate() takes for arrays of width
  // scalars of `scalar_bytes`, `limits` said.
  virtual Count resident_bytes() const = 0;
  virtual Count building_bytes() const = 0;
  virtual Count evaluation_bytes(Index level, Index width, Count scalar_bytes, bool limits,
                                 const Pace& pace) const = 0;

 protected:
  explicit Refinable(std::shared_ptr<const Lattice> lattice) : lattice_(std::move(lattice)) {}

 private:
  std::shared_ptr<const Lattice> lattice_;
};

// The same for values that are to be kept.
template <class Real>
Result<void> evaluate(const Refinable& part, Index level, std::span<const Real> control, Index width,
                      Smoothing smoothing, const Evaluated<Real>& out, Index threads, const Budget& budget) {
  return part.evaluate(level, copy_of_control(control), width, smoothing, out, threads, budget);
}

// Grids from level 0 on.
std::shared_ptr<const Refinable> make_refinable(std::shared_ptr<const Net<Triangles>> net);
std::shared_ptr<const Refinable> make_refinable(std::shared_ptr<const Net<Quads>> net);
// Polygons, whose first step makes the quads of `net`.
std::shared_ptr<const Refinable> make_refinable(FirstStep step, std::shared_ptr<const Net<Quads>> net);
// Level by level, to the last level of the steps. Tangents and normals where no mask of tangents is known are those of
// the refined faces (core/limit/face_frames.h).
std::shared_ptr<const Refinable> make_refinable(Steps steps);

}  // namespace subdivd
