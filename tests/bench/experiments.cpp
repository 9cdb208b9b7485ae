#include "tests/bench/experiments.h"

#include <cmath>
#include <cstring>
#include <optional>
#include <thread>
#include <vector>

#include "tests/bench/floor.h"
#include "tests/bench/peers.h"
#include "tests/support/allocations.h"

namespace subdivd::bench {
namespace {

using oracle::FarTiming;

// Mean and mean square of each coordinate: the same for the same points in another order.
std::vector<double> moments(const Buffer<float>& points) {
  std::vector<double> sums(6, 0.0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points[k];
    sums[k % 3] += x;
    sums[3 + k % 3] += x * x;
  }
  for (double& sum : sums) sum /= static_cast<double>(points.size()) / 3;
  return sums;
}

// All workloads have an extent of 2 to 3.
bool are_alike(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!(std::abs(a[k] - b[k]) < 1e-5)) return false;
  return true;
}

Laps run_far(const Case& cell, FarTiming& far, Output& out) {
  Laps laps;
  Stopwatch stopwatch;
  far.create();
  laps.emplace_back("plan", stopwatch.lap());
  far.refine(static_cast<int>(cell.level), false);
  laps.emplace_back("refine", stopwatch.lap());
  far.interpolate(cell.workload->points.data(), out.points.data());
  laps.emplace_back("evaluate", stopwatch.lap());
  far.extract(out.faces.data());
  laps.emplace_back("indices", stopwatch.lap());
  far.release();  // not timed, for nobody
  double total = 0;
  for (const auto& [phase, ms] : laps) total += ms;
  laps.emplace_back("total", total);
  return laps;
}

Laps run_peer(const Case& cell, const Peer& peer, Output& out) {
  const PeerTimes times = peer.run({.points = cell.workload->points,
                                    .corners = cell.workload->corners,
                                    .creases = cell.workload->creases,
                                    .crease_sharpnesses = cell.workload->mesh.crease_sharpnesses,
                                    .level = static_cast<int>(cell.level),
                                    .out_points = out.points,
                                    .out_corners = out.faces});
  if (!times.ok) return {};
  return {{"plan", times.build},
          {"refine", times.refine},
          {"indices", times.extract},
          {"total", times.build + times.refine + times.extract}};
}

Laps timed(const char* quantity, const auto& work, double scale = 1) {
  Stopwatch stopwatch;
  work();
  return {{quantity, stopwatch.lap() * scale}};
}

// An array like the refined points, touched; with room for what Floor does behind its end.
Buffer<float> like(const Output& out) { return Buffer<float>(out.points.size() + Floor::kSpare, 0.f); }

}  // namespace

bool same_answer(const Case& cell) {
  Output ours(cell), theirs(cell);
  run_ours(cell, 1, ours);
  FarTiming far(cell.cage());
  if (!far.create()) return false;
  far.refine(static_cast<int>(cell.level), false);
  if (3 * far.point_count() != ours.points.size() ||
      static_cast<std::size_t>(cell.workload->face_size) * far.face_count() != ours.faces.size())
    return false;
  far.interpolate(cell.workload->points.data(), theirs.points.data());
  const std::vector<double> expected = moments(theirs.points);
  if (!are_alike(moments(ours.points), expected)) return false;
  // And of who is to make the same; libraries know no creases.
  if (cell.workload->face_size != 4) return true;
  return !run_peer(cell, {"half-edges", 4, run_half_edges}, theirs).empty() &&
         are_alike(moments(theirs.points), expected);
}

double time_total(const Case& cell, const Pace& pace, Results& results) {
  Output out(cell);
  const Buffer<float> points = out.points;
  const Buffer<Index> faces = out.faces;
  FarTiming far(cell.cage());
  Contest contest;
  contest.enter("ours", [&]() -> Laps {
    const OurTimes times = run_ours(cell, 1, out);
    return {{"plan", times.plan},
            {"evaluate", times.evaluate},
            {"indices", times.indices},
            {"total", times.total()}};
  });
  contest.enter("Far", [&] { return run_far(cell, far, out); });
  contest.enter("memset", [&] {
    return timed("total", [&] {
      std::memset(out.points.data(), 1, out.points.size() * sizeof(float));
      std::memset(out.faces.data(), 1, out.faces.size() * sizeof(Index));
    });
  });
  contest.enter("memcpy", [&] {
    return timed("total", [&] {
      std::memcpy(out.points.data(), points.data(), points.size() * sizeof(float));
      std::memcpy(out.faces.data(), faces.data(), faces.size() * sizeof(Index));
    });
  });
  for (const Peer& peer : installed_peers())
    if (cell.workload->face_size == peer.face_size)
      contest.enter(
          peer.name, [&cell, &out, peer] { return run_peer(cell, peer, out); }, 4);
  return contest.hold(pace, cell.name(), "total", results);
}

// The plan keeps its own to itself. Of triangles; of other faces there is no floor.
Topology<Triangles> topology_of(const Case& cell) {
  const ControlMesh& mesh = cell.workload->mesh;
  if (cell.workload->face_size != 3) return {};
  return Topology<Triangles>(static_cast<Index>(mesh.point_count()), Triangles(mesh.face_vertex_indices));
}

