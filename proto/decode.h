#pragma once
// The door of proto: bytes of a request in, a checked RefineRequest out; results in, bytes of the answer out.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/refine/plan.h"
#include "proto/wire.h"

namespace subdivd::proto {

// What the transport knows of the body's kind. `unspecified` (absent, octet-stream, curl's default form
// type): "glTF" as the first four bytes is GLB; the first words outside comments tell OBJ and OFF
// (text/kind.h); a JSON object with a member "asset" is glTF, otherwise it is JSON.
enum class BodyKind { unspecified, json, glb, gltf, obj, off };

// Whether the body begins as a GLB does.
bool is_glb(std::string_view body);

using QueryParameters = std::vector<std::pair<std::string, std::string>>;

// Reads and validates a whole request: body, then query parameters over its options. The body need not be
// padded. What it becomes in memory is taken from the budget before it is allocated. Error::where is a path
// into the body (of OBJ and OFF empty: messages name the line), or {"?name"} for a query parameter (starts with '?').
Result<RefineRequest> decode_refine(std::string_view body, BodyKind kind, const QueryParameters& query,
                                    const Limits& limits, const Budget& budget = {});

// The first step: what the body and the query say, not checked yet.
Result<RefineRequest> read_refine(std::string_view body, BodyKind kind, const QueryParameters& query,
                                  const Limits& limits, const Budget& budget = {});

// The last step of reading: checks the options against the limits and each other (`query` tells who is to
// blame), lets them override what the meshes say, repairs what may be repaired and checks everything.
Result<void> make_ready(RefineRequest& request, const QueryParameters& query, const Limits& limits,
                        const Budget& budget = {});

// Whether the answer's format has a place for all that is asked for (unsupported): an OFF has none for curves, OBJ
// and OFF none for the report of `verify`. To be asked before an answer is made, when the format has been chosen.
Result<void> check_format(const RefineRequest& request, const QueryParameters& query);

// Size of the answer, known before any refinement: exact for GLB binary data, an upper bound for
// text. Refuses what exceeds the limits (too_large with predicted and allowed).
struct Prediction {
  std::vector<Plan> plans;  // of the meshes: what it follows from, and what they are to be refined by
  Count answer_bytes = 0;   // of the body that will be sent (upper bound)
  Count held_bytes =
      0;  // of them in memory, beside the core's arrays: OBJ and OFF are made while they are sent
  Count working_bytes = 0;  // of the arrays of the core, and what it needs beside them, plans included
  Count taken_bytes = 0;    // of both together: taken from the budget already, for the plans
};
Result<Prediction> predict_refine(const RefineRequest& request, const Limits& limits,
                                  const Budget& budget = {});

// The whole answer in the request's answer_format. Consumes the answer: big arrays are moved into the
// payload.
Result<Payload> encode_refine(const RefineRequest& request, AnyAnswer answer, const Budget& budget = {});

// The report alone, as POST /v1/verify answers it: JSON whatever came in.
Result<Payload> encode_report(const RefineRequest& request, const oracle::Report& report,
                              const Budget& budget = {});

}  // namespace subdivd::proto
