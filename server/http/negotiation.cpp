#include "server/http/negotiation.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "server/transport/grammar.h"

namespace subdivd::server {
namespace {

// Cuts the part before `mark` off the front of `rest`.
std::string_view next_part(std::string_view& rest, char mark) {
  const std::string_view part = rest.substr(0, rest.find(mark));
  rest.remove_prefix(std::min(rest.size(), part.size() + 1));
  return trimmed(part);
}

// How closely a range of Accept names a type: 0 not at all, 1 by */*, 2 by its first half, 3 exactly.
int closeness(std::string_view range, std::string_view type) {
  if (range == "*/*") return 1;
  if (range == type) return 3;
  return range.ends_with("/*") && type.starts_with(range.substr(0, range.size() - 1)) ? 2 : 0;
}

// 1 unless the parameters say otherwise; a malformed q is taken for 0: nobody said that it is wanted.
double quality(std::string_view parameters) {
  while (!parameters.empty()) {
    const std::string parameter = lowered(next_part(parameters, ';'));
    if (!parameter.starts_with("q=")) continue;
    double value = 0;
    const char* end = parameter.data() + parameter.size();
    const auto [stopped, fault] = std::from_chars(parameter.data() + 2, end, value, std::chars_format::fixed);
    return fault == std::errc() && stopped == end && value >= 0 && value <= 1 ? value : 0;
  }
  return 1;
}

double quality_of(std::string_view accept, std::string_view type) {
  int best = 0;
  double result = 0;
  while (!accept.empty()) {
    std::string_view item = next_part(accept, ',');
    const std::string range = lowered(next_part(item, ';'));
    if (const int close = closeness(range, type); close > best) {
      best = close;
      result = quality(item);
    }
  }
  return result;
}

// All Accept headers as one list; everything when there is none.
std::string accept_of(const Request& request) {
  std::string accept;
  for (const auto& [name, value] : request.headers)
    if (name == "accept") accept += (accept.empty() ? "" : ",") + value;
  return trimmed(accept).empty() ? "*/*" : accept;
}

}  // namespace

std::optional<proto::BodyKind> body_kind(const Request& request) {
  const std::string* header = request.header("content-type");
  if (header == nullptr) return proto::BodyKind::unspecified;
  std::string_view rest = *header;
  const std::string type = lowered(next_part(rest, ';'));
  if (type == "application/json") return proto::BodyKind::json;
  if (type == "model/gltf-binary") return proto::BodyKind::glb;
  if (type == "model/gltf+json") return proto::BodyKind::gltf;
  if (type == "model/obj") return proto::BodyKind::obj;
  constexpr std::array<std::string_view, 4> kSayNothing = {"", "application/octet-stream", "text/plain",
                                                           "application/x-www-form-urlencoded"};
  if (std::find(kSayNothing.begin(), kSayNothing.end(), type) != kSayNothing.end())
    return proto::BodyKind::unspecified;
  return std::nullopt;
}

std::optional<proto::Format> preferred_format(const Request& request, proto::Format came_in) {
  const std::string accept = accept_of(request);
  std::optional<proto::Format> best;
  double best_quality = 0;
  using enum proto::Format;  // not off: what Accept may call it, text/plain, says nothing
  for (const proto::Format format : {came_in, json, glb, gltf, obj}) {
    const double wanted = quality_of(accept, proto::media_type(format));
    if (wanted <= best_quality) continue;
    best = format;
    best_quality = wanted;
  }
  return best;
}

bool accepts_json(const Request& request) {
  return quality_of(accept_of(request), proto::media_type(proto::Format::json)) > 0;
}

}  // namespace subdivd::server
