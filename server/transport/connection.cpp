#include "server/transport/connection.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "server/transport/target.h"

namespace subdivd::server {
namespace {

constexpr std::string_view kHeadEnd = "\r\n\r\n";
// An announced length is believed, and memory reserved for it, once this much has come.
constexpr std::size_t kBelieved = 1 << 20;

class Busy {
 public:
  explicit Busy(BusyCount& count) : count_(count) { count_.enter(); }
  ~Busy() { count_.leave(); }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  BusyCount& count_;
};

class Watching {
 public:
  explicit Watching(Watcher::Entry& entry) : entry_(entry) { entry_.watch(true); }
  ~Watching() { entry_.watch(false); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

 private:
  Watcher::Entry& entry_;
};

Refusal body_too_large(std::uint64_t announced, std::uint64_t allowed) {
  return {413, "body_too_large",
          "the body is larger than the " + std::to_string(allowed) + " bytes that are allowed", announced,
          allowed};
}

// What an exception becomes; what() stays inside.
const Refusal kInternal{500, "internal", "the server failed to answer this request"};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Connection::Connection(int fd, Engine& engine, const ConnectionContext& context)
    : engine_(engine), context_(context), socket_(fd), entry_(context.watcher, fd) {}

void Connection::serve() {
  const std::size_t most = context_.options.max_requests_per_connection;
  for (std::size_t count = 1; count <= most; ++count) {
    if (!wait_for_request(count == 1)) return;
    const Busy busy(context_.busy);
    if (!serve_one(count == most)) return;
  }
}

bool Connection::wait_for_request(bool first) {
  const auto give_up = [&] {
    return entry_.cancelled() || (!first && (context_.draining || context_.others_wait()));
  };
  return socket_.wait(Clock::now() + context_.options.idle_timeout, give_up) == ClientSocket::Outcome::ready;
}

Connection::ReadHead Connection::read_head(std::string& text, Refusal& refusal) {
  const Pace pace(context_.options.read_timeout);
  for (;;) {
    while (socket_.buffered().starts_with("\r\n")) socket_.consume(2);  // RFC 9112, 2.2
    const std::string_view buffered = socket_.buffered();
    const std::size_t end = buffered.substr(0, kMaxHeadBytes).find(kHeadEnd);
    if (end != std::string_view::npos) {
      text = buffered.substr(0, end + kHeadEnd.size());
      socket_.consume(text.size());
      return ReadHead::complete;
    }
    if (buffered.size() >= kMaxHeadBytes) {
      refusal = buffered.substr(0, kMaxHeadBytes).find('\n') == std::string_view::npos
                    ? Refusal{414, "uri_too_long", "the request target is longer than 8192 bytes"}
                    : Refusal{431, "headers_too_large", "the head of a request may have 32768 bytes"};
      return ReadHead::refused;
    }
    switch (socket_.fill(pace.deadline())) {
      case ClientSocket::Outcome::ready:
        break;
      case ClientSocket::Outcome::timed_out:
        refusal = {408, "request_timeout", "the head of the request did not arrive in time"};
        return ReadHead::refused;
      default:
        return ReadHead::closed;
    }
  }
}

std::optional<Refusal> Connection::understand(const std::string& text, Head& head, Request& request) const {
  auto parsed = parse_head(text);
  if (Refusal* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  head = std::get<Head>(std::move(parsed));
  request.method = head.method;
  request.target = head.target;
  request.headers = head.headers;
  auto target = parse_target(head.target);
  if (!target)
    return Refusal{
        400, "bad_request",
        "the request target must be a path, and percent-escapes must be two hexadecimal digits that "
        "make UTF-8"};
  request.path = std::move(target->path);
  request.query = std::move(target->query);
  return std::nullopt;
}

// Judges everything but the body; false when the client went away.
bool Connection::begin(Turn& turn) {
  Request& request = turn.request;
  request.arrived = Clock::now();
  request.peer = socket_.peer();
  request.cancelled = &entry_.cancelled();
  std::string text;
  Refusal refusal;
  const ReadHead read = read_head(text, refusal);
  if (read == ReadHead::closed) return false;
  turn.body_left = true;  // until the head says otherwise, where the request ends is anyone's guess
  if (read == ReadHead::refused) {
    turn.early = refuse_safely(request, refusal);
    return true;
  }
  if (const auto fault = understand(text, turn.head, request)) {
    turn.early = refuse_safely(request, *fault);
    return true;
  }
  const Head& head = turn.head;
  turn.body_left = head.framing == Head::Framing::chunked || head.content_length > 0;
  turn.early = screen_safely(request);
  const std::uint64_t allowed = context_.options.max_body_bytes;
  if (!turn.early && head.content_length > allowed)
    turn.early = refuse_safely(request, body_too_large(head.content_length, allowed));
  return true;
}

bool Connection::serve_one(bool last) {
  Turn turn;
  if (!begin(turn)) return false;
  int status = 0;
  std::uint64_t size = 0;
  bool close = true;
  const bool with_body = !turn.early && turn.body_left;
  const auto answer = [&](const BodyReader& reader) {
    Response response = turn.early  ? *std::move(turn.early)
                        : with_body ? answer_with_body(reader, turn)
                                    : answer_safely(turn.request);
    response.close |= last || turn.body_left || !turn.head.keep_alive || context_.draining;
    close = response.close;
    status = response.status;
    size = response.size();
    return response;
  };
  const bool sent = engine_.exchange(socket_, turn.head, with_body, context_.options.read_timeout, answer);
  if (status != 0)
    record_safely({turn.request, status, size, sent, milliseconds_since(turn.request.arrived)});
  if (sent && turn.body_left) socket_.linger();
  return sent && !close;
}

std::optional<Refusal> Connection::read_body(const BodyReader& reader, Turn& turn,
                                             Quota::Lease& lease) const {
  const std::uint64_t allowed = context_.options.max_body_bytes;
  std::string& body = turn.request.body;
  std::optional<Refusal> refusal;
  const bool complete = reader([&](std::string_view piece) {
    if (body.size() + piece.size() > allowed)
      refusal = body_too_large(0, allowed);  // chunked: how large it would have become is not known
    else if (!lease.grow_to(body.size() + piece.size()))
      refusal = Refusal{503, "overloaded", "the bodies of other requests fill the memory set aside for them"};
    else if (body.capacity() < turn.head.content_length && body.size() + piece.size() > kBelieved)
      body.reserve(turn.head.content_length);
    if (!refusal) body.append(piece);
    return !refusal;
  });
  if (!complete && !refusal)
    refusal =
        Refusal{400, "incomplete_body", "the body is not properly framed, ended early or came too slowly"};
  return refusal;
}

Response Connection::answer_with_body(const BodyReader& reader, Turn& turn) {
  Quota::Lease lease(context_.memory);
  if (const auto refusal = read_body(reader, turn, lease)) return refuse_safely(turn.request, *refusal);
  turn.body_left = false;
  Response response = answer_safely(turn.request);
  std::string().swap(turn.request.body);
  return response;
}

std::optional<Response> Connection::screen_safely(const Request& request) {
  try {
    return context_.service.screen(request);
  } catch (...) {
    return refuse_safely(request, kInternal);
  }
}

Response Connection::answer_safely(Request& request) {
  const Watching watching(entry_);
  try {
    return context_.service.answer(request);
  } catch (...) {
    return refuse_safely(request, kInternal);
  }
}

Response Connection::refuse_safely(const Request& request, const Refusal& refusal) {
  try {
    return context_.service.refuse(request, refusal);
  } catch (...) {
    Response bare;
    bare.status = refusal.status;
    bare.close = true;
    return bare;
  }
}

void Connection::record_safely(const Exchange& exchange) {
  try {
    context_.service.record(exchange);
  } catch (...) {  // a full disk must not end the process
  }
}

}  // namespace subdivd::server
