#pragma once
// One mesh and one set of curves of a JSON body.

#include <array>
#include <bitset>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/curves/control_curve.h"
#include "core/mesh/control_mesh.h"
#include "core/surfaces/patch.h"
#include "proto/json/arrays.h"
#include "proto/json/cursor.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

struct MeshRead {
  ControlMesh mesh;
  JsonMeshForm form;
  std::vector<NameList> primvar_names;  // of every primvar
  bool had_normals = false;             // they are not used
};

struct CurvesRead {
  ControlCurves curves;
  std::optional<ControlPatch> surface;  // of type "bsplineSurface"; `curves` is empty then
  JsonCurvesForm form;
  JsonSurfaceForm surface_form;  // its points are as those of `form`
  bool had_tangents = false;     // they are not used
};

// Reads the members of a mesh one by one, in any order; finish() settles what depends on several of them.
class MeshReader {
 public:
  explicit MeshReader(Cursor& cursor) : cursor_(cursor) {}

  static constexpr std::size_t kMembers = 17;
  static const std::array<Cursor::Member<MeshReader>, kMembers>& members();

  // To be called standing in the mesh, after its last member.
  bool finish();
  MeshRead take() { return std::move(result_); }

  bool name();
  bool points();
  bool face_vertex_counts();
  bool face_vertex_indices();
  bool orientation();
  bool subdivision_scheme();
  bool triangle_subdivision_rule();
  bool interpolate_boundary();
  bool face_varying_linear_interpolation();
  bool crease_indices();
  bool crease_lengths();
  bool crease_sharpnesses();
  bool corner_indices();
  bool corner_sharpnesses();
  bool hole_indices();
  bool primvars();
  bool normals();

 private:
  Cursor& cursor_;
  MeshRead result_;
  Lists faces_, creases_;
  bool has_points_ = false, has_faces_ = false, has_counts_ = false, has_lengths_ = false;
};

// The same for a set of curves, or for a surface: their type says which of the two they are.
class CurvesReader {
 public:
  CurvesReader(Cursor& cursor, CurvesRead& out) : cursor_(cursor), out_(out) {}

  using Member = Cursor::Member<CurvesReader>;
  static constexpr std::size_t kMembers = 15, kSurfaceMembers = 14;
  static const std::array<Member, kMembers>& members();
  static const std::array<Member, kSurfaceMembers>& surface_members();

  // It is a surface, whatever stands in it or not.
  void expect_surface();

  // To be called standing in the curves, after the last member.
  bool finish();

  bool name();
  bool type();
  bool basis();
  bool degree();
  bool wrap();
  bool tension();
  bool ratio();
  bool spacing();
  bool points();
  bool curve_vertex_counts();
  bool order();
  bool knots();
  bool ranges();
  bool point_weights();
  bool tangents();
  bool u_vertex_count();
  bool v_vertex_count();
  bool u_degree();
  bool v_degree();
  bool u_wrap();
  bool v_wrap();
  bool face_vertex_counts();
  bool face_vertex_indices();
  bool normals();

 private:
  // Those that belong to some kinds of curves only.
  enum class Part {
    basis,
    degree,
    wrap,
    tension,
    ratio,
    spacing,
    order,
    knots,
    ranges,
    point_weights,
    vertex_counts,
    u_count,
    v_count,
    u_degree,
    v_degree,
    u_wrap,
    v_wrap,
    faces,
    normals,
    count
  };
  bool given(Part part) {
    given_.set(static_cast<std::size_t>(part));
    return true;
  }
  bool is_given(Part part) const { return given_[static_cast<std::size_t>(part)]; }
  CurveBasis chosen_basis();
  bool check_members();
  bool settle_type();
  bool settle_surface();
  bool read_word(std::span<const std::string_view> words, std::optional<std::size_t>& out);
  bool read_wrap(CurveWrap& out);
  bool read_number(double& out);
  bool read_numbers(std::vector<double>& out);

  Cursor& cursor_;
  CurvesRead& out_;
  bool has_points_ = false;
  std::optional<std::size_t> type_;
  // Members come in any order: what belongs to some kinds only waits here until the kind is known.
  std::size_t basis_ = 0;  // of basis_words()
  UniformBSpline bspline_;
  FourPoint four_point_;
  CornerCutting corner_cutting_;
  CatmullRom catmull_rom_;
  Nurbs nurbs_;
  ControlPatch surface_;  // what of it has been read
  std::bitset<static_cast<std::size_t>(Part::count)> given_;
};

bool read_mesh(Cursor& cursor, MeshRead& out);
bool read_curves(Cursor& cursor, CurvesRead& out);
bool read_surface(Cursor& cursor, CurvesRead& out);

}  // namespace subdivd::proto::json
