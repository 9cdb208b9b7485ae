#pragma once
// One uniformly refined level of a control mesh by OpenSubdiv's Far, as plain data. Includes no OpenSubdiv.

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/refine/refine.h"

namespace subdivd::oracle {

// Far keeps 4 bits of the level and signed 32-bit counts; above this nothing useful fits anyway.
inline constexpr Index kMaxFarLevel = 10;

enum class FarRule { smooth, dart, crease, corner };

// What Far knows about one of its vertices at the refined level.
struct FarVertex {
  // Its place on the lowest-numbered base face that holds it. A vertex of no face (unreferenced point):
  // face = kNoIndex and i the number of the control point.
  Provenance place;
  FarRule rule = FarRule::smooth;
  Index faces = 0;        // incident faces
  bool boundary = false;  // on a border edge
  bool non_manifold = false;
  bool semi_sharp = false;  // the vertex or an edge at it still is
};

template <class Real>
struct FarPrimvar {
  std::vector<Real> values;        // as RefinedPrimvar, per Far vertex, face or face-varying value
  std::vector<Real> limit_values;  // vertex and face_varying, when asked for; not face_varying of level 0
  std::vector<Index> indices;      // face_varying: one per face corner
  // face_varying: per base face, set where Far tears a value (far_quirks.h); empty when it nowhere does.
  std::vector<unsigned char> torn_faces;
};

template <class Real>
struct FarLevel {
  Index level = 0;
  Index base_points = 0;     // control points
  std::vector<Real> points;  // x y z per vertex
  std::vector<FarVertex> vertices;
  std::vector<Index> faces;                  // 3 vertices per face, holes included
  std::vector<GridPoint> corners;            // of every face corner: its place on the grid of the base face
  std::vector<Index> base_faces;             // per face
  std::vector<unsigned char> holes;          // per face
  std::vector<FarPrimvar<Real>> primvars;    // in the order of ControlMesh::primvars
  std::vector<Real> limit_points;            // with options.limit, tangents or normals: x y z per vertex
  std::vector<Real> tangents_u, tangents_v;  // with options.tangents or normals; lengths are Far's own
};

// Whether far_refine<Real> would take this mesh to this level: out_of_range (level), unsupported (no faces),
// too_large (counts that Far cannot number, or more working memory than budget.max_bytes: see far_bytes).
Result<void> check_far_size(const ControlMesh& mesh, Index level, const Budget& budget);
// Bytes that Far and FarLevel<double> take at their peak, roughly; measured, on the safe side.
Count far_bytes(const ControlMesh& mesh, Index level);
// too_large when the levels of one refiner have more face corners together than an int counts, as Far does.
Result<void> check_far_corners(Count corners);
// too_large when verification takes more than budget.max_bytes.
Result<void> check_far_bytes(Count bytes, const Budget& budget);

// Refines to options.level (0..kMaxFarLevel) in one go. `mesh` must have passed check(): Far checks nothing.
// Fails as check_far_size, with out_of_range for a number that Real cannot hold, with unsupported for what
// Far refuses (a vertex of more than 65535 faces), or when the budget is polled dry.
template <class Real>
Result<FarLevel<Real>> far_refine(const ControlMesh& mesh, const RefineOptions& options,
                                  const Budget& budget);

}  // namespace subdivd::oracle
