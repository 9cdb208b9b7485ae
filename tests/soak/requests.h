#pragma once
// What well-behaved clients ask: requests that are answered 200, and requests that are refused with a known
// status.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace subdivd::soak {

struct Request {
  std::string kind;    // a row of the report
  std::string bytes;   // head and body
  int status = 200;    // what must come back
  int weight = 1;      // how often it is sent, relative to the others
  bool small = false;  // its latency is reported

  // Equal for equal requests.
  std::uint64_t identity() const { return identity_of(bytes); }
  static std::uint64_t identity_of(std::string_view bytes) { return std::hash<std::string_view>{}(bytes); }
};

std::string get(std::string_view target, std::string_view headers = {}, std::string_view method = "GET");
std::string post(std::string_view target, std::string_view body, std::string_view headers = {});
// The head of a POST whose body comes in chunks.
std::string chunked_head(std::string_view target);

// A sheet of columns x rows squares, each two triangles, as a JSON body; `extra` are more members.
std::string sheet_json(int columns, int rows, std::string_view extra = {});
inline constexpr std::string_view kTetrahedron =
    R"({"points":[[4,4,4],[-4,-4,4],[-4,4,-4],[4,-4,-4]],"faceVertexIndices":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]})";

// `sources` is the root of the project: bodies of tests/shapes and the examples of the OpenAPI document are
// sent. Each of them needs less than 64 MiB of memory.
std::vector<Request> good_requests(const std::string& sources);
std::vector<Request> refused_requests(const std::string& sources);
std::string file_text(const std::string& path);

}  // namespace subdivd::soak
