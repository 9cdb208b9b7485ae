#pragma once
// cpp-httplib, tamed: it never sees a byte that a client chose for a head.
//
// parse_head has judged the head; httplib is given a new one, written here, that says only what it needs: is
// there a body, and where does it end. So its regular expressions, percent-decoding of header values, form
// and multipart parsers, decompressors, Range arithmetic (a heap over-read) and compression never run. What
// is left of it decodes bodies and writes responses.

#include <httplib.h>

#include <functional>
#include <string>
#include <string_view>

#include "server/transport/client_socket.h"
#include "server/transport/head.h"
#include "server/transport/message.h"

namespace subdivd::server {

// Hands the body over piece by piece until the receiver says false; false unless all of it was handed over.
using BodyReader = std::function<bool(const std::function<bool(std::string_view)>& receiver)>;

class Engine final : private httplib::Server {
 public:
  Engine();

  // One exchange. The body is on the wire (or in the socket's buffer) if `with_body`; then `answer` may read
  // it, once. `answer` must not throw. True when the whole response has been handed to the kernel.
  bool exchange(ClientSocket& socket, const Head& head, bool with_body, std::chrono::milliseconds patience,
                const std::function<Response(const BodyReader&)>& answer);

 private:
  void send(Response response, httplib::Response& out);

  const std::function<Response(const BodyReader&)>* answer_ = nullptr;  // of the exchange under way
  bool close_ = false;
};

}  // namespace subdivd::server
