#pragma once
// Bulk arrays straight from the text into vectors, which are allocated once, as long as the text has commas:
// every element kept costs at least two bytes of it ("0,") and no element is kept that is not a number of its
// own.

#include <vector>

#include "core/base/index.h"
#include "proto/json/cursor.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// Tuples of `width` scalars: [[x, y], …] or [x, y, …].
struct Tuples {
  std::vector<double> values;
  ArrayForm form = ArrayForm::nested;  // of an empty array: nested
  Index width = 0;  // of nested tuples: what all of them have; 0: there are none, or the array is flat
};

// `width` 0: any from 1 to `widest`, the same for all tuples. Otherwise nested tuples must have this width
// and a flat array must be a multiple of it. `noun` names a tuple in messages, e.g. "point".
bool read_tuples(Cursor& cursor, Index width, Index widest, std::string_view noun, Tuples& out);

// Whole numbers from 0 to 2^32 - 2; 3.0 is one.
bool read_indices(Cursor& cursor, std::vector<Index>& out);

// Lists of indices, flat or nested: [[0, 1, 2], …] fills `counts` with the length of every list, [0, 1, 2, …]
// leaves it empty. An empty array counts as flat.
struct Lists {
  std::vector<Index> indices;
  std::vector<Index> counts;
  ArrayForm form = ArrayForm::flat;
};
bool read_lists(Cursor& cursor, std::string_view noun, Lists& out);

bool read_reals(Cursor& cursor, std::vector<double>& out);

// Numbers or "infinite". Single precision, as the rule is (core/mesh/control_mesh.h).
bool read_sharpnesses(Cursor& cursor, std::vector<float>& out);

bool read_whole_number(Cursor& cursor, Index& out);

}  // namespace subdivd::proto::json
