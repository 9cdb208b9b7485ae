#pragma once
// Arrays of tuples of numbers, as the values of vertices are kept while a mesh is read.

#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "proto/gltf/weld.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

// Leaves the values that represent others, in order.
Result<void> keep_first(std::vector<double>& values, Count width, const Welded& weld, Work& work);

// Writes the last `count` tuples of `values`, of `from` numbers each, as tuples of `to`, the last number of which is
// `padding` and the others behind the given ones 0. from <= to.
Result<void> widen_last(std::vector<double>& values, Count count, Count from, Count to, double padding,
                        Work& work);

}  // namespace subdivd::proto::gltf
