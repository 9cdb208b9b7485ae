#pragma once
// Which kind of body came in, and which kind of answer is wanted.

#include <optional>
#include <string_view>

#include "proto/decode.h"
#include "proto/wire.h"
#include "server/transport/message.h"

namespace subdivd::server {

// From Content-Type. `unspecified` (proto looks at the bytes) when it is absent or says nothing:
// octet-stream, text/plain (what fetch() sends for a string) and x-www-form-urlencoded (what curl sends
// without -H). Empty: a kind that is not read here.
std::optional<proto::BodyKind> body_kind(const Request& request);

// From Accept, with q-values and wildcards; of equals the kind that came in, then JSON. Empty: none of ours.
std::optional<proto::Format> preferred_format(const Request& request, proto::Format came_in);

// May the answer be JSON, according to Accept?
bool accepts_json(const Request& request);

}  // namespace subdivd::server
