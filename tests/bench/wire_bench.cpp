// Requests read and answers written, without the refinement between.
#include <benchmark/benchmark.h>

#include <string>

#include "proto/decode.h"
#include "tests/shapes/build.h"

namespace subdivd::proto {
namespace {

constexpr Limits kRoomy{.max_level = 8, .max_output_bytes = Count{8} << 30, .max_body_bytes = Count{1} << 30};

std::string text_of(const Payload& payload) {
  std::string text;
  for (const Chunk& chunk : payload.chunks)
    text.append(reinterpret_cast<const char*>(chunk.bytes.data()), chunk.bytes.size());
  return text;
}

// A torus of 2 * side * side triangles in the asked encoding: JSON is written by us, in double.
RefineRequest torus_request(Index side, Format format) {
  RefineRequest request;
  request.meshes.push_back(shapes::big_torus(side, side, 1));
  request.mesh_forms.resize(1);
  request.face_origins.resize(1);
  request.options.level = 0;
  request.options.format = format;
  return request;
}

template <class Real>
AnyAnswer answer_to(const RefineRequest& request) {
  RefineAnswer<Real> answer;
  RefineOptions options;
  options.level = request.options.level;
  answer.meshes.push_back(*refine<Real>(request.meshes[0], options, {}));
  return answer;
}

AnyAnswer answer_to(const RefineRequest& request, Format format) {
  return format == Format::json ? answer_to<double>(request) : answer_to<float>(request);
}

void write(benchmark::State& state, Format format) {
  const RefineRequest request = torus_request(static_cast<Index>(state.range(0)), format);
  const AnyAnswer answer = answer_to(request, format);
  Count bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    AnyAnswer copy = answer;  // encoding consumes it
    state.ResumeTiming();
    bytes += encode_refine(request, std::move(copy))->size();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.counters["floats_per_second"] = benchmark::Counter(
      static_cast<double>(request.meshes[0].points.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void read(benchmark::State& state, Format format) {
  const RefineRequest request = torus_request(static_cast<Index>(state.range(0)), format);
  RefineRequest plain = request;
  std::string body = text_of(*encode_refine(request, answer_to(request, format)));
  const BodyKind kind = format == Format::json ? BodyKind::json : BodyKind::glb;
  // An answer carries members that a request has not: keep the mesh alone.
  if (format == Format::json) {
    body = R"({"points":)";
    for (std::size_t k = 0; k < plain.meshes[0].points.size(); k += 3) {
      body += k == 0 ? "[[" : ",[";
      for (std::size_t c = 0; c < 3; ++c) {
        if (c > 0) body += ',';
        body += std::to_string(plain.meshes[0].points[k + c]);
      }
      body += ']';
    }
    body += R"(],"faceVertexIndices":)";
    for (std::size_t k = 0; k < plain.meshes[0].face_vertex_indices.size(); ++k) {
      body += k == 0 ? '[' : ',';
      body += std::to_string(plain.meshes[0].face_vertex_indices[k]);
    }
    body += "]}";
  }
  for (auto _ : state) benchmark::DoNotOptimize(decode_refine(body, kind, {}, kRoomy));
  state.SetBytesProcessed(static_cast<std::int64_t>(body.size()) * state.iterations());
}

BENCHMARK_CAPTURE(read, json, Format::json)->Arg(100)->Arg(700)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, glb, Format::glb)->Arg(100)->Arg(700)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write, json, Format::json)->Arg(100)->Arg(700)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write, glb, Format::glb)->Arg(100)->Arg(700)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace subdivd::proto
