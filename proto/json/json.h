#pragma once
// The JSON encoding of requests and answers (DESIGN §6). read: simdjson; write: std::to_chars.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Reads a JSON body: meshes (not yet checked by ControlMesh::check), curves, options.
Result<RefineRequest> read(std::string_view body, const Limits& limits);

// Upper bound of the text that write() will make.
Count predicted_bytes(const RefineRequest& request, const std::vector<RefinedSize>& meshes);

Result<Payload> write(const RefineRequest& request, AnyAnswer answer);

// {"options": {…}, "statistics": {…}, "warnings": […], "verification": {…}} as one JSON object: the members
// that every answer carries, whatever its format. glTF puts it into asset.extras.subdivd. Members that do not
// apply are left out.
std::string envelope(const RefineRequest& request, const AnyAnswer& answer);
std::string report(const oracle::Report& report);

}  // namespace subdivd::proto::json
