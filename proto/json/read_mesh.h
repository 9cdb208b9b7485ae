#pragma once
// One mesh and one set of curves of a JSON body.

#include <array>
#include <bitset>
#include <set>
#include <string>

#include "core/curves/control_curve.h"
#include "core/mesh/control_mesh.h"
#include "proto/json/arrays.h"
#include "proto/json/cursor.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

struct MeshRead {
  ControlMesh mesh;
  JsonMeshForm form;
  bool had_normals = false;  // they are not used
};

struct CurvesRead {
  ControlCurves curves;
  ArrayForm form = ArrayForm::nested;
  bool had_tangents = false;  // they are not used
};

// Reads the members of a mesh one by one, in any order; finish() settles what depends on several of them.
class MeshReader {
 public:
  explicit MeshReader(Cursor& cursor) : cursor_(cursor) {}

  static constexpr std::size_t kMembers = 15;
  static const std::array<Cursor::Member<MeshReader>, kMembers>& members();

  // To be called standing in the mesh, after its last member.
  bool finish();
  MeshRead take() { return std::move(result_); }

  bool name(Value value);
  bool points(Value value);
  bool face_vertex_counts(Value value);
  bool face_vertex_indices(Value value);
  bool subdivision_scheme(Value value);
  bool interpolate_boundary(Value value);
  bool face_varying_linear_interpolation(Value value);
  bool crease_indices(Value value);
  bool crease_lengths(Value value);
  bool crease_sharpnesses(Value value);
  bool corner_indices(Value value);
  bool corner_sharpnesses(Value value);
  bool hole_indices(Value value);
  bool primvars(Value value);
  bool normals(Value value);

 private:
  Cursor& cursor_;
  MeshRead result_;
  Lists faces_, creases_;
  bool has_points_ = false, has_faces_ = false, has_counts_ = false, has_lengths_ = false;
};

bool read_mesh(Cursor& cursor, Value value, MeshRead& out);
bool read_curves(Cursor& cursor, Value value, CurvesRead& out);

}  // namespace subdivd::proto::json
