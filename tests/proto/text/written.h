#pragma once
// Answers as OBJ and OFF, and what is read of them again.

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/tasks/refine_task.h"
#include "tests/proto/support.h"
#include "tests/support/payload_text.h"

namespace subdivd::proto::test {

// Nothing is refused for its size.
inline constexpr Limits kWide{
    .max_level = 8, .max_output_bytes = Count{1} << 32, .max_body_bytes = Count{1} << 30};

// The answer, which is as long as it says and no longer than was predicted.
inline std::string written(const RefineRequest& request, const Budget& budget = {}) {
  server::tasks::Phases phases;
  const auto predicted = predict_refine(request, kWide);
  EXPECT_TRUE(predicted.ok()) << predicted.error().message;
  const auto payload = server::tasks::refine(request, kWide, budget, phases);
  EXPECT_TRUE(payload.ok()) << payload.error().message;
  if (!payload || !predicted) return {};
  std::string text = subdivd::test::text_of(*payload);
  EXPECT_EQ(text.size(), payload->size());
  EXPECT_LE(text.size(), predicted->answer_bytes);
  return text;
}

inline std::string written(std::string_view json, const QueryParameters& query) {
  const auto request = decode(json, query, kWide);
  EXPECT_TRUE(request.ok()) << request.error().message;
  return request ? written(*request) : std::string();
}

inline RefineRequest read_again(std::string_view text) {
  auto request = decode_refine(text, BodyKind::unspecified, {}, kWide);
  EXPECT_TRUE(request.ok()) << request.error().message << "\n" << text.substr(0, 1000);
  return request ? *std::move(request) : RefineRequest{};
}

// Whether numbers are the same to the last bit, in the precision they were written in.
template <class Real>
bool same_bits(const std::vector<double>& read, const Buffer<Real>& written) {
  if (read.size() != written.size()) return false;
  for (std::size_t k = 0; k < read.size(); ++k) {
    const Real value = static_cast<Real>(read[k]);
    if (std::memcmp(&value, &written[k], sizeof value) != 0) return false;
    // JSON's rule, too: the shortest text of a float reads back to that float.
  }
  return true;
}

}  // namespace subdivd::proto::test
