// What reading a body and computing on curves allocate, counted, against what they took from their budget and
// what was predicted. A program of its own: it replaces operator new.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <string>

#include "core/base/budget.h"
#include "proto/curve_task.h"
#include "proto/decode.h"
#include "server/tasks/compute_curves.h"
#include "tests/support/allocations.h"

namespace subdivd::server::tasks {
namespace {

using Kind = proto::CurveTaskKind;

// Blocks are as large as the allocator gives them.
constexpr Count kSlack = 65536;

class Ledger final : public MemoryGrant {
 public:
  Result<void> take(Count bytes) override {
    taken += bytes;
    return {};
  }
  Count taken = 0;
};

std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

struct Measured {
  Count peak = 0, promised = 0;
};

void expect_kept(const char* name, const Measured& measured, double most_over) {
  const double over = static_cast<double>(measured.promised) / static_cast<double>(measured.peak + 1);
  std::cout << name << ": peak " << measured.peak << ", promised " << measured.promised << ", " << over
            << '\n';
  EXPECT_LE(measured.peak, measured.promised + kSlack) << name;
  if (most_over > 0) {
    EXPECT_LE(over, most_over) << name;
  }
}

Measured read(const std::string& body) {
  Ledger ledger;
  Budget budget;
  budget.memory = &ledger;
  Measured measured;
  {
    const test::Allocations count;
    const auto request = proto::decode_refine(body, proto::BodyKind::json, {}, {}, budget);
    measured.peak = static_cast<Count>(count.peak_bytes());
  }
  measured.promised = ledger.taken;
  return measured;
}

// A strip of triangles.
std::string mesh(std::size_t rows, bool nested, const std::string& members = {}) {
  std::string points, faces;
  for (std::size_t i = 0; i < 2 * rows; ++i) {
    const std::string at = std::to_string(static_cast<double>(i) / 7) + ",0.125," + std::to_string(i % 2);
    points += (i > 0 ? "," : "") + (nested ? "[" + at + "]" : at);
    if (i + 2 >= 2 * rows) continue;
    const std::string face = std::to_string(i) + ',' + std::to_string(i % 2 ? i + 2 : i + 1) + ',' +
                             std::to_string(i % 2 ? i + 1 : i + 2);
    faces += (i > 0 ? "," : "") + (nested ? "[" + face + "]" : face);
  }
  return "{\"points\":[" + points + "],\"faceVertexIndices\":[" + faces + "]" + members + "}";
}

const std::string kSmallMesh = R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]},)";
const std::string kSmallCurve = R"({"points":[[0],[1]]},)";
const std::string kSmallSurface =
    R"({"uVertexCount":2,"vVertexCount":2,"degree":1,"points":[[0],[1],[2],[3]]},)";

std::string primvars(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += (i > 0 ? ",\"" : "\"") + std::to_string(i) + R"(":{"values":[0,1,2],"elementSize":1})";
  return text;
}

// One crease along the strip, from one side to the other and back.
std::string creased(std::size_t points) {
  std::string crease = "0";
  for (std::size_t i = 1; i < points; ++i) crease += "," + std::to_string(i);
  return ",\"creaseIndices\":[" + crease + "],\"creaseLengths\":[" + std::to_string(points) +
         "],\"creaseSharpnesses\":[1]";
}

TEST(Memory, of_reading_is_taken_beforehand_and_not_much_more) {
  for (const std::size_t rows : {std::size_t{1000}, std::size_t{20000}})
    for (const bool nested : {true, false})
      expect_kept(nested ? "nested mesh" : "flat mesh", read(mesh(rows, nested)), rows > 1000 ? 3 : 0);
}

