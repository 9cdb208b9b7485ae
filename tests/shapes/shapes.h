#pragma once
// Control meshes named by what they exercise, and random ones. All are meant to be accepted: each passes
// ControlMesh::check(). Coordinates are about 1 and wobble a little: symmetry would hide wrong weights.

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/control_mesh.h"

namespace subdivd::shapes {

struct NamedShape {
  std::string name;  // lower-case words joined by '_', unique
  ControlMesh mesh;  // mesh.name is the same
};

// Every family below, one after the other.
std::vector<NamedShape> all_shapes();

std::vector<NamedShape> closed_shapes();        // closed fans of every valence, spheres, torus
std::vector<NamedShape> border_shapes();        // fans, disks, strips, in all three boundary modes
std::vector<NamedShape> crease_shapes();        // darts, creases, crossings, sharpness along an edge
std::vector<NamedShape> corner_shapes();        // corners and holes
std::vector<NamedShape> non_manifold_shapes();  // fins, bow-ties, clashing windings
std::vector<NamedShape> seam_shapes();          // face-varying channels, in all six modes
std::vector<NamedShape> primvar_shapes();       // constant, uniform, varying, vertex; narrow and wide

// A valid mesh of 1 to some 200 faces: a flipped, split and punched grid, sphere or torus, with random
// creases, corners, holes, primvars, seams, boundary and face-varying modes. The same seed gives the same
// mesh on every machine.
ControlMesh random_mesh(std::uint64_t seed);

// For benchmarks: rows x columns quads, two triangles each; every tenth diagonal or so runs the other way, so
// that valences from 4 to 8 occur. No tags, no primvars. rows, columns >= 3.
ControlMesh big_torus(Index rows, Index columns, std::uint64_t seed);

}  // namespace subdivd::shapes
