#pragma once
// Answers as OBJ and OFF.

#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/refine/refine.h"
#include "proto/wire.h"

namespace subdivd::proto::text {

// Upper bounds for an answer in the request's answer_format, obj or off: of its text, and of what stands in
// memory of it beside the refined arrays that it is made from.
struct PredictedText {
  Count bytes = 0, held_bytes = 0;
};
Result<PredictedText> predict(const RefineRequest& request, const std::vector<RefinedSize>& meshes,
                              const Budget& budget);

// `warnings`: sentences that become comments, at the top or, of an OFF, behind its first word. Meshes stand first,
// then curves, then surfaces, in the order of the request. An OFF has no lines: curves are refused (unsupported).
Result<Payload> write(const RefineRequest& request, AnyAnswer answer, std::vector<std::string> warnings,
                      const Budget& budget);

}  // namespace subdivd::proto::text
