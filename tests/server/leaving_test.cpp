// Clients that go, half-go and stay; a server that ends.
#include <gtest/gtest.h>

#include "tests/server/fake_service.h"

namespace subdivd::server::testing {
namespace {

using std::chrono::milliseconds;

std::string wait_request(const std::string& version) {
  return "POST /wait " + version + "\r\nHost: a\r\nContent-Length: 1\r\n\r\nx";
}

TEST(Leaving, a_client_that_only_ends_its_sending_side_is_answered) {
  for (const char* version : {"HTTP/1.1", "HTTP/1.0"}) {
    RunningTransport server;
    RawClient client(server.port);
    client.send(wait_request(version));
    ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
    client.end_sending();
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_EQ(server.service.seen_cancelled, 0) << version;
    server.service.let_go = true;
    EXPECT_EQ(client.receive_final().body, "waited") << version;
  }
}
TEST(Leaving, a_half_closed_client_is_asked_once_whether_it_waits) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(wait_request("HTTP/1.1"));
  client.end_sending();
  EXPECT_EQ(client.receive().status, 100);
  std::this_thread::sleep_for(milliseconds(200));
  server.service.let_go = true;
  EXPECT_EQ(client.receive().status, 200);
}
TEST(Leaving, a_client_of_http_1_0_gets_no_interim_response) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(wait_request("HTTP/1.0"));
  client.end_sending();
  std::this_thread::sleep_for(milliseconds(200));
  server.service.let_go = true;
  EXPECT_EQ(client.receive().status, 200);
}
TEST(Leaving, a_quick_answer_comes_without_an_interim_response) {
  const RunningTransport server;
  RawClient client(server.port);
  client.send(get("/a") + get("/b"));
  client.end_sending();
  EXPECT_EQ(client.receive().body, "GET /a\n");
  EXPECT_EQ(client.receive().body, "GET /b\n");
  EXPECT_TRUE(client.closed_within(milliseconds(5000)));
}
TEST(Leaving, stop_gives_up_on_work_that_cannot_be_cancelled) {
  RunningTransport server;
  RawClient client(server.port);
  client.send(post("/stuck", "x"));
  ASSERT_TRUE(eventually([&] { return server.service.waiting == 1; }));
  EXPECT_FALSE(server.transport.stop(milliseconds(50)));
  server.service.let_go = true;
  EXPECT_TRUE(server.transport.stop(milliseconds(10'000)));
  EXPECT_EQ(server.transport.state().threads, 0u);
}

}  // namespace
}  // namespace subdivd::server::testing
