// Options: lines of name=value are query parameters, a line that begins with '{' is the body's `options`.
// What is accepted comes back in the echo, and the echo is accepted with the same meaning.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "proto/decode.h"
#include "proto/options.h"
#include "proto/problem.h"

namespace {

using namespace subdivd;

void require(bool fact) {
  if (!fact) std::abort();
}

std::string body_with(std::string_view options) {
  std::string body = R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"options":)";
  body += options;
  return body + "}";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  proto::QueryParameters query;
  std::string options = "{}";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
    const std::size_t equals = line.find('=');
    if (line.starts_with('{'))
      options = line;
    else if (equals != std::string_view::npos)
      query.emplace_back(line.substr(0, equals), line.substr(equals + 1));
  }
  const auto request = proto::decode_refine(body_with(options), proto::BodyKind::json, query, {});
  if (!request) {
    require(nlohmann::json::accept(proto::problem_json(proto::to_problem(request.error(), 400))));
    return 0;
  }
  const auto again =
      proto::decode_refine(body_with(proto::effective_options(*request)), proto::BodyKind::json, {}, {});
  require(again.ok());
  require(proto::effective_options(*again) == proto::effective_options(*request));
  return 0;
}
