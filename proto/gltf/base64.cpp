#include "proto/gltf/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace subdivd::proto::gltf {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNoDigit = 0xff;

constexpr std::array<std::uint8_t, 256> kDigits = [] {
  std::array<std::uint8_t, 256> digits{};
  digits.fill(kNoDigit);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  return digits;
}();

constexpr std::size_t kPieceBytes = std::size_t{3} << 20;

// Appends the digits of 1 to 3 bytes, padded.
void append_group(const std::byte* bytes, std::size_t count, std::string& out) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i)
    bits = bits << 8 | (i < count ? std::to_integer<std::uint32_t>(bytes[i]) : 0);
  for (std::size_t i = 0; i < 4; ++i) out += i <= count ? kAlphabet[bits >> (18 - 6 * i) & 63] : '=';
}

}  // namespace

Result<std::optional<std::vector<std::byte>>> decode_base64(std::string_view text, Work& work) {
  using Bytes = std::optional<std::vector<std::byte>>;
  if (text.size() % 4 != 0) return Bytes();
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  const std::size_t size = text.size() / 4 * 3 - padding;
  if (auto kept = work.keep(size + kBlockBytes); !kept) return kept.error();
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  for (std::size_t at = 0; at < text.size(); at += 4) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    const std::size_t missing = at + 4 == text.size() ? padding : 0;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint8_t digit = i < 4 - missing ? kDigits[static_cast<unsigned char>(text[at + i])] : 0;
      if (digit == kNoDigit) return Bytes();
      bits = bits << 6 | digit;
    }
    if ((bits & ((1u << (8 * missing)) - 1)) != 0) return Bytes();
    for (std::size_t i = 0; i < 3 - missing; ++i)
      bytes.push_back(static_cast<std::byte>(bits >> (16 - 8 * i)));
  }
  return Bytes(std::move(bytes));
}

Result<std::vector<Chunk>> encode_base64(std::vector<Chunk> chunks, Work& work) {
  std::vector<Chunk> pieces;
  std::string piece;
  std::array<std::byte, 3> carried{};  // bytes of a group that spans two chunks
  std::size_t carry = 0;
  for (Chunk& chunk : chunks) {
    std::span<const std::byte> rest = chunk.bytes;
    while (!rest.empty()) {
      if (carry > 0 || rest.size() < 3) {
        carried[carry++] = rest.front();
        rest = rest.subspan(1);
        if (carry == 3) append_group(carried.data(), 3, piece), carry = 0;
      } else {
        const std::size_t take = std::min(rest.size() / 3 * 3, kPieceBytes - piece.size() / 4 * 3);
        // At once what a piece may hold, or the bytes of a thousand small chunks would be moved a thousand
        // times.
        if (piece.capacity() < piece.size() + base64_size(take) + 8)
          piece.reserve(std::max(std::min(2 * piece.capacity(), base64_size(kPieceBytes) + 16),
                                 piece.size() + base64_size(take) + 8));
        for (std::size_t at = 0; at < take; at += 3) append_group(rest.data() + at, 3, piece);
        rest = rest.subspan(take);
        if (auto stop = work.spend(take / 3)) return *std::move(stop);
      }
      if (piece.size() >= base64_size(kPieceBytes)) pieces.push_back(Chunk::own(std::exchange(piece, {})));
    }
    chunk = Chunk();
  }
  if (carry > 0) append_group(carried.data(), carry, piece);
  if (!piece.empty()) pieces.push_back(Chunk::own(std::move(piece)));
  return pieces;
}

}  // namespace subdivd::proto::gltf
