#pragma once
// One level from the one before it, with the topology of every level in full: the way of any split on any
// mesh, and the witness of the engines that do without.

#include <array>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/adjacency.h"
#include "core/engine/plain/step_rows.h"
#include "core/mesh/control_mesh.h"
#include "core/mesh/sharpness.h"
#include "core/schemes/all.h"

namespace subdivd::plain {

// One level of a mesh or of a face-varying channel of it.
struct Level {
  Adjacency faces;
  Sharpness sharpness;
  // Sharpness of the halves of every edge, one level on: [e][0] next to its lower-numbered end, [e][1] to the
  // other.
  std::vector<std::array<float, 2>> halves;
  bool linear = false, linear_borders = false;  // see Channel
  bool thirds_next = false;  // of Split::centroids: whether the next step cuts borders into three
};

// Level 0 of a mesh.
Level first_level(Adjacency faces, Sharpness sharpness, CreaseMethod method, const Pace& pace = {});
// Of a channel. It has the mesh's sharpness but for its borders, at every level: under Chaikin's rule that
// decays with the edges around a point of the *mesh*, of which a channel's vertex at a seam sees only some.
// `mesh`: the level of the mesh that this level of the channel belongs to; the same faces in the same order.
Level first_level(Adjacency faces, Sharpness sharpness, bool linear, bool linear_borders, const Level& mesh,
                  const Pace& pace = {});

// Sharpness of that step's edges and vertices, as many as are said: the halves of edges and the points on them come
// first, what lies inside faces is smooth.
Sharpness next_sharpness(const Level& level, Index vertices, Index edges, const Pace& pace = {});

// One step; split.h says how its points, edges and faces are numbered.
Level next_level(const Level& level, Split split, CreaseMethod method, const Pace& pace = {});
Level next_level(const Level& channel, Split split, const Level& next_mesh, const Pace& pace = {});

// The values of that step's vertices from those of `level`'s. `linear`: midpoints, and means of faces where they
// get points, whatever the level's own rules.
StepRows rows_of(const AnyGridScheme& scheme, CreaseMethod method, const Level& level, bool linear,
                 const Pace& pace = {});

}  // namespace subdivd::plain
