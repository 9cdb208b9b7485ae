#pragma once
// What a JSON text will become, before it is parsed: how many elements every container has, how many bytes
// the tree will take, and which long stretches the parser need not see. No parser: it knows quotes, brackets
// and commas, and says nothing about text that is no JSON.

#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

// Strings and white space from this length on are left out of what the library parses: it collects every
// token, twice, and repeats it in its messages.
inline constexpr std::size_t kLongText = 4096;

struct LongText {
  std::size_t begin = 0, end = 0;  // between the quotes, whose closing one may be missing; or white space
  bool string = false;
};

struct JsonShape {
  std::vector<Index> sizes;     // of every container, in the order of opening: as many elements or a few more
  std::vector<LongText> longs;  // in order
  Count values = 1;
  Count bytes = 0;  // that the tree will take
};

// Refuses what exceeds the limits. The memory of the shape itself, memory_of(it), is kept with `work`.
Result<JsonShape> shape_of(std::string_view text, const JsonLimits& limits, Work& work);
Count memory_of(const JsonShape& shape);

}  // namespace subdivd::proto::gltf
