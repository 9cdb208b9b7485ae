#pragma once
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/primitive.h"
#include "proto/gltf/source.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

struct ReadLines {
  std::vector<ControlCurves> curves;  // none: too short to refine; the primitive stays as it is
  CurvesSlot slot;                    // mesh, primitive, mode and attributes set; curves are not
};

// LINE_STRIP is one pinned curve, LINE_LOOP one periodic curve. Segments of LINES are chained through
// vertices where exactly two of them meet; closed chains are periodic. Attributes other than NORMAL and
// TANGENT are refined along, as further scalars of each point.
Result<ReadLines> read_lines(const Asset& asset, Index mesh, Index primitive, const Options& options,
                             const Place& place);

// Chains of vertices one after the other.
struct ChainList {
  std::vector<Index> vertices;
  std::vector<Index> lengths;
};
// Segments joined into maximal chains. A closed chain does not repeat its first vertex at the end.
struct Chains {
  ChainList open, closed;
  Held memory;
};
Result<Chains> chain_segments(const std::vector<Index>& ends, Index vertex_count, Work& work);

}  // namespace subdivd::proto::gltf
