#pragma once
// Control meshes of faces of any sizes, for the schemes that take them. They carry tags but no primvars, and do not
// pass ControlMesh::check(), which takes triangles alone.

#include <cstdint>
#include <vector>

#include "tests/shapes/shapes.h"

namespace subdivd::shapes {

// Named by what they exercise: quads with borders, poles of 3 to 360, faces of 3 to 12 corners, vertices of two
// edges, creases and corners of all kinds, boundary modes, edges of three faces.
std::vector<NamedShape> polygon_shapes();

// The same points and tags with some faces joined across edges that no crease runs along, chosen by the seed:
// faces of 3 to `most` corners. Primvars and holes are left out.
ControlMesh with_joined_faces(const ControlMesh& triangles, Index most, std::uint64_t seed);

}  // namespace subdivd::shapes
