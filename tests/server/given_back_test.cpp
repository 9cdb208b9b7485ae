// Whatever requests take, the good, the bad and the broken off, is given back: descriptors, threads, memory,
// places.
#include <dirent.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/server/fake_service.h"

namespace subdivd::server::testing {
namespace {

constexpr std::uint64_t kMemory = 2'000'000;

int open_files(const char* folder) {
  int count = 0;
  DIR* const entries = ::opendir(folder);
  while (::readdir(entries) != nullptr) ++count;
  ::closedir(entries);
  return count;
}

const std::string kChunkedHead = "POST /size HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n";

// One client of each kind; `round` varies the sizes.
void send_one_of_each(RunningTransport& server, std::size_t round) {
  const std::string body(round * 997 % 90'000, 'x');
  ask(server.port, get("/a"));
  ask(server.port, get("/health"));
  ask(server.port, post("/size", body));
  ask(server.port, kChunkedHead + "3\r\nabc\r\n0\r\nX: y\r\n\r\n");
  ask(server.port, kChunkedHead + "3\r\nabcd");
  ask(server.port, post("/early", body));
  ask(server.port, post("/throws", body));
  ask(server.port, post("/no-memory", body));
  ask(server.port, post("/size", std::string(100'001, 'x')));
  ask(server.port, "\x16\x03\x01");
  ask(server.port, "GET / HTTP/1.1\r\nX: " + std::string(round * 97 % 40'000, 'x') + "\r\n\r\n");
  {
    RawClient pipelines(server.port);
    pipelines.send(post("/a", body) + get("/b") + get("/health") + post("/c", body) + "GET");
    for (int i = 0; i < 4; ++i) pipelines.receive();
  }
  RawClient silent(server.port), cut_in_head(server.port), cut_in_body(server.port), reset(server.port);
  cut_in_head.send("GET / HTTP/1.1\r\nX: " + std::string(round * 31 % 20'000, 'x'));
  cut_in_body.send("POST /size HTTP/1.1\r\nHost: a\r\nContent-Length: 90000\r\n\r\nabc");
  reset.send(get("/large"));
  reset.reset();
  RawClient leaves(server.port), half_closes(server.port);
  leaves.send(post("/wait", body));
  half_closes.send(post("/a", body));
  half_closes.end_sending();
  half_closes.receive_final();
}

TEST(GivenBack, everything_after_thousands_of_requests_of_all_kinds) {
  TransportOptions options = quick_options();
  options.max_requests_per_connection = 100'000;
  RunningTransport server(options, kMemory);
  ask(server.port, get("/a"));
  ASSERT_TRUE(eventually([&] { return server.transport.state().connections == 0; }));
  const Transport::State before = server.transport.state();
  const int files = open_files("/proc/self/fd"), threads = open_files("/proc/self/task");
  std::vector<std::thread> clients;
  std::atomic<std::size_t> round = 0;
  for (int i = 0; i < 4; ++i)
    clients.emplace_back([&] {
      for (std::size_t mine = round++; mine < 150; mine = round++) send_one_of_each(server, mine);
    });
  for (std::thread& client : clients) client.join();
  EXPECT_TRUE(eventually([&] { return server.transport.state().connections == 0; }));
  EXPECT_TRUE(server.transport.wait_until_idle(std::chrono::milliseconds(10'000)));
  const Transport::State after = server.transport.state();
  EXPECT_EQ(after.requests, 0u);
  EXPECT_EQ(after.waiting + after.heads + after.silent + after.idle + after.lingering, 0u);
  EXPECT_EQ(after.threads, before.threads);
  EXPECT_EQ(server.service.waiting, 0);
  EXPECT_EQ(open_files("/proc/self/fd"), files);
  EXPECT_EQ(open_files("/proc/self/task"), threads);
  EXPECT_EQ(server.memory.free(), server.memory.total());
}

}  // namespace
}  // namespace subdivd::server::testing
