// Connections that nobody works on: silent, slow, idle ones, and too many of them.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <memory>
#include <vector>

#include "tests/server/fake_service.h"

namespace subdivd::server::testing {
namespace {

using std::chrono::milliseconds;
using Clients = std::vector<std::unique_ptr<RawClient>>;

TransportOptions patient_options() {
  TransportOptions options = quick_options();
  options.read_timeout = options.idle_timeout = options.queue_timeout = std::chrono::minutes(10);
  return options;
}

Clients silent_clients(int port, int count) {
  Clients clients;
  for (int i = 0; i < count; ++i) clients.push_back(std::make_unique<RawClient>(port));
  return clients;
}

// Idle in this order.
Clients idle_clients(const RunningTransport& server, std::size_t count) {
  Clients clients;
  while (clients.size() < count) {
    clients.push_back(std::make_unique<RawClient>(server.port));
    clients.back()->send(get("/a"));
    EXPECT_EQ(clients.back()->receive().status, 200);
    EXPECT_TRUE(eventually([&] { return server.transport.state().idle == clients.size(); }));
  }
  return clients;
}

bool is_open(RawClient& client) {
  client.send(get("/a"));
  return client.receive().status == 200;
}

TEST(Reception, spends_no_thread_on_the_silent_the_slow_and_the_idle) {
  TransportOptions options = patient_options();
  options.threads = 1;
  const RunningTransport server(options);
  const Clients silent = silent_clients(server.port, 50), slow = silent_clients(server.port, 50),
                idle = idle_clients(server, 50);
  for (const auto& client : slow) client->send("GET / HTTP/1.1\r\nHo");
  EXPECT_EQ(ask(server.port, get("/a")).status, 200);
  EXPECT_TRUE(eventually([&] {
    const Transport::State state = server.transport.state();
    return state.silent == 50 && state.heads == 50 && state.idle == 50 && state.requests == 50;
  }));
}
TEST(Reception, closes_a_silent_connection_after_the_idle_timeout) {
  const RunningTransport server;
  RawClient client(server.port);
  EXPECT_FALSE(client.closed_within(milliseconds(200)));
  EXPECT_TRUE(client.closed_within(milliseconds(5000)));
}
TEST(Reception, keeps_a_connection_longer_than_it_said) {
  TransportOptions options = quick_options();
  options.idle_timeout = milliseconds(50);
  options.idle_grace = std::chrono::minutes(10);
  const RunningTransport server(options);
  RawClient client(server.port);
  EXPECT_TRUE(is_open(client));
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_TRUE(is_open(client));
}
TEST(Reception, times_a_head_from_its_first_byte) {
  TransportOptions options = patient_options();
  options.read_timeout = milliseconds(300);
  const RunningTransport server(options);
  RawClient client(server.port);
  std::this_thread::sleep_for(milliseconds(500));
  client.send("GET /a HTTP/1.1\r\n");
  std::this_thread::sleep_for(milliseconds(50));
  client.send("Host: a\r\n\r\n");
  EXPECT_EQ(client.receive().status, 200);
  client.send("GET /a HTTP/1.1\r\n");
  EXPECT_EQ(client.receive().status, 408);
}
TEST(Reception, takes_empty_lines_between_requests_for_nothing) {
  const RunningTransport server(patient_options());
  RawClient client(server.port);
  client.send("\r\n" + get("/a") + "\r\n\r\n" + get("/b") + "\r");
  EXPECT_EQ(client.receive().body, "GET /a\n");
  EXPECT_EQ(client.receive().body, "GET /b\n");
  EXPECT_TRUE(eventually([&] { return server.transport.state().idle == 1; }));
  client.send("\n" + get("/c"));
  EXPECT_EQ(client.receive().body, "GET /c\n");
}
TEST(Reception, closes_the_longest_silent_connection_when_it_is_full) {
  TransportOptions options = patient_options();
  options.max_connections = 4;
  const RunningTransport server(options);
  const Clients idle = idle_clients(server, 2), silent = silent_clients(server.port, 2);
  ASSERT_TRUE(eventually([&] { return server.transport.state().silent == 2; }));
  RawClient another(server.port);
  EXPECT_TRUE(is_open(another));
  EXPECT_TRUE(silent[0]->closed_within(milliseconds(5000)));
  for (RawClient* client : {silent[1].get(), idle[0].get(), idle[1].get()}) EXPECT_TRUE(is_open(*client));
}
TEST(Reception, closes_the_longest_idle_connection_when_it_is_full) {
  TransportOptions options = patient_options();
  options.max_connections = 3;
  const RunningTransport server(options);
  const Clients idle = idle_clients(server, 3);
  EXPECT_TRUE(is_open(*idle[0]));
  ASSERT_TRUE(eventually([&] { return server.transport.state().idle == 3; }));
  RawClient another(server.port);
  EXPECT_TRUE(is_open(another));
  EXPECT_TRUE(idle[1]->closed_within(milliseconds(5000)));
  EXPECT_TRUE(is_open(*idle[0]));
  EXPECT_TRUE(is_open(*idle[2]));
}
TEST(Reception, closes_nobody_who_is_being_answered) {
  TransportOptions options = patient_options();
  options.max_connections = 2;
  RunningTransport server(options);
  const Clients busy = silent_clients(server.port, 2);
  for (const auto& client : busy) client->send(post("/wait", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 2; }));
  RawClient another(server.port);
  another.send(get("/a"));
  std::this_thread::sleep_for(milliseconds(100));
  EXPECT_LE(server.transport.state().connections, 2u);
  server.service.let_go = true;
  for (const auto& client : busy) EXPECT_EQ(client->receive().body, "waited");
  EXPECT_EQ(another.receive().status, 200);
}
TEST(Reception, survives_a_flood_of_connections) {
  TransportOptions options = patient_options();
  options.max_connections = 200;
  const RunningTransport server(options);
  const Clients flood = silent_clients(server.port, 600);
  EXPECT_EQ(ask(server.port, get("/a")).status, 200);
  EXPECT_LE(server.transport.state().connections, 200u);
}
// Lets the process have a few descriptors more than it has now, as long as it lives.
class FewDescriptors {
 public:
  explicit FewDescriptors(rlim_t more) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int next = ::dup(STDERR_FILENO);
    ::close(next);
    rlimit few = before_;
    few.rlim_cur = static_cast<rlim_t>(next) + more;
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  ~FewDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  FewDescriptors(const FewDescriptors&) = delete;
  FewDescriptors& operator=(const FewDescriptors&) = delete;

 private:
  rlimit before_{};
};

TEST(Reception, makes_room_when_descriptors_are_out) {
  const RunningTransport server(patient_options());
  Clients clients;
  for (int i = 0; i < 10; ++i) clients.push_back(std::make_unique<RawClient>());
  const FewDescriptors few(3);
  for (const auto& client : clients) client->connect(server.port);
  EXPECT_TRUE(is_open(*clients.back()));
  EXPECT_TRUE(clients.front()->closed_within(milliseconds(5000)));
  EXPECT_LE(server.transport.state().connections, 3u);
}
TEST(Reception, closes_the_idle_at_once_when_it_drains) {
  RunningTransport server(patient_options());
  const Clients idle = idle_clients(server, 300);
  server.transport.begin_drain();
  EXPECT_TRUE(server.transport.wait_until_idle(milliseconds(5000)));
  EXPECT_TRUE(eventually([&] { return server.transport.state().connections == 0; }));
}

}  // namespace
}  // namespace subdivd::server::testing
