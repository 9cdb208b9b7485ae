#pragma once
// What the readers of all JSON bodies share: the document around the object, lists of curves and surfaces,
// options.

#include <simdjson.h>

#include <functional>
#include <string_view>

#include "core/base/result.h"
#include "proto/json/cursor.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Walks the object that the body must be, and makes sure that nothing follows it. `read` returns false when
// it failed, with the reason in the cursor.
Result<void> read_document(std::string_view body,
                           const std::function<bool(Cursor&, simdjson::ondemand::object)>& read);

// The members "curves", "surfaces" and "options".
bool read_curve_list(Cursor& cursor, Value value, RefineRequest& out);
bool read_surface_list(Cursor& cursor, Value value, RefineRequest& out);
bool read_options(Cursor& cursor, Value value, Options& out);

}  // namespace subdivd::proto::json
