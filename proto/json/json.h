#pragma once
// The JSON encoding of requests and answers. read: cursor.h; write: the shortest texts
// (text_writer.h).

#include <string>
#include <string_view>
#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Reads a JSON body: meshes (not yet checked by ControlMesh::check), curves, options.
Result<RefineRequest> read(std::string_view body, const Limits& limits, const Budget& budget);

// The same for a body that is one curve or surface, with its members at the top (Survey::is_curve).
Result<RefineRequest> read_curve(std::string_view body, const Limits& limits, const Budget& budget);

// Upper bounds of the texts that write() and envelope() will make.
Count predicted_envelope_bytes(const RefineRequest& request);
Count predicted_bytes(const RefineRequest& request, const std::vector<RefinedSize>& meshes);

Result<Payload> write(const RefineRequest& request, AnyAnswer answer, const Budget& budget);
// With other members behind the geometry than the envelope: the text of a JSON object.
Result<Payload> write(const RefineRequest& request, AnyAnswer answer, std::string_view members,
                      const Budget& budget);

// {"options": {…}, "statistics": {…}, "warnings": […], "verification": {…}} as one JSON object: the members
// that every answer carries, whatever its format. glTF puts it into asset.extras.subdivd. Members that do not
// apply are left out.
Result<std::string> envelope(const RefineRequest& request, const AnyAnswer& answer, const Budget& budget);
// The same for an answer that is a report only: options, statistics of the input, warnings, verification.
Result<std::string> report_envelope(const RefineRequest& request, const oracle::Report& verification,
                                    const Budget& budget);
// Its warnings, for answers that hold no envelope.
std::vector<std::string> answer_warnings(const RefineRequest& request);
// The verification member. With the request, faces are numbered as the caller numbered them.
std::string report(const oracle::Report& report, const RefineRequest* request = nullptr);

}  // namespace subdivd::proto::json
