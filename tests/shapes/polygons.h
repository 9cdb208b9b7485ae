#pragma once
// Control meshes of faces of any sizes, for the schemes that take them. They carry tags but no primvars.

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

// With a primvar of every interpolation: "constant", "uniform", "varying", "vertex", and face-varying "st",
// which has seams between faces of different islands, of which there are that many, and "torn", of which
// every corner has a value of its own. And a hole, where there are faces enough.
ControlMesh with_values(ControlMesh mesh, Index islands, std::uint64_t seed);

}  // namespace subdivd::shapes