TEST(Memory, of_reading_hostile_bodies_is_taken_beforehand) {
  constexpr std::size_t kMany = 500000;
  const std::string bodies[] = {
      R"({"points":[)" + repeated("0,", kMany) + "0]}",
      R"({"points":[)" + repeated("[0,0,0],", kMany) + "0]}",
      R"({"faceVertexIndices":[)" + repeated("[],", kMany) + "[]]}",
      R"({"faceVertexIndices":[)" + repeated("[0],", kMany) + "[0]]}",
      R"({"points":[)" + repeated("{},", kMany) + "0]}",
      // One more than a vector that grows has room for.
      R"({"meshes":[)" + repeated(kSmallMesh, 32768) + kSmallMesh.substr(0, kSmallMesh.size() - 1) + "]}",
      R"({"curves":[)" + repeated(kSmallCurve, 32768) + kSmallCurve.substr(0, kSmallCurve.size() - 1) + "]}",
      R"({"surfaces":[)" + repeated(kSmallSurface, 32768) +
          kSmallSurface.substr(0, kSmallSurface.size() - 1) + "]}",
      R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"primvars":{)" + primvars(1025) + "}}",
      R"({"meshes":[)" +
          repeated(R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"primvars":{)" + primvars(5) +
                       "}},",
                   10000) +
          kSmallMesh.substr(0, kSmallMesh.size() - 1) + "]}",
      R"({"meshes":[)" + repeated(R"({"points":[],"faceVertexIndices":[]},)", 60000) + "{}]}",
      R"({"curves":[)" + repeated(R"({"points":[]},)", 60000) + "{}]}",
      R"({"surfaces":[)" + repeated("{},", 60000) + "{}]}",
      R"({"points":[],"primvars":{)" + repeated("\"a\":{},", kMany) + "\"a\":{}}}",
      R"({"name":")" + repeated("\\u00e9", kMany) + "\"}",
      R"({"statistics":[)" + repeated("{},", kMany) + "0]}",
      R"({"curves":[{"points":[[0]],"curveVertexCounts":[)" + repeated("1,", kMany) + "1]}]}",
      R"({"points":[)" + repeated("\",\",", kMany) + "0]}",
      mesh(20000, true, R"(,"options":{"triangulate":true},"holeIndices":[0,1,2])"),
      mesh(20000, false, creased(40000)),
      R"({"statistics":")" + repeated("\\u00e9", kMany) + "\"}",
      R"({"statistics":{")" + repeated("\\u00e9", kMany) + "\":0}}",
      R"({"statistics":")" + repeated("x", kMany) + "\\n\"}",
  };
  for (const std::string& body : bodies) expect_kept(body.substr(0, 60).c_str(), read(body), 0);
}

Measured compute(Kind kind, const std::string& body) {
  Measured measured;
  Ledger ledger;
  Budget budget;
  budget.memory = &ledger;
  auto request = proto::decode_curves(body, kind, {}, {});
  EXPECT_TRUE(request.ok()) << request.error().message;
  const auto predicted = predict_curve_task(*request, Count{1} << 40);
  const test::Allocations count;
  const auto encoded = [&]() -> Result<proto::Payload> {
    if (kind == Kind::measure) {
      auto measures = compute_measures(*request, budget);
      if (!measures) return std::move(measures).error();
      return encode_measures(*request, *measures, budget);
    }
    if (kind == Kind::evaluate && request->task.on_surfaces) {
      auto samples = compute_surface_samples(*request, budget);
      if (!samples) return std::move(samples).error();
      return encode_samples(*request, *samples, budget);
    }
    if (kind == Kind::evaluate) {
      auto samples = compute_samples(*request, budget);
      if (!samples) return std::move(samples).error();
      return encode_samples(*request, *samples, budget);
    }
    auto edited = compute_edited(*request, budget);
    if (!edited) return std::move(edited).error();
    return encode_edited(*request, *std::move(edited), budget);
  }();
  EXPECT_TRUE(encoded.ok()) << encoded.error().message;
  measured.peak = static_cast<Count>(count.peak_bytes());
  measured.promised = ledger.taken + *predicted;
  return measured;
}

