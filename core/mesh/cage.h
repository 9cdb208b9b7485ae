#pragma once
// The cage: of a control mesh what does not depend on values, that is faces and the tags that say how they
// are refined. A plan is made from it alone, so that other points and primvars can be refined by the same
// plan.

#include <span>
#include <string_view>
#include <vector>

#include "core/base/index.h"

namespace subdivd {

struct ControlMesh;

// What happens where the surface ends.  [USD interpolateBoundary]
enum class BoundaryInterpolation {
  none,             // faces that touch the border support the surface but are not output
  edge_only,        // the border is a smooth curve; corners of the border are rounded
  edge_and_corner,  // as edge_only, and a border vertex of a single face is pinned
};

// Which parts of a face-varying channel's border are linear instead of smooth.
// [USD faceVaryingLinearInterpolation], from least to most linear.
enum class FaceVaryingInterpolation { none, corners_only, corners_plus1, corners_plus2, boundaries, all };

// What an edge beside triangles takes of its faces under Catmull and Clark's scheme: as much as of other faces, or
// more, so that triangles among quads show less.  [USD triangleSubdivisionRule]
enum class TriangleRule { catmull_clark, smooth };

// How the sharpness of a semi-sharp crease decays along the levels.  [DeRose98, section 4; RenderMan]
enum class CreaseMethod { uniform, chaikin };

// Sharpness is single precision, as in USD and OpenSubdiv: its decay 2.3 -> 1.3 -> 0.3 rounds at every step,
// so the type is part of the rule. At or above this it is infinite, as in OpenSubdiv; USD writes 1e38.
inline constexpr float kInfiniteSharpness = 10.0f;

// The faces [face_begin, face_end) as a renderer indexes them: seams of any attribute split a vertex. Only
// connectivity: the refined render mesh says which refined vertices to copy (glTF primitives use it).
struct RenderMesh {
  Index face_begin = 0, face_end = 0;
  Index vertex_count = 0;
  std::vector<Index> indices;  // one per face corner, each < vertex_count
};

// Refers to the arrays of a control mesh that outlives it; control_mesh.h says what they hold. Whoever wants
// a cage wants that of a mesh that has passed check(), unless they say otherwise.
struct Cage {
  // Implicit: a control mesh is taken wherever a cage is wanted.
  Cage(const ControlMesh& mesh);
  Cage(const ControlMesh&&) = delete;

  Count face_count() const {
    return face_vertex_counts.empty() ? face_vertex_indices.size() / 3 : face_vertex_counts.size();
  }
  Index face_size(Count face) const { return face_vertex_counts.empty() ? 3 : face_vertex_counts[face]; }

  std::string_view subdivision_scheme;
  Index point_count;
  std::span<const Index> face_vertex_counts;  // empty: all faces are triangles
  std::span<const Index> face_vertex_indices;
  BoundaryInterpolation interpolate_boundary;
  FaceVaryingInterpolation face_varying_linear_interpolation;
  TriangleRule triangle_subdivision_rule;
  std::span<const Index> crease_indices, crease_lengths;
  std::span<const float> crease_sharpnesses;
  std::span<const Index> corner_indices;
  std::span<const float> corner_sharpnesses;
  std::span<const Index> hole_indices;

  // Where the values of a face-varying primvar sit.
  struct Seams {
    Index value_count;
    std::span<const Index> corner_values;  // one value per face corner; empty: 0, 1, 2, …
  };
  std::vector<Seams> channels;  // in the order of the face-varying primvars
  std::span<const RenderMesh> render_meshes;
};

}  // namespace subdivd
