// What attackers send, over a real socket. Each test ends by the server's own limits.
#include <gtest/gtest.h>

#include "tests/server/fake_service.h"

namespace subdivd::server::testing {
namespace {

using std::chrono::milliseconds;

const std::string kChunkedPost = "POST /size HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n";

bool alive(const RunningTransport& server) { return ask(server.port, get("/alive")).status == 200; }

// cpp-httplib asks the provider for offsets past the data: a heap over-read.
TEST(Hostile, ignores_a_range_past_the_end) {
  const RunningTransport server;
  const RawResponse response = ask(server.port, get("/a", "Range: bytes=100000-200000\r\n"));
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.body, "GET /a\n");
}
// Each range copies the body again: ten cost a gigabyte.
TEST(Hostile, ignores_many_ranges) {
  const RunningTransport server;
  const RawResponse response = ask(server.port, get("/a", "Range: bytes=0-,0-,0-,0-,0-,0-,0-,0-,0-,0-\r\n"));
  EXPECT_EQ(response.body, "GET /a\n");
  EXPECT_EQ(response.header("accept-ranges"), "none");
}
TEST(Hostile, ignores_a_malformed_range) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, get("/a", "Range: bytes=z-99999999999999999999999\r\n")).status, 200);
}
TEST(Hostile, never_compresses) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, get("/large", "Accept-Encoding: br, gzip\r\n")).header("content-encoding"), "");
}
TEST(Hostile, closes_after_a_smuggling_attempt) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(
      "POST /a HTTP/1.1\r\nHost: a\r\nContent-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n"
      "0\r\n\r\n" +
      get("/smuggled"));
  EXPECT_EQ(client.receive().status, 400);
  EXPECT_EQ(client.receive().status, 0);
}
TEST(Hostile, ends_a_chunked_body_where_it_ends) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(kChunkedPost + "0\r\n\r\n" + get("/next"));
  EXPECT_EQ(client.receive().body, "0");
  EXPECT_EQ(client.receive().body, "GET /next\n");
}
TEST(Hostile, takes_nothing_after_a_malformed_chunked_body_for_a_request) {
  const RunningTransport server;
  for (const char* body : {"0\n\n", "0\r\n\n", "1\nx\r\n0\r\n\r\n", "1 \r\nx\r\n0\r\n\r\n", "0x0\r\n\r\n",
                           "1\r\nxx\r\n0\r\n\r\n", "0\r\n folded: 1\r\n\r\n"}) {
    RawClient client(server.port);
    client.send(kChunkedPost + body + get("/smuggled"));
    EXPECT_EQ(client.receive().status, 400) << body;
    EXPECT_EQ(client.receive().status, 0) << body;
  }
}
TEST(Hostile, refuses_what_can_never_become_http_at_once) {
  TransportOptions options = quick_options();
  options.read_timeout = std::chrono::minutes(10);
  const RunningTransport server(options);
  const std::string tls_hello("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);
  for (const std::string& bytes : {tls_hello, std::string("GET / HTTP/1.1\nHost: a\n\n"),
                                   std::string("GET /\rX"), std::string("GET /\0", 6), std::string("\x01"),
                                   std::string(" GET"), std::string("\r\n\n"), std::string("G\x7f")}) {
    RawClient client(server.port);
    client.send(bytes);
    EXPECT_EQ(client.receive().status, 400) << ::testing::PrintToString(bytes);
    EXPECT_TRUE(client.closed_within(milliseconds(5000)));
  }
}
TEST(Hostile, refuses_a_host_that_is_markup) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "GET /a HTTP/1.1\r\nHost: <script>\r\n\r\n").status, 400);
}
TEST(Hostile, refuses_malformed_lengths) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "POST /a HTTP/1.1\r\nHost: a\r\nContent-Length: abc\r\n\r\n").status, 400);
}
TEST(Hostile, refuses_two_lengths) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "POST /a HTTP/1.1\r\nHost: a\r\nContent-Length: 1\r\nContent-Length: 1\r\n\r\nx")
                .status,
            400);
}
TEST(Hostile, takes_a_body_of_exactly_the_limit) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, post("/size", std::string(100'000, 'x'))).body, "100000");
}
TEST(Hostile, refuses_a_declared_body_over_the_limit_before_it_comes) {
  const RunningTransport server;
  const RawResponse response =
      ask(server.port, "POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 999999999999999999\r\n\r\n");
  EXPECT_EQ(response.status, 413);
  EXPECT_EQ(response.header("connection"), "close");
}
TEST(Hostile, lets_a_client_that_sends_too_much_read_the_refusal) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, post("/size", std::string(3'000'000, 'x'))).status, 413);
}
TEST(Hostile, refuses_a_chunked_body_over_the_limit) {
  const RunningTransport server;
  std::string request = kChunkedPost;
  for (int i = 0; i < 101; ++i) request += "3e8\r\n" + std::string(1000, 'x') + "\r\n";
  EXPECT_EQ(ask(server.port, request + "0\r\n\r\n").status, 413);
}
TEST(Hostile, refuses_one_chunk_over_the_limit) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, kChunkedPost + "7fffffffffffffff\r\n" + std::string(200'000, 'x')).status, 413);
}
TEST(Hostile, refuses_an_endless_chunk_size_line) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, kChunkedPost + "1;" + std::string(100'000, 'a')).status, 400);
}
TEST(Hostile, refuses_a_chunk_size_that_is_no_number) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, kChunkedPost + "zz\r\nabc\r\n0\r\n\r\n").status, 400);
}
TEST(Hostile, refuses_a_body_that_there_is_never_room_for) {
  const RunningTransport server(quick_options(), 100'000);
  EXPECT_EQ(ask(server.port, post("/size", std::string(60'000, 'x'))).status, 413);
  EXPECT_EQ(ask(server.port, post("/size", std::string(40'000, 'x'))).status, 200);
}
TEST(Hostile, refuses_a_body_that_waits_too_long_for_the_memory_of_others) {
  RunningTransport server(quick_options(), 400'000);
  const std::string body(90'000, 'x');
  {
    Quota::Lease others(server.memory.large);
    ASSERT_TRUE(others.grow_to(150'000));
    EXPECT_EQ(ask(server.port, post("/size", body)).status, 503);
    EXPECT_EQ(ask(server.port, post("/size", std::string(40'000, 'x'))).status, 200);
  }
  EXPECT_EQ(ask(server.port, post("/size", body)).status, 200);
}
TEST(Hostile, refuses_a_head_that_would_fill_the_memory_for_all) {
  const RunningTransport server(quick_options(), 48'000);
  EXPECT_EQ(ask(server.port, get("/a", "X: " + std::string(20'000, 'x') + "\r\n")).status, 503);
  const std::string smaller = get("/a", "X: " + std::string(2'000, 'x') + "\r\n");
  EXPECT_TRUE(
      eventually([&] { return ask(server.port, smaller).status == 200; }));  // as soon as it is given back
}
// Four uploads that were announced and not sent kept everybody waiting who sent a few hundred bytes.
TEST(Hostile, lets_only_large_bodies_wait_for_a_large_one_that_comes_slowly) {
  TransportOptions options = quick_options();
  options.read_timeout = std::chrono::minutes(10);
  options.max_body_bytes = 500'000;
  RunningTransport server(options, 1'600'000);
  RawClient slow(server.port), other(server.port);
  slow.send("POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 500000\r\n\r\n" + std::string(70'000, 'x'));
  ASSERT_TRUE(eventually([&] { return server.memory.large.free() == 300'000; }));
  other.send(post("/size", std::string(400'000, 'x')));
  EXPECT_EQ(ask(server.port, post("/size", std::string(60'000, 'x'))).body, "60000");
  EXPECT_EQ(ask(server.port, post("/size", std::string(70'000, 'x'))).body, "70000");
  EXPECT_EQ(ask(server.port, get("/a", "X: " + std::string(20'000, 'x') + "\r\n")).status, 200);
  slow.send(std::string(430'000, 'x'));
  EXPECT_EQ(slow.receive().body, "500000");
  EXPECT_EQ(other.receive().body, "400000");
}
TEST(Hostile, reads_the_largest_body_in_chunks) {
  TransportOptions options = quick_options();
  options.max_body_bytes = 500'000;
  const RunningTransport server(options, 1'000'000);
  RawClient client(server.port);
  client.send("POST /size HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n7a120\r\n" +
              std::string(500'000, 'x') + "\r\n0\r\n\r\n");
  EXPECT_EQ(client.receive().body, "500000");
}
TEST(Hostile, gives_buffer_memory_back) {
  const RunningTransport server(quick_options(), 400'000);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(ask(server.port, post("/size", std::string(90'000, 'x'))).status, 200);
  EXPECT_EQ(server.memory.free(), server.memory.total());
}
TEST(Hostile, refuses_an_endless_request_line) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "GET /" + std::string(200'000, 'a')).status, 414);
}
TEST(Hostile, refuses_a_flood_of_headers) {
  const RunningTransport server;
  std::string request = "GET / HTTP/1.1\r\nHost: a\r\n";
  for (int i = 0; i < 10'000; ++i) request += "x-" + std::to_string(i) + ": y\r\n";
  EXPECT_EQ(ask(server.port, request).status, 431);
}
TEST(Hostile, cuts_a_dripping_head) {
  const RunningTransport server;
  RawClient client(server.port);
  const auto start = std::chrono::steady_clock::now();
  while (client.send("a") && std::chrono::steady_clock::now() - start < milliseconds(5000))
    std::this_thread::sleep_for(milliseconds(20));
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(4000));
}
TEST(Hostile, answers_a_head_that_does_not_end) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "GET / HTTP/1.1\r\nHo").status, 408);
}
TEST(Hostile, cuts_a_dripping_body) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send("POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 100000\r\n\r\n");
  const auto start = std::chrono::steady_clock::now();
  while (client.send("a") && std::chrono::steady_clock::now() - start < milliseconds(5000))
    std::this_thread::sleep_for(milliseconds(20));
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(4000));
}
TEST(Hostile, answers_a_body_that_does_not_come) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\nabc").status, 400);
}
TEST(Hostile, cuts_a_client_that_does_not_read) {
  RunningTransport server;
  RawClient client(server.port, 4096);
  client.send(get("/large"));
  EXPECT_TRUE(eventually([&] { return server.service.broken_off == 1; }));
}
TEST(Hostile, survives_more_dripping_connections_than_threads) {
  const RunningTransport server;
  std::vector<std::unique_ptr<RawClient>> drips;
  for (int i = 0; i < 20; ++i) {
    drips.push_back(std::make_unique<RawClient>(server.port));
    drips.back()->send("GET / HT");
  }
  EXPECT_TRUE(alive(server));
}
TEST(Hostile, hides_what_a_handler_throws) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(post("/throws", "x"));
  const RawResponse response = client.receive();
  EXPECT_EQ(response.status, 500);
  EXPECT_EQ(response.body.find("secret"), std::string::npos);
  for (const auto& [name, value] : response.headers)
    EXPECT_EQ(value.find("secret"), std::string::npos) << name;
}
TEST(Hostile, survives_a_handler_that_throws_a_number) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, get("/throws-a-number")).status, 500);
  EXPECT_TRUE(alive(server));
}
TEST(Hostile, says_503_when_a_handler_runs_out_of_memory_or_threads) {
  const RunningTransport server;
  for (const char* path : {"/no-memory", "/no-threads"}) {
    const RawResponse response = ask(server.port, post(path, "x"));
    EXPECT_EQ(response.status, 503) << path;
    EXPECT_EQ(response.body.substr(0, response.body.find(':')), "overloaded") << path;
  }
}
TEST(Hostile, says_503_when_there_is_no_memory_for_words) {
  RunningTransport server;
  server.service.refuse_throws = true;
  const RawResponse response = ask(server.port, get("/no-memory"));
  EXPECT_EQ(response.status, 503);
  EXPECT_EQ(response.header("retry-after"), "1");
  EXPECT_TRUE(alive(server));
}
TEST(Hostile, survives_a_screen_that_throws) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, get("/screen-throws")).status, 500);
}
TEST(Hostile, survives_an_error_page_that_throws) {
  RunningTransport server;
  server.service.refuse_throws = true;
  EXPECT_EQ(ask(server.port, get("/throws")).status, 500);
  EXPECT_TRUE(alive(server));
}
TEST(Hostile, survives_a_logger_that_throws) {
  RunningTransport server;
  server.service.record_throws = true;
  EXPECT_EQ(ask(server.port, get("/a")).status, 200);
  EXPECT_TRUE(alive(server));
}
TEST(Hostile, shows_header_values_as_they_came) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, get("/header", "X-Test: a%0d%0aSet-Cookie: b\r\n")).body,
            "a%0d%0aSet-Cookie: b");
}
TEST(Hostile, cannot_be_told_another_peer_address) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, get("/peer", "REMOTE_ADDR: 1.2.3.4\r\n")).body, "127.0.0.1");
}
TEST(Hostile, survives_clients_that_reset_at_once) {
  const RunningTransport server;
  for (int i = 0; i < 50; ++i) {
    RawClient client(server.port);
    client.send(post("/large", "x"));
    client.reset();
  }
  EXPECT_TRUE(alive(server));
}

}  // namespace
}  // namespace subdivd::server::testing
