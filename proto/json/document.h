#pragma once
// What the readers of all JSON bodies share: the document around the object, lists of curves and surfaces,
// options.

#include <functional>
#include <span>
#include <string_view>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/json/cursor.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Walks the object that the body must be, and makes sure that nothing follows it. `read` returns false when
// it failed, with the reason in the cursor.
Result<void> read_document(std::string_view body, const Budget& budget,
                           const std::function<bool(Cursor&)>& read);

// The members "curves", "surfaces" and "options".
bool read_curve_list(Cursor& cursor, RefineRequest& out);
bool read_surface_list(Cursor& cursor, RefineRequest& out);
// `taken`: names of the options that are taken here. `deepest`: see Cursor::skip.
bool read_options(Cursor& cursor, std::size_t deepest, Options& out, std::span<const std::string_view> taken);

}  // namespace subdivd::proto::json
