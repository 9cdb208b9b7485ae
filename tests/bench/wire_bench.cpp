// Requests read and answers written, without the refinement between. Bytes per second are bytes of the body;
// "numbers" counts every number in it (coordinates, normals, indices), "reals" only those that are no
// indices.
#include <benchmark/benchmark.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <string>
#include <utility>

#include "proto/decode.h"
#include "server/tasks/refine_task.h"
#include "tests/shapes/build.h"
#include "tests/support/payload_text.h"

namespace subdivd::proto {
namespace {

constexpr Limits kRoomy{.max_level = 8, .max_output_bytes = Count{8} << 30, .max_body_bytes = Count{1} << 30};

#ifdef __GLIBC__
// Memory once got from the system is kept: otherwise half of what is measured are pages given out and taken
// back.
[[maybe_unused]] const bool kWarm =
    mallopt(M_MMAP_MAX, 0) == 1 && mallopt(M_TRIM_THRESHOLD, 2'000'000'000) == 1;
#endif

// Texture coordinates with a seam across and a seam along the torus.
Primvar texture(const ControlMesh& torus, Index side) {
  Primvar primvar{"st", Interpolation::face_varying, 2, {}, {}};
  for (Index row = 0; row <= side; ++row)
    for (Index column = 0; column <= side; ++column)
      primvar.values.insert(primvar.values.end(), {double(column) / side, double(row) / side});
  const auto& corners = torus.face_vertex_indices;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const std::size_t face = corner / 3 * 3;
    bool last_row = false, last_column = false;
    for (std::size_t k = face; k < face + 3; ++k) {
      last_row |= corners[k] / side == side - 1;
      last_column |= corners[k] % side == side - 1;
    }
    const Index row = corners[corner] / side, column = corners[corner] % side;
    primvar.indices.push_back((row == 0 && last_row ? side : row) * (side + 1) +
                              (column == 0 && last_column ? side : column));
  }
  return primvar;
}

// A torus of 2 * side * side triangles, alone or with normals and texture coordinates.
enum class Content { positions, all };

RefineRequest torus_request(Index side, Format format, Content content, Index level) {
  RefineRequest request;
  request.meshes.push_back(shapes::big_torus(side, side, 1));
  request.mesh_forms.resize(1);
  request.face_origins.resize(1);
  request.options.level = level;
  request.options.format = format;
  if (content == Content::all) {
    request.options.normals = true;
    request.meshes[0].primvars.push_back(texture(request.meshes[0], side));
  }
  return request;
}

AnyAnswer answer_to(const RefineRequest& request) { return *server::tasks::compute(request, kRoomy); }

std::string glb_of(Index side, Content content) {
  const RefineRequest request = torus_request(side, Format::glb, content, 0);
  return test::text_of(*encode_refine(request, answer_to(request)));
}

// The same mesh in lines, with 6 decimals; with all its content corners are "7/3".
std::string obj_of(Index side, Content content) {
  const ControlMesh mesh = shapes::big_torus(side, side, 1);
  const bool textured = content == Content::all;
  const Primvar st = textured ? texture(mesh, side) : Primvar{};
  std::string body;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    body += (k % 3 == 0 ? "v " : " ") + std::to_string(mesh.points[k]) + (k % 3 == 2 ? "\n" : "");
  for (std::size_t k = 0; k < st.values.size(); ++k)
    body += (k % 2 == 0 ? "vt " : " ") + std::to_string(st.values[k]) + (k % 2 == 1 ? "\n" : "");
  for (std::size_t k = 0; k < mesh.face_vertex_indices.size(); ++k) {
    body += (k % 3 == 0 ? "f " : " ") + std::to_string(mesh.face_vertex_indices[k] + 1);
    if (textured) body += '/' + std::to_string(st.indices[k] + 1);
    if (k % 3 == 2) body += '\n';
  }
  return body;
}

std::string off_of(Index side) {
  const ControlMesh mesh = shapes::big_torus(side, side, 1);
  std::string body =
      "OFF\n" + std::to_string(mesh.point_count()) + ' ' + std::to_string(mesh.face_count()) + " 0\n";
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    body += std::to_string(mesh.points[k]) + (k % 3 == 2 ? '\n' : ' ');
  for (std::size_t k = 0; k < mesh.face_vertex_indices.size(); ++k)
    body +=
        (k % 3 == 0 ? "3 " : "") + std::to_string(mesh.face_vertex_indices[k]) + (k % 3 == 2 ? '\n' : ' ');
  return body;
}

// Every number as it is usually written: 6 decimals.
std::string json_of(Index side) {
  const ControlMesh mesh = shapes::big_torus(side, side, 1);
  std::string body = R"({"points":)";
  for (std::size_t k = 0; k < mesh.points.size(); k += 3) {
    body += k == 0 ? "[[" : ",[";
    for (std::size_t c = 0; c < 3; ++c) {
      if (c > 0) body += ',';
      body += std::to_string(mesh.points[k + c]);
    }
    body += ']';
  }
  body += R"(],"faceVertexIndices":)";
  for (std::size_t k = 0; k < mesh.face_vertex_indices.size(); ++k) {
    body += k == 0 ? '[' : ',';
    body += std::to_string(mesh.face_vertex_indices[k]);
  }
  return body + "]}";
}

void read(benchmark::State& state, Format format, Content content) {
  const auto side = static_cast<Index>(state.range(0));
  const std::string body = format == Format::json  ? json_of(side)
                           : format == Format::obj ? obj_of(side, content)
                           : format == Format::off ? off_of(side)
                                                   : glb_of(side, content);
  const BodyKind kind = format == Format::json  ? BodyKind::json
                        : format == Format::obj ? BodyKind::obj
                        : format == Format::off ? BodyKind::off
                                                : BodyKind::glb;
  for (auto _ : state) benchmark::DoNotOptimize(decode_refine(body, kind, {}, kRoomy));
  state.SetBytesProcessed(static_cast<std::int64_t>(body.size()) * state.iterations());
  state.counters["MB"] = static_cast<double>(body.size()) / 1e6;
}

// Numbers in the arrays of a JSON answer: those that are no indices, and all.
std::pair<Count, Count> numbers_in(const AnyAnswer& answer) {
  return std::visit(
      [](const auto& typed) {
        const auto& mesh = typed.meshes[0];
        Count reals = mesh.points.size() + mesh.normals.size(), indices = mesh.faces.size();
        for (const auto& primvar : mesh.primvars)
          reals += primvar.values.size(), indices += primvar.indices.size();
        return std::pair{reals, reals + indices};
      },
      answer);
}

// The answer to a torus of level 2, as the server has it when refinement is done: GLB requests know where
// their vertices split.
void write(benchmark::State& state, Format format, Content content) {
  const auto side = static_cast<Index>(state.range(0));
  RefineRequest request = torus_request(side, format, content, 2);
  if (format == Format::glb) {
    request = *decode_refine(glb_of(side, content), BodyKind::glb, {}, kRoomy);
    request.options.level = 2;
  }
  const AnyAnswer answer = answer_to(request);
  Count bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    {
      AnyAnswer copy = answer;  // encoding consumes it
      state.ResumeTiming();
      const Result<Payload> payload = encode_refine(request, std::move(copy));
      // Lines are made while they are sent: both times count.
      if (is_text(format))
        for (const Chunk& chunk : payload->chunks)
          while (chunk.maker && !chunk.maker->next().empty()) {
          }
      state.PauseTiming();
      bytes += payload->size();
    }
    state.ResumeTiming();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  using benchmark::Counter;
  state.counters["MB"] = static_cast<double>(bytes) / 1e6 / static_cast<double>(state.iterations());
  if (format != Format::json) return;
  const auto [reals, numbers] = numbers_in(answer);
  state.counters["reals"] = Counter(static_cast<double>(reals), Counter::kIsIterationInvariantRate);
  state.counters["numbers"] = Counter(static_cast<double>(numbers), Counter::kIsIterationInvariantRate);
}

#define WIRE_BENCHMARK(way, name, format, content) \
  BENCHMARK_CAPTURE(way, name, Format::format, Content::content)->Unit(benchmark::kMillisecond)
WIRE_BENCHMARK(read, json, json, positions)->Arg(100)->Arg(860);
WIRE_BENCHMARK(read, glb, glb, positions)->Arg(100)->Arg(860);
WIRE_BENCHMARK(read, glb_textured, glb, all)->Arg(100)->Arg(860);
WIRE_BENCHMARK(read, obj, obj, positions)->Arg(100)->Arg(860)->Arg(1200);
WIRE_BENCHMARK(read, obj_textured, obj, all)->Arg(100)->Arg(860);
WIRE_BENCHMARK(read, off, off, positions)->Arg(100)->Arg(860);
WIRE_BENCHMARK(write, json, json, positions)->Arg(25)->Arg(175);
WIRE_BENCHMARK(write, json_textured, json, all)->Arg(25)->Arg(175);
WIRE_BENCHMARK(write, glb, glb, positions)->Arg(25)->Arg(175);
WIRE_BENCHMARK(write, glb_textured, glb, all)->Arg(25)->Arg(175);

WIRE_BENCHMARK(write, obj, obj, positions)->Arg(25)->Arg(175);
WIRE_BENCHMARK(write, obj_textured, obj, all)->Arg(25)->Arg(175);
WIRE_BENCHMARK(write, off, off, positions)->Arg(25)->Arg(175);

}  // namespace
}  // namespace subdivd::proto