std::string wave(std::size_t count, std::size_t width) {
  std::string points;
  for (std::size_t i = 0; i < count; ++i) {
    points += i > 0 ? ",[" : "[";
    for (std::size_t k = 0; k < width; ++k)
      points += (k > 0 ? "," : "") + std::to_string(static_cast<double>((i * (k + 7)) % 13));
    points += "]";
  }
  return "\"points\":[" + points + "]";
}

std::string numbers(std::size_t count, double most, double first = 0) {
  std::string text = "[" + std::to_string(first);
  for (std::size_t i = 1; i < count; ++i)
    text += "," + std::to_string(most * static_cast<double>(i) / static_cast<double>(count));
  return text + "]";
}

std::string counted(std::size_t count) {
  std::string text = "[0";
  for (std::size_t i = 1; i < count; ++i) text += "," + std::to_string(i);
  return text + "]";
}

TEST(Memory, of_tasks_on_curves_is_promised) {
  constexpr std::size_t kPoints = 9001;  // 3 k + 1
  const struct {
    const char* name;
    Kind kind;
    std::string body;
  } tasks[] = {
      {"measure, one dimension", Kind::measure, "{" + wave(kPoints, 1) + R"(,"tolerance":1e-3})"},
      {"measure", Kind::measure, "{" + wave(kPoints, 3) + R"(,"tolerance":1e-6})"},
      {"measure, degree 9", Kind::measure, "{" + wave(kPoints, 3) + R"(,"degree":9,"tolerance":1e-4})"},
      {"measure Bezier", Kind::measure, "{" + wave(kPoints, 2) + R"(,"basis":"bezier","tolerance":1e-4})"},
      {"measure Catmull-Rom", Kind::measure,
       "{" + wave(kPoints, 2) + R"(,"basis":"catmullRom","tolerance":1e-4})"},
      {"measure many", Kind::measure,
       "{" + wave(9000, 2) + R"(,"tolerance":1e-4,"curveVertexCounts":[)" + repeated("4,", 2249) + "4]}"},
      {"closest", Kind::measure,
       "{" + wave(1000, 2) + R"(,"tolerance":1e-3,"closestTo":[)" + repeated("[1,2],", 199) + "[5,5]]}"},
      {"flatten", Kind::measure, "{" + wave(3000, 3) + R"(,"tolerance":1e-3,"flatten":0.05})"},
      {"flatten four-point", Kind::measure, "{" + wave(3000, 3) + R"(,"basis":"fourPoint","flatten":0.05})"},
      {"equal lengths", Kind::measure, "{" + wave(300, 3) + R"(,"tolerance":1e-3,"equalLengths":3000})"},
      {"convergence", Kind::measure, R"({"points":[[0,0],[1,1],[2,0],[3,1]],"convergence":18})"},
      {"evaluate", Kind::evaluate,
       "{" + wave(3000, 3) + R"(,"derivatives":2,"frames":true,"samples":{"ts":)" + numbers(20000, 2900) +
           "}}"},
      {"evaluate, one dimension", Kind::evaluate,
       "{" + wave(3000, 1) + R"(,"samples":{"ts":)" + numbers(20000, 2900) + "}}"},
      {"evaluate many", Kind::evaluate,
       "{" + wave(20000, 2) + R"(,"degree":1,"curveVertexCounts":[)" + repeated("2,", 9999) +
           R"(2],"samples":{"curves":)" + counted(10000) + R"(,"ts":[)" + repeated("0.5,", 9999) + "1]}}"},
      {"evaluate many Bezier", Kind::evaluate,
       "{" + wave(40000, 2) + R"(,"basis":"bezier","curveVertexCounts":[)" + repeated("4,", 9999) +
           R"(4],"samples":{"curves":)" + counted(10000) + R"(,"ts":[)" + repeated("0.5,", 9999) + "1]}}"},
      {"evaluate four-point", Kind::evaluate,
       "{" + wave(3000, 2) + R"(,"basis":"fourPoint","samples":{"ts":)" + numbers(5000, 2900) + "}}"},
      {"evaluate surfaces", Kind::evaluate,
       R"({"type":"bsplineSurface","uVertexCount":4,)" + wave(16, 1) +
           R"(,"derivatives":2,"samples":{"us":)" + numbers(20000, 1) + R"(,"vs":)" + numbers(20000, 1) +
           "}}"},
      {"insert", Kind::insert_knot,
       "{" + wave(kPoints, 2) + R"(,"insert":)" + numbers(3000, 2900, 0.5) + "}"},
      {"convert to Bezier", Kind::convert, "{" + wave(kPoints, 1) + R"(,"to":"bezier"})"},
      {"convert to Hermite", Kind::convert, "{" + wave(kPoints, 1) + R"(,"to":"hermite"})"},
      {"raise the degree", Kind::convert, "{" + wave(1000, 2) + R"(,"toDegree":9})"},
      {"remove", Kind::remove_knot, "{" + wave(600, 2) + R"(,"tolerance":0.5})"},
      {"join many", Kind::convert,
       R"({"join":true,"tolerance":100,"curves":[{"degree":1,)" + wave(8000, 2) +
           R"(,"curveVertexCounts":[)" + repeated("2,", 3999) + "2]}]}"},
      {"join", Kind::convert,
       R"({"join":true,"tolerance":100,"curves":[)" + repeated("{" + wave(40, 2) + "},", 29) + "{" +
           wave(40, 2) + "}]}"},
  };
  for (const auto& task : tasks) expect_kept(task.name, compute(task.kind, task.body), 0);
}

