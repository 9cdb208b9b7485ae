// A PNG file without compression: four colours, two bits a pixel.
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/shapes/sample.h"

namespace subdivd::shapes {
namespace {

constexpr int kSize = 256;
enum Colour : unsigned { cream, cobalt, sky, rust };
constexpr unsigned char kPalette[] = {243, 234, 214, 33, 62, 128, 132, 172, 208, 176, 86, 46};

double wave(double u, double periods) { return std::sin(2 * std::numbers::pi * periods * u); }

// What is painted on the jug at (u, v).
Colour painted(double u, double v) {
  if (v > 0.88) return cobalt;              // handle
  if (v > 0.80 || v < 0.05) return cobalt;  // lip and foot
  if ((v > 0.765 && v < 0.78) || (v > 0.065 && v < 0.08)) return rust;
  if (v > 0.56 && v < 0.74) {  // leaves hang from the neck
    const double leaf = std::abs(wave(u, 6)) * 0.15;
    if (0.74 - v < leaf - 0.03) return sky;
    if (0.74 - v < leaf) return cobalt;
    return cream;
  }
  if ((v > 0.50 && v < 0.515) || (v > 0.125 && v < 0.14)) return cobalt;
  const double up = 0.32 + 0.10 * wave(u, 5), down = 0.32 - 0.10 * wave(u, 5);
  if (std::abs(v - up) < 0.018) return cobalt;
  if (std::abs(v - down) < 0.018) return sky;
  const double x = std::abs(wave(u, 5));  // berries where the waves are far apart
  if (x > 0.90 && std::abs(v - 0.32) < 0.028) return rust;
  return cream;
}

void put_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
}

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

void put_chunk(std::string& png, const std::string& type, const std::string& data) {
  put_big_endian(png, static_cast<std::uint32_t>(data.size()));
  png += type + data;
  put_big_endian(png, crc32(type + data));
}

// A zlib stream of one stored block: at most 65,535 bytes.
std::string stored(const std::string& raw) {
  std::string out = {'\x78', '\x01', '\x01'};
  const auto size = static_cast<std::uint16_t>(raw.size());
  for (const unsigned half : {unsigned{size}, ~unsigned{size}}) {
    out += static_cast<char>(half & 0xff);
    out += static_cast<char>(half >> 8 & 0xff);
  }
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : raw) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  out += raw;
  put_big_endian(out, b << 16 | a);
  return out;
}

}  // namespace

std::string sample_texture_png() {
  std::string rows;
  for (int y = 0; y < kSize; ++y) {
    rows += '\0';  // no filter
    for (int x = 0; x < kSize; x += 4) {
      unsigned four = 0;
      for (int k = 0; k < 4; ++k) four = four << 2 | painted((x + k + 0.5) / kSize, (y + 0.5) / kSize);
      rows += static_cast<char>(four);
    }
  }
  std::string header;
  put_big_endian(header, kSize);
  put_big_endian(header, kSize);
  header += std::string{'\x02', '\x03', '\0', '\0', '\0'};  // 2 bits, palette
  std::string png = "\x89PNG\r\n\x1a\n";
  put_chunk(png, "IHDR", header);
  put_chunk(png, "PLTE", std::string(reinterpret_cast<const char*>(kPalette), sizeof kPalette));
  put_chunk(png, "IDAT", stored(rows));
  put_chunk(png, "IEND", "");
  return png;
}

}  // namespace subdivd::shapes
