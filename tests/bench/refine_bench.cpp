// `./dev bench`: everything that README.md names, each as one benchmark of Google's library, and the table.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <deque>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>

#include "tests/bench/experiments.h"

namespace subdivd::bench {
namespace {

struct Flags {
  bool quick = false;
  std::string json;
};

// Takes our flags out of the arguments; the rest is Google Benchmark's.
Flags take_flags(int& argc, char** argv) {
  Flags flags;
  int kept = 1;
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    if (word == "--quick")
      flags.quick = true;
    else if (word == "--json" && k + 1 < argc)
      flags.json = argv[++k];
    else if (word.starts_with("--json="))
      flags.json = word.substr(7);
    else
      argv[kept++] = argv[k];
  }
  argc = kept;
  argv[argc] = nullptr;
  return flags;
}

// Memory once had is kept: for all contestants alike, the cost of new pages is out of the figures. The heap
// is not asked to lie on huge pages (glibc.malloc.hugetlb): Far's totals came out slower with them, not
// faster.
void keep_allocator_warm() {
  ::mallopt(M_MMAP_MAX, 0);
  ::mallopt(M_TRIM_THRESHOLD, -1);
  ::mallopt(M_TOP_PAD, 256 << 20);
}

// One line per benchmark while they run; the table comes at the end.
class Progress : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.error_occurred) {
        failed = true;
        std::cerr << run.run_name.function_name << ": " << run.error_message << '\n';
      } else {
        std::cerr << run.run_name.function_name << ' ' << run.GetAdjustedRealTime() << '\n';
      }
  }
  bool failed = false;
};

// `experiment` runs its own rounds, for the contestants take turns; its median is what is reported to the
// library.
void add(const std::string& name, const std::function<double()>& experiment) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [experiment](benchmark::State& state) {
                                 for (auto _ : state) {
                                   const double ms = experiment();
                                   if (ms <= 0) state.SkipWithError("no answer, or not Far's");
                                   state.SetIterationTime(ms / 1000);
                                 }
                               })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_cell(const Case& cell, const Pace& pace, Results& results) {
  const std::string name = cell.name();
  add("total/" + name, [=, &results] { return same_answer(cell) ? time_total(cell, pace, results) : 0; });
  add("limits/" + name, [=, &results] { return time_limits(cell, pace, results); });
  add("again/" + name, [=, &results] { return time_again(cell, pace, results); });
  add("threads/" + name, [=, &results] { return time_threads(cell, pace, results); });
  add("memory/" + name, [=, &results] { return count_memory(cell, results); });
  if (name == "model6k.L4") add("http/" + name, [=, &results] { return time_http(cell, pace, results); });
}

int run(int argc, char** argv) {
  const Flags flags = take_flags(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const Pace pace = flags.quick ? kQuick : kThorough;
  Results results;
  std::deque<Workload> workloads;
  for (const auto& make : {icosahedron, blob100k, torus1m, model6k, quads6k, quads100k, quads1m}) {
    const Workload& workload = workloads.emplace_back(make());
    must(workload.mesh.check());
    for (const Index level : workload.levels) add_cell({&workload, level}, pace, results);
    const Case highest{&workload, workload.levels.back()};
    add("plan/" + workload.name, [=, &results] { return time_plan(highest, pace, results); });
  }
  std::deque<Asset> assets;
  for (Asset& made : request_assets()) {
    const Asset& asset = assets.emplace_back(std::move(made));
    for (const Index level : {1, 2, 3})
      add("requests/" + asset.name + ".L" + std::to_string(level),
          [=, &asset, &results] { return time_request(asset, level, pace, results); });
  }
  Progress progress;
  benchmark::RunSpecifiedBenchmarks(&progress);
  results.print(std::cout);
  if (!flags.json.empty()) {
    std::ofstream file(flags.json);
    results.write_json(file);
    file.close();
    if (!file) std::cerr << "cannot write " << flags.json << '\n';
    progress.failed |= !file;
  }
  return progress.failed ? 1 : 0;
}

}  // namespace
}  // namespace subdivd::bench

int main(int argc, char** argv) {
  subdivd::bench::keep_allocator_warm();
  return subdivd::bench::run(argc, argv);
}
