// Who waits for whom.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/server/fake_service.h"

namespace subdivd::server::testing {
namespace {

using std::chrono::milliseconds;
using Clients = std::vector<std::unique_ptr<RawClient>>;

TransportOptions two_threads() {
  TransportOptions options = quick_options();
  options.threads = 2;
  options.read_timeout = options.queue_timeout = std::chrono::minutes(10);
  return options;
}

Clients send_from_two(int port, const std::string& bytes, int receive_buffer = 0) {
  Clients clients;
  for (int i = 0; i < 2; ++i) {
    clients.push_back(std::make_unique<RawClient>(port, receive_buffer));
    clients.back()->send(bytes);
  }
  return clients;
}

// Neither waiting for a thread nor for the rest of a head: both threads have them.
bool both_threads_are_taken(const RunningTransport& server) {
  return eventually([&] {
    const Transport::State state = server.transport.state();
    return state.requests == 2 && state.waiting == 0 && state.heads == 0;
  });
}

TEST(Lanes, answers_for_its_health_while_all_threads_compute) {
  RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 2; }));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
  server.service.let_go = true;
}
TEST(Lanes, answers_for_its_health_while_all_threads_read_slow_bodies) {
  const RunningTransport server(two_threads());
  const Clients busy =
      send_from_two(server.port, "POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 9\r\n\r\nabc");
  ASSERT_TRUE(both_threads_are_taken(server));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
}
TEST(Lanes, answers_for_its_health_while_all_threads_have_slow_readers) {
  const RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, get("/large"), 4096);
  ASSERT_TRUE(both_threads_are_taken(server));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
}
TEST(Lanes, reads_no_body_in_the_health_lane) {
  const RunningTransport server(two_threads());
  RawClient slow(server.port);
  slow.send("GET /health HTTP/1.1\r\nHost: a\r\nContent-Length: 9\r\n\r\nabc");
  ASSERT_TRUE(eventually([&] { return server.transport.state().requests == 1; }));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
}
TEST(Lanes, drops_who_asks_for_the_health_and_does_not_read) {
  TransportOptions options = two_threads();
  options.max_requests_per_connection = 100'000;
  RunningTransport server(options);
  RawClient deaf(server.port, 4096);
  const std::string request = get("/health?" + std::string(4'000, 'x'));  // and so long is the answer
  for (int i = 0; i < 4'000 && deaf.send(request); ++i) {
  }
  EXPECT_TRUE(eventually([&] { return server.service.broken_off == 1; }));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
}
TEST(Lanes, refuses_heads_while_all_threads_compute) {
  RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 2; }));
  EXPECT_EQ(ask(server.port, "nonsense\r\n\r\n").status, 400);
  server.service.let_go = true;
}
TEST(Lanes, lets_requests_wait_for_a_thread) {
  RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 2; }));
  RawClient next(server.port);
  next.send(get("/a"));
  ASSERT_TRUE(eventually([&] { return server.transport.state().waiting == 1; }));
  server.service.let_go = true;
  EXPECT_EQ(next.receive().status, 200);
}
TEST(Lanes, refuses_who_has_waited_for_too_long) {
  TransportOptions options = two_threads();
  options.queue_timeout = milliseconds(100);
  RunningTransport server(options);
  const Clients busy = send_from_two(server.port, post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 2; }));
  const RawResponse response = ask(server.port, post("/a", "x"));
  EXPECT_EQ(response.status, 503);
  EXPECT_EQ(response.body, "overloaded: no thread was free for this request in time");
  server.service.let_go = true;
}
TEST(Lanes, lets_a_pipeline_not_pass_others_that_wait) {
  TransportOptions options = two_threads();
  options.threads = 1;
  RunningTransport server(options);
  RawClient first(server.port), second(server.port);
  first.send(post("/wait", "x") + post("/last", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  second.send(post("/early", "x"));
  ASSERT_TRUE(eventually([&] { return server.transport.state().waiting == 1; }));
  server.service.let_go = true;
  EXPECT_EQ(first.receive().body, "waited");
  EXPECT_EQ(first.receive().status, 200);
  ASSERT_TRUE(eventually([&] { return server.transport.state().requests == 0; }));
  const std::lock_guard lock(server.service.mutex);
  EXPECT_EQ(server.service.statuses, (std::vector<int>{200, 403, 200}));
}

}  // namespace
}  // namespace subdivd::server::testing
