#pragma once
// Meshes of quads, and of faces of several sizes, that have everything the comparison looks at.

#include <algorithm>
#include <string>

#include "tests/core/oracle/fixtures.h"
#include "tests/shapes/polygons.h"

namespace subdivd::oracle::testing {

inline ControlMesh polygon_shape(const std::string& name) {
  for (const auto& shape : shapes::polygon_shapes())
    if (shape.name == name) return shape.mesh;
  ADD_FAILURE() << "there is no shape " << name;
  return {};
}

inline ControlMesh bilinear(ControlMesh mesh) {
  mesh.subdivision_scheme = "bilinear";
  return mesh;
}

// Poles of five faces, an infinite crease, a hole that is neither the first nor the last face, and a primvar
// of every interpolation.
inline ControlMesh with_everything(ControlMesh mesh) {
  mesh = shapes::with_values(std::move(mesh), 1, 7);
  mesh.hole_indices = {2};
  return mesh;
}

inline ControlMesh rich_quads() { return with_everything(polygon_shape("pole_of_5_quads")); }

// Pentagons above and below, quads between them; below also triangles.
inline ControlMesh rich_polygons() {
  ControlMesh mesh = polygon_shape("prism_of_5");
  mesh.points.insert(mesh.points.end(), {0.1, 0.2, -1});  // point 10
  mesh.face_vertex_counts.erase(mesh.face_vertex_counts.begin());
  mesh.face_vertex_indices.erase(mesh.face_vertex_indices.begin(), mesh.face_vertex_indices.begin() + 5);
  for (Index k = 0; k < 5; ++k) {
    mesh.face_vertex_counts.push_back(3);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {k, 10, (k + 1) % 5});
  }
  shapes::crease(mesh, {5, 6, 7}, kInfiniteSharpness);
  // Two quads stand before the pentagon, so that faces next to each other may be swapped at level 0.
  std::rotate(mesh.face_vertex_counts.begin(), mesh.face_vertex_counts.begin() + 1,
              mesh.face_vertex_counts.begin() + 6);
  std::rotate(mesh.face_vertex_indices.begin(), mesh.face_vertex_indices.begin() + 5,
              mesh.face_vertex_indices.begin() + 25);
  return with_everything(std::move(mesh));
}

}  // namespace subdivd::oracle::testing
