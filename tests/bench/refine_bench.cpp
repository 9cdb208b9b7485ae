// Control mesh to refined mesh, in memory: our engine beside Far as the oracle drives it.
#include <benchmark/benchmark.h>

#include "core/oracle/far.h"
#include "core/refine/refine.h"
#include "tests/shapes/build.h"

namespace subdivd {
namespace {

ControlMesh icosahedron() { return shapes::icosahedron(); }
ControlMesh torus_20k() { return shapes::big_torus(100, 100, 1); }

RefineOptions options_of(const benchmark::State& state) {
  RefineOptions options;
  options.level = static_cast<Index>(state.range(0));
  return options;
}

void count_triangles(benchmark::State& state, const ControlMesh& mesh) {
  const auto triangles = static_cast<double>(mesh.face_count() << (2 * state.range(0)));
  state.counters["ns_per_triangle"] = benchmark::Counter(
      triangles * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Shape>
void ours(benchmark::State& state, Shape shape) {
  const ControlMesh mesh = shape();
  for (auto _ : state) benchmark::DoNotOptimize(refine<float>(mesh, options_of(state), {}));
  count_triangles(state, mesh);
}

template <class Shape>
void ours_with_limits(benchmark::State& state, Shape shape) {
  const ControlMesh mesh = shape();
  RefineOptions options = options_of(state);
  options.limit = options.normals = true;
  for (auto _ : state) benchmark::DoNotOptimize(refine<float>(mesh, options, {}));
  count_triangles(state, mesh);
}

template <class Shape>
void far(benchmark::State& state, Shape shape) {
  const ControlMesh mesh = shape();
  for (auto _ : state) benchmark::DoNotOptimize(oracle::far_refine<float>(mesh, options_of(state), {}));
  count_triangles(state, mesh);
}

BENCHMARK_CAPTURE(ours, icosahedron, icosahedron)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(far, icosahedron, icosahedron)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ours, torus_20k, torus_20k)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(far, torus_20k, torus_20k)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ours_with_limits, torus_20k, torus_20k)->DenseRange(1, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace subdivd
