#include "tests/soak/requests.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace subdivd::soak {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kGlb = "Content-Type: model/gltf-binary\r\n";

void add(std::vector<Request>& list, std::string kind, int weight, std::string bytes, bool small = false) {
  list.push_back({.kind = std::move(kind), .bytes = std::move(bytes), .weight = weight, .small = small});
}

void add_refused(std::vector<Request>& list, int status, const std::string& why, std::string bytes) {
  list.push_back({.kind = std::to_string(status) + ": " + why, .bytes = std::move(bytes), .status = status});
}

void add_plain(std::vector<Request>& list) {
  add(list, "GET /livez", 20, get("/livez"), true);
  add(list, "GET /readyz", 3, get("/readyz"), true);
  add(list, "GET /", 1, get("/"));
  add(list, "GET /openapi.json", 2, get("/openapi.json"));
  add(list, "GET /v1/schemes", 3, get("/v1/schemes"), true);
  for (const int valence : {3, 4, 7, 12, 30})
    add(list, "GET /v1/schemes/loop/N", 1, get("/v1/schemes/loop/" + std::to_string(valence)));
}

// Levels 0 to 5: few faces and many levels, many faces and few.
void add_meshes(std::vector<Request>& list) {
  struct Case {
    int squares, level, weight;
    const char* options;
  };
  constexpr Case kCases[] = {
      {1, 5, 4, ""},
      {2, 4, 4, "&limit=true"},
      {4, 5, 2, "&normals=true"},
      {6, 3, 4, "&format=glb"},
      {10, 3, 3, "&precision=single"},
      {12, 4, 2, "&format=glb&limit=true&normals=true"},
      {20, 2, 3, ""},
      {30, 2, 2, "&loopWeights=warren"},
      {40, 1, 2, "&normals=true&limit=true"},
      {60, 0, 2, ""},
      {100, 1, 1, "&format=glb"},
      {150, 0, 1, "&precision=single"},
  };
  for (const Case& each : kCases) {
    const std::string level = std::to_string(each.level);
    add(list, "mesh, level " + level, each.weight,
        post("/v1/refine?level=" + level + each.options, sheet_json(each.squares, each.squares)));
  }
  add(list, "tetrahedron, level 1", 20, post("/v1/refine?level=1", kTetrahedron), true);
  add(list, "tetrahedron, level 5", 3, post("/v1/refine?level=5", kTetrahedron));
  add(list, "creased mesh", 3,
      post("/v1/refine?level=3", sheet_json(8, 8,
                                            R"(,"creaseIndices":[9,10,11,12],"creaseLengths":[4],)"
                                            R"("creaseSharpnesses":[2.5],"cornerIndices":[0],)"
                                            R"("cornerSharpnesses":["infinite"],"holeIndices":[3])")));
}

void add_assets(std::vector<Request>& list, const std::string& sources) {
  const std::string glb = file_text(sources + "/tests/shapes/sample.glb");
  for (const int level : {0, 1, 2, 3})
    add(list, "GLB, level " + std::to_string(level), 2,
        post("/v1/refine?level=" + std::to_string(level) + "&normals=true", glb, kGlb));
  add(list, "GLB to glTF", 1, post("/v1/refine?level=1&format=gltf", glb, kGlb));
  add(list, "GLB to JSON", 1, post("/v1/refine?level=2&format=json", glb, kGlb));
  const std::string curve = file_text(sources + "/tests/shapes/curve.json");
  add(list, "curves", 4, post("/v1/refine?level=4&normals=true", curve));
  add(list, "curves to GLB", 2, post("/v1/refine?level=5&format=glb", curve));
  const std::string house = file_text(sources + "/tests/shapes/house.json");
  for (const int level : {0, 1, 4})
    add(list, "polygons, level " + std::to_string(level), 3,
        post("/v1/refine?normals=true&limit=true&level=" + std::to_string(level), house));
  add(list, "polygons to GLB", 3, post("/v1/refine?level=3&format=glb&normals=true", house));
  add(list, "polygons to GLB, marked", 1, post("/v1/refine?level=1&format=glb&ngons=true", house));
  add(list, "polygons to OBJ", 2, post("/v1/refine?level=3&format=obj&normals=true", house));
  add(list, "polygons to OFF", 1, post("/v1/refine?level=2&format=off&faces=triangles", house));
  add(list, "verify polygons", 1, post("/v1/verify?level=2&limit=true", house));
  add(list, "GLB by Catmull-Clark", 2,
      post("/v1/refine?level=2&subdivisionScheme=catmullClark&normals=true", glb, kGlb));
  add(list, "triangles by Catmull-Clark", 2,
      post("/v1/refine?level=2&subdivisionScheme=catmullClark", sheet_json(30, 30)));
  add(list, "butterfly", 1,
      post("/v1/refine?level=2&subdivisionScheme=butterfly&normals=true&format=glb", sheet_json(8, 8)));
  add(list, "bilinear", 1, post("/v1/refine?level=3&subdivisionScheme=bilinear", sheet_json(10, 10)));
  add(list, "verify", 2, post("/v1/verify?level=3", file_text(sources + "/tests/shapes/cube.json")));
  add(list, "verify", 2, post("/v1/verify?level=2&limit=true", sheet_json(8, 8)));
  add(list, "verify", 2, post("/v1/verify?level=4", curve));
}

