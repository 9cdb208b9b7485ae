#pragma once
// A connection, and the request that it is about to make.
//
// Connections travel between the reception, the lanes and the workers as the one element of a list. Passing
// one on is a splice, so it cannot fail for want of memory, and whoever drops the list closes the connection.

#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "server/transport/census.h"
#include "server/transport/client_socket.h"
#include "server/transport/head.h"
#include "server/transport/head_scan.h"
#include "server/transport/message.h"
#include "server/transport/quota.h"
#include "server/transport/service.h"

namespace subdivd::server {

class Connection;
using Connections = std::list<std::unique_ptr<Connection>>;

// One request, from its first byte to the last of its answer.
struct Turn {
  Request request;                 // of an unreadable head only the peer is known
  Head head;                       // without the parts that went into `request`
  std::optional<Refusal> refusal;  // what the head alone earned
  Census::Counted counted;

  // Does a body have to be read before it can be answered?
  bool wants_body() const { return !refusal && head.has_body(); }
};

// A refusal for want of memory or threads; without its detail when memory is out.
Refusal overloaded(const char* detail) noexcept;
// The answer when there is no memory for any other.
inline constexpr std::string_view kBareOverloaded =
    "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 1\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

class Connection {
 public:
  enum class Progress {
    nothing,   // not a byte of a request has come
    begun,     // a head that is not complete
    complete,  // turn() can be answered
    closed     // by the client, before a head was complete
  };

  Connection(int fd, Quota& memory, Census& census)
      : socket_(fd), census_(census), counted_(census.connection()), buffer_memory_(memory) {}

  // Reads on, without waiting, what has arrived. Throws when memory is out.
  Progress read_head();
  // Gives up on a request that has begun.
  void refuse(Refusal refusal) noexcept { turn_->refusal = std::move(refusal); }
  Turn& turn() { return *turn_; }
  // Gives back the memory of a large buffer, but for what is still in it.
  void trim_buffer();
  // The request is answered: the next one begins.
  void end_turn();
  std::size_t answered() const { return answered_; }

  ClientSocket& socket() { return socket_; }

  // Where the reception keeps it; nobody else's business.
  enum class Phase { silent, head, idle, lingering };
  struct Place {
    Phase phase = Phase::silent;
    Clock::time_point since{};
    Connections::iterator at{};
    bool registered = false;  // with epoll
  };
  Place place;
  Clock::time_point queued{};  // when a lane took it

 private:
  Progress judge();
  void begin_turn();
  bool pay_for_buffer();

  ClientSocket socket_;
  Census& census_;
  Census::Counted counted_;
  Quota::Lease buffer_memory_;
  HeadScan scan_;
  std::unique_ptr<Turn> turn_;
  std::size_t answered_ = 0;
  std::size_t blank_bytes_ = 0;
};

}  // namespace subdivd::server
