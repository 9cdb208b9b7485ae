#pragma once
// The first step of a mesh whose faces are not all quads, where it makes quads of them: values by rows, and what
// the quads' own net is built from.

#include <memory>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/level.h"
#include "core/engine/plain/step_rows.h"
#include "core/mesh/channel.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"
#include "core/schemes/all.h"

namespace subdivd {

// The quads that faces become, one for each corner in turn: (v, point of the edge behind it, point of the face, point
// of the edge before). Vertices are numbered: those of `polygons`, points of edges, points of faces.
std::shared_ptr<const Topology<Quads>> quads_of(const Connectivity<Polygons>& polygons, const Pace& pace);

struct FirstStep {
  std::shared_ptr<const Topology<Polygons>> polygons;
  std::shared_ptr<const Topology<Quads>> quads;
  Sharpness sharpness;        // of the quads
  plain::StepRows rows;       // of the quads' vertices; empty where all is linear
  std::vector<Index> values;  // of a channel: see Channel
  bool linear = false;
};

// Of the mesh, and of a channel of it. `level`: what the channels' steps need of the mesh's.
struct MeshFirstStep {
  FirstStep step;
  plain::Level level;
};
MeshFirstStep first_step(const AnyGridScheme& scheme, CreaseMethod method,
                         std::shared_ptr<const Topology<Polygons>> polygons, Sharpness sharpness,
                         const Pace& pace);
FirstStep first_step(const AnyGridScheme& scheme, CreaseMethod method, Channel<Polygons> channel,
                     const plain::Level& mesh, const Pace& pace);

// Values of the quads' vertices. `linear`: edges get midpoints and faces means, whatever the rules.
template <class Real>
Buffer<Real> apply(const FirstStep& step, std::span<const Real> control, Index width, bool linear,
                   const Pace& pace);

}  // namespace subdivd
