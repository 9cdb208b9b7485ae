#include "proto/json/text_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "proto/json/number_text.h"

namespace subdivd::proto::json {
namespace {

constexpr std::size_t kChunkSize = std::size_t{1} << 20;

}  // namespace

std::string quoted_json(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void TextWriter::flush(std::size_t bytes) {
  if (!stopped_) stopped_ = budget_.poll();
  if (stopped_) {  // what has been written is of no use
    chunks_.clear();
    used_ = 0;
    if (size_ >= bytes) return;
  }
  if (used_ > 0) {
    last_ = buffer_[used_ - 1];
    const auto text = std::as_bytes(std::span(buffer_.get(), used_));
    chunks_.push_back({std::move(buffer_), text});
  }
  size_ = std::max(bytes, next_size_);
  buffer_ = std::make_shared_for_overwrite<char[]>(size_);
  used_ = 0;
  next_size_ = std::min(2 * next_size_, kChunkSize);
}

void TextWriter::raw(std::string_view text) {
  std::memcpy(room(text.size()), text.data(), text.size());
  used_ += text.size();
}

template <class Number>
void TextWriter::scalar(Number value) {
  char* const begin = room(kLongestNumber);
  used_ += static_cast<std::size_t>(print_number(begin, value) - begin);
}
void TextWriter::number(double value) { scalar(value); }
void TextWriter::number(float value) { scalar(value); }
void TextWriter::number(std::uint64_t value) { scalar(value); }

void TextWriter::separate() {
  const char before = used_ > 0 ? buffer_[used_ - 1] : last_;
  if (before != '{' && before != '[' && before != 0) raw(",");
}

void TextWriter::key(std::string_view name) {
  separate();
  string(name);
  raw(":");
}

template <class Number>
std::size_t TextWriter::array(std::span<const Number> values, std::size_t width, ArrayForm form) {
  const bool nested = form == ArrayForm::nested;
  raw("[");
  std::size_t in_tuple = 0;
  for (std::size_t i = 0; i < values.size() && !stopped_; ++i) {
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(values[i])) return i;
    char* const begin = room(kLongestNumber + 4);
    char* at = begin;
    if (i > 0) *at++ = ',';
    if (nested && in_tuple == 0) *at++ = '[';
    at = print_number(at, values[i]);
    if (++in_tuple == width) {
      in_tuple = 0;
      if (nested) *at++ = ']';
    }
    used_ += static_cast<std::size_t>(at - begin);
  }
  raw("]");
  return kAllFinite;
}

template <class Real>
std::size_t TextWriter::tuples(std::span<const Real> values, std::size_t width, ArrayForm form) {
  return array(values, width, form);
}
template std::size_t TextWriter::tuples<float>(std::span<const float>, std::size_t, ArrayForm);
template std::size_t TextWriter::tuples<double>(std::span<const double>, std::size_t, ArrayForm);

void TextWriter::indices(std::span<const Index> values, std::size_t width, ArrayForm form) {
  array(values, width, form);
}

std::vector<Chunk> TextWriter::finish() {
  flush(0);
  return std::move(chunks_);
}

}  // namespace subdivd::proto::json
