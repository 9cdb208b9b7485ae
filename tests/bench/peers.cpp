#include "tests/bench/peers.h"

namespace subdivd::bench {

std::vector<Peer> installed_peers() {
  std::vector<Peer> peers = {{"half-edges", 4, run_half_edges}};
#ifdef SUBDIVD_BENCH_CGAL
  peers.push_back({"CGAL", 3, run_cgal});
#endif
#ifdef SUBDIVD_BENCH_OPENMESH
  peers.push_back({"OpenMesh", 3, run_openmesh});
#endif
  return peers;
}

}  // namespace subdivd::bench
