#pragma once
// The GLB container: a 12-byte header, then chunks of 4-byte aligned length. JSON comes first, BIN (if any)
// second, chunks of unknown type may follow and are kept.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace subdivd::proto::gltf {

inline constexpr std::uint32_t kGlbMagic = 0x46546C67;  // "glTF"
inline constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
inline constexpr std::size_t kGlbHeaderSize = 12, kChunkHeaderSize = 8;

struct ForeignChunk {
  std::uint32_t type = 0;
  std::span<const std::byte> bytes;
};

// Views into the bytes that were parsed.
struct Container {
  std::string_view json;
  std::optional<std::span<const std::byte>> bin;
  std::vector<ForeignChunk> foreign;
};

// Reads nothing past `body`, whatever lengths it claims; the claimed total must be exact.
Result<Container> parse_glb(std::string_view body);

}  // namespace subdivd::proto::gltf
