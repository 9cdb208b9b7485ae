#pragma once
// Base64 as RFC 4648 has it: padded, no white space, unused bits zero.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/wire.h"

namespace subdivd::proto::gltf {

// Empty when `text` is not strictly Base64.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

inline constexpr Count base64_size(Count bytes) { return (bytes + 2) / 3 * 4; }

// The text of all chunks one after the other, in pieces of about 4 MiB.
std::vector<Chunk> encode_base64(const std::vector<Chunk>& chunks);

}  // namespace subdivd::proto::gltf
