#pragma once
// One look over a body before it is read: what it is, and how much memory reading it can take. Nothing is
// checked here; of a text that is not JSON the reader says so.

#include <cstddef>
#include <string_view>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd::proto::json {

struct Survey {
  // Of the members at the top
  bool has_asset = false;       // glTF has it, and must
  bool has_basis = false;       // of curves
  bool has_type = false;        // of curves and surfaces
  bool has_curve_type = false;  // its value is one that they have
  bool of_mesh = false;         // a member that meshes have, and neither curves nor surfaces
  bool of_surface = false;      // one that surfaces alone have
  // Outside strings, without members that are looked at but not kept
  Count commas = 0, brackets = 0, braces = 0;
  Count string_bytes = 0;

  // One curve or surface with its members at the top; a mesh or lists otherwise.
  bool is_curve() const {
    if (has_curve_type || of_surface) return true;
    return !of_mesh && (has_type || has_basis);
  }
  // At most what the readers allocate, see README.md.
  Count reading_bytes() const;
};

Result<Survey> survey(std::string_view body, const Budget& budget);

}  // namespace subdivd::proto::json
