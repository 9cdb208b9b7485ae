#pragma once
// The bytes of a glTF asset's buffers: the BIN chunk or embedded Base64. Nothing is ever opened or fetched.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

using Bytes = std::span<const std::byte>;

// In order of `buffers`; each exactly byteLength long.
struct Buffers {
  std::vector<Bytes> bytes;
  std::vector<std::vector<std::byte>> decoded;  // what `bytes` of data URIs look at
};

// Needs the document's root to be an object. Text of a data URI that has become bytes is taken out of the
// document, unless the answer will need it (`keep_text`: of all buffers but the first, which is written
// anew).
Result<Buffers> load_buffers(Json& document, std::optional<Bytes> bin, bool keep_text, Work& work);

}  // namespace subdivd::proto::gltf