double time_limits(const Case& cell, const Pace& pace, Results& results) {
  Output out(cell);
  Buffer<float> limits = like(out), normals = like(out), u = like(out), v = like(out);
  const std::vector<float>& control = cell.workload->points;
  const auto evaluate_ours = [&](const Plan& plan, const Evaluated<float>& to) {
    must(evaluate<float>(plan.mesh(), cell.level, control, 3, Smoothing::smooth, to, 1, {}));
  };
  FarTiming far(cell.cage());
  Contest contest;
  contest.enter("ours", [&]() -> Laps {
    Stopwatch stopwatch;
    const Plan plan = cell.plan();
    const double planned = stopwatch.lap();
    evaluate_ours(plan, {.values = out.points.data()});
    const double without = stopwatch.lap();
    evaluate_ours(plan, {.values = out.points.data(), .limits = limits.data(), .normals = normals.data()});
    const double with = stopwatch.lap();
    must(plan.mesh().lattice()->write_faces(cell.level, plan.holes(), out.faces.data(), 1, {}));
    return {{"limits", with - without}, {"total_limits", planned + with + stopwatch.lap()}};
  });
  contest.enter("Far", [&]() -> Laps {
    Stopwatch stopwatch;
    far.create();
    far.refine(static_cast<int>(cell.level), true);
    far.interpolate(control.data(), out.points.data());
    far.extract(out.faces.data());
    const double rest = stopwatch.lap();
    far.limit(out.points.data(), limits.data(), u.data(), v.data());
    const double limit = stopwatch.lap();
    oracle::normals_of_tangents(out.points.size() / 3, u.data(), v.data(), normals.data());
    const double last = stopwatch.lap();
    far.release();
    return {{"limits", limit}, {"normals", last}, {"total_limits", rest + limit + last}};
  });
  const Topology<Triangles> topology = topology_of(cell);
  std::optional<Floor> floor;
  if (cell.workload->face_size == 3) {
    floor.emplace(topology, cell.level);
    // `u` serves as the refined points.
    contest.enter("floor",
                  [&] { return timed("limits", [&] { floor->limit(u, limits.data(), normals.data()); }); });
  }
  return contest.hold(pace, cell.name(), "limits", results);
}

double time_again(const Case& cell, const Pace& pace, Results& results) {
  const Plan plan = cell.plan();
  Output out(plan.counts(cell.level));
  FarTiming far(cell.cage());
  far.create();
  far.refine(static_cast<int>(cell.level), false);
  far.build_stencils();
  std::vector<float> control = cell.workload->points;
  const double per_vertex = 1e6 / (static_cast<double>(out.points.size()) / 3);  // ms to ns
  const auto move = [&] {
    for (float& x : control) x *= 1.000001f;
  };
  Contest contest;
  const auto enter = [&](const char* who, auto work) {
    contest.enter(who, [&move, per_vertex, work] {
      move();
      return timed("again", work, per_vertex);
    });
  };
  enter("ours", [&] {
    must(evaluate<float>(plan.mesh(), cell.level, control, 3, Smoothing::smooth,
                         {.values = out.points.data()}, 1, {}));
  });
  enter("Far", [&] { far.update_stencils(control.data(), out.points.data()); });
  enter("base", [&] { far.evaluate_stencils(control.data(), out.points.data()); });
  const Topology<Triangles> topology = topology_of(cell);
  std::optional<Floor> floor;
  Buffer<float> written = like(out);
  if (cell.workload->face_size == 3) {
    floor.emplace(topology, cell.level);
    enter("floor", [&] { floor->refine(control, written.data()); });
  }
  return contest.hold(pace, cell.name(), "again", results);
}

double time_threads(const Case& cell, const Pace& pace, Results& results) {
  Output out(cell);
  Contest contest;
  const auto enter = [&](const char* who, Index threads) {
    contest.enter(who, [&cell, &out, threads]() -> Laps {
      const OurTimes times = run_ours(cell, threads, out);
      return {{"threads", times.evaluate + times.indices}, {"total_threads", times.total()}};
    });
  };
  enter("ours", 2);
  enter("base", 1);
  // What the memory lets two threads gain.
  const auto fill = [&out](Index part) {
    const auto half = [part](auto& items) {
      const std::size_t begin = items.size() / 2 * part, end = part == 0 ? items.size() / 2 : items.size();
      std::memset(items.data() + begin, 1, (end - begin) * sizeof items[0]);
    };
    half(out.points);
    half(out.faces);
  };
  contest.enter("memset", [&fill] {
    return timed("threads", [&fill] {
      std::thread other(fill, 1);
      fill(0);
      other.join();
    });
  });
  return contest.hold(pace, cell.name(), "threads", results);
}

double time_plan(const Case& cell, const Pace& pace, Results& results) {
  FarTiming far(cell.cage());
  Contest contest;
  contest.enter("ours", [&]() -> Laps {
    Stopwatch stopwatch;
    const Plan plan = cell.plan();
    return {{"plan_alone", stopwatch.lap()}};
  });
  contest.enter("Far", [&] {
    Laps laps = timed("plan_alone", [&] { far.create(); });
    far.release();
    return laps;
  });
  return contest.hold(pace, cell.workload->name, "plan_alone", results);
}

double count_memory(const Case& cell, Results& results) {
  Output out(cell);
  FarTiming far(cell.cage());
  const double percent = 100 / static_cast<double>(out.bytes());
  {
    const test::Allocations count;
    run_ours(cell, 1, out);
    results.add(cell.name(), "memory", "ours", static_cast<double>(count.peak_bytes()) * percent);
  }
  {
    const test::Allocations count;
    run_far(cell, far, out);
    results.add(cell.name(), "memory", "Far", static_cast<double>(count.peak_bytes()) * percent);
  }
  return *results.median(cell.name(), "memory", "ours");
}

}  // namespace subdivd::bench
