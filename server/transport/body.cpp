#include "server/transport/body.h"

#include <algorithm>

#include "server/transport/chunked_body.h"
#include "server/transport/connection.h"

namespace subdivd::server {
namespace {

// An announced length is believed, and memory reserved for all of it, once this much has come; of little
// memory less, so that many bodies that wait for all of theirs do not take it from each other.
constexpr std::uint64_t kBelieved = 1 << 20, kBelievedShare = 128;
// What a body without announced length begins with.
constexpr std::uint64_t kFirstRoom = 64 * 1024;
constexpr std::size_t kReadBytes = 64 * 1024;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

Refusal no_room() { return overloaded("the bodies of other requests fill the memory set aside for them"); }

Refusal incomplete(const char* detail) { return {400, "incomplete_body", detail}; }

std::optional<Refusal> read_length(ClientSocket& socket, std::uint64_t length, const BodyLimits& limits,
                                   BodyBuffer& buffer, std::string& body) {
  Pace pace(limits.patience);
  char piece[kReadBytes];
  const std::uint64_t first = std::clamp(buffer.most() / kBelievedShare, kFirstRoom, kBelieved);
  const auto reserve = [&](std::uint64_t bytes) {
    const bool reserved = buffer.reserve(bytes, Clock::now() + limits.patience);
    pace = Pace(limits.patience);  // waiting for others was not the client's doing
    return reserved;
  };
  if (!reserve(std::min(length, first))) return no_room();
  while (body.size() < length) {
    if (body.size() == buffer.reserved() && !reserve(length)) return no_room();
    const std::uint64_t room = buffer.reserved() - body.size();
    const std::size_t count = socket.read(piece, std::min<std::uint64_t>(room, kReadBytes), pace.deadline());
    if (count == 0) return incomplete("the body ended early or came too slowly");
    pace.moved(count);
    body.append(piece, count);
  }
  return std::nullopt;
}

std::optional<Refusal> add_piece(std::string_view piece, std::uint64_t chunk_left, const BodyLimits& limits,
                                 BodyBuffer& buffer, std::string& body) {
  const std::uint64_t allowed = limits.bytes;
  const std::uint64_t size = body.size() + piece.size();
  // How large it would have become in the end is not known.
  if (size > allowed || chunk_left > allowed - size) return body_too_large(0, allowed);
  if (size > buffer.reserved()) {
    const std::uint64_t doubled = std::max(kFirstRoom, 2 * buffer.reserved());
    if (!buffer.reserve(std::max(size, std::min(doubled, allowed)), Clock::now() + limits.patience))
      return no_room();
  }
  body.append(piece);
  return std::nullopt;
}

std::optional<Refusal> read_chunked(ClientSocket& socket, const BodyLimits& limits, BodyBuffer& buffer,
                                    std::string& body) {
  // Only the body's own bytes buy time: extensions and chunks of one byte do not.
  Pace pace(limits.patience);
  ChunkedBody chunks;
  for (;;) {
    const ChunkedBody::Step step = chunks.read(socket.buffered());
    if (!step.data.empty()) {
      if (auto refusal = add_piece(step.data, chunks.chunk_left(), limits, buffer, body)) return refusal;
      pace.moved(step.data.size());
    }
    socket.consume(step.used);
    if (chunks.state() == ChunkedBody::State::done) return std::nullopt;
    if (chunks.state() == ChunkedBody::State::malformed)
      return incomplete("the body's chunks are not framed as RFC 9112, 7.1 has it");
    if (Clock::now() >= pace.deadline() ||
        (socket.buffered().empty() &&
         socket.fill(kReadBytes, pace.deadline()) != ClientSocket::Outcome::ready))
      return incomplete("the body ended early or came too slowly");
  }
}

}  // namespace

bool BodyBuffer::reserve(std::uint64_t bytes, Clock::time_point deadline) {
  if (bytes <= reserved_) return true;
  Quota::Lease& next = leases_[1 - current_];
  if (!next.grow_to(bytes, deadline, nullptr)) return false;
  // reserve() of a string that holds something makes room for twice as much as it did, wanted or not.
  std::string larger;
  larger.reserve(bytes);
  larger.append(body_);
  body_ = std::move(larger);
  leases_[current_].release();
  current_ = 1 - current_;
  reserved_ = bytes;
  return true;
}

void BodyBuffer::release() {
  std::string().swap(body_);
  for (Quota::Lease& lease : leases_) lease.release();
  reserved_ = 0;
}

Refusal body_too_large(std::uint64_t announced, std::uint64_t allowed) {
  return {413, "body_too_large",
          "the body is larger than the " + std::to_string(allowed) + " bytes that are allowed", announced,
          allowed};
}

std::optional<Refusal> read_body(ClientSocket& socket, const Head& head, const BodyLimits& limits,
                                 BodyBuffer& buffer, std::string& body) {
  if (head.expects_continue && !socket.holds_unread()) {
    Pace pace(limits.patience);
    if (!socket.write(kContinue, pace)) return incomplete("the client left before it sent the body");
  }
  return head.framing == Head::Framing::chunked
             ? read_chunked(socket, limits, buffer, body)
             : read_length(socket, head.content_length, limits, buffer, body);
}

}  // namespace subdivd::server
