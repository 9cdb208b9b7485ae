#pragma once
// What travels: a request as the service sees it, and the response it gives back. No HTTP library in sight.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/byte_maker.h"

namespace subdivd::server {

using Field = std::pair<std::string, std::string>;

struct Request {
  std::string method;
  std::string target;        // as it came: path and query, percent-encoded
  std::string path;          // decoded; may hold any byte a client likes to send
  std::vector<Field> query;  // decoded, in order, duplicates kept
  std::vector<Field>
      headers;       // names lower-cased, values as they came; only visible ASCII, blanks, tabs, UTF-8
  std::string peer;  // numeric address
  std::string body;
  std::chrono::steady_clock::time_point arrived{};  // when its first byte was there
  // Turns true when the client has gone or the drain deadline has passed: nobody waits for the answer.
  const std::atomic<bool>* cancelled = nullptr;

  // Value of the first header of this (lower-case) name; nullptr when there is none.
  const std::string* header(std::string_view name) const {
    for (const Field& field : headers)
      if (field.first == name) return &field.second;
    return nullptr;
  }
};

// Bytes and whatever keeps them alive, for big arrays are sent from where they were computed; or what makes
// them while they are sent.
struct Bytes {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> bytes;
  std::shared_ptr<ByteMaker> maker = nullptr;  // where it is set, `bytes` is empty

  std::uint64_t size() const { return maker ? maker->size() : bytes.size(); }

  static Bytes of(std::string text) {
    auto kept = std::make_shared<const std::string>(std::move(text));
    return {kept, std::as_bytes(std::span(*kept))};
  }
};

struct Response {
  int status = 200;
  std::string content_type;  // ignored without a body
  std::vector<Field> headers;
  std::vector<Bytes> body;           // sent one after the other
  std::shared_ptr<const void> hold;  // released when the last byte has been sent or the client has gone
  bool close = false;                // end the connection afterwards

  std::uint64_t size() const {
    std::uint64_t total = 0;
    for (const Bytes& part : body) total += part.size();
    return total;
  }
  // What stands in memory until it is sent: all that is not made only then, and what that is made from.
  std::uint64_t held_bytes() const {
    std::uint64_t total = 0;
    for (const Bytes& part : body) total += part.maker ? part.maker->held_bytes() : part.bytes.size();
    return total;
  }
};

}  // namespace subdivd::server
