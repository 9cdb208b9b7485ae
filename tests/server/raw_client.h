#pragma once
// A client that sends exactly the bytes it is told to, hostile ones included, and reads within a time limit.

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace subdivd::server::testing {

struct RawResponse {
  int status = 0;                              // 0: the connection ended without a whole head
  std::map<std::string, std::string> headers;  // names lower-cased
  std::string body;
  bool complete = false;  // as many bytes as Content-Length said

  std::string header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? std::string() : found->second;
  }
};

class RawClient {
 public:
  RawClient();                                           // with a descriptor, not yet connected
  explicit RawClient(int port, int receive_buffer = 0);  // 0: the system's size
  ~RawClient();
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  void connect(int port, int receive_buffer = 0);
  bool send(std::string_view bytes);  // false once the server has closed
  RawResponse receive(bool head_request = false);
  RawResponse receive_final();                             // skips interim responses
  bool closed_within(std::chrono::milliseconds patience);  // by the server, cleanly or not
  void close();
  void end_sending();  // and goes on reading
  void reset();        // closes with a RST

 private:
  bool more();
  int fd_;
  std::string buffer_;
};

// One request on a connection of its own.
RawResponse ask(int port, std::string_view bytes);
std::string get(std::string_view target, std::string_view headers = {});
std::string post(std::string_view target, std::string_view body, std::string_view headers = {});

}  // namespace subdivd::server::testing
