#pragma once
// JSON text into chunks of about a megabyte: a big answer is never one string, so it never needs twice its
// size. Numbers are written with std::to_chars, the shortest text that reads back to the same bits.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

inline const Budget kUnlimited{};

// A JSON string literal; bytes that are not UTF-8 become U+FFFD.
std::string quoted_json(std::string_view text);

class TextWriter {
 public:
  static constexpr std::size_t kAllFinite = static_cast<std::size_t>(-1);

  // Polls `budget`, which must outlive it, at every chunk; stopped, it writes no more, and says why.
  explicit TextWriter(const Budget& budget = kUnlimited) : budget_(budget) {}
  const std::optional<Error>& stopped() const { return stopped_; }

  void raw(std::string_view text);
  // The comma before a member or an element, unless it is the first.
  void separate();
  void key(std::string_view name);  // separate(), then "name":
  void string(std::string_view text) { raw(quoted_json(text)); }

  void number(double value);  // finite
  void number(float value);
  void number(std::uint64_t value);

  void open(char bracket) { raw(std::string_view(&bracket, 1)); }
  void close(char bracket) { raw(std::string_view(&bracket, 1)); }

  // [[x,y,z],…] or [x,y,z,…]. Stops at a number that is not finite and returns its place, otherwise
  // kAllFinite.
  template <class Real>
  std::size_t tuples(std::span<const Real> values, std::size_t width, ArrayForm form);
  void indices(std::span<const Index> values, std::size_t width, ArrayForm form);

  std::vector<Chunk> finish();

 private:
  template <class Number>
  void scalar(Number value);
  template <class Number>
  std::size_t array(std::span<const Number> values, std::size_t width, ArrayForm form);
  // Makes room for `bytes` more and returns where they go.
  char* room(std::size_t bytes) {
    if (size_ - used_ < bytes) flush(bytes);
    return buffer_.get() + used_;
  }
  void flush(std::size_t bytes);

  const Budget& budget_;
  std::optional<Error> stopped_;
  std::vector<Chunk> chunks_;
  std::shared_ptr<char[]> buffer_;  // of size_ bytes, unset beyond used_
  std::size_t size_ = 0, used_ = 0, next_size_ = 1 << 14;
  char last_ = 0;  // of what has been flushed
};

extern template std::size_t TextWriter::tuples<float>(std::span<const float>, std::size_t, ArrayForm);
extern template std::size_t TextWriter::tuples<double>(std::span<const double>, std::size_t, ArrayForm);

}  // namespace subdivd::proto::json
