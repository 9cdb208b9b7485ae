#pragma once
// Takes out of a document what refinement replaces or cannot carry over, leaving it valid once the slots are
// filled.

#include <vector>

#include "proto/gltf/buffers.h"
#include "proto/gltf/source.h"
#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

// `source` has its slots and `document` as read; sets `document` and `data`.
// Replaced accessors and bufferViews are removed and the rest renumbered, into one buffer; `only_append` (an
// extension of unknown meaning is aboard): nothing is removed.
Result<void> patch(Source& source, const Buffers& buffers, bool only_append, Warnings& warnings, Work& work);

}  // namespace subdivd::proto::gltf
