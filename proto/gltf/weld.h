#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

struct Welded {
  std::vector<Index> id;     // per tuple; equal tuples share one; numbered by first appearance
  std::vector<Index> first;  // per id, the first tuple that has it

  Held memory;  // what the two take

  bool all_differ() const { return first.size() == id.size(); }
};

// Tuples of `width` numbers are equal when bit-identical, -0 and +0 being the same. With `groups`, one number
// per tuple, only tuples of the same group can be equal. Expected linear; n log n for tuples that an attacker
// chose to collide in the hash table.
Result<Welded> weld_tuples(std::span<const double> values, Count width, std::span<const Index> groups,
                           Work& work);
Result<Welded> weld_tuples(std::span<const Index> values, Count width, Work& work);

// The same by sorting: what a hash table that an attacker has filled gives way to, and what tests compare
// with.
Result<Welded> weld_by_sorting(std::span<const double> values, Count width, std::span<const Index> groups,
                               Work& work);

}  // namespace subdivd::proto::gltf
