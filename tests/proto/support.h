#pragma once
// A request through the whole of proto and the engine, without a server.

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "proto/decode.h"
#include "proto/wire.h"

namespace subdivd::proto::test {

Result<RefineRequest> decode(std::string_view body, const QueryParameters& query = {},
                             const Limits& limits = {});

// "code pointer" of the refusal, e.g. "out_of_range /points/3"; a query parameter as "?name". "accepted" when
// there is none.
std::string refusal(std::string_view body, const QueryParameters& query = {}, const Limits& limits = {});

// The message of the refusal; empty when there is none.
std::string message(std::string_view body, const QueryParameters& query = {});

// What the engine makes of the request, in its precision.
Result<AnyAnswer> compute(const RefineRequest& request);

// Decoded, refined, encoded.
Result<std::string> answer(std::string_view body, const QueryParameters& query = {},
                           const Limits& limits = {});

// The same everywhere, unlike the distributions of <random>.  [splitmix64]
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

 private:
  std::uint64_t state_;
};

inline constexpr std::string_view kTriangle =
    R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})";

std::string source_file(const std::string& name);  // counted from the root

}  // namespace subdivd::proto::test
