// What callers write comes back cut, wherever they write it.

#include "proto/client_text.h"

#include <gtest/gtest.h>

#include <string>

#include "proto/curve_task.h"
#include "proto/problem.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

const std::string kHuge(1'000'000, '/');  // the worst in a pointer: every one is escaped

std::size_t problem_bytes(const Error& error) { return problem_json(to_problem(error, 422)).size(); }

TEST(client_text, is_cut_between_characters) {
  EXPECT_EQ(client_text("short"), "short");
  EXPECT_EQ(client_text(std::string(kLongestClientText, 'a')), std::string(kLongestClientText, 'a'));
  std::string accents;
  for (int i = 0; i < 100; ++i) accents += "é";
  for (const std::string& text : {accents, "a" + accents, "ab" + accents}) {
    const std::string cut = client_text(text);
    EXPECT_LE(cut.size(), kLongestClientText);
    ASSERT_TRUE(cut.ends_with("…"));
    EXPECT_EQ((cut.size() - 3 - text.find("é")) % 2, 0u) << cut;
    EXPECT_EQ(client_text(cut), cut);
  }
  EXPECT_LE(client_text(std::string(1000, '\x80')).size(), kLongestClientText);
}

TEST(client_text, of_a_megabyte_is_cut_everywhere) {
  const std::string points = R"("points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2])";
  const std::string bodies[] = {
      "{\"" + kHuge + "\":1}",
      "{\"" + kHuge + "\" 1}",
      "{\"statistics\":{\"" + kHuge + "\":tru}}",
      "{\"statistics\":{\"" + kHuge + "\":{\"" + kHuge + "\":{\"" + kHuge + "\":1e999}}}}",
      "{" + points + ",\"primvars\":{\"" + kHuge + "\":{}}}",
      "{" + points + ",\"primvars\":{\"" + kHuge + "\":{\"values\":[1,2]}}}",
      "{" + points + ",\"primvars\":{\"" + kHuge + "\":{\"values\":[1]},\"" + kHuge + "\":{\"values\":[1]}}}",
      "{" + points + ",\"primvars\":{\"st\":{\"interpolation\":\"" + kHuge + "\"}}}",
      "{" + points + ",\"options\":{\"" + kHuge + "\":1}}",
      "{" + points + ",\"options\":{\"format\":\"" + kHuge + "\"}}",
      "{" + points + ",\"creaseSharpnesses\":[\"" + kHuge + "\"]}",
      "{" + points + ",\"subdivisionScheme\":\"" + kHuge + "\"}",
      "{\"points\":[" + std::string(1'000'000, '1') + "]}",
      "{\"type\":\"" + kHuge + "\"}",
      "{\"curves\":[{\"" + kHuge + "\":1}]}",
      "{\"curves\":[{\"basis\":\"" + kHuge + "\",\"points\":[]}]}",
      "{\"meshes\":[{\"" + kHuge + "\":1}]}",
      "{\"asset\":{\"version\":\"" + kHuge + "\"}}",
      kHuge,
  };
  for (const std::string& body : bodies) {
    const Result<RefineRequest> request = decode(body);
    ASSERT_FALSE(request.ok()) << body.substr(0, 100);
    EXPECT_LT(problem_bytes(request.error()), 4096u) << body.substr(0, 100);
    const auto task = decode_curves(body, CurveTaskKind::evaluate, {}, {});
    ASSERT_FALSE(task.ok());
    EXPECT_LT(problem_bytes(task.error()), 4096u) << body.substr(0, 100);
  }
  const std::string good = "{" + points + "}";
  for (const QueryParameters& query :
       {QueryParameters{{kHuge, "1"}}, QueryParameters{{"level", kHuge}}, QueryParameters{{"format", kHuge}},
        QueryParameters{{"limit", kHuge}}}) {
    const Result<RefineRequest> request = decode(good, query);
    ASSERT_FALSE(request.ok());
    EXPECT_LT(problem_bytes(request.error()), 4096u);
  }
}

TEST(client_text, of_warnings_is_cut_and_names_of_answers_are_whole) {
  const std::string body =
      "{\"name\":\"" + kHuge + R"(","points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,0,1,0,1,2]})";
  const Result<RefineRequest> request = decode(body);
  ASSERT_TRUE(request.ok());
  ASSERT_EQ(request->warnings.size(), 1u);
  EXPECT_LT(request->warnings[0].size(), 500u);
  EXPECT_EQ(request->meshes[0].name, kHuge);
}

}  // namespace
}  // namespace subdivd::proto::test
