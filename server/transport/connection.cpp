#include "server/transport/connection.h"

#include <algorithm>
#include <new>
#include <utility>
#include <variant>

#include "server/transport/target.h"

namespace subdivd::server {
namespace {

// Buffers up to this size are taken for granted; 10,000 connections hold no more than 10 MB of them. Larger
// ones are paid for from the memory that all requests share.
constexpr std::size_t kFreeBuffer = 1024;
// Most heads are smaller. What comes behind a head stays with the kernel, but for the rest of such a piece.
constexpr std::size_t kPiece = 4 * 1024;
// Empty lines before a request are skipped [RFC 9112, 2.2], but not for ever.
constexpr std::size_t kMaxBlankBytes = 16;

std::optional<Refusal> understand(std::string_view text, Turn& turn) {
  auto parsed = parse_head(text);
  if (Refusal* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  turn.head = std::get<Head>(std::move(parsed));
  Request& request = turn.request;
  request.method = std::move(turn.head.method);
  request.target = std::move(turn.head.target);
  request.headers = std::move(turn.head.headers);
  auto target = parse_target(request.target);
  if (!target)
    return Refusal{400, "bad_request",
                   "the request target must be a path, or a URL with a host; percent-escapes must be two "
                   "hexadecimal digits that make UTF-8"};
  request.path = std::move(target->path);
  request.query = std::move(target->query);
  return std::nullopt;
}

Refusal fault_of(HeadScan::Verdict verdict) {
  switch (verdict) {
    case HeadScan::Verdict::endless_target:
      return {414, "uri_too_long", "the request target is longer than 8192 bytes"};
    case HeadScan::Verdict::too_large:
      return {431, "headers_too_large", "the head of a request may have 32768 bytes"};
    default:
      return {400, "bad_request",
              "this is no HTTP/1.1: lines end in CR LF, and the first one begins with a method"};
  }
}

}  // namespace

Refusal overloaded(const char* detail) noexcept {
  Refusal refusal{503, "overloaded", {}};
  try {
    refusal.detail = detail;
  } catch (const std::bad_alloc&) {
  }
  return refusal;
}

void Connection::begin_turn() {
  turn_ = std::make_unique<Turn>();
  turn_->counted = census_.request();
  turn_->request.arrived = Clock::now();
}

bool Connection::pay_for_buffer() {
  const std::size_t bytes = socket_.buffer_bytes();
  return bytes <= kFreeBuffer || buffer_memory_.grow_to(bytes);
}

Connection::Progress Connection::judge() {
  while (!turn_ && blank_bytes_ < kMaxBlankBytes && socket_.buffered().starts_with("\r\n")) {
    socket_.consume(2);
    blank_bytes_ += 2;
  }
  // The first half of such a line may still become a whole one.
  if (!turn_ && (socket_.buffered().empty() || socket_.buffered() == "\r")) return Progress::nothing;
  if (!turn_) begin_turn();
  if (!pay_for_buffer()) {
    refuse(overloaded("other requests fill the memory set aside for them"));
    return Progress::complete;
  }
  const HeadScan::Verdict verdict = scan_.read(socket_.buffered());
  if (verdict == HeadScan::Verdict::incomplete) return Progress::begun;
  if (verdict == HeadScan::Verdict::complete) {
    turn_->refusal = understand(socket_.buffered().substr(0, scan_.size()), *turn_);
    socket_.consume(scan_.size());
  } else {
    turn_->refusal = fault_of(verdict);
  }
  return Progress::complete;
}

Connection::Progress Connection::read_head() {
  Progress progress = judge();
  while (progress != Progress::complete) {
    const std::size_t room = kMaxHeadBytes - std::min(kMaxHeadBytes, socket_.buffered().size());
    const ClientSocket::Outcome outcome = socket_.fill_now(std::clamp<std::size_t>(room, 1, kPiece));
    if (outcome == ClientSocket::Outcome::closed) return Progress::closed;
    if (outcome == ClientSocket::Outcome::would_block) break;
    progress = judge();
  }
  return progress;
}

void Connection::end_turn() {
  turn_.reset();
  scan_ = HeadScan();
  blank_bytes_ = 0;
  ++answered_;
  trim_buffer();
}

void Connection::trim_buffer() {
  if (socket_.buffer_bytes() <= kFreeBuffer) return;
  try {
    socket_.trim_buffer();
    buffer_memory_.release();
  } catch (const std::bad_alloc&) {  // then it stays as large as it is, and paid for
  }
}

}  // namespace subdivd::server
