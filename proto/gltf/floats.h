#pragma once
// Arrays of an answer, looked through once before they travel: by all threads that help.

#include <functional>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

enum class Clamp { none, unit };  // unit: values below 0 become 0, those above 1 become 1

struct FloatScan {
  bool finite = true;
  // The least and the largest of every component, where they were asked for; never -0. Of finite values only.
  std::vector<float> least, most;
};

// `values`: tuples of `components` (1 to 4), at least one. Fails when the budget says to stop.
Result<FloatScan> scan_floats(std::span<float> values, Index components, bool bounds, Clamp clamp,
                              Work& work);

// Calls f(begin, end) for blocks of 0..total-1 that cover it once, on any of the threads that help.
Result<void> in_shared_blocks(Count total, Work& work, const std::function<void(Count begin, Count end)>& f);

}  // namespace subdivd::proto::gltf
