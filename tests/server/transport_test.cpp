// Ordinary HTTP over a real socket.
#include <gtest/gtest.h>

#include "tests/server/fake_service.h"

namespace subdivd::server::testing {
namespace {

using std::chrono::milliseconds;

TEST(Transport, picks_a_free_port) {
  const RunningTransport a, b;
  EXPECT_GT(a.port, 0);
  EXPECT_NE(a.port, b.port);
}
TEST(Transport, refuses_a_port_that_is_taken) {
  const RunningTransport first;
  TransportOptions options = quick_options();
  options.port = first.port;
  FakeService service;
  RequestMemory memory(1);
  Transport second(options, service, memory);
  EXPECT_FALSE(second.start().ok());
}
TEST(Transport, answers_a_get) {
  const RunningTransport server;
  const RawResponse response = ask(server.port, get("/a?b=1&b=2"));
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.body, "GET /a b=1 b=2\n");
}
TEST(Transport, answers_a_post) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, post("/a", "body")).body, "POST /a\nbody");
}
TEST(Transport, answers_a_post_without_body) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "POST /a HTTP/1.1\r\nHost: a\r\n\r\n").body, "POST /a\n");
}
TEST(Transport, passes_other_methods_on) {
  const RunningTransport server;
  EXPECT_EQ(ask(server.port, "DELETE /a HTTP/1.1\r\nHost: a\r\n\r\n").body, "DELETE /a\n");
}
TEST(Transport, answers_head_without_a_body) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send("HEAD /a HTTP/1.1\r\nHost: a\r\n\r\n" + get("/b"));
  EXPECT_EQ(client.receive(true).header("content-length"), "8");
  EXPECT_EQ(client.receive().body, "GET /b\n");
}
TEST(Transport, reads_a_chunked_body) {
  const RunningTransport server;
  const RawResponse response = ask(server.port,
                                   "POST /a HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n"
                                   "3\r\nabc\r\n2;ext=1\r\nde\r\n0\r\n\r\n");
  EXPECT_EQ(response.body, "POST /a\nabcde");
}
TEST(Transport, reads_past_the_trailers_of_a_chunked_body) {
  const RunningTransport server;
  const RawResponse response = ask(server.port,
                                   "POST /a HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n"
                                   "3\r\nabc\r\n0\r\nX-Checksum: 1\r\nX-Other: 2\r\n\r\n");
  EXPECT_EQ(response.body, "POST /a\nabc");
}
TEST(Transport, answers_a_head_request_that_has_a_body_without_one) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send("HEAD /a HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\nabc" + get("/b"));
  EXPECT_EQ(client.receive(true).status, 200);
  const RawResponse next = client.receive();
  EXPECT_EQ(next.status, 200);  // which a body before it would have spoilt
  EXPECT_EQ(next.body, "GET /b\n");
}
TEST(Transport, keeps_a_connection_alive) {
  const RunningTransport server;
  RawClient client(server.port);
  for (int i = 0; i < 3; ++i) {
    client.send(post("/a", "x"));
    EXPECT_EQ(client.receive().body, "POST /a\nx");
  }
}
TEST(Transport, answers_pipelined_requests_in_order) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(post("/a", "1") + get("/b") + post("/c", "3"));
  EXPECT_EQ(client.receive().body, "POST /a\n1");
  EXPECT_EQ(client.receive().body, "GET /b\n");
  EXPECT_EQ(client.receive().body, "POST /c\n3");
}
TEST(Transport, closes_when_the_client_asks_for_it) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(get("/a", "Connection: close\r\n"));
  EXPECT_EQ(client.receive().header("connection"), "close");
  EXPECT_TRUE(client.closed_within(milliseconds(300)));
}
TEST(Transport, announces_how_long_it_keeps_a_connection) {
  TransportOptions options = quick_options();
  options.idle_timeout = milliseconds(7'900);
  const RunningTransport server(options);
  EXPECT_EQ(ask(server.port, get("/a")).header("keep-alive"), "timeout=7");
  EXPECT_EQ(ask(server.port, get("/a", "Connection: close\r\n")).header("keep-alive"), "");
}
TEST(Transport, announces_no_time_that_is_shorter_than_a_second) {
  const RunningTransport server;
  const RawResponse response = ask(server.port, get("/a"));
  EXPECT_EQ(response.header("connection"), "keep-alive");
  EXPECT_EQ(response.header("keep-alive"), "");
}
TEST(Transport, closes_an_idle_connection) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(get("/a"));
  client.receive();
  EXPECT_TRUE(client.closed_within(milliseconds(5000)));
}
TEST(Transport, closes_after_the_last_allowed_request) {
  TransportOptions options = quick_options();
  options.max_requests_per_connection = 2;
  const RunningTransport server(options);
  RawClient client(server.port);
  client.send(get("/a") + get("/b"));
  EXPECT_EQ(client.receive().header("connection"), "keep-alive");
  EXPECT_EQ(client.receive().header("connection"), "close");
  // Its third request may be on its way already.
  EXPECT_TRUE(eventually([&] { return server.transport.state().lingering == 1; }));
}
TEST(Transport, gives_an_idle_connections_thread_to_one_that_waits) {
  TransportOptions options = quick_options();
  options.threads = 1;
  options.idle_timeout = std::chrono::minutes(10);
  const RunningTransport server(options);
  RawClient idle(server.port);
  idle.send(get("/a"));
  idle.receive();
  EXPECT_EQ(ask(server.port, get("/b")).status, 200);
}
// Every write began to look for its part at the first one: 40,000 primitives took a quarter of a minute to
// send.
TEST(Transport, sends_a_body_of_very_many_small_parts_whole) {
  TransportOptions options = quick_options();
  options.read_timeout = std::chrono::milliseconds(10'000);
  const RunningTransport server(options);
  const RawResponse response = ask(server.port, get("/crumbs"));
  std::string expected;
  for (std::size_t i = 0; i < FakeService::kCrumbs; ++i)
    expected.append(i % 100, static_cast<char>('a' + i % 26));
  expected.append(FakeService::kLargePart, 'z').append("end");
  EXPECT_TRUE(response.body == expected) << response.body.size() << " of " << expected.size() << " bytes";
}
TEST(Transport, sends_what_is_made_while_it_is_sent) {
  const RunningTransport server;
  const auto made = [](std::size_t pieces) {
    std::string text;
    for (std::size_t k = 1; k <= pieces; ++k)
      text.append(k % 1000 == 0 ? 200'000 : 1 + k % 100, static_cast<char>('a' + k % 26));
    return text;
  };
  RawClient client(server.port);
  client.send(get("/made"));
  const RawResponse response = client.receive();
  const std::string expected = "begin" + made(FakeService::kMadePieces) + made(1) + "end";
  ASSERT_TRUE(response.complete);
  EXPECT_TRUE(response.body == expected) << response.body.size() << " of " << expected.size() << " bytes";
  client.send(get("/after"));
  EXPECT_EQ(client.receive().body, "GET /after\n");
}
TEST(Transport, sends_large_bodies_whole) {
  const RunningTransport server;
  const RawResponse response = ask(server.port, get("/large"));
  ASSERT_TRUE(response.complete);
  EXPECT_EQ(response.body,
            std::string(FakeService::kLargePart, 'a') + std::string(FakeService::kLargePart, 'b'));
}
TEST(Transport, says_continue_before_an_awaited_body) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send("POST /a HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(client.receive().status, 100);
  client.send("abc");
  EXPECT_EQ(client.receive().body, "POST /a\nabc");
}
TEST(Transport, does_not_say_continue_to_a_body_it_will_refuse) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send("POST /a HTTP/1.1\r\nHost: a\r\nContent-Length: 300000\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(client.receive().status, 413);
}
TEST(Transport, answers_from_the_head_alone_when_the_service_wants_it) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send("POST /early HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\n");
  const RawResponse response = client.receive();
  EXPECT_EQ(response.status, 403);
  EXPECT_EQ(response.header("connection"), "close");
}
TEST(Transport, dates_its_responses) {
  const RunningTransport server;
  EXPECT_TRUE(ask(server.port, get("/a")).header("date").ends_with(" GMT"));
}
TEST(Transport, tells_a_request_that_its_client_has_left) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  client.close();
  EXPECT_TRUE(eventually([&] { return server.service.seen_cancelled == 1; }));
}
TEST(Transport, tells_a_request_that_its_client_reset_the_connection) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  client.reset();
  EXPECT_TRUE(eventually([&] { return server.service.seen_cancelled == 1; }));
}
TEST(Transport, does_not_cancel_a_request_whose_client_waits) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  std::this_thread::sleep_for(milliseconds(200));
  server.service.let_go = true;
  EXPECT_EQ(client.receive().body, "waited");
  EXPECT_EQ(server.service.seen_cancelled, 0);
}
TEST(Transport, finishes_what_is_in_flight_when_it_drains) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  server.transport.begin_drain();
  EXPECT_FALSE(server.transport.wait_until_idle(milliseconds(50)));
  server.service.let_go = true;
  const RawResponse response = client.receive();
  EXPECT_EQ(response.body, "waited");
  EXPECT_EQ(response.header("connection"), "close");
  EXPECT_TRUE(server.transport.wait_until_idle(milliseconds(5000)));
}
TEST(Transport, still_answers_new_connections_while_it_drains) {
  RunningTransport server;
  server.transport.begin_drain();
  EXPECT_EQ(ask(server.port, get("/a")).header("connection"), "close");
}
TEST(Transport, closes_idle_connections_when_it_drains) {
  TransportOptions options = quick_options();
  options.idle_timeout = std::chrono::minutes(10);
  RunningTransport server(options);
  RawClient client(server.port);
  client.send(get("/a"));
  client.receive();
  server.transport.begin_drain();
  EXPECT_TRUE(client.closed_within(milliseconds(5000)));
}
TEST(Transport, cancels_what_still_runs_when_it_stops) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  server.transport.stop();
  EXPECT_EQ(server.service.seen_cancelled, 1);
}
TEST(Transport, records_every_response) {
  RunningTransport server;
  const auto recorded = [&](const std::vector<int>& statuses) {
    return eventually([&] {
      const std::lock_guard lock(server.service.mutex);
      return server.service.statuses == statuses;
    });
  };
  ask(server.port, get("/a"));
  EXPECT_TRUE(recorded({200}));
  ask(server.port, "nonsense\r\n\r\n");
  EXPECT_TRUE(recorded({200, 400}));
}

}  // namespace
}  // namespace subdivd::server::testing
