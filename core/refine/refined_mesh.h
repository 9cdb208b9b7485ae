#pragma once
// The result of refinement: flat arrays, and where on the control mesh every refined vertex lies.
//
// Numbering, in closed form (n = 2^level): base vertices 0..V-1; then the n-1 points inside base edge e
// at V + e(n-1) + (i-1); then the (n-1)(n-2)/2 points inside face f, row by row. See core/lattice/split.h.

#include <string>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/lattice/provenance.h"
#include "core/lattice/triangles.h"
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
  // face_varying: one index per corner of every output triangle. uniform: one value per output triangle,
  // constant: one value, vertex and varying: one value per refined vertex; indices stay empty, as they do
  // without RefineOptions::connectivity.
  Buffer<Index> indices;
};

// A refined RenderMesh. Triangles appear in the order of RefinedMesh::triangles.
struct RefinedRenderMesh {
  Index vertex_count = 0;
  Index triangle_begin = 0, triangle_end = 0;  // its range in RefinedMesh::triangles, counted in triangles
  TriangleStream triangles;                    // 3 indices each, < vertex_count
  // For every render vertex the refined vertex whose position it copies, and for every face-varying primvar,
  // in their order, the refined value; kNoIndex: no output triangle uses it (inside a hole). An empty array:
  // that of the vertex's own number, for all.
  Buffer<Index> source_vertices;
  std::vector<Buffer<Index>> source_values;
};

template <class Real>
struct RefinedMesh {
  std::string name;
  Index level = 0;
  Count triangle_count = 0;       // output triangles
  Buffer<Real> points;            // x y z per refined vertex
  Buffer<Index> triangles;        // 3 per output triangle; triangles of holes are left out; on request
  Buffer<Index> triangle_faces;   // base face of every output triangle; on request
  Buffer<Provenance> provenance;  // per refined vertex
  std::vector<RefinedPrimvar<Real>> primvars;  // in the order of ControlMesh::primvars
  std::vector<RefinedRenderMesh> render_meshes;

  // Present on request (RefineOptions), otherwise empty; 3 per refined vertex.
  Buffer<Real> limit_points;
  Buffer<Real> tangents_u, tangents_v;  // span the tangent plane; tangents_u x tangents_v points outwards
  Buffer<Real> normals;                 // unit; (0,0,0) where the surface has none (see core/limit)
};

}  // namespace subdivd
