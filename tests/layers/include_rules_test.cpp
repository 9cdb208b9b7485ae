#include "tests/layers/include_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace subdivd::layers {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

// A little source tree of its own for each test, with the headers that the planted includes name.
class IncludeRules : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(SUBDIVD_BINARY_DIR) / "planted_includes" / test->name();
    fs::remove_all(root_);
    for (const char* header :
         {"core/base/result.h", "core/mesh/topology.h", "core/schemes/all.h", "core/schemes/loop.h",
          "core/lattice/split.h", "core/limit/limit.h", "core/engine/net.h", "core/engine/grid/evaluate.h",
          "core/refine/plan.h", "core/splines/bspline.h", "core/curves/subdivision.h", "core/oracle/report.h",
          "core/oracle/far.h", "proto/wire.h", "server/config.h", "server/transport/transport.h",
          "server/http/status.h"})
      write(header, "#pragma once");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& line) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << "// planted\n" << line << "\n";
  }

  // What is found when `file` holds nothing but `line`, as its second line.
  std::vector<Violation> planted(const std::string& file, const std::string& line) {
    write(file, line);
    return check_includes(root_);
  }

  fs::path root_;
};

auto one_at(const std::string& file, const std::string& what) {
  return ElementsAre(AllOf(Field(&Violation::file, file), Field(&Violation::line, 2),
                           Field(&Violation::what, HasSubstr(what))));
}

TEST(ThisTree, draws_only_the_arrows_of_the_design) {
  for (const Violation& v : check_includes(SUBDIVD_SOURCE_DIR))
    ADD_FAILURE() << v.file << ":" << v.line << ": " << v.what;
}

TEST_F(IncludeRules, curves_know_splines_and_not_the_other_way_round) {
  EXPECT_THAT(planted("core/curves/a.cpp", "#include \"core/splines/bspline.h\""), IsEmpty());
}
TEST_F(IncludeRules, refuses_a_curve_among_the_splines) {
  EXPECT_THAT(planted("core/splines/a.cpp", "#include \"core/curves/subdivision.h\""),
              one_at("core/splines/a.cpp", "core/curves/subdivision.h"));
}

TEST_F(IncludeRules, accepts_a_tree_without_strays) { EXPECT_THAT(check_includes(root_), IsEmpty()); }

TEST_F(IncludeRules, accepts_an_arrow_that_is_drawn) {
  EXPECT_THAT(planted("core/refine/a.cpp", "#include \"core/engine/grid/evaluate.h\""), IsEmpty());
}

TEST_F(IncludeRules, rejects_core_including_proto) {
  EXPECT_THAT(planted("core/mesh/a.h", "#include \"proto/wire.h\""), one_at("core/mesh/a.h", "proto/wire.h"));
}

TEST_F(IncludeRules, rejects_mesh_including_the_lattice) {
  EXPECT_THAT(planted("core/mesh/a.h", "#include \"core/lattice/split.h\""),
              one_at("core/mesh/a.h", "core/lattice/split.h"));
}

// The way of the arrows: lattice, engine, refine.
TEST_F(IncludeRules, rejects_the_lattice_including_an_engine) {
  EXPECT_THAT(planted("core/lattice/a.h", "#include \"core/engine/net.h\""),
              one_at("core/lattice/a.h", "core/engine/net.h"));
}
TEST_F(IncludeRules, accepts_an_engine_including_the_lattice) {
  EXPECT_THAT(planted("core/engine/tri_grid/a.h", "#include \"core/lattice/split.h\""), IsEmpty());
}
TEST_F(IncludeRules, rejects_an_engine_including_refine) {
  EXPECT_THAT(planted("core/engine/tri_grid/a.h", "#include \"core/refine/plan.h\""),
              one_at("core/engine/tri_grid/a.h", "core/refine/plan.h"));
}
TEST_F(IncludeRules, rejects_what_engines_share_including_one_of_them) {
  EXPECT_THAT(planted("core/engine/a.h", "#include \"core/engine/grid/evaluate.h\""),
              one_at("core/engine/a.h", "core/engine/grid/evaluate.h"));
}
TEST_F(IncludeRules, rejects_one_engine_including_another) {
  EXPECT_THAT(planted("core/engine/plain/a.h", "#include \"core/engine/grid/evaluate.h\""),
              one_at("core/engine/plain/a.h", "core/engine/grid/evaluate.h"));
}
TEST_F(IncludeRules, rejects_limits_including_an_engine) {
  EXPECT_THAT(planted("core/limit/a.h", "#include \"core/engine/net.h\""),
              one_at("core/limit/a.h", "core/engine/net.h"));
}

