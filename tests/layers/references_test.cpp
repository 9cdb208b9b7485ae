// Every formula names its source by a key, [Loop87]: the references of core/README.md hold all of them, once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace subdivd::testing {
namespace {

const std::string kRoot = SUBDIVD_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// In brackets, several of them with ";" or "," between, each perhaps followed by a chapter.
std::set<std::string> keys_cited(const std::string& text) {
  static const std::regex brackets(R"(\[([A-Za-z][^\][]*[0-9][0-9][^\][]*)\])");
  static const std::regex key(R"((?:^|[;,] *)((?:[A-Z]|de|do)[A-Za-z]*[a-z][0-9]{2})(?=$|[;,: ]))");
  std::set<std::string> keys;
  for (std::sregex_iterator bracket(text.begin(), text.end(), brackets), end; bracket != end; ++bracket) {
    const std::string inside = (*bracket)[1];
    for (std::sregex_iterator one(inside.begin(), inside.end(), key); one != end; ++one)
      keys.insert((*one)[1]);
  }
  return keys;
}

std::map<std::string, int> keys_listed(const std::string& text) {
  static const std::regex entry(R"(\*\*\[(\w+)\]\*\*)");
  std::map<std::string, int> keys;
  for (std::sregex_iterator one(text.begin(), text.end(), entry), end; one != end; ++one) ++keys[(*one)[1]];
  return keys;
}

TEST(References, keys_are_found_in_every_form) {
  EXPECT_EQ(keys_cited("  [Loop87]  [deBoor72; Far]"), (std::set<std::string>{"Loop87", "deBoor72"}));
  EXPECT_EQ(keys_cited("[DeRose98, section 4; doCarmo76,\n// 1-5]"),
            (std::set<std::string>{"DeRose98", "doCarmo76"}));
  EXPECT_EQ(keys_cited("points[2 * i] of [0, 10], a[i16] (see [i])"), std::set<std::string>{});
}

TEST(References, every_key_in_the_core_has_an_entry) {
  const auto listed = keys_listed(text_of(kRoot + "/core/README.md"));
  std::size_t cited = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot + "/core")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp" && extension != ".inc") continue;
    for (const std::string& key : keys_cited(text_of(entry.path()))) {
      EXPECT_TRUE(listed.contains(key)) << key << " in " << entry.path();
      ++cited;
    }
  }
  EXPECT_GT(cited, 50u);
  for (const auto& [key, times] : listed) EXPECT_EQ(times, 1) << key;
}

}  // namespace
}  // namespace subdivd::testing
