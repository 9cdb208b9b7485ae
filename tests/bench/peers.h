#pragma once
// Other libraries' Loop subdivision, as far as they are installed (docker/packages.txt, section test). They
// know no creases: on a mesh that has some they do a little less than we do.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace subdivd::bench {

struct PeerJob {
  std::span<const float> points;  // x y z
  std::span<const int> triangles;
  int level;
  std::span<float> out_points;
  std::span<std::uint32_t> out_triangles;
};

// Milliseconds; ok: the mesh was taken, and its refinement fills the output exactly.
struct PeerTimes {
  bool ok = false;
  double build = 0, refine = 0, extract = 0;
};

struct Peer {
  const char* name;
  PeerTimes (*run)(const PeerJob&);
};

std::vector<Peer> installed_peers();
PeerTimes run_cgal(const PeerJob& job);      // only where CGAL is installed
PeerTimes run_openmesh(const PeerJob& job);  // only where OpenMesh is installed

}  // namespace subdivd::bench
