// The whole service over a real socket, in this process.
#include "server/http/application.h"

#include <gtest/gtest.h>

#include "server/log.h"
#include "server/transport/transport.h"
#include "tests/server/fake_service.h"
#include "tests/server/raw_client.h"

namespace subdivd::server::testing {
namespace {

const std::string kTetrahedron =
    R"({"points":[[1,1,1],[1,-1,-1],[-1,1,-1],[-1,-1,1]],"faceVertexIndices":[0,1,2,0,2,3,0,3,1,1,3,2]})";

Config quick_config() {
  Config config = default_config();
  config.max_body_bytes = 1'000'000;
  config.max_output_bytes = 10'000'000;
  config.max_memory_bytes = 1'000'000'000;
  config.threads = 8;
  return config;
}

TransportOptions options_of(const Config& config) {
  TransportOptions options;
  options.threads = config.threads;
  options.max_body_bytes = config.max_body_bytes;
  return options;
}

struct RunningApplication {
  explicit RunningApplication(Config wanted = quick_config())
      : config(std::move(wanted)),
        bodies(config.max_memory_bytes),
        application(config, config.max_memory_bytes),
        transport(options_of(config), application, bodies) {
    start_log("off");
    application.prepare();
    if (!transport.start()) throw std::runtime_error("cannot listen");
    port = transport.port();
  }
  RawResponse refine(const std::string& query, const std::string& headers = {},
                     const std::string& body = kTetrahedron) const {
    return ask(port, post("/v1/refine" + query, body, headers));
  }
  const Config config;
  RequestMemory bodies;
  Application application;
  Transport transport;
  int port = 0;
};

bool holds(const RawResponse& response, const std::string& text) {
  return response.body.find(text) != std::string::npos;
}

TEST(Application, refines_json) {
  const RunningApplication server;
  const RawResponse response = server.refine("?level=1");
  EXPECT_EQ(response.status, 200) << response.body;
  EXPECT_EQ(response.header("content-type"), "application/json");
  EXPECT_TRUE(holds(response, "\"points\""));
}
TEST(Application, takes_a_body_as_curl_sends_it) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("?level=1", "Content-Type: application/x-www-form-urlencoded\r\n").status, 200);
}
TEST(Application, gives_the_same_bytes_for_any_number_of_threads) {
  Config config = quick_config();
  config.max_level = 9;  // half a million points: enough for every step to be shared
  config.max_output_bytes = 100'000'000;
  config.request_threads = 1;
  const RunningApplication alone(config);
  config.request_threads = 4;
  const RunningApplication helped(config);
  const std::string query = "?level=9&format=glb&normals=1&limit=1";
  const RawResponse one = alone.refine(query), four = helped.refine(query);
  EXPECT_EQ(one.status, 200) << one.body;
  EXPECT_TRUE(one.body == four.body);
}
TEST(Application, answers_glb_when_the_query_wants_it) {
  const RunningApplication server;
  const RawResponse response = server.refine("?level=1&format=glb", "Accept: application/json\r\n");
  EXPECT_EQ(response.header("content-type"), "model/gltf-binary");
  EXPECT_EQ(response.body.substr(0, 4), "glTF");
}
TEST(Application, answers_glb_when_accept_wants_it) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("?level=1", "Accept: model/gltf-binary\r\n").body.substr(0, 4), "glTF");
}
TEST(Application, answers_obj_and_off_when_they_are_wanted) {
  const RunningApplication server;
  const RawResponse obj = server.refine("?level=1&format=obj"), off = server.refine("?level=1&format=off");
  EXPECT_EQ(obj.header("content-type"), "model/obj");
  EXPECT_EQ(obj.body.substr(0, 2), "v ");
  EXPECT_EQ(off.header("content-type"), "text/plain; charset=utf-8");
  EXPECT_EQ(off.body.substr(0, 12), "OFF\n10 16 0\n");
  EXPECT_EQ(server.refine("?level=1", "Accept: model/obj\r\n").body, obj.body);
  EXPECT_EQ(server.refine("?level=0&format=obj", {}, obj.body).body, obj.body);
  EXPECT_EQ(server.refine("?level=1&format=off&verify=1").status, 400);
  EXPECT_EQ(server.refine("?level=1&verify=1", "Accept: model/obj\r\n").status, 400);
  const std::string curve = R"({"points":[[0,0],[1,1],[2,0],[3,1]]})";
  EXPECT_EQ(ask(server.port, post("/v1/curves/refine?format=off", curve)).status, 400);
  EXPECT_TRUE(holds(ask(server.port, post("/v1/curves/refine?format=obj&level=0", curve)), "\nl 1 2 3 4\n"));
}
// Made while they are sent, in several pieces.
TEST(Application, sends_long_texts_whole) {
  Config config = quick_config();
  config.max_output_bytes = config.max_body_bytes = 100'000'000;
  const RunningApplication server(config);
  const std::string whole = server.refine("?level=7&format=obj").body;
  EXPECT_GT(whole.size(), 2'000'000u);
  EXPECT_EQ(whole.back(), '\n');
  EXPECT_TRUE(server.refine("?level=0&format=obj", {}, whole).body == whole);
}
// The choice was made when the request had been made ready for another format: left-handed faces stayed as they were.
TEST(Application, turns_left_handed_faces_for_what_accept_chooses) {
  const RunningApplication server;
  std::string left = kTetrahedron;
  left.insert(1, R"("orientation":"leftHanded",)");
  for (const auto& [type, format] : {std::pair("model/obj", "obj"), std::pair("model/gltf-binary", "glb")}) {
    const std::string query = std::string("?level=0&format=") + format;
    const RawResponse asked = server.refine(query, {}, left);
    EXPECT_EQ(server.refine("?level=0", std::string("Accept: ") + type + "\r\n", left).body, asked.body)
        << type;
    EXPECT_NE(server.refine(query).body, asked.body) << type;
  }
}
// Bodies once carried milliseconds, so that no two answers were equal and nothing could be cached.
TEST(Application, answers_equal_requests_with_equal_bytes) {
  const RunningApplication server;
  const std::string curve = R"({"points":[[0,0],[1,1],[2,0],[3,1]])";
  const std::pair<const char*, std::string> requests[] = {
      {"/v1/refine?level=2", kTetrahedron},
      {"/v1/refine?level=2&verify=true", kTetrahedron},
      {"/v1/refine?level=2&format=glb", kTetrahedron},
      {"/v1/refine?level=2&format=gltf&verify=true", kTetrahedron},
      {"/v1/refine?level=2&format=obj", kTetrahedron},
      {"/v1/refine?level=2&format=off", kTetrahedron},
      {"/v1/verify", kTetrahedron},
      {"/v1/curves/refine", curve + "}"},
      {"/v1/curves/measure", curve + "}"},
  };
  for (const auto& [target, body] : requests) {
    const RawResponse first = ask(server.port, post(target, body)),
                      second = ask(server.port, post(target, body));
    EXPECT_EQ(first.status, 200) << target << first.body;
    EXPECT_EQ(first.body, second.body) << target;
  }
}
TEST(Application, refines_its_own_glb) {
  const RunningApplication server;
  const std::string glb = server.refine("?level=1&format=glb").body;
  const RawResponse again = server.refine("?level=1", {}, glb);
  EXPECT_EQ(again.status, 200) << again.body;
  EXPECT_EQ(again.header("content-type"), "model/gltf-binary");
}
TEST(Application, answers_406_when_accept_admits_nothing) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("?level=1", "Accept: text/html\r\n").status, 406);
}
TEST(Application, answers_the_same_bytes_to_the_same_request_but_for_times) {
  const RunningApplication server;
  const std::string query = "?level=3&format=glb";
  const std::string a = server.refine(query).body, b = server.refine(query).body;
  const auto geometry = [](const std::string& glb) { return glb.substr(glb.size() / 2); };
  EXPECT_EQ(geometry(a), geometry(b));
}
TEST(Application, verifies_against_the_oracle) {
  const RunningApplication server;
  const RawResponse response = ask(server.port, post("/v1/verify?level=2", kTetrahedron));
  EXPECT_EQ(response.status, 200) << response.body;
  EXPECT_TRUE(holds(response, "OpenSubdiv"));
  EXPECT_TRUE(holds(response, "\"passed\":true"));
}
// A box with a triangle on one side and a pentagon on the other, in every form that has such faces.
TEST(Application, verifies_quads_and_polygons_of_any_body) {
  const RunningApplication server;
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.5 1.5 0\n"
      "f 1 4 9 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 4 1 5 8\nf 3 9 7\nf 9 4 8 7\n";
  const std::string off =
      "OFF\n9 7 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n0.5 1.5 0\n"
      "5 0 3 8 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 3 0 4 7\n3 2 8 6\n4 8 3 7 6\n";
  const std::string json =
      R"({"points":[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1],[0.5,1.5,0]],)"
      R"("faceVertexIndices":[[0,3,8,2,1],[4,5,6,7],[0,1,5,4],[1,2,6,5],[3,0,4,7],[2,8,6],[8,3,7,6]]})";
  for (const std::string& body : {obj, off, json})
    for (const char* scheme : {"catmullClark", "bilinear"}) {
      const std::string query = std::string("?level=2&limit=true&normals=true&subdivisionScheme=") + scheme;
      const RawResponse report = ask(server.port, post("/v1/verify" + query, body));
      EXPECT_EQ(report.status, 200) << report.body;
      EXPECT_TRUE(holds(report, "\"verification\":{\"oracle\":\"OpenSubdiv 3.5.0 Far\",\"passed\":true"))
          << report.body;
      EXPECT_TRUE(holds(report, "\"faces\":112")) << report.body;
      EXPECT_TRUE(holds(ask(server.port, post("/v1/refine" + query + "&verify=true&format=json", body)),
                        "\"passed\":true"));
    }
}
TEST(Application, attaches_the_report_on_request) {
  const RunningApplication server;
  EXPECT_TRUE(holds(server.refine("?level=1&verify=true"), "OpenSubdiv"));
}
TEST(Application, verify_answers_json_only) {
  const RunningApplication server;
  EXPECT_EQ(ask(server.port, post("/v1/verify", kTetrahedron, "Accept: model/gltf-binary\r\n")).status, 406);
}
TEST(Application, points_at_the_fault_in_a_body) {
  const RunningApplication server;
  const RawResponse response =
      server.refine("", {}, R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,7]})");
  EXPECT_EQ(response.status, 422) << response.body;
  EXPECT_EQ(response.header("content-type"), "application/problem+json");
  EXPECT_TRUE(holds(response, "/faceVertexIndices/2")) << response.body;
}
TEST(Application, answers_400_to_a_body_that_is_no_json) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("", {}, "{\"points\":").status, 400);
}
TEST(Application, answers_400_to_an_empty_body) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("", {}, "").status, 400);
}
TEST(Application, answers_400_to_an_unknown_query_parameter) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("?levle=1").status, 400);
}
TEST(Application, answers_400_to_a_parameter_given_twice) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("?level=1&level=2").status, 400);
}
TEST(Application, refuses_compressed_bodies) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("", "Content-Encoding: gzip\r\n", "\x1f\x8b\x08").status, 415);
}
TEST(Application, takes_identity_for_no_compression) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("?level=1", "Content-Encoding: identity\r\n").status, 200);
}
TEST(Application, refuses_foreign_content_types) {
  const RunningApplication server;
  EXPECT_EQ(server.refine("", "Content-Type: text/html\r\n").status, 415);
}
TEST(Application, refuses_a_body_over_the_limit) {
  const RunningApplication server;
  const RawResponse response = server.refine("", {}, std::string(1'000'001, ' '));
  EXPECT_EQ(response.status, 413);
  EXPECT_TRUE(holds(response, "1000001") && holds(response, "1000000"));
}
TEST(Application, refuses_an_answer_over_the_limit_with_numbers) {
  Config config = quick_config();
  config.max_output_bytes = 10'000;
  const RunningApplication server(config);
  const RawResponse response = server.refine("?level=6");
  EXPECT_EQ(response.status, 422);
  EXPECT_TRUE(holds(response, "\"predicted\"") && holds(response, "\"allowed\":10000")) << response.body;
}
TEST(Application, refuses_work_that_no_memory_is_set_aside_for) {
  Config config = quick_config();
  config.max_memory_bytes = 20'000;
  const RunningApplication server(config);
  const RawResponse response = server.refine("?level=6");
  EXPECT_EQ(response.status, 422);
  EXPECT_TRUE(holds(response, "\"allowed\":" + std::to_string(server.application.grants().most_bytes())))
      << response.body;
}
// Each answer kept what it had been predicted to take beyond its size: after some thousand, all requests were
// refused. The counters tell after a few what a long run would.
TEST(Application, gives_everything_back_after_each_answer) {
  const RunningApplication server;
  const auto expect_whole = [&](const char* after) {
    // The memory of an answer is free when its last byte has been sent, a moment after the client has it.
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    Grants::State state = server.application.grants().state();
    while ((state.free_bytes < state.bytes || server.bodies.free() < server.bodies.total()) &&
           std::chrono::steady_clock::now() < deadline)
      state = server.application.grants().state();
    EXPECT_EQ(state.free_bytes, state.bytes) << after;
    EXPECT_EQ(state.free_places, state.places) << after;
    EXPECT_EQ(state.waiting, 0u) << after;
    EXPECT_EQ(server.bodies.free(), server.bodies.total()) << after;
  };
  EXPECT_EQ(server.refine("?level=5").status, 200);
  expect_whole("a refinement");
  EXPECT_EQ(server.refine("?level=3&verify=true&format=glb").status, 200);
  expect_whole("a refinement with its verification");
  EXPECT_EQ(ask(server.port, post("/v1/verify?level=2", kTetrahedron)).status, 200);
  expect_whole("a verification");
  EXPECT_EQ(ask(server.port, post("/v1/curves/measure", R"({"points":[[0,0],[1,1],[2,0]]})")).status, 200);
  expect_whole("a curve's length");
  EXPECT_EQ(ask(server.port, get("/v1/schemes/loop/5")).status, 200);
  expect_whole("a spectrum");
  EXPECT_EQ(server.refine("?level=2", {}, "{").status, 400);
  EXPECT_EQ(server.refine("?level=8").status, 422);
  EXPECT_EQ(server.refine("?level=2", "Accept: image/png\r\n").status, 406);
  expect_whole("refusals");
  {
    RawClient client(server.port);
    client.send(post("/v1/refine?level=7&format=glb", kTetrahedron));
    client.close();
  }
  expect_whole("a client that left");
}
TEST(Application, takes_no_gltf_where_curves_are_asked_about) {
  const RunningApplication server;
  const std::string glb("glTF\x02\0\0\0\x0c\0\0\0", 12);
  for (const char* path :
       {"/v1/evaluate", "/v1/curves/refine", "/v1/curves/evaluate", "/v1/curves/insert-knot",
        "/v1/curves/remove-knot", "/v1/curves/convert", "/v1/curves/measure"}) {
    for (const char* type :
         {"", "Content-Type: model/gltf-binary\r\n", "Content-Type: model/gltf+json\r\n"}) {
      const RawResponse response = ask(server.port, post(path, glb, type));
      EXPECT_EQ(response.status, 415) << path << type;
      EXPECT_EQ(response.header("accept-post"), "application/json") << path << type;
    }
  }
  EXPECT_EQ(ask(server.port, post("/v1/refine", glb, "Content-Type: model/gltf-binary\r\n")).status, 400);
}
TEST(Application, takes_obj_and_off_where_meshes_are_refined_and_nowhere_else) {
  const RunningApplication server;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                    off = "OFF 3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* path : {"/v1/refine", "/v1/verify"}) {
    for (const char* type : {"", "Content-Type: model/obj\r\n", "Content-Type: text/plain\r\n"})
      EXPECT_EQ(ask(server.port, post(path, obj, type)).status, 200) << path << type;
    for (const char* type :
         {"", "Content-Type: text/plain\r\n", "Content-Type: application/octet-stream\r\n"})
      EXPECT_EQ(ask(server.port, post(path, off, type)).status, 200) << path << type;
  }
  EXPECT_EQ(ask(server.port, post("/v1/curves/refine", obj, "Content-Type: model/obj\r\n")).status, 415);
}
TEST(Application, tells_the_time_it_took_in_a_header_only) {
  const RunningApplication server;
  for (const char* path :
       {"/v1/refine?level=2", "/v1/refine?level=1&format=glb", "/v1/refine?level=1&format=gltf",
        "/v1/refine?level=1&verify=true", "/v1/verify?level=2"}) {
    const RawResponse first = ask(server.port, post(path, kTetrahedron));
    const RawResponse second = ask(server.port, post(path, kTetrahedron));
    EXPECT_EQ(first.status, 200) << path;
    EXPECT_EQ(first.body, second.body) << path;
    EXPECT_EQ(first.header("server-timing").substr(0, 9), "read;dur=") << path;
  }
}
TEST(Application, refuses_a_level_over_the_limit) {
  Config config = quick_config();
  config.max_level = 3;
  const RunningApplication server(config);
  EXPECT_EQ(server.refine("?level=3").status, 200);
  EXPECT_GE(server.refine("?level=4").status, 400);
}
TEST(Application, answers_503_when_the_time_is_up) {
  Config config = quick_config();
  config.deadline_seconds = 0;
  const RunningApplication server(config);
  const RawResponse response = server.refine("?level=6");
  EXPECT_EQ(response.status, 503);
  EXPECT_TRUE(holds(response, "deadline_exceeded"));
  EXPECT_EQ(response.header("retry-after"), "1");
}
TEST(Application, answers_404_to_unknown_paths) {
  const RunningApplication server;
  EXPECT_EQ(ask(server.port, get("/nowhere")).status, 404);
  EXPECT_EQ(ask(server.port, get("/v1/refine/")).status, 404);
}
TEST(Application, answers_405_with_the_allowed_methods) {
  const RunningApplication server;
  const RawResponse response = ask(server.port, get("/v1/refine"));
  EXPECT_EQ(response.status, 405);
  EXPECT_EQ(response.header("allow"), "POST, OPTIONS");
  EXPECT_EQ(ask(server.port, post("/livez", "")).header("allow"), "GET, HEAD, OPTIONS");
}
TEST(Application, answers_every_get_to_head_without_a_body) {
  const RunningApplication server;
  for (const Route& route : server.application.router().routes()) {
    if (route.path.find('{') != std::string_view::npos) continue;  // no path itself
    if (route.method != "GET") continue;
    const std::string path(route.path);
    const RawResponse got = ask(server.port, get(path));
    const RawResponse head = ask(server.port, "HEAD " + path + " HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_EQ(head.status, 200) << path;
    EXPECT_EQ(head.header("content-length"), std::to_string(got.body.size())) << path;
  }
}
TEST(Application, answers_a_preflight) {
  const RunningApplication server;
  const RawResponse response = ask(server.port,
                                   "OPTIONS /v1/refine HTTP/1.1\r\nHost: a\r\nOrigin: https://a.example\r\n"
                                   "Access-Control-Request-Method: POST\r\n\r\n");
  EXPECT_EQ(response.status, 204);
  EXPECT_EQ(response.header("access-control-allow-origin"), "*");
  EXPECT_EQ(response.header("access-control-allow-methods"), "POST, OPTIONS");
  EXPECT_EQ(response.headers.count("content-length"), 0u);
}
TEST(Application, lets_pages_read_refusals_too) {
  const RunningApplication server;
  for (const std::string& request : {get("/nowhere"), std::string("GET / HTTP/1.1\r\n\r\n")})
    EXPECT_EQ(ask(server.port, request).header("access-control-allow-origin"), "*") << request;
}
TEST(Application, forbids_sniffing_on_every_answer) {
  const RunningApplication server;
  for (const std::string& request : {get("/"), get("/nowhere"), std::string("nonsense\r\n\r\n")})
    EXPECT_EQ(ask(server.port, request).header("x-content-type-options"), "nosniff") << request;
}
TEST(Application, is_alive_and_ready) {
  const RunningApplication server;
  EXPECT_EQ(ask(server.port, get("/livez")).status, 200);
  EXPECT_EQ(ask(server.port, get("/readyz")).status, 200);
}
TEST(Application, is_alive_but_not_ready_before_the_self_test) {
  const Config config = quick_config();
  RequestMemory bodies(config.max_memory_bytes);
  Application application(config, config.max_memory_bytes);
  Transport transport(options_of(config), application, bodies);
  ASSERT_TRUE(transport.start().ok());
  EXPECT_EQ(ask(transport.port(), get("/livez")).status, 200);
  EXPECT_EQ(ask(transport.port(), get("/readyz")).status, 503);
}
TEST(Application, refuses_new_work_while_it_drains) {
  RunningApplication server;
  server.application.begin_drain();
  EXPECT_EQ(ask(server.port, get("/readyz")).status, 503);
  EXPECT_EQ(server.refine("?level=1").status, 503);
  EXPECT_EQ(ask(server.port, get("/livez")).status, 200);
}
TEST(Application, serves_its_description) {
  const RunningApplication server;
  const RawResponse response = ask(server.port, get("/openapi.json"));
  EXPECT_EQ(response.header("content-type"), "application/json");
  EXPECT_TRUE(holds(response, "\"openapi\""));
}
TEST(Application, describes_every_route) {
  const RunningApplication server;
  const RawResponse response = ask(server.port, get("/openapi.json"));
  for (const Route& route : server.application.router().routes())
    EXPECT_TRUE(holds(response, "\"" + std::string(route.path) + "\":")) << route.path;
}
TEST(Application, finds_schemes_by_the_steps_of_their_paths) {
  const RunningApplication server;
  EXPECT_EQ(ask(server.port, get("/v1/schemes")).status, 200);
  const RawResponse five = ask(server.port, get("/v1/schemes/loop/5?weights=warren"));
  EXPECT_EQ(five.status, 200) << five.body;
  EXPECT_TRUE(holds(five, "\"limitMask\""));
  EXPECT_EQ(ask(server.port, get("/v1/schemes/loop/2")).status, 422);
  EXPECT_EQ(ask(server.port, get("/v1/schemes/loop/five")).status, 422);
  for (const char* path :
       {"/v1/schemes/loop", "/v1/schemes/loop/", "/v1/schemes//5", "/v1/schemes/loop/5/", "/v1/scheme"})
    EXPECT_EQ(ask(server.port, get(path)).status, 404) << path;
  EXPECT_EQ(ask(server.port, post("/v1/schemes/loop/5", "{}")).status, 405);
}
TEST(Application, answers_what_is_asked_about_curves) {
  const RunningApplication server;
  const std::string curve = R"("points":[[0,0],[1,1],[2,0],[3,1]])";
  const auto asked = [&](const std::string& path, const std::string& members) {
    return ask(server.port, post(path, "{" + curve + members + "}", "Content-Type: application/json\r\n"));
  };
  EXPECT_TRUE(holds(asked("/v1/curves/refine?level=1", ""), "\"points\""));
  EXPECT_TRUE(holds(asked("/v1/evaluate", R"(,"samples":{"ts":[1]})"), "\"points\""));
  EXPECT_TRUE(holds(asked("/v1/curves/convert", R"(,"to":"bezier")"), "\"bezier\""));
  EXPECT_TRUE(holds(asked("/v1/curves/measure", ""), "\"errorBound\""));
  EXPECT_EQ(asked("/v1/curves/insert-knot", "").status, 422);
  EXPECT_EQ(asked("/v1/curves/refine?format=glb", "").body.substr(0, 4), "glTF");
  EXPECT_EQ(ask(server.port, post("/v1/curves/measure", "{" + curve + "}",
                                  "Content-Type: application/json\r\nAccept: model/gltf-binary\r\n"))
                .status,
            406);
}
TEST(Application, answers_what_is_asked_about_surfaces) {
  const RunningApplication server;
  const std::string surface =
      R"("type":"bsplineSurface","uVertexCount":2,"points":[[0,0,0],[1,0,0],[0,1,0],[1,1,1]])";
  const auto asked = [&](const std::string& path, const std::string& members = {}) {
    return ask(server.port, post(path, "{" + surface + members + "}", "Content-Type: application/json\r\n"));
  };
  EXPECT_TRUE(holds(asked("/v1/refine?level=1"), "\"faceVertexIndices\":[0,1,4,3"));
  EXPECT_TRUE(
      holds(asked("/v1/curves/refine?level=1&faces=triangles"), "\"faceVertexIndices\":[0,1,4,0,4,3"));
  EXPECT_EQ(asked("/v1/refine?format=glb").body.substr(0, 4), "glTF");
  EXPECT_TRUE(holds(asked("/v1/evaluate", R"(,"samples":{"us":[0.5],"vs":[0.5]})"), "[[0.5,0.5,0.25]]"));
  EXPECT_TRUE(holds(asked("/v1/verify?level=3"), "\"passed\":true"));
  EXPECT_TRUE(holds(asked("/v1/refine?level=3&verify=true&normals=true&limit=true"), "\"passed\":true"));
  const RawResponse refused = asked("/v1/curves/measure");
  EXPECT_EQ(refused.status, 422);
  EXPECT_TRUE(holds(refused, "\"pointer\":\"/type\""));
  EXPECT_TRUE(holds(asked("/v1/evaluate", R"(,"samples":{"us":[0.5],"vs":[2]})"), "\"/samples/vs/0\""));
}
// OpenSubdiv takes hundreds of bytes for a point of a curve or surface: reserved before it begins.
TEST(Application, reserves_what_verifying_takes) {
  struct Case {
    std::uint64_t enough_to_refine;
    const char* body;
  };
  for (
      const auto& [memory, body] :
      {Case{32'000'000,
            R"({"type":"bsplineSurface","uVertexCount":2,"points":[[0,0,0],[1,0,0],[0,1,0],[1,1,1]]})"},
       Case{
           20'000'000,
           R"({"type":"cubic","points":[[0],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1],[2],[1]]})"}}) {
    Config config = quick_config();
    config.max_memory_bytes = memory;
    const RunningApplication server(config);
    const auto asked = [&](const char* path) {
      return ask(server.port, post(path, body, "Content-Type: application/json\r\n"));
    };
    EXPECT_EQ(asked("/v1/refine?level=8").status, 200);
    const RawResponse refused = asked("/v1/verify?level=8");
    EXPECT_EQ(refused.status, 422);
    EXPECT_TRUE(holds(refused, "bytes of memory")) << refused.body;
    EXPECT_EQ(asked("/v1/verify?level=3").status, 200);
  }
}
TEST(Application, serves_a_page_that_names_its_version) {
  const RunningApplication server;
  const RawResponse response = ask(server.port, get("/"));
  EXPECT_EQ(response.header("content-type"), "text/html; charset=utf-8");
  EXPECT_TRUE(holds(response, std::string("Version ") + SUBDIVD_VERSION));
  EXPECT_TRUE(response.body.ends_with("</html>\n"));
}
TEST(Application, stops_computing_for_a_client_that_has_left) {
  Config config = quick_config();
  config.max_concurrent = 1;
  config.max_output_bytes = 2'000'000'000;
  config.max_memory_bytes = 8'000'000'000;
  config.max_level = 15;
  RunningApplication server(config);
  RawClient client(server.port);
  client.send(post("/v1/refine?level=11&format=glb", kTetrahedron));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  client.close();
  EXPECT_EQ(server.refine("?level=1").status, 200);  // had to wait for the one place
}

}  // namespace
}  // namespace subdivd::server::testing