// Every example that the API shows, under the path that shows it.
void add_examples(std::vector<Request>& list) {
  const Json document = Json::parse(file_text(SUBDIVD_OPENAPI));
  for (const auto& [path, operations] : document.at("paths").items()) {
    if (!operations.contains("post")) continue;
    const Json& content = operations.at("post").at("requestBody").at("content");
    if (!content.contains("application/json")) continue;
    // Warren's weights, which one example chooses, have nothing to be compared with.
    const std::string choice = path == "/v1/verify" ? "?loopWeights=loop" : "";
    for (const Json& example : content.at("application/json").value("examples", Json::object()))
      add(list, "example of " + path, 2, post(path + choice, example.at("value").dump()));
  }
}

}  // namespace

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string get(std::string_view target, std::string_view headers, std::string_view method) {
  return std::string(method) + " " + std::string(target) + " HTTP/1.1\r\nHost: soak\r\n" +
         std::string(headers) + "\r\n";
}

std::string post(std::string_view target, std::string_view body, std::string_view headers) {
  return get(target, "Content-Length: " + std::to_string(body.size()) + "\r\n" + std::string(headers),
             "POST") +
         std::string(body);
}

std::string chunked_head(std::string_view target) {
  return get(target, "Transfer-Encoding: chunked\r\n", "POST");
}

std::string sheet_json(int columns, int rows, std::string_view extra) {
  std::string points, faces;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      points += "[" + std::to_string(x) + "," + std::to_string(y) + "," +
                std::to_string((x * 7 + y * 5) % 3) + "],";
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int a = y * (columns + 1) + x, c = a + columns + 1;
      for (const int corner : {a, a + 1, c + 1, a, c + 1, c}) faces += std::to_string(corner) + ",";
    }
  points.pop_back();
  faces.pop_back();
  return "{\"points\":[" + points + "],\"faceVertexIndices\":[" + faces + "]" + std::string(extra) + "}";
}

std::vector<Request> good_requests(const std::string& sources) {
  std::vector<Request> list;
  add_plain(list);
  add_meshes(list);
  add_assets(list, sources);
  add_examples(list);
  return list;
}

std::vector<Request> refused_requests(const std::string& sources) {
  const std::string mesh(kTetrahedron), glb = file_text(sources + "/tests/shapes/sample.glb");
  std::vector<Request> list;
  add_refused(list, 400, "no JSON", post("/v1/refine", "{\"points\":[[0,0,0],"));
  add_refused(list, 400, "half a GLB", post("/v1/refine", glb.substr(0, glb.size() / 2), kGlb));
  add_refused(list, 400, "a bad query", post("/v1/refine?level=x", mesh));
  add_refused(list, 400, "an unknown option", post("/v1/refine?levle=1", mesh));
  add_refused(list, 404, "no such path", get("/nowhere"));
  add_refused(list, 404, "no such path", post("/v1/nowhere", mesh));
  add_refused(list, 405, "the wrong method", get("/v1/refine"));
  add_refused(list, 405, "the wrong method", post("/livez", mesh));
  add_refused(list, 406, "nothing acceptable", post("/v1/refine", mesh, "Accept: image/png\r\n"));
  add_refused(list, 413, "too large a body", get("/v1/refine", "Content-Length: 5000000000\r\n", "POST"));
  add_refused(list, 415, "a foreign type", post("/v1/refine", mesh, "Content-Type: text/html\r\n"));
  add_refused(list, 415, "a compressed body", post("/v1/refine", mesh, "Content-Encoding: gzip\r\n"));
  add_refused(list, 422, "an index past the points",
              post("/v1/refine", R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,3]})"));
  add_refused(list, 422, "a misspelt member",
              post("/v1/refine", R"({"pionts":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})"));
  add_refused(list, 422, "polygons by Loop's scheme",
              post("/v1/refine?subdivisionScheme=loop", file_text(sources + "/tests/shapes/house.json")));
  add_refused(list, 422, "nothing to refine", post("/v1/refine", "{}"));
  add_refused(list, 422, "too high a level", post("/v1/refine?level=12", mesh));
  add_refused(list, 422, "too large an answer", post("/v1/refine?level=8", glb, kGlb));
  return list;
}

}  // namespace subdivd::soak
