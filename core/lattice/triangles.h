#pragma once
// The index buffer of a refined mesh, by formula alone.

#include <span>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// Refined triangles of the faces whose `holes` flag is 0, in the order of split.h: 3 indices each, 3 * n^2
// per face, into `out`. `holes`: one flag per face of the connectivity. Independent of the number of threads.
Result<void> write_triangles(const Connectivity<Triangles>& connectivity, Index level,
                             std::span<const unsigned char> holes, Index* out, Index threads,
                             const Budget& budget);

}  // namespace subdivd
