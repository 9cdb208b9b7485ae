#pragma once
// OFF and OBJ bodies to core types. Nothing of them is checked that prepare() checks as well.

#include <string_view>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/wire.h"

namespace subdivd::proto::text {

// Faults name the line ("line 12: …") and have no place. What the arrays take is counted first and taken from
// the budget. Options are at their defaults, but for what an OBJ says of them (creasemethod).
Result<RefineRequest> read_off(std::string_view body, const Budget& budget);
Result<RefineRequest> read_obj(std::string_view body, const Budget& budget);

}  // namespace subdivd::proto::text
