#pragma once
// The result of refinement: flat arrays, and where on the control mesh every refined vertex lies.
//
// Numbering is in closed form, faces follow their base faces: core/lattice/lattice.h.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/lattice/provenance.h"
#include "core/lattice/split.h"
#include "core/lattice/triangle_stream.h"
#include "core/mesh/control_mesh.h"

namespace subdivd {

template <class Real>
struct RefinedPrimvar {
  std::string name;
  Interpolation interpolation = Interpolation::vertex;
  Index element_size = 1;
  Buffer<Real> values;  // element_size scalars per refined value
  // With RefineOptions::limit, for vertex and face_varying: the limit of every value; otherwise empty.
  Buffer<Real> limit_values;
  // face_varying: one index per corner of every output face. uniform: one value per output face,
  // constant: one value, vertex and varying: one value per refined vertex; indices stay empty, as they do
  // without RefineOptions::connectivity.
  Buffer<Index> indices;
};

// A refined RenderMesh. Its triangles follow the order of the refined faces.
struct RefinedRenderMesh {
  Index vertex_count = 0;
  Index face_begin = 0, face_end = 0;  // its range among the refined mesh's output faces
  TriangleStream triangles;            // 3 indices each, < vertex_count
  // For every render vertex the refined vertex whose position it copies, and for every face-varying primvar,
  // in their order, the refined value; kNoIndex: no output face uses it (inside a hole). An empty array:
  // that of the vertex's own number, for all.
  Buffer<Index> source_vertices;
  std::vector<Buffer<Index>> source_values;
};

template <class Real>
struct RefinedMesh {
  std::string name;
  std::string_view scheme;  // its name in the list
  Index level = 0;
  std::vector<LevelCounts> levels;             // 0 to `level`: what each has, holes included
  Count face_count = 0;                        // output faces: those of holes are left out
  Index face_size = 3;                         // corners of each, 3 or 4; 0: face_vertex_counts tells
  Buffer<Real> points;                         // x y z per refined vertex
  Buffer<Index> face_vertex_counts;            // one per output face where face_size is 0; on request
  Buffer<Index> faces;                         // vertices of the output faces, corner by corner; on request
  Buffer<Index> base_faces;                    // base face of every output face; on request
  Buffer<Provenance> provenance;               // per refined vertex; on request
  std::vector<RefinedPrimvar<Real>> primvars;  // in the order of ControlMesh::primvars
  std::vector<RefinedRenderMesh> render_meshes;

  // Present on request (RefineOptions), otherwise empty; 3 per refined vertex.
  Buffer<Real> limit_points;
  Buffer<Real> tangents_u, tangents_v;  // span the tangent plane; tangents_u x tangents_v points outwards
  Buffer<Real> normals;                 // unit; (0,0,0) where the surface has none (see core/limit)
};

}  // namespace subdivd
