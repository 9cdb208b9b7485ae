#include "tests/bench/peers.h"

namespace subdivd::bench {

std::vector<Peer> installed_peers() {
  std::vector<Peer> peers;
#ifdef SUBDIVD_BENCH_CGAL
  peers.push_back({"CGAL", run_cgal});
#endif
#ifdef SUBDIVD_BENCH_OPENMESH
  peers.push_back({"OpenMesh", run_openmesh});
#endif
  return peers;
}

}  // namespace subdivd::bench