// Two counts for a knot vector of degree 63 were promised for every one of them: 20,000 bytes in the place of
// some hundred.
TEST(Memory, of_many_small_curves_that_are_edited_is_promised_and_not_much_more) {
  constexpr std::size_t kCurves = 10000;
  const std::string cubics =
      wave(4 * kCurves, 3) + R"(,"curveVertexCounts":[)" + repeated("4,", kCurves - 1) + "4]";
  std::string knots = "0,0,0,0,1,1,1,1";
  for (std::size_t i = 1; i < kCurves; ++i) knots += ",0,0,0,0,1,1,1,1";
  const std::string on_knots = cubics + R"(,"type":"nurbs","order":[4],"knots":[)" + knots + "]";
  const std::string weighted =
      on_knots + R"(,"pointWeights":[)" + repeated("0.3333333333333333,", 4 * kCurves - 1) + "2]";
  const std::string apart = R"("curves":[)" +
                            repeated("{" + wave(4, 1) + R"(,"name":"\u0001\u0001"},)", kCurves - 1) + "{" +
                            wave(4, 1) + "}]";
  const struct {
    const char* name;
    Kind kind;
    std::string body;
    double most_over;
  } tasks[] = {
      {"insert, many", Kind::insert_knot, "{" + cubics + R"(,"insert":[0.3,0.7]})", 5},
      {"insert, many on knots", Kind::insert_knot, "{" + on_knots + R"(,"insert":[0.3,0.7]})", 5},
      {"insert, many with weights", Kind::insert_knot, "{" + weighted + R"(,"insert":[0.3]})", 5},
      {"insert, many apart", Kind::insert_knot, "{" + apart + R"(,"insert":[0.3]})", 0},
      {"remove, many", Kind::remove_knot, "{" + cubics + R"(,"tolerance":0.1})", 5},
      {"remove from a list, many", Kind::remove_knot, "{" + cubics + R"(,"remove":[1],"tolerance":100})", 5},
      {"to NURBS, many", Kind::convert, "{" + weighted + R"(,"reversed":true})", 5},
      {"to NURBS, many apart", Kind::convert, "{" + apart + "}", 0},
      {"to Bezier, many", Kind::convert, "{" + cubics + R"(,"to":"bezier"})", 5},
      {"to B-splines, many", Kind::convert, "{" + cubics + R"(,"wrap":"periodic","to":"bspline"})", 5},
      {"to Hermite, many", Kind::convert, "{" + on_knots + R"(,"to":"hermite"})", 8},
      {"to Catmull-Rom, many", Kind::convert, "{" + on_knots + R"(,"to":"catmullRom"})", 8},
      {"degree 20, many", Kind::convert, "{" + on_knots + R"(,"toDegree":20})", 5},
      {"degree 2, many", Kind::convert, "{" + on_knots + R"(,"toDegree":2,"tolerance":1000})", 8},
      {"join, many cubics", Kind::convert, "{" + weighted + R"(,"join":true,"tolerance":1000})", 8},
      {"join, many to Bezier", Kind::convert,
       "{" + cubics + R"(,"join":true,"to":"bezier","tolerance":1000})", 8},
  };
  for (const auto& task : tasks) expect_kept(task.name, compute(task.kind, task.body), task.most_over);
}

