#pragma once
// The control mesh exactly as the caller gave it: points, faces, tags, primvars.
// Field names and defaults are OpenUSD's UsdGeomMesh. Values are kept in double: every float is a double,
// so nothing is lost, and the engines convert once.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/mesh/cage.h"

namespace subdivd {

// One value per: mesh (constant), base face (uniform), point and refined linearly (varying),
// point and refined like positions (vertex), face corner (face_varying).
enum class Interpolation { constant, uniform, varying, vertex, face_varying };

struct Primvar {
  std::string name;
  Interpolation interpolation = Interpolation::vertex;
  Index element_size = 1;      // scalars per value, 1..kMaxElementSize
  std::vector<double> values;  // element_size scalars per value
  std::vector<Index> indices;  // one per mesh / face / point / face corner; empty: 0, 1, 2, …
};

inline constexpr Index kMaxElementSize = 4096;

struct ControlMesh {
  std::string name;
  // A name from core/schemes/all.h; empty: the first of its list that takes faces of these sizes.
  std::string subdivision_scheme;
  std::vector<double> points;              // x y z per point
  std::vector<Index> face_vertex_counts;   // empty: all faces are triangles
  std::vector<Index> face_vertex_indices;  // face after face; a face's vertices counter-clockwise
  BoundaryInterpolation interpolate_boundary = BoundaryInterpolation::edge_and_corner;
  FaceVaryingInterpolation face_varying_linear_interpolation = FaceVaryingInterpolation::corners_plus1;
  TriangleRule triangle_subdivision_rule = TriangleRule::catmull_clark;

  // Creases are polylines of point indices, one after the other; crease_lengths[k] ≥ 2 points each.
  // crease_sharpnesses holds one number per crease, or one per edge of every crease. An edge that several
  // creases name takes the last sharpness given.
  std::vector<Index> crease_indices;
  std::vector<Index> crease_lengths;
  std::vector<float> crease_sharpnesses;
  std::vector<Index> corner_indices;      // points
  std::vector<float> corner_sharpnesses;  // one per corner
  std::vector<Index> hole_indices;        // faces that refine but are not output

  std::vector<Primvar> primvars;
  std::vector<RenderMesh> render_meshes;  // glTF only; face ranges must not overlap

  Count point_count() const { return points.size() / 3; }
  Count face_count() const {
    return face_vertex_counts.empty() ? face_vertex_indices.size() / 3 : face_vertex_counts.size();
  }
  Index face_size(Count face) const { return face_vertex_counts.empty() ? 3 : face_vertex_counts[face]; }

  // Finds the first fault and says where it is (`where` uses the JSON field names, e.g.
  // {"faceVertexIndices", 17}); empty when the mesh may be given to any function of this library.
  // Everything OpenSubdiv's Far fails to check is checked here: indices against their arrays, counts against
  // lengths, finiteness, creases along existing edges, tags given twice. Linear in the size of the mesh.
  // Faces of less than three vertices are faults, and so are faces that repeat a vertex
  // (call drop_degenerate_faces first). subdivision_scheme is refine()'s to judge, and whether it takes faces of these
  // sizes: masks live above this folder.
  // Stops when the budget says so; its error then has no place.
  Result<void> check(const Budget& budget = {}) const;
};

// Whether the mesh, which has passed check(), can be refined in Real: no point and no value of a primvar is
// beyond kLargestValue (core/base/precision.h). Otherwise the first that is, by its field's name and its
// index among the numbers there, e.g. {"points", 7}. refine() asks the same. Instantiated for float and
// double.
template <class Real>
Result<void> check_magnitudes(const ControlMesh& mesh, const Budget& budget = {});

}  // namespace subdivd
