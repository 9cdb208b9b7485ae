#include <cstring>
#include <string>
#include <vector>

#include "core/refine/refine.h"
#include "proto/decode.h"
#include "server/tasks/refine_task.h"
#include "tests/bench/daemon.h"
#include "tests/bench/experiments.h"

namespace subdivd::bench {
namespace {

const proto::Limits kLimits{.max_output_bytes = Count{2} << 30};

// What the daemon does between reading a body and sending the answer.
std::size_t answer_in_process(const std::string& glb, Index level) {
  auto request = must(proto::decode_refine(glb, proto::BodyKind::glb, {}, kLimits));
  request.options.level = level;
  request.options.format = proto::Format::glb;
  server::tasks::Phases phases;
  const proto::Payload payload = must(server::tasks::refine(request, kLimits, {}, phases));
  for (const proto::Chunk& chunk : payload.chunks)  // what is made while it is sent
    while (chunk.maker && !chunk.maker->next().empty()) {
    }
  return payload.size();
}

// The mesh refined, and nothing around it.
void refine_alone(const proto::RefineRequest& request) {
  const RefineOptions options = proto::mesh_options(request);
  for (const ControlMesh& mesh : request.meshes) {
    const Plan plan = must(Plan::build(mesh, plan_options(options), {}));
    const RefinedMesh<float> refined = must(refine<float>(mesh, plan, options, {}));
    for (const RefinedRenderMesh& render : refined.render_meshes) must(render.triangles.all(1, {}));
  }
}

}  // namespace

double time_request(const Asset& asset, Index level, const Pace& pace, Results& results) {
  auto decoded = must(proto::decode_refine(asset.glb, proto::BodyKind::glb, {}, kLimits));
  decoded.options.level = level;
  const std::string request =
      "POST /v1/refine?level=" + std::to_string(level) +
      " HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\nContent-Length: " +
      std::to_string(asset.glb.size()) + "\r\n\r\n" + asset.glb;
  const Daemon alone({"--request-threads", "1"}), threaded;
  Client to_alone(alone.port(), Client::Body::dropped), to_threaded(threaded.port(), Client::Body::dropped);
  Client reader(alone.port(), Client::Body::kept);
  // Warm: the daemon has answered, the client has room for the answer.
  std::size_t answer = 0;
  for (int k = 0; k < 3; ++k) {
    answer = to_alone.exchange(request);
    if (answer == 0 || to_threaded.exchange(request) != answer || reader.exchange(request) != answer)
      return 0;
  }
  std::vector<char> from(std::max(answer, request.size()), 1), to(from.size(), 1);
  const auto exchange = [&](Client& client, const char* quantity) -> Laps {
    Stopwatch stopwatch;
    if (client.exchange(request) != answer) return {};
    return {{quantity, stopwatch.lap()}};
  };
  Echo echo(request.size(), answer, Client::Body::dropped), read(request.size(), answer, Client::Body::kept);
  Contest contest;
  contest.enter("ours", [&] { return exchange(to_alone, "request"); });
  contest.enter("ours", [&] { return exchange(to_threaded, "request_threads"); });
  contest.enter("ours", [&] { return exchange(reader, "request_read"); });
  contest.enter("ours", [&]() -> Laps {
    Stopwatch stopwatch;
    answer_in_process(asset.glb, level);
    return {{"in_process", stopwatch.lap()}};
  });
  contest.enter("base", [&]() -> Laps {
    Stopwatch stopwatch;
    refine_alone(decoded);
    std::memcpy(to.data(), from.data(), request.size());
    std::memcpy(to.data(), from.data(), answer);
    const double ms = stopwatch.lap();
    return {{"request", ms}, {"request_threads", ms}, {"request_read", ms}, {"in_process", ms}};
  });
  const auto echoed = [](Echo& other, const char* quantity) -> Laps {
    Stopwatch stopwatch;
    if (!other.exchange()) return {};
    return {{quantity, stopwatch.lap()}};
  };
  contest.enter("loopback", [&] { return echoed(echo, "request"); });
  contest.enter("loopback", [&] { return echoed(read, "request_read"); });
  return contest.hold(pace, asset.name + ".L" + std::to_string(level), "request", results);
}

}  // namespace subdivd::bench