// One long curve: what it takes meanwhile counts.
TEST(Memory, of_a_long_curve_that_is_edited_is_promised) {
  constexpr std::size_t kPoints = 9001;
  const std::string cubic = wave(kPoints, 1);
  const std::string bezier = wave(kPoints, 3) + R"(,"basis":"bezier")";
  const struct {
    const char* name;
    Kind kind;
    std::string body;
  } tasks[] = {
      {"degree 63", Kind::convert, "{" + wave(1000, 1) + R"(,"toDegree":63})"},
      {"degree 63 in space", Kind::convert, "{" + wave(1000, 3) + R"(,"toDegree":63})"},
      {"degree 1", Kind::convert, "{" + cubic + R"(,"degree":9,"toDegree":1,"tolerance":1e6})"},
      {"degree 2 of Bezier", Kind::convert, "{" + bezier + R"(,"toDegree":2,"tolerance":1e6})"},
      {"a part backwards", Kind::convert,
       "{" + cubic + R"(,"range":[0.5,8999.5],"reversed":true,"domain":[0,1]})"},
      {"to Catmull-Rom", Kind::convert, "{" + wave(kPoints, 2) + R"(,"to":"catmullRom","tolerance":1e6})"},
      {"to a B-spline", Kind::convert, "{" + bezier + R"(,"to":"bspline","tolerance":1e6})"},
      {"remove a list", Kind::remove_knot, "{" + cubic + R"(,"remove":)" + numbers(8990, 8990, 1) + "}"},
      {"remove what can be", Kind::remove_knot, "{" + cubic + R"(,"tolerance":1e6})"},
      {"insert into all", Kind::insert_knot, "{" + cubic + R"(,"insert":)" + numbers(30000, 8990, 0.5) + "}"},
  };
  for (const auto& task : tasks) expect_kept(task.name, compute(task.kind, task.body), 0);
}

// AddressSanitizer and ThreadSanitizer reserve terabytes of addresses.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void read_with_little_memory(const std::string& body) {
  std::ifstream status("/proc/self/statm");
  rlim_t pages = 0;
  status >> pages;
  const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{8} << 20);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  try {
    const auto request = proto::decode_refine(body, proto::BodyKind::json, {}, {});
    std::_Exit(request.ok() ? 0 : 1);
  } catch (const std::bad_alloc&) {
    std::_Exit(42);
  }
}

// It was told to be no JSON.
TEST(Memory, that_the_system_has_not_is_no_fault_of_the_body) {
  const std::string body = R"({"curves":[{"points":[)" + repeated("0,", 24'000'000) + "0]}]}";
  EXPECT_EXIT(read_with_little_memory(body), testing::ExitedWithCode(42), "");
}
#endif

}  // namespace
}  // namespace subdivd::server::tasks
