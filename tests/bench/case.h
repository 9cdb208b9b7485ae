#pragma once
// One cell of the table: a workload at a level, our engine on it, and room for the answer.

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>

#include "core/base/buffer.h"
#include "core/oracle/far_timing.h"
#include "core/refine/plan.h"
#include "core/refine/refinable.h"
#include "tests/bench/stopwatch.h"
#include "tests/bench/workloads.h"

namespace subdivd::bench {

// The workloads are right: a failure is a fault of the program, and no figure would mean anything.
template <class T>
T must(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "bench: %s\n", result.error().message.c_str());
    std::exit(1);
  }
  if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

struct Case {
  const Workload* workload;
  Index level;

  std::string name() const { return workload->name + ".L" + std::to_string(level); }
  PlanOptions plan_options() const {
    PlanOptions options;
    options.max_level = level;
    return options;
  }
  Plan plan() const { return must(Plan::build(workload->mesh, plan_options(), {})); }
  oracle::FarCage cage() const {
    return {.vertex_count = static_cast<int>(workload->mesh.point_count()),
            .face_size = workload->face_size,
            .corners = workload->corners,
            .creases = workload->creases,
            .crease_sharpnesses = workload->mesh.crease_sharpnesses,
            .boundary = workload->mesh.interpolate_boundary};
  }
};

// Written to before anything is timed: no page is new to whoever fills it.
struct Output {
  Buffer<float> points;
  Buffer<Index> faces;

  explicit Output(const LevelCounts& counts)
      : points(3 * counts.vertices, 0.f), faces(counts.face_size * counts.faces, 0u) {}
  explicit Output(const Case& cell) : Output(cell.plan().counts(cell.level)) {}
  std::size_t bytes() const { return points.size() * sizeof(float) + faces.size() * sizeof(Index); }
};

struct OurTimes {
  double plan = 0, evaluate = 0, indices = 0;
  double total() const { return plan + evaluate + indices; }
};

inline OurTimes run_ours(const Case& cell, Index threads, Output& out) {
  OurTimes times;
  Stopwatch stopwatch;
  const Plan plan = cell.plan();
  times.plan = stopwatch.lap();
  must(evaluate<float>(plan.mesh(), cell.level, cell.workload->points, 3, Smoothing::smooth,
                       {.values = out.points.data()}, threads, {}));
  times.evaluate = stopwatch.lap();
  must(plan.mesh().lattice()->write_faces(cell.level, plan.holes(), out.faces.data(), threads, {}));
  times.indices = stopwatch.lap();
  return times;
}

}  // namespace subdivd::bench
