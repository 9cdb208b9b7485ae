#pragma once
// Values of checked accessors: any component type, interleaved or packed, sparse, normalized; zeros where an
// accessor has no data.

#include <span>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/buffers.h"
#include "proto/gltf/structure.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

struct Elements {
  const Structure& structure;
  const Buffers& buffers;
};

// Scalars of an element.
Index components_of(const tinygltf::Accessor& accessor);

// Appends all scalars, element after element, of the elements `chosen` (ascending), or of all when it is
// empty. Normalized integers become numbers in [-1, 1] or [0, 1]. `out` should have room for them.
Result<void> append_reals(const Elements& from, Index accessor, std::span<const Index> chosen,
                          std::vector<double>& out, Work& work);

// Values of an accessor of unsigned integers. Their memory is the caller's to ask for.
Result<std::vector<Index>> read_indices(const Elements& from, Index accessor, Work& work);

}  // namespace subdivd::proto::gltf
