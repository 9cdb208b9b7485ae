// Who waits for whom.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "server/transport/transfer_time.h"
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

constexpr const char* kSlowBody = "POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 9\r\n\r\nabc";
constexpr const char* kSlowChunks =
    "POST /size HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n9\r\nabc";

TEST(Lanes, answers_for_its_health_while_all_threads_compute) {
  RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 2; }));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
  server.service.let_go = true;
}
TEST(Lanes, answers_for_its_health_while_all_threads_read_slow_bodies) {
  const RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, kSlowBody);
  ASSERT_TRUE(both_threads_are_taken(server));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
}
TEST(Lanes, answers_for_its_health_while_all_threads_have_slow_readers) {
  const RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, get("/large"), 4096);
  ASSERT_TRUE(both_threads_are_taken(server));
  EXPECT_EQ(ask(server.port, get("/health")).status, 200);
}
TEST(Lanes, ends_slow_bodies_for_those_who_wait) {
  for (const char* slow : {kSlowBody, kSlowChunks}) {
    const RunningTransport server(two_threads());
    const Clients busy = send_from_two(server.port, slow);
    ASSERT_TRUE(both_threads_are_taken(server));
    EXPECT_EQ(ask(server.port, get("/a")).status, 200);
    // As many as waited, and no more: the other one is still read.
    ASSERT_TRUE(eventually([&] { return server.transport.state().requests == 1; }));
    std::vector<int> statuses;
    for (const auto& client : busy) {
      client->send("defghi\r\n0\r\n\r\n");
      const RawResponse response = client->receive();
      statuses.push_back(response.status);
      if (response.status == 503) {
        EXPECT_EQ(response.body, "overloaded: others waited for a thread while this body came slowly");
      }
    }
    EXPECT_EQ(std::count(statuses.begin(), statuses.end(), 503), 1);
    EXPECT_EQ(std::count(statuses.begin(), statuses.end(), 200), 1);
  }
}
// A byte now and then was no reason to look at the time.
TEST(Lanes, ends_bodies_that_drip_for_those_who_wait) {
  const RunningTransport server(two_threads());
  const Clients busy =
      send_from_two(server.port, "POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 99999\r\n\r\nabc");
  ASSERT_TRUE(both_threads_are_taken(server));
  std::atomic<bool> served = false;
  std::thread drip([&] {
    while (!served) {
      for (const auto& client : busy) client->send("x");
      std::this_thread::sleep_for(milliseconds(10));
    }
  });
  EXPECT_EQ(ask(server.port, get("/a")).status, 200);
  served = true;
  drip.join();
}
// Who waits asks every 100 ms, and the thread of a transfer that has ended for him may take longer to come free.
TEST(ThreadDemand, ends_no_second_transfer_while_the_first_ones_thread_is_on_its_way) {
  ThreadDemand demand;
  EXPECT_FALSE(demand.claim());
  demand.ask(1);
  EXPECT_TRUE(demand.claim());
  demand.ask(1);
  EXPECT_FALSE(demand.claim());
  demand.ask(3);
  EXPECT_TRUE(demand.claim());
  EXPECT_TRUE(demand.claim());
  EXPECT_FALSE(demand.claim());
  for (int thread = 0; thread < 3; ++thread) demand.came_free();
  demand.ask(1);
  EXPECT_TRUE(demand.claim());
  demand.came_free();
  demand.came_free();  // one that no transfer ended for
  demand.ask(1);
  EXPECT_TRUE(demand.claim());
}
TEST(Lanes, ends_slow_readers_for_those_who_wait) {
  RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, get("/large"), 4096);
  ASSERT_TRUE(both_threads_are_taken(server));
  EXPECT_EQ(ask(server.port, get("/a")).status, 200);
  EXPECT_EQ(server.service.broken_off, 1);
}
TEST(Lanes, ends_the_slower_of_two_bodies) {
  TransportOptions options = two_threads();
  options.max_body_bytes = 5'000'000;
  const RunningTransport server(options, 50'000'000);
  RawClient large(server.port), drip(server.port);
  large.send("POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 4000009\r\n\r\n" +
             std::string(4'000'000, 'a'));
  drip.send(kSlowBody);
  ASSERT_TRUE(both_threads_are_taken(server));
  EXPECT_EQ(ask(server.port, get("/a")).status, 200);
  EXPECT_EQ(drip.receive().status, 503);
  large.send("123456789");
  EXPECT_EQ(large.receive().body, "4000009");
}
TEST(Lanes, leaves_slow_bodies_alone_while_nobody_waits) {
  const RunningTransport server(two_threads());
  const Clients busy = send_from_two(server.port, kSlowBody);
  ASSERT_TRUE(both_threads_are_taken(server));
  std::this_thread::sleep_for(TransferTime::kGraceWhenAsked + milliseconds(300));
  for (const auto& client : busy) {
    client->send("defghi");
    EXPECT_EQ(client->receive().status, 200);
  }
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
