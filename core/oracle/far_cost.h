#pragma once
// How long Far will be busy in one call, judged before it is called. Includes no OpenSubdiv.
//
// Two of Far's functions cannot be stopped once they run: TopologyRefinerFactory::Create, which searches all
// edges of a point for every face there, and TopologyRefiner::RefineUniform. Everything else is called level
// by level, or calls us back for every value, and is polled. README.md has the measurements behind the
// formulas, and what they cover.

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/grids.h"

namespace subdivd::oracle {

// Predicted processor times, as measured on an idle core of 2023; a busy machine takes as much longer as it does
// for everything else.
using Picoseconds = Count;
inline constexpr Picoseconds kLongestFarCall = 1'000'000'000'000;  // a second

// Far keeps the faces and the edges of a point, and the corners of a face, in 16 bits.
inline constexpr Count kMostFacesOfAPoint = 65535;

// What Far's time depends on.
struct FarLoad {
  GridShape shape = GridShape::triangles;
  Count points = 0, edges = 0, faces = 0, corners = 0;
  Count face_varying_channels = 0;
  // Over all points: faces times edges. Far looks for every side of a face among the edges of its first end.
  Count searches = 0;
  // Over all faces of more than three corners: corners squared. Far looks for every point of a face among the
  // face's corners.
  Count corner_searches = 0;
  // Over all points: faces squared, once per channel. Far looks for every value among those it has found.
  Count value_searches = 0;
  // Over all creases: the edges of the end that has fewer.
  Count crease_searches = 0;
  Count creases = 0;  // edges of them
  // Over all edges of more than two faces: faces squared, three times per channel: for every face around a
  // new point of a torn edge Far looks for the one it comes from.
  Count torn_searches = 0;
  // Corners at points of more than six faces or edges, for which Far keeps a map, and corners whose point is
  // none of the last face's nor a near one: what Far needs of it is not in the processor's cache.
  Count crowded_corners = 0, distant_corners = 0;
  // The point of most searches, its faces and edges; the edge of most faces.
  Index busiest_point = kNoIndex;
  Count busiest_faces = 0, busiest_edges = 0;
  Count most_faces_of_an_edge = 0;
  Index largest_face = kNoIndex;  // and its corners
  Count most_corners = 0;
};

// `mesh` must have passed check(). Linear, in both memory and time. Fails as far_scheme_of(), with
// unsupported for a point of more than kMostFacesOfAPoint faces or edges and for a face of more corners, and
// when the budget says stop.
Result<FarLoad> far_load(const ControlMesh& mesh, const Budget& budget);

Picoseconds far_build_time(const FarLoad& load);
Picoseconds far_refine_time(const FarLoad& load, Index level);

// too_large when one of the two is longer than kLongestFarCall; says what was found.
Result<void> check_far_time(const FarLoad& load, Index level);

// too_large when refining a surface's grid of `quads` by one level, or building it, takes longer.
Result<void> check_far_grid_time(Count quads);

}  // namespace subdivd::oracle
