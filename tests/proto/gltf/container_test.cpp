#include "proto/gltf/container.h"

#include <gtest/gtest.h>

#include "proto/gltf/base64.h"
#include "tests/proto/gltf/unlimited.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::proto::gltf {
namespace {

std::string glb() { return test::make_glb("{}", "12345678"); }

std::string with_word(std::string bytes, std::size_t at, std::uint32_t word) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(word >> (8 * i));
  return bytes;
}

std::string with_chunk(std::string bytes, std::uint32_t type, const std::string& data) {
  const std::size_t at = bytes.size();
  bytes += std::string(8, '\0') + data;
  bytes = with_word(with_word(bytes, at, static_cast<std::uint32_t>(data.size())), at + 4, type);
  return with_word(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
}

ErrorCode code_of(const std::string& bytes) {
  const auto parsed = parse_glb(bytes);
  return parsed ? ErrorCode::internal : parsed.error().code;
}

TEST(Container, finds_both_chunks) {
  const std::string bytes = glb();
  const auto parsed = parse_glb(bytes);
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(parsed->json, "{}  ");
  ASSERT_TRUE(parsed->bin.has_value());
  EXPECT_EQ(parsed->bin->size(), 8u);
}

TEST(Container, needs_no_bin_chunk) {
  const std::string bytes = test::make_glb("{}", "");
  const auto parsed = parse_glb(bytes);
  ASSERT_TRUE(parsed.ok());
  EXPECT_FALSE(parsed->bin.has_value());
}

TEST(Container, keeps_chunks_of_unknown_type) {
  const std::string bytes = with_chunk(glb(), 0x58585858, "abcd");
  const auto parsed = parse_glb(bytes);
  ASSERT_TRUE(parsed.ok());
  ASSERT_EQ(parsed->foreign.size(), 1u);
  EXPECT_EQ(parsed->foreign[0].type, 0x58585858u);
  EXPECT_EQ(parsed->foreign[0].bytes.size(), 4u);
}

TEST(Container, refuses_every_truncation) {
  const std::string whole = glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // A copy of exact size: AddressSanitizer sees a read one past the cut.
    const std::vector<char> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(parse_glb({cut.data(), cut.size()}).ok()) << size;
  }
}

TEST(Container, refuses_bytes_behind_the_end) { EXPECT_EQ(code_of(glb() + "abcd"), ErrorCode::malformed); }
TEST(Container, refuses_another_magic) { EXPECT_EQ(code_of(with_word(glb(), 0, 1)), ErrorCode::malformed); }
TEST(Container, refuses_version_1) { EXPECT_EQ(code_of(with_word(glb(), 4, 1)), ErrorCode::unsupported); }
TEST(Container, refuses_a_chunk_past_the_file) {
  EXPECT_EQ(code_of(with_word(glb(), 24, 0xfffffffc)), ErrorCode::malformed);
  EXPECT_EQ(code_of(with_word(glb(), 12, 0xfffffffc)), ErrorCode::malformed);
}
TEST(Container, refuses_an_unaligned_chunk) {
  EXPECT_EQ(code_of(with_word(glb(), 24, 7)), ErrorCode::malformed);
}
TEST(Container, refuses_bin_as_the_first_chunk) {
  EXPECT_EQ(code_of(with_word(glb(), 16, kBinChunk)), ErrorCode::malformed);
}
TEST(Container, refuses_a_second_json_chunk) {
  EXPECT_EQ(code_of(with_chunk(glb(), kJsonChunk, "{}  ")), ErrorCode::malformed);
}
TEST(Container, refuses_a_second_bin_chunk) {
  EXPECT_EQ(code_of(with_chunk(glb(), kBinChunk, "abcd")), ErrorCode::malformed);
}

std::optional<std::vector<std::byte>> decode(std::string_view text) {
  test::Unlimited unlimited;
  return *decode_base64(text, unlimited.work);
}

TEST(Base64, decodes_what_another_encoder_wrote) {
  for (const std::string text : {"", "a", "ab", "abc", "abcd", "\xff\xfe\xfd\x01"}) {
    const auto bytes = decode(test::base64(text));
    ASSERT_TRUE(bytes.has_value());
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), text);
  }
}

TEST(Base64, refuses_all_but_the_strict_form) {
  for (const char* text :
       {"YQ", "YQ=", "YR==", "Y===", "YW J", "YWJj\n", "=aaa", "YQ==YQ==", "YW-_", "YWI=YWI="})
    EXPECT_FALSE(decode(text).has_value()) << text;
}

TEST(Base64, encodes_across_chunk_borders) {
  const std::string text = "The quick brown fox jumps over the lazy dog.";
  for (std::size_t cut = 0; cut <= text.size(); ++cut)
    for (std::size_t second = cut; second <= text.size(); second += 3) {
      std::string out;
      test::Unlimited unlimited;
      const auto pieces =
          encode_base64({Chunk::own(text.substr(0, cut)), Chunk::own(text.substr(cut, second - cut)),
                         Chunk::own(text.substr(second))},
                        unlimited.work);
      for (const Chunk& piece : *pieces)
        out.append(reinterpret_cast<const char*>(piece.bytes.data()), piece.bytes.size());
      ASSERT_EQ(out, test::base64(text)) << cut << ' ' << second;
    }
}

}  // namespace
}  // namespace subdivd::proto::gltf
