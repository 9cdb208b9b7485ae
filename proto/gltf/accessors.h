#pragma once
// Values of checked accessors: any component type, interleaved or packed, sparse, normalized; zeros where an
// accessor has no data.

#include <tiny_gltf.h>

#include <vector>

#include "proto/gltf/buffers.h"

namespace subdivd::proto::gltf {

// All scalars, element after element. Normalized integers become numbers in [-1, 1] or [0, 1].
std::vector<double> read_reals(const tinygltf::Model& model, const Buffers& buffers, Index accessor);

// Values of an accessor of unsigned integers.
std::vector<Index> read_indices(const tinygltf::Model& model, const Buffers& buffers, Index accessor);

}  // namespace subdivd::proto::gltf
