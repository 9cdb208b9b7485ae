#pragma once
// An answer's body as one text.

#include <string>

#include "proto/wire.h"

namespace subdivd::test {

// What is made while it is sent is made here: once for every payload.
inline std::string text_of(const proto::Payload& payload) {
  std::string text;
  const auto append = [&](std::span<const std::byte> bytes) {
    text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  for (const proto::Chunk& chunk : payload.chunks) {
    append(chunk.bytes);
    for (std::span<const std::byte> made; chunk.maker && !(made = chunk.maker->next()).empty();) append(made);
  }
  return text;
}

}  // namespace subdivd::test
