#pragma once
// One primvar of a mesh.

#include "core/mesh/control_mesh.h"
#include "proto/json/cursor.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Fills everything but the name. `form` is that of `values`, `names` what these stand for, if they stand for names: then
// they are whole numbers below their count.
bool read_primvar(Cursor& cursor, Primvar& out, ArrayForm& form, NameList& names);

}  // namespace subdivd::proto::json