TEST_F(IncludeRules, accepts_the_list_of_schemes_above_it) {
  EXPECT_THAT(planted("core/engine/a.cpp", "#include \"core/schemes/all.h\""), IsEmpty());
  EXPECT_THAT(planted("proto/a.cpp", "#include \"core/schemes/all.h\""), IsEmpty());
}
TEST_F(IncludeRules, rejects_whoever_names_one_scheme) {
  for (const std::string file : {"core/limit/a.cpp", "core/refine/a.cpp", "proto/a.cpp", "server/a.cpp"}) {
    EXPECT_THAT(planted(file, "#include \"core/schemes/loop.h\""), one_at(file, "one scheme"));
    write(file, "");
  }
}

TEST_F(IncludeRules, rejects_curves_including_mesh) {
  EXPECT_THAT(planted("core/curves/a.cpp", "#include \"core/mesh/topology.h\""),
              one_at("core/curves/a.cpp", "core/mesh"));
}

TEST_F(IncludeRules, rejects_core_including_the_oracle) {
  EXPECT_THAT(planted("core/limit/a.cpp", "#include \"core/oracle/report.h\""),
              one_at("core/limit/a.cpp", "core/oracle"));
}

TEST_F(IncludeRules, rejects_proto_including_server) {
  EXPECT_THAT(planted("proto/json/a.cpp", "#include \"server/config.h\""),
              one_at("proto/json/a.cpp", "server/config.h"));
}

TEST_F(IncludeRules, accepts_proto_including_the_report) {
  EXPECT_THAT(planted("proto/a.cpp", "#include \"core/oracle/report.h\""), IsEmpty());
}

TEST_F(IncludeRules, rejects_proto_including_the_rest_of_the_oracle) {
  EXPECT_THAT(planted("proto/a.cpp", "#include \"core/oracle/far.h\""),
              one_at("proto/a.cpp", "core/oracle/far.h"));
}

TEST_F(IncludeRules, accepts_opensubdiv_in_the_oracle) {
  EXPECT_THAT(planted("core/oracle/a.cpp", "#include <opensubdiv/far/primvarRefiner.h>"), IsEmpty());
}

TEST_F(IncludeRules, rejects_opensubdiv_in_server) {
  EXPECT_THAT(planted("server/a.cpp", "#include <opensubdiv/far/error.h>"),
              one_at("server/a.cpp", "opensubdiv"));
}

TEST_F(IncludeRules, rejects_a_system_header_in_core) {
  EXPECT_THAT(planted("core/base/a.cpp", "#include <unistd.h>"), one_at("core/base/a.cpp", "unistd.h"));
}

TEST_F(IncludeRules, rejects_json_in_server) {
  EXPECT_THAT(planted("server/a.cpp", "#include <nlohmann/json.hpp>"), one_at("server/a.cpp", "nlohmann"));
}

TEST_F(IncludeRules, rejects_http_in_tasks) {
  EXPECT_THAT(planted("server/tasks/a.cpp", "#include \"server/http/status.h\""),
              one_at("server/tasks/a.cpp", "server/http/status.h"));
}

TEST_F(IncludeRules, rejects_httplib_outside_transport) {
  EXPECT_THAT(planted("server/handlers/a.cpp", "#include <httplib.h>"),
              one_at("server/handlers/a.cpp", "httplib.h"));
}

TEST_F(IncludeRules, accepts_httplib_in_transport) {
  EXPECT_THAT(planted("server/transport/a.cpp", "#include <httplib.h>"), IsEmpty());
}

TEST_F(IncludeRules, rejects_a_path_that_does_not_start_at_the_root) {
  EXPECT_THAT(planted("core/base/a.cpp", "#include \"result.h\""),
              one_at("core/base/a.cpp", "no file counted from the root"));
}

TEST_F(IncludeRules, rejects_a_way_around_through_parents) {
  EXPECT_THAT(planted("core/mesh/a.cpp", "#include \"core/mesh/../../proto/wire.h\""),
              one_at("core/mesh/a.cpp", ".."));
}

TEST_F(IncludeRules, rejects_an_include_behind_a_macro) {
  EXPECT_THAT(planted("core/base/a.cpp", "#include HEADER"), one_at("core/base/a.cpp", "plain words"));
}

TEST_F(IncludeRules, sees_through_unusual_spacing) {
  EXPECT_THAT(planted("core/base/a.cpp", "  #  include\t<opensubdiv/version.h>  // why"),
              one_at("core/base/a.cpp", "opensubdiv"));
}

TEST_F(IncludeRules, rejects_a_folder_outside_the_design) {
  write("core/helpers/a.h", "#pragma once");
  EXPECT_THAT(check_includes(root_), ElementsAre(Field(&Violation::file, "core/helpers/a.h")));
}

}  // namespace
}  // namespace subdivd::layers
