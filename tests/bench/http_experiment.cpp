#include <cstdint>
#include <string>
#include <vector>

#include "proto/decode.h"
#include "tests/bench/daemon.h"
#include "tests/bench/experiments.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::bench {
namespace {

std::string glb_of(const Workload& workload) {
  test::GltfBuilder builder;
  const std::vector<std::uint32_t> indices(workload.corners.begin(), workload.corners.end());
  const int positions = builder.values(workload.points, 3);
  std::vector<float> least(workload.points.begin(), workload.points.begin() + 3), most = least;
  for (std::size_t k = 0; k < workload.points.size(); ++k) {
    least[k % 3] = std::min(least[k % 3], workload.points[k]);
    most[k % 3] = std::max(most[k % 3], workload.points[k]);
  }
  auto& accessor = builder.document()["accessors"][static_cast<std::size_t>(positions)];
  accessor["min"] = least;
  accessor["max"] = most;
  builder.mesh({{"POSITION", positions}}, builder.values(indices, 1));
  return builder.glb();
}

// What the daemon will refine: glTF carries no creases.
Workload decoded(const Workload& workload, const std::string& glb) {
  const proto::RefineRequest request =
      must(proto::decode_refine(glb, proto::BodyKind::glb, {}, proto::Limits{}));
  Workload made;
  made.name = workload.name;
  made.mesh = request.meshes[0];
  made.points.assign(made.mesh.points.begin(), made.mesh.points.end());
  return made;
}

}  // namespace

double time_http(const Case& cell, const Pace& pace, Results& results) {
  const std::string glb = glb_of(*cell.workload);
  const Workload received = decoded(*cell.workload, glb);
  const Case core{&received, cell.level};
  Output out(core);
  const std::string request =
      "POST /v1/refine?level=" + std::to_string(cell.level) +
      " HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\nContent-Length: " +
      std::to_string(glb.size()) + "\r\n\r\n" + glb;
  const Daemon daemon;
  Client client(daemon.port());
  const std::size_t answer = client.exchange(request);
  if (answer == 0) return 0;
  const double bytes_ms = static_cast<double>(glb.size() + answer) / 1e6;  // at 1 GB/s
  Contest contest;
  contest.enter("ours", [&]() -> Laps {
    Stopwatch stopwatch;
    if (client.exchange(request) != answer) return {};
    return {{"http", stopwatch.lap()}};
  });
  contest.enter("base", [&]() -> Laps { return {{"http", run_ours(core, 1, out).total() + bytes_ms}}; });
  return contest.hold(pace, cell.name(), "http", results);
}

}  // namespace subdivd::bench
