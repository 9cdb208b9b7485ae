// What a body of text is taken for.

#include "proto/text/kind.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using text::TextKind;

TextKind kind(std::string_view body) { return *text::find_kind(body, {}); }

TEST(text_kind, off_is_found_by_its_header_word) {
  for (const char* body : {"OFF", "COFF\n", "NOFF 1 2 3", "STOFF\r\n", "4OFF", "nOFF", "STCN4nOFF",
                           "# a\n\n OFF", "\xEF\xBB\xBFOFF"})
    EXPECT_EQ(kind(body), TextKind::off) << body;
}

TEST(text_kind, off_is_found_by_its_counts) {
  for (const char* body : {"8 6 12\n0 0 0", "8 6", "# a\n8 6 12 # b\n"})
    EXPECT_EQ(kind(body), TextKind::off) << body;
}

TEST(text_kind, obj_is_found_by_its_first_word_or_by_comments_alone) {
  for (const char* body :
       {"v 0 0 0", "f 1 2 3", "o a", "g a", "mtllib a.mtl", "usemtl a", "vn 1 0 0", "vt 1", "s off",
        "t crease 2/1/0 0 1 3", "# only", "#\n\n#", "# Blender\n\nv 0 0 0", "cstype bspline"})
    EXPECT_EQ(kind(body), TextKind::obj) << body;
}

TEST(text_kind, json_and_anything_else_is_neither) {
  for (const char* body : {"", " ", "\n\n", "{\"points\":[]}", "{", "[1]", "8", "1.5 2 3", "1 2 3 4",
                           "vertex 0", "off", "OFFF", "\"v\"", "null", "glTF", "v{", "O"})
    EXPECT_EQ(kind(body), TextKind::none) << body;
}

// No change of one byte makes text of a JSON object, as long as its brace is the first.
TEST(text_kind, json_stays_json_whatever_byte_is_changed) {
  const std::string json = R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})";
  for (std::size_t at = 1; at < json.size(); ++at)
    for (int byte = 0; byte < 256; ++byte) {
      std::string body = json;
      body[at] = static_cast<char>(byte);
      ASSERT_EQ(kind(body), TextKind::none) << body;
    }
}

// A header word that is changed in one letter, or followed by one, is no header unless it is another one.
TEST(text_kind, a_changed_header_is_no_off) {
  const std::string header = "COFF";
  for (std::size_t at = 0; at < header.size(); ++at)
    for (int byte = 33; byte < 127; ++byte) {
      std::string body = header;
      body[at] = static_cast<char>(byte);
      const bool other = at == 0 && std::string("CN4n").find(body[0]) != std::string::npos;
      EXPECT_EQ(kind(body) == TextKind::off, other || body == header) << body;
    }
}

TEST(text_kind, a_body_of_one_long_word_or_comment_is_looked_at_in_linear_time) {
  EXPECT_EQ(kind(std::string(50'000'000, 'v')), TextKind::none);
  EXPECT_EQ(kind('#' + std::string(50'000'000, 'v')), TextKind::obj);
  EXPECT_EQ(kind(std::string(50'000'000, '\n')), TextKind::none);
}

}  // namespace
}  // namespace subdivd::proto::test
