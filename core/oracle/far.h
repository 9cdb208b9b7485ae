#pragma once
// One uniformly refined level of a control mesh by OpenSubdiv's Far, as plain data. Includes no OpenSubdiv.

#include <memory>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/far_scheme.h"
#include "core/oracle/grids.h"
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
  bool semi_sharp = false;       // the vertex or an edge at it still is
  bool has_other_faces = false;  // at level 0: than its scheme makes
};

template <class Real>
struct FarPrimvar {
  Buffer<Real> values;        // as RefinedPrimvar, per Far vertex, face or face-varying value
  Buffer<Real> limit_values;  // vertex and face_varying, when asked for; not face_varying of level 0
  Buffer<Index> indices;      // face_varying: one per face corner
  // face_varying: per base face, set where Far tears a value (far_quirks.h); empty when it nowhere does.
  std::vector<unsigned char> torn_faces;
};

template <class Real>
struct FarLevel {
  Index level = 0;
  FarScheme scheme = FarScheme::loop;
  GridShape shape = GridShape::triangles;
  FaceRows base_rows;     // corners of every base face
  Index base_points = 0;  // control points
  Buffer<Real> points;    // x y z per vertex
  Buffer<FarVertex> vertices;
  FaceRows rows;                           // corners of every face, holes included
  Buffer<Index> faces;                     // vertices, corner by corner
  Buffer<GridPoint> corners;               // of every face corner: its place on the grid of the base face
  Buffer<Index> base_faces;                // per face
  Buffer<Index> base_corners;              // per face: FarGrid says when, otherwise empty
  Buffer<unsigned char> holes;             // per face
  std::vector<FarPrimvar<Real>> primvars;  // in the order of ControlMesh::primvars
  Buffer<Real> limit_points;               // with options.limit, tangents or normals: x y z per vertex
  Buffer<Real> tangents_u, tangents_v;     // with options.tangents or normals; lengths are Far's own

  // Of a corner of that face, counted as in `corners`.
  Provenance place(Count face, Count corner) const;
};

// Whether Far would take this mesh to this level: out_of_range (level), unsupported (no faces, a scheme that
// Far does not have, or a face or point of more corners or faces than Far can count), too_large (counts that
// Far cannot number, more working memory than budget.max_bytes: see far_mesh_bytes, or a call of Far that
// would take too long: see far_cost.h). Linear in the size of the control mesh; stops when the budget says
// stop.
Result<void> check_far_size(const ControlMesh& mesh, Index level, const Budget& budget);
// Bytes that verify() takes at its peak for Far, FarLevel<double> and the comparison, with limits and
// normals; our own refine() comes on top. Measured, on the safe side: README.md. Of any mesh, checked or not,
// and at any level; no more than 2^63.
Count far_mesh_bytes(const ControlMesh& mesh, Index level);
// too_large when the levels of one refiner have more face corners together than an int counts, as Far does.
Result<void> check_far_corners(Count corners);
// too_large when verification takes more than budget.max_bytes.
Result<void> check_far_bytes(Count bytes, const Budget& budget);

// A control mesh in Far, of which one level is taken after the other: Far looks for the neighbours once.
class FarMesh {
 public:
  // `mesh` must outlive it and have passed check(): Far checks nothing. Fails as check_far_size for level
  // `deepest`, with unsupported for what Far refuses all the same, and when the budget says stop.
  static Result<FarMesh> build(const ControlMesh& mesh, CreaseMethod crease_method, Index deepest,
                               const Budget& budget);
  FarMesh(FarMesh&&) noexcept;
  FarMesh& operator=(FarMesh&&) noexcept;
  ~FarMesh();

  // The level options.level, at most `deepest`; other levels play no part. options.crease_method must be the
  // one above. Far makes all levels in one go: with limits, tangents or normals, which it gives of its last
  // level only, up to this one; otherwise up to `deepest`, once for all levels that are asked for one after
  // the other. It lets them go when its last level has been taken. Fails with out_of_range for a number that
  // Real cannot hold, with unsupported for what Far refuses, or when the budget says stop. Thrown
  // std::bad_allocs pass through.
  template <class Real>
  Result<FarLevel<Real>> refine(const RefineOptions& options, const Budget& budget);

 private:
  struct State;
  explicit FarMesh(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// Both in one.
template <class Real>
Result<FarLevel<Real>> far_refine(const ControlMesh& mesh, const RefineOptions& options,
                                  const Budget& budget);

}  // namespace subdivd::oracle
