#pragma once
// Takes a chunked body apart, as strictly as RFC 9112, 7.1 is written: hexadecimal sizes, line ends of CR LF,
// extensions and trailers within bounds. Two readers that disagree on where a body ends take the rest for
// different requests, so whatever is not exactly as written there is malformed.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace subdivd::server {

class ChunkedBody {
 public:
  // Of all extensions of a body together, and of all its trailers: more than anyone needs, too few to burden
  // us.
  static constexpr std::size_t kMaxExtensionBytes = 4 * 1024;
  static constexpr std::size_t kMaxTrailerBytes = 8 * 1024;
  static constexpr std::size_t kMaxSizeDigits = 16;  // of one chunk, leading zeros included

  enum class State { reading, done, malformed };
  struct Step {
    std::size_t used = 0;   // bytes of `wire` that are dealt with, `data` included
    std::string_view data;  // a piece of the body, within `wire`
  };

  // Reads on from `wire`: up to the end of the next piece of data, of the body or of `wire`. What comes after
  // the body is not touched.
  Step read(std::string_view wire);
  State state() const;
  // How much of the current chunk has not come yet, as the client announced it.
  std::uint64_t chunk_left() const { return left_; }

 private:
  enum class At {
    size_start,  // the first digit of a chunk's size
    size,
    blank,  // behind the size, where only an extension may follow
    extension,
    size_lf,
    data,
    data_cr,
    data_lf,
    trailer_start,  // the beginning of a trailer's line, or of the empty one
    trailer_name,
    trailer_value,
    trailer_lf,
    last_lf,
    done,
    malformed
  };

  At after(char c);
  At after_size(char c);
  At in_extension(char c);
  At in_trailer(char c);

  At at_ = At::size_start;
  std::uint64_t left_ = 0;
  std::size_t size_digits_ = 0;
  std::size_t extension_bytes_ = 0, trailer_bytes_ = 0;
  bool last_ = false;  // the chunk of size 0
};

}  // namespace subdivd::server
