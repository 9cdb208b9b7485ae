#pragma once
// Base64 as RFC 4648 has it: padded, no white space, unused bits zero.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/work.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// Empty when `text` is not strictly Base64. The bytes are kept with `work`.
Result<std::optional<std::vector<std::byte>>> decode_base64(std::string_view text, Work& work);

inline constexpr Count base64_size(Count bytes) { return (bytes + 2) / 3 * 4; }

// The text of all chunks one after the other, in pieces of about 4 MiB. Each chunk is let go of as soon as it
// is text.
Result<std::vector<Chunk>> encode_base64(std::vector<Chunk> chunks, Work& work);

}  // namespace subdivd::proto::gltf
