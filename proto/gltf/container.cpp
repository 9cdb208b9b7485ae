#include "proto/gltf/container.h"

#include <string>

namespace subdivd::proto::gltf {
namespace {

constexpr std::size_t kMaxForeignChunks = 64;

Error broken(std::string message) { return Error{ErrorCode::malformed, std::move(message)}; }

std::uint32_t little_endian(std::string_view body, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(body[at + i])} << (8 * i);
  return value;
}

Result<void> check_header(std::string_view body) {
  if (body.size() < kGlbHeaderSize)
    return broken("the GLB ends within its header: 12 bytes are needed, there are " +
                  std::to_string(body.size()));
  if (little_endian(body, 0) != kGlbMagic)
    return broken("the body does not begin with \"glTF\": it is no GLB file");
  if (const std::uint32_t version = little_endian(body, 4); version != 2)
    return Error{ErrorCode::unsupported,
                 "the GLB container has version " + std::to_string(version) + "; version 2 is needed"};
  if (const std::uint32_t length = little_endian(body, 8); length != body.size())
    return broken("the GLB header says " + std::to_string(length) + " bytes but the body has " +
                  std::to_string(body.size()));
  return {};
}

// Takes the chunk into its place, or says why it may not stand there.
Result<void> accept(Container& container, std::size_t ordinal, std::uint32_t type, std::string_view bytes) {
  const std::string name = "GLB chunk " + std::to_string(ordinal);
  if ((ordinal == 0) != (type == kJsonChunk))
    return broken(ordinal == 0 ? "the first GLB chunk is not JSON" : name + " is a second JSON chunk");
  const auto span = std::as_bytes(std::span(bytes));
  if (type == kJsonChunk) {
    container.json = bytes;
  } else if (type == kBinChunk) {
    if (container.bin || ordinal != 1)
      return broken(name + " is BIN; there may be one and only directly after JSON");
    container.bin = span;
  } else {
    if (container.foreign.size() == kMaxForeignChunks)
      return broken("the GLB has more than " + std::to_string(kMaxForeignChunks) + " chunks of unknown type");
    container.foreign.push_back({type, span});
  }
  return {};
}

}  // namespace

Result<Container> parse_glb(std::string_view body) {
  if (auto header = check_header(body); !header) return header.error();
  Container container;
  std::size_t at = kGlbHeaderSize;
  for (std::size_t ordinal = 0; at < body.size(); ++ordinal) {
    const std::string name = "GLB chunk " + std::to_string(ordinal);
    if (body.size() - at < kChunkHeaderSize)
      return broken(name + " ends within its header at byte " + std::to_string(at));
    const std::uint32_t length = little_endian(body, at), type = little_endian(body, at + 4);
    at += kChunkHeaderSize;
    if (length % 4 != 0)
      return broken(name + " has " + std::to_string(length) + " bytes; a multiple of 4 is needed");
    // A length past the file makes careless readers copy whatever lies behind it in memory.
    if (length > body.size() - at)
      return broken(name + " claims " + std::to_string(length) + " bytes but " +
                    std::to_string(body.size() - at) + " are left");
    if (auto taken = accept(container, ordinal, type, body.substr(at, length)); !taken) return taken.error();
    at += length;
  }
  if (container.json.empty()) return broken("the GLB has no JSON chunk");
  return container;
}

}  // namespace subdivd::proto::gltf
