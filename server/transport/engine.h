#pragma once
// cpp-httplib, tamed: it never sees a byte that a client chose.
//
// It is given a head that is written here and says no more than whether the answer may have a body. So its
// regular expressions, percent-decoding of header values, form and multipart parsers, lenient chunk parser,
// decompressors, Range arithmetic (a heap over-read) and compression have nothing to work on. What is left of
// it writes responses.

#include <httplib.h>

#include "server/transport/client_socket.h"
#include "server/transport/message.h"

namespace subdivd::server {

class Engine final : private httplib::Server {
 public:
  enum class Sent { whole, partly, nothing };

  // `keep_alive_seconds` is announced on responses that keep the connection, unless it is 0.
  explicit Engine(long long keep_alive_seconds);

  // Sends the response, without its body when `head_only`, and frees it. `nothing`: not a byte has gone out,
  // for want of memory.
  Sent send(ClientSocket& socket, Response response, bool head_only, TransferTime time);

 private:
  void describe(Response response, httplib::Response& out);

  const long long keep_alive_seconds_;
  Response* response_ = nullptr;  // of the exchange under way
  bool close_ = false, failed_ = false;
};

}  // namespace subdivd::server
