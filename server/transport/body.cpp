#include "server/transport/body.h"

#include <algorithm>

#include "server/transport/chunked_body.h"
#include "server/transport/connection.h"

namespace subdivd::server {
namespace {

constexpr std::size_t kReadBytes = 64 * 1024;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

Refusal no_room() { return overloaded("the bodies of other requests fill the memory set aside for them"); }

Refusal incomplete(const char* detail) { return {400, "incomplete_body", detail}; }

// Reads into a buffer that grows. Waiting for the memory of others is not the client's doing: it does not
// count as its time.
class Reader {
 public:
  Reader(ClientSocket& socket, const BodyLimits& limits, ThreadDemand& demand,
         const std::atomic<bool>* cancelled, BodyBuffer& buffer, std::string& body)
      : socket_(socket),
        limits_(limits),
        demand_(demand),
        cancelled_(cancelled),
        buffer_(buffer),
        body_(body),
        time_(limits.patience, demand) {}

  std::optional<Refusal> read_length(std::uint64_t length);
  std::optional<Refusal> read_chunked();

 private:
  bool reserve(std::uint64_t bytes) {
    if (bytes <= buffer_.reserved()) return true;
    const bool reserved = buffer_.reserve(bytes, Clock::now() + limits_.patience, cancelled_);
    time_ = TransferTime(limits_.patience, demand_);
    return reserved;
  }
  // Why the socket has no more.
  Refusal broken_off() const {
    if (time_.gave_way()) return overloaded("others waited for a thread while this body came slowly");
    return incomplete("the body ended early or came too slowly");
  }
  std::optional<Refusal> add_piece(std::string_view piece, std::uint64_t chunk_left);

  ClientSocket& socket_;
  const BodyLimits& limits_;
  ThreadDemand& demand_;
  const std::atomic<bool>* cancelled_;
  BodyBuffer& buffer_;
  std::string& body_;
  TransferTime time_;
};

std::optional<Refusal> Reader::read_length(std::uint64_t length) {
  char piece[kReadBytes];
  if (!reserve(std::min(length, kFreeBody))) return no_room();
  while (body_.size() < length) {
    if (body_.size() == buffer_.reserved() && !reserve(length)) return no_room();
    const std::uint64_t room = buffer_.reserved() - body_.size();
    const std::size_t count = socket_.read(piece, std::min<std::uint64_t>(room, kReadBytes), time_);
    if (count == 0) return broken_off();
    time_.moved(count);
    body_.append(piece, count);
  }
  return std::nullopt;
}

std::optional<Refusal> Reader::add_piece(std::string_view piece, std::uint64_t chunk_left) {
  const std::uint64_t size = body_.size() + piece.size();
  // How large it would have become in the end is not known.
  if (size > limits_.bytes || chunk_left > limits_.bytes - size) return body_too_large(0, limits_.bytes);
  if (size > buffer_.reserved() && !reserve(buffer_.next_room(size, limits_.bytes))) return no_room();
  body_.append(piece);
  return std::nullopt;
}

std::optional<Refusal> Reader::read_chunked() {
  ChunkedBody chunks;
  for (;;) {
    const ChunkedBody::Step step = chunks.read(socket_.buffered());
    if (!step.data.empty()) {
      if (auto refusal = add_piece(step.data, chunks.chunk_left())) return refusal;
      time_.moved(step.data.size());  // only these buy time: extensions and chunks of one byte do not
    }
    socket_.consume(step.used);
    if (chunks.state() == ChunkedBody::State::done) return std::nullopt;
    if (chunks.state() == ChunkedBody::State::malformed)
      return incomplete("the body's chunks are not framed as RFC 9112, 7.1 has it");
    if (time_.is_over() ||
        (socket_.buffered().empty() && socket_.fill(kReadBytes, time_) != ClientSocket::Outcome::ready))
      return broken_off();
  }
}

}  // namespace

bool BodyBuffer::reserve(std::uint64_t bytes, Clock::time_point deadline,
                         const std::atomic<bool>* cancelled) {
  if (bytes <= reserved_) return true;
  const bool small = bytes <= kFreeBody, medium = bytes <= memory_.most_medium();
  if (!small) {
    Quota::Lease& lease = medium ? medium_ : large_;
    // One that waited for more of what it has already could wait for itself.
    if (lease.bytes() > 0 ? !lease.grow_to(bytes) : !lease.grow_to(bytes, deadline, cancelled)) return false;
  }
  // reserve() of a string that holds something makes room for twice as much as it did, wanted or not.
  std::string larger;
  larger.reserve(bytes);
  larger.append(body_);
  body_ = std::move(larger);
  if (!medium) medium_.release();
  reserved_ = bytes;
  return true;
}

std::uint64_t BodyBuffer::next_room(std::uint64_t bytes, std::uint64_t most) const {
  for (const std::uint64_t room : {kFreeBody, memory_.most_medium()})
    if (bytes <= room) return std::min(room, most);
  return most;  // only what is written to takes real memory
}

void BodyBuffer::release() {
  std::string().swap(body_);
  medium_.release();
  large_.release();
  reserved_ = 0;
}

Refusal body_too_large(std::uint64_t announced, std::uint64_t allowed) {
  return {413, "body_too_large",
          "the body is larger than the " + std::to_string(allowed) + " bytes that are allowed", announced,
          allowed};
}

std::optional<Refusal> read_body(ClientSocket& socket, const Head& head, const BodyLimits& limits,
                                 ThreadDemand& demand, const std::atomic<bool>* cancelled, BodyBuffer& buffer,
                                 std::string& body) {
  if (head.expects_continue && !socket.holds_unread()) {
    TransferTime time(limits.patience, demand);
    if (!socket.write(kContinue, time)) return incomplete("the client left before it sent the body");
  }
  Reader reader(socket, limits, demand, cancelled, buffer, body);
  return head.framing == Head::Framing::chunked ? reader.read_chunked()
                                                : reader.read_length(head.content_length);
}

}  // namespace subdivd::server
