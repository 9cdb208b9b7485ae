#include "server/transport/chunked_body.h"

#include <algorithm>
#include <limits>

#include "server/transport/grammar.h"

namespace subdivd::server {
ChunkedBody::State ChunkedBody::state() const {
  return at_ == At::done ? State::done : at_ == At::malformed ? State::malformed : State::reading;
}

ChunkedBody::Step ChunkedBody::read(std::string_view wire) {
  Step step;
  while (step.used < wire.size() && state() == State::reading) {
    if (at_ == At::data) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left_, wire.size() - step.used));
      step.data = wire.substr(step.used, count);
      step.used += count;
      left_ -= count;
      if (left_ == 0) at_ = At::data_cr;
      return step;
    }
    at_ = after(wire[step.used++]);
  }
  return step;
}

ChunkedBody::At ChunkedBody::after(char c) {
  switch (at_) {
    case At::size_start:
      left_ = 0;
      size_digits_ = 0;
      return hex_digit(c) < 0 ? At::malformed : after_size(c);
    case At::size:
      return after_size(c);
    case At::blank:
    case At::extension:
      return in_extension(c);
    case At::size_lf:
      return c != '\n' ? At::malformed : last_ ? At::trailer_start : At::data;
    case At::data_cr:
      return c == '\r' ? At::data_lf : At::malformed;
    case At::data_lf:
      return c == '\n' ? At::size_start : At::malformed;
    case At::trailer_lf:
      return c == '\n' ? At::trailer_start : At::malformed;
    case At::last_lf:
      return c == '\n' ? At::done : At::malformed;
    default:
      return in_trailer(c);
  }
}

// chunk-size = 1*HEXDIG
ChunkedBody::At ChunkedBody::after_size(char c) {
  if (const int digit = hex_digit(c); digit >= 0) {
    if (left_ > std::numeric_limits<std::uint64_t>::max() / 16 || ++size_digits_ > kMaxSizeDigits)
      return At::malformed;
    left_ = left_ * 16 + static_cast<std::uint64_t>(digit);
    return At::size;
  }
  last_ = left_ == 0;
  if (c == '\r') return At::size_lf;
  if (c == ';') return At::extension;
  return c == ' ' || c == '\t' ? At::blank : At::malformed;
}

// chunk-ext = *( BWS ";" ... ): what it says is nobody's business here, how long it is, is.
ChunkedBody::At ChunkedBody::in_extension(char c) {
  if (++extension_bytes_ > kMaxExtensionBytes) return At::malformed;
  if (at_ == At::blank) return c == ';' ? At::extension : c == ' ' || c == '\t' ? At::blank : At::malformed;
  if (c == '\r') return At::size_lf;
  return is_text_character(c) ? At::extension : At::malformed;
}

// trailer-section = *( field-line CRLF ), read and thrown away
ChunkedBody::At ChunkedBody::in_trailer(char c) {
  if (++trailer_bytes_ > kMaxTrailerBytes) return At::malformed;
  switch (at_) {
    case At::trailer_start:
      if (c == '\r') return At::last_lf;
      return is_token_character(c) ? At::trailer_name : At::malformed;
    case At::trailer_name:
      if (c == ':') return At::trailer_value;
      return is_token_character(c) ? At::trailer_name : At::malformed;
    case At::trailer_value:
      if (c == '\r') return At::trailer_lf;
      return is_text_character(c) ? At::trailer_value : At::malformed;
    default:
      return At::malformed;
  }
}

}  // namespace subdivd::server
