#pragma once
// Others' ways. Of libraries, as far as they are installed (docker/packages.txt, section test), Loop's scheme: they know no
// creases, and on a mesh that has some they do a little less than we do. Of quads the half-edge way, written here.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace subdivd::bench {

struct PeerJob {
  std::span<const float> points;              // x y z
  std::span<const int> corners;               // face after face
  std::span<const int> creases;               // 2 points an edge
  std::span<const float> crease_sharpnesses;  // one an edge
  int level;
  std::span<float> out_points;
  std::span<std::uint32_t> out_corners;
};

// Milliseconds; ok: the mesh was taken, and its refinement fills the output exactly.
struct PeerTimes {
  bool ok = false;
  double build = 0, refine = 0, extract = 0;
};

struct Peer {
  const char* name;
  int face_size;  // of the meshes that it takes
  PeerTimes (*run)(const PeerJob&);
};

std::vector<Peer> installed_peers();

PeerTimes run_half_edges(const PeerJob& job);
PeerTimes run_cgal(const PeerJob& job);      // only where CGAL is installed
PeerTimes run_openmesh(const PeerJob& job);  // only where OpenMesh is installed

}  // namespace subdivd::bench
