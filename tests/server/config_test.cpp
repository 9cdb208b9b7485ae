#include "server/config.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "server/version.h"

namespace subdivd::server {
namespace {

Result<Invocation> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "subdivd");
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

// A variable of the environment for the length of a test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~Variable() { ::unsetenv(name_); }

 private:
  const char* name_;
};

TEST(Config, defaults_are_valid_values) {
  for (const Setting& setting : setting_table()) {
    Config config;
    EXPECT_TRUE(setting.set(config, setting.default_value)) << setting.flag;
  }
}
TEST(Config, flags_are_named_once) {
  std::set<std::string_view> flags;
  for (const Setting& setting : setting_table())
    EXPECT_TRUE(flags.insert(setting.flag).second) << setting.flag;
}
TEST(Config, refuses_nonsense_for_every_setting_but_the_host) {
  for (const Setting& setting : setting_table()) {
    Config config;
    if (setting.flag != "host") {
      EXPECT_FALSE(setting.set(config, "nonsense")) << setting.flag;
    }
    EXPECT_FALSE(setting.set(config, "")) << setting.flag;
  }
}
TEST(Config, listens_on_loopback_by_default) { EXPECT_EQ(default_config().host, "127.0.0.1"); }
TEST(Config, takes_flags_with_and_without_equals_sign) {
  const auto invocation = parse({"--port", "1234", "--max-level=3"});
  ASSERT_TRUE(invocation.ok()) << invocation.error().message;
  EXPECT_EQ(invocation->config.port, 1234);
  EXPECT_EQ(invocation->config.max_level, 3u);
}
TEST(Config, takes_the_environment) {
  const Variable port("SUBDIVD_PORT", "4321");
  EXPECT_EQ(parse({})->config.port, 4321);
}
TEST(Config, prefers_the_flag_to_the_environment) {
  const Variable port("SUBDIVD_PORT", "4321");
  EXPECT_EQ(parse({"--port", "1"})->config.port, 1);
}
TEST(Config, refuses_a_bad_value_in_words) {
  const auto invocation = parse({"--port", "65536"});
  ASSERT_FALSE(invocation.ok());
  EXPECT_EQ(invocation.error().message, "--port (SUBDIVD_PORT) must be 0 to 65535, not '65536'");
}
TEST(Config, refuses_a_bad_value_in_the_environment) {
  const Variable level("SUBDIVD_MAX_LEVEL", "-1");
  EXPECT_FALSE(parse({}).ok());
}
TEST(Config, refuses_unknown_flags) { EXPECT_FALSE(parse({"--prot", "1"}).ok()); }
TEST(Config, refuses_stray_words) { EXPECT_FALSE(parse({"serve"}).ok()); }
TEST(Config, refuses_trailing_characters) { EXPECT_FALSE(parse({"--port", "80x"}).ok()); }
TEST(Config, refuses_not_a_number) { EXPECT_FALSE(parse({"--deadline-seconds", "nan"}).ok()); }
TEST(Config, reads_units_of_bytes) {
  EXPECT_EQ(parse({"--max-body-bytes", "3MiB"})->config.max_body_bytes, 3u << 20);
  EXPECT_EQ(parse({"--max-body-bytes", "1000"})->config.max_body_bytes, 1000u);
}
TEST(Config, refuses_sizes_that_overflow) {
  EXPECT_FALSE(parse({"--max-body-bytes", "18446744073709551615GiB"}).ok());
  EXPECT_FALSE(parse({"--max-body-bytes", "99999999999999999999"}).ok());
}
TEST(Config, reads_a_list_of_origins) {
  const auto invocation = parse({"--cors-origins", "https://a.example,http://localhost:3000"});
  ASSERT_TRUE(invocation.ok());
  EXPECT_EQ(invocation->config.cors_origins,
            (std::vector<std::string>{"https://a.example", "http://localhost:3000"}));
}
TEST(Config, refuses_an_origin_with_a_path) {
  EXPECT_FALSE(parse({"--cors-origins", "https://a.example/"}).ok());
}
TEST(Config, reads_none_as_no_origin) {
  EXPECT_TRUE(parse({"--cors-origins", "none"})->config.cors_origins.empty());
}
TEST(Config, help_names_every_flag_and_variable) {
  const auto invocation = parse({"--help"});
  ASSERT_TRUE(invocation.ok());
  EXPECT_EQ(invocation->action, Invocation::Action::print);
  for (const Setting& setting : setting_table()) {
    EXPECT_NE(invocation->text.find("--" + std::string(setting.flag)), std::string::npos) << setting.flag;
    EXPECT_NE(invocation->text.find(environment_name(setting)), std::string::npos) << setting.flag;
  }
}
TEST(Config, prints_the_version) {
  EXPECT_EQ(parse({"--version"})->text, "subdivd " + std::string(kVersion) + "\n");
}
TEST(Config, asks_for_a_health_check) {
  const auto invocation = parse({"--health-check", "http://127.0.0.1:8080/livez"});
  EXPECT_EQ(invocation->action, Invocation::Action::health_check);
  EXPECT_EQ(invocation->text, "http://127.0.0.1:8080/livez");
}
TEST(Config, readme_holds_the_table_of_settings) {
  std::ifstream file(std::string(SUBDIVD_SOURCE_DIR) + "/server/README.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(settings_as_markdown()), std::string::npos) << "server/README.md should hold:\n"
                                                                        << settings_as_markdown();
}

}  // namespace
}  // namespace subdivd::server
