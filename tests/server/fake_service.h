#pragma once
// A service that answers with what it was asked, or misbehaves when told to by the path, and a transport
// that carries it.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "server/transport/transport.h"
#include "tests/server/raw_client.h"

namespace subdivd::server::testing {

class FakeService final : public Service {
 public:
  Lane lane(const Request& head) override { return head.path == "/health" ? Lane::health : Lane::general; }

  std::optional<Response> screen(const Request& head) override {
    if (head.path == "/screen-throws") throw std::runtime_error("secret of screen");
    if (head.path != "/early") return std::nullopt;
    return text(403, "early");
  }

  Response answer(Request& request) override {
    if (request.path == "/throws") throw std::runtime_error("secret of answer");
    if (request.path == "/throws-a-number") throw 42;
    if (request.path == "/no-memory") throw std::bad_alloc();
    if (request.path == "/no-threads")
      throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    if (request.path == "/stuck") return stuck();
    if (request.path == "/large") return large();
    if (request.path == "/crumbs") return crumbs();
    if (request.path == "/made") return made();
    if (request.path == "/wait") return wait(request);
    if (request.path == "/peer") return text(200, request.peer);
    if (request.path == "/size") return text(200, std::to_string(request.body.size()));
    if (request.path == "/header")
      return text(200, request.header("x-test") ? *request.header("x-test") : "-");
    std::string echo = request.method + " " + request.path;
    for (const auto& [name, value] : request.query) echo += " " + name + "=" + value;
    return text(200, echo + "\n" + request.body);
  }

  Response refuse(const Request&, const Refusal& refusal) override {
    if (refuse_throws) throw std::runtime_error("secret of refuse");
    return text(refusal.status, std::string(refusal.code) + ": " + refusal.detail);
  }

  void record(const Exchange& exchange) override {
    const std::lock_guard lock(mutex);
    statuses.push_back(exchange.status);
    if (!exchange.completed) ++broken_off;
    if (record_throws) throw std::runtime_error("disk full");
  }

  static Response text(int status, std::string body) {
    Response response;
    response.status = status;
    response.content_type = "text/plain";
    response.body.push_back(Bytes::of(std::move(body)));
    return response;
  }

  // Parts that are made while they are sent, one of no bytes among them, beside others.
  static Response made() {
    Response response = text(200, "begin");
    for (const std::size_t pieces : {kMadePieces, std::size_t{0}, std::size_t{1}})
      response.body.push_back({nullptr, {}, std::make_shared<Maker>(pieces)});
    response.body.push_back(Bytes::of("end"));
    return response;
  }

  static constexpr std::size_t kLargePart = 3'000'000, kCrumbs = 200'000, kMadePieces = 5000;
  std::atomic<bool> refuse_throws = false, record_throws = false;
  std::atomic<bool> let_go = false;                  // ends /wait and /stuck
  std::atomic<int> waiting = 0, seen_cancelled = 0;  // requests in /wait; those that were cancelled there
  std::atomic<int> broken_off = 0;                   // responses that were not sent whole
  std::mutex mutex;
  std::vector<int> statuses;

 private:
  static Response large() {
    Response response = text(200, std::string(kLargePart, 'a'));
    response.body.push_back(Bytes::of(std::string(kLargePart, 'b')));
    return response;
  }

  // Parts of every size up to a hundred bytes, empty ones and a large one among them.
  static Response crumbs() {
    Response response = text(200, "");
    for (std::size_t i = 0; i < kCrumbs; ++i)
      response.body.push_back(Bytes::of(std::string(i % 100, static_cast<char>('a' + i % 26))));
    response.body.push_back(Bytes::of(std::string(kLargePart, 'z')));
    response.body.push_back(Bytes::of("end"));
    return response;
  }

  // Pieces of every size up to a hundred bytes and a few large ones, each over the one before it.
  class Maker final : public ByteMaker {
   public:
    explicit Maker(std::size_t pieces) : pieces_(pieces) {}
    Count size() const override {
      Count total = 0;
      for (std::size_t k = 1; k <= pieces_; ++k) total += size_of(k);
      return total;
    }
    Count held_bytes() const override { return kPiece; }
    std::span<const std::byte> next() noexcept override {
      if (at_ == pieces_) return {};
      ++at_;
      std::fill(piece_.begin(), piece_.end(), static_cast<std::byte>('a' + at_ % 26));
      return std::span<const std::byte>(piece_).first(size_of(at_));
    }

   private:
    static std::size_t size_of(std::size_t k) { return k % 1000 == 0 ? kPiece : 1 + k % 100; }
    static constexpr std::size_t kPiece = 200'000;
    std::size_t pieces_, at_ = 0;
    std::vector<std::byte> piece_ = std::vector<std::byte>(kPiece);
  };

  // As /wait, but it cannot be cancelled.
  Response stuck() {
    ++waiting;
    while (!let_go) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    --waiting;
    return text(200, "stuck");
  }

  Response wait(const Request& request) {
    ++waiting;
    while (!let_go && !*request.cancelled) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (*request.cancelled) ++seen_cancelled;
    --waiting;
    return text(200, "waited");
  }
};

inline TransportOptions quick_options() {
  TransportOptions options;
  options.threads = 8;
  options.max_body_bytes = 100'000;
  options.read_timeout = std::chrono::milliseconds(400);
  options.idle_timeout = std::chrono::milliseconds(400);
  options.idle_grace = std::chrono::milliseconds(100);
  return options;
}

// Declared after the service, so that it ends first.
struct RunningTransport {
  explicit RunningTransport(const TransportOptions& options = quick_options(),
                            std::uint64_t memory_bytes = 1'000'000)
      : memory(memory_bytes), transport(options, service, memory) {
    const Result<void> started = transport.start();
    if (!started) throw std::runtime_error("cannot listen");
    port = transport.port();
  }
  FakeService service;
  RequestMemory memory;
  Transport transport;
  int port = 0;
};

// Polls until the condition holds, for 10 s at most.
template <class Condition>
bool eventually(Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace subdivd::server::testing
