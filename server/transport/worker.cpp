#include "server/transport/worker.h"

#include <exception>
#include <new>
#include <system_error>
#include <utility>

namespace subdivd::server {
namespace {

class Attached {
 public:
  Attached(Watcher::Post& post, int fd) : post_(post) { post_.attach(fd); }
  ~Attached() { post_.detach(); }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  Watcher::Post& post_;
};

class Watching {
 public:
  Watching(Watcher::Post& post, bool may_probe) : post_(post) { post_.watch(may_probe); }
  ~Watching() { post_.unwatch(); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

 private:
  Watcher::Post& post_;
};

bool is_short_of_resources(const std::system_error& error) {
  return error.code() == std::errc::resource_unavailable_try_again ||
         error.code() == std::errc::not_enough_memory;
}

// What the exception under way becomes; what() stays inside.
Refusal refusal_of_exception() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return overloaded("memory is out");
  } catch (const std::system_error& error) {
    if (is_short_of_resources(error)) return overloaded("threads are out");
  } catch (...) {
  }
  return {500, "internal", "the server failed to answer this request"};
}

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Worker::Worker(const WorkerContext& context, std::chrono::milliseconds patience)
    : context_(context),
      patience_(patience),
      engine_(std::chrono::floor<std::chrono::seconds>(context.idle_timeout).count()),
      post_(context.watcher) {}

Worker::After Worker::answer(Connection& connection) {
  After after = After::close;
  try {
    const Attached attached(post_, connection.socket().fd());
    after = exchange(connection);
  } catch (...) {  // out of memory before a byte was sent
    connection.socket().write_now(kBareOverloaded);
    after = After::linger;
  }
  return after;
}

Worker::After Worker::exchange(Connection& connection) {
  Turn& turn = connection.turn();
  Request& request = turn.request;
  request.cancelled = &post_.cancelled();
  request.peer = connection.socket().peer();
  BodyBuffer buffer(context_.memory, request.body);
  bool body_left = turn.refusal || turn.head.has_body();
  Response response = respond(connection, buffer, body_left);
  buffer.release();
  const bool last = connection.answered() + 1 >= context_.max_requests_per_connection;
  response.close |= last || body_left || turn.refusal || !turn.head.keep_alive || context_.draining;
  const bool close = response.close;
  const int status = response.status;
  const std::uint64_t size = response.size();
  const Engine::Sent sent = engine_.send(connection.socket(), std::move(response), request.method == "HEAD",
                                         TransferTime(patience_, context_.demand));
  if (sent == Engine::Sent::nothing && !post_.cancelled()) connection.socket().write_now(kBareOverloaded);
  const bool whole = sent == Engine::Sent::whole;
  record_safely({request, sent == Engine::Sent::nothing ? 503 : status, size, whole,
                 milliseconds_since(request.arrived)});
  if (!close && whole) return After::keep;
  // One who was told of the end only now may be sending the next request already: to be closed under it would
  // destroy the answer on its way [RFC 9112, 9.6].
  const bool more_comes = body_left || turn.head.keep_alive || connection.socket().holds_unread();
  return sent != Engine::Sent::partly && more_comes ? After::linger : After::close;
}

Response Worker::respond(Connection& connection, BodyBuffer& buffer, bool& body_left) {
  Turn& turn = connection.turn();
  Request& request = turn.request;
  if (turn.refusal) return refuse_safely(request, *turn.refusal);
  if (auto early = screen_safely(request)) return *std::move(early);
  if (body_left) {
    if (turn.head.content_length > context_.body.bytes)
      return refuse_safely(request, body_too_large(turn.head.content_length, context_.body.bytes));
    std::optional<Refusal> refusal;
    try {
      refusal = read_body(connection.socket(), turn.head, context_.body, context_.demand, request.cancelled,
                          buffer, request.body);
    } catch (...) {
      refusal = refusal_of_exception();
    }
    if (refusal) {
      buffer.release();
      return refuse_safely(request, *refusal);
    }
    body_left = false;
  }
  connection.trim_buffer();
  return answer_safely(turn, request, buffer);
}

std::optional<Response> Worker::screen_safely(const Request& request) {
  try {
    return context_.service.screen(request);
  } catch (...) {
    return refuse_safely(request, refusal_of_exception());
  }
}

Response Worker::answer_safely(const Turn& turn, Request& request, BodyBuffer& buffer) {
  const Watching watching(post_, turn.head.minor_version >= 1);
  try {
    return context_.service.answer(request);
  } catch (...) {
    buffer.release();  // words need memory, too
    return refuse_safely(request, refusal_of_exception());
  }
}

Response Worker::refuse_safely(const Request& request, const Refusal& refusal) {
  try {
    return context_.service.refuse(request, refusal);
  } catch (...) {
    Response bare;
    bare.status = refusal.status;
    bare.close = true;
    if (bare.status == 503) bare.headers.emplace_back("Retry-After", "1");
    return bare;
  }
}

void Worker::record_safely(const Exchange& exchange) {
  try {
    context_.service.record(exchange);
  } catch (...) {  // a full disk must not end the process
  }
}

}  // namespace subdivd::server
