// Curves and B-spline surfaces: refinement beside a copy of the answer, evaluation at many parameters beside
// the definition of the basis, which asks every control point. "ns" is the time per point of the answer or
// per parameter; "ratio" is measured in the same round, one beside the other.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "core/base/buffer.h"
#include "core/curves/local_subdivision.h"
#include "core/curves/subdivision.h"
#include "core/splines/bspline.h"
#include "core/surfaces/patch.h"

namespace subdivd {
namespace {

double seconds(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The first rounds wait for pages that the system gives out.
double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

std::vector<double> wave(Count points, Index width) {
  std::vector<double> values(points * width);
  for (Count i = 0; i < values.size(); ++i) values[i] = std::sin(0.37 * static_cast<double>(i));
  return values;
}

void refine_beside_memcpy(benchmark::State& state, Index degree) {
  ControlCurves curves;
  curves.basis = UniformBSpline{degree};
  curves.points = wave(static_cast<Count>(state.range(0)), 3);
  const CurveOptions options{.level = static_cast<Index>(state.range(1))};
  const Buffer<double> like = refine<double>(curves, options, {})->points;
  // Both into memory that has just been got: pages are given out to the one as to the other. Beside it a copy
  // into memory that is there already, which refine() has no way to be given.
  std::vector<double> ours, copied, copied_again;
  Buffer<double> there(like.size());
  for (auto _ : state) {
    ours.push_back(seconds([&] { benchmark::DoNotOptimize(refine<double>(curves, options, {})); }));
    copied.push_back(seconds([&] {
      Buffer<double> copy(like.size());
      std::memcpy(copy.data(), like.data(), like.size() * sizeof(double));
      benchmark::DoNotOptimize(copy.data());
    }));
    copied_again.push_back(seconds([&] {
      std::memcpy(there.data(), like.data(), like.size() * sizeof(double));
      benchmark::DoNotOptimize(there.data());
    }));
  }
  state.counters["ns"] = median(ours) * 1e9 / static_cast<double>(like.size() / 3);
  state.counters["times_memcpy"] = median(ours) / median(copied);
  state.counters["times_warm_memcpy"] = median(ours) / median(copied_again);
}

// A cubic in space on uneven knots.
Spline uneven(Count points) {
  Spline spline{3, 3, false, false, {0, 0, 0, 0}, wave(points, 3)};
  double t = 0;
  for (Count i = 4; i < points; ++i) spline.knots.push_back(t += 1 + 0.5 * std::sin(static_cast<double>(i)));
  spline.knots.insert(spline.knots.end(), 4, t + 1);
  return spline;
}

// By the definition: every control point's function, each by its own recursion from degree 0.
double all_functions(const Spline& spline, Index degree, Count i, double t) {
  const std::vector<double>& u = spline.knots;
  if (degree == 0) return u[i] <= t && t < u[i + 1] ? 1 : 0;
  double sum = 0;
  if (u[i] < u[i + degree])
    sum += (t - u[i]) / (u[i + degree] - u[i]) * all_functions(spline, degree - 1, i, t);
  if (u[i + 1] < u[i + degree + 1])
    sum += (u[i + degree + 1] - t) / (u[i + degree + 1] - u[i + 1]) *
           all_functions(spline, degree - 1, i + 1, t);
  return sum;
}

// In order, or in any: the search for the span and what it reads must not live from the neighbour before.
void evaluate_beside_all_functions(benchmark::State& state, bool in_order) {
  const Spline spline = uneven(static_cast<Count>(state.range(0)));
  constexpr Count kAll = 10'000'000, kFew = 20'000;
  std::vector<double> ts(kAll), points(3 * kAll);
  const double step = (spline.end() - spline.begin()) / kAll;
  for (Count k = 0; k < kAll; ++k) ts[k] = spline.begin() + step * static_cast<double>(k);
  if (!in_order) std::ranges::shuffle(ts, std::mt19937_64(1));
  double ours = 0, naive = 0;
  for (auto _ : state) {
    const SplineEvaluator evaluator(spline);
    ours += seconds([&] { evaluator.evaluate(ts, points); });
    benchmark::DoNotOptimize(points.data());
    const Count few = kFew * 100 / static_cast<Count>(state.range(0));
    naive += seconds([&] {
               for (Count k = 0; k < few; ++k) {
                 const double t = ts[k * (kAll / few)];
                 double point[3] = {};
                 for (Count i = 0; i < spline.point_count(); ++i) {
                   const double weight = all_functions(spline, 3, i, t);
                   for (Count x = 0; x < 3; ++x) point[x] += weight * spline.points[3 * i + x];
                 }
                 benchmark::DoNotOptimize(point);
               }
             }) *
             kAll / static_cast<double>(few);
  }
  const double all = static_cast<double>(kAll) * static_cast<double>(state.iterations());
  state.counters["ns"] = ours * 1e9 / all;
  state.counters["naive_ns"] = naive * 1e9 / all;
  state.counters["ratio"] = naive / ours;
}

// A torus with quads beside a copy of its arrays, both into memory that has just been got.
void refine_surface_beside_memcpy(benchmark::State& state, Index degree, bool normals) {
  const auto n = static_cast<Index>(state.range(0));
  const ControlPatch patch{
      "", n, n, degree, degree, CurveWrap::periodic, CurveWrap::periodic, 3, wave(Count{n} * n, 3)};
  const PatchOptions options{
      .level = static_cast<Index>(state.range(1)), .normals = normals, .faces = PatchFaces::quads};
  const Count bytes = *predict_bytes<double>(patch, options);
  const Buffer<char> like(bytes, 1);
  std::vector<double> ours, copied;
  for (auto _ : state) {
    ours.push_back(seconds([&] { benchmark::DoNotOptimize(refine<double>(patch, options, {})); }));
    copied.push_back(seconds([&] {
      Buffer<char> copy(bytes);
      std::memcpy(copy.data(), like.data(), bytes);
      benchmark::DoNotOptimize(copy.data());
    }));
  }
  const Count points = (Count{n} * n) << (2 * options.level);
  state.counters["ns"] = median(ours) * 1e9 / static_cast<double>(points);
  state.counters["times_memcpy"] = median(ours) / median(copied);
}

// Point and derivative at parameters of 52 bits.
void evaluate_four_point(benchmark::State& state) {
  ControlCurves curves;
  curves.basis = FourPoint{};
  curves.points = wave(1000, 3);
  const SubdividedCurve curve = *subdivided_curve(curves, 0, {});
  std::vector<double> rows(6);
  double t = 0;
  for (auto _ : state) {
    t = std::fmod(t + 123.45678901, curve.end());
    benchmark::DoNotOptimize(derivatives(curve, t, 1, rows).ok());
  }
}

BENCHMARK_CAPTURE(refine_beside_memcpy, cubic, 3)
    ->Args({1'000'000, 3})
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(refine_beside_memcpy, chaikin, 2)
    ->Args({1'000'000, 3})
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(refine_beside_memcpy, quintic, 5)
    ->Args({1'000'000, 3})
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(refine_surface_beside_memcpy, bicubic, 3, false)
    ->Args({128, 4})
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(refine_surface_beside_memcpy, bicubic_normals, 3, true)
    ->Args({128, 4})
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(evaluate_four_point);
BENCHMARK_CAPTURE(evaluate_beside_all_functions, in_order, true)
    ->Arg(100)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(evaluate_beside_all_functions, shuffled, false)
    ->Arg(100)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace subdivd
