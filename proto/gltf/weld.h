#pragma once
#include <span>
#include <vector>

#include "core/base/index.h"

namespace subdivd::proto::gltf {

struct Welded {
  std::vector<Index> id;     // per tuple; equal tuples share one; numbered by first appearance
  std::vector<Index> first;  // per id, the first tuple that has it
};

// Tuples of `width` numbers are equal when bit-identical, -0 and +0 being the same. By sorting: a hash table
// would take quadratic time for points that an attacker chose to collide.
Welded weld_tuples(std::span<const double> values, Count width);

}  // namespace subdivd::proto::gltf
