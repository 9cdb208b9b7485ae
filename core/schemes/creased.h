#pragma once
// The crease rules, which are the same for every scheme that cuts edges into two: along a crease points follow the
// uniform cubic B-spline curve, a corner stays, and where sharpness runs out two masks are blended.
// [DeRose98, section 4; Biermann00; Far 3.5]

#include "core/mesh/rings.h"
#include "core/mesh/sharpness.h"
#include "core/schemes/mask.h"

namespace subdivd {

// 1/2 (a + b) on a crease, otherwise `smooth`. A sharpness below 1 that runs out blends the two.
EdgeMask creased_edge(const EdgeMask& smooth, const EdgeRing& ring);

// The first and last sharp edge of the ring (for a crease, its two): 3/4 v + 1/8 (e_a + e_b).
VertexMask crease_vertex_mask(std::span<const float> edge_sharpness);

// 3/4 v + 1/8 (e_a + e_b) on a crease, v at a corner, otherwise smooth(), the mask of a vertex and a dart. Blended
// by the fractional weight when the rule changes with the next level. A ring without faces stays where it is.
template <class Smooth>
VertexMask creased_vertex(const VertexRing& ring, Smooth&& smooth) {
  if (ring.face_count == 0) return {};
  const auto mask_of = [&](Rule rule, std::span<const float> edges) {
    switch (rule) {
      case Rule::smooth:
      case Rule::dart:
        return smooth();
      case Rule::crease:
        return crease_vertex_mask(edges);
      case Rule::corner:
        break;
    }
    return VertexMask{};
  };
  const Rule parent_rule = rule_of(ring.sharpness, ring.edge_sharpness);
  const VertexMask parent = mask_of(parent_rule, ring.edge_sharpness);
  if (parent_rule == Rule::smooth || parent_rule == Rule::dart) return parent;
  const Rule child_rule = rule_of(ring.child_sharpness, ring.child_edge_sharpness);
  if (child_rule == parent_rule) return parent;
  const VertexMask child = mask_of(child_rule, ring.child_edge_sharpness);
  const double w = fractional_weight(ring.crease_method, ring.sharpness, ring.child_sharpness,
                                     ring.edge_sharpness, ring.child_edge_sharpness);
  // Sharpness only decays: at most one of the two masks has a crease pair of its own, or both share it.
  const VertexMask& pair = parent.crease != 0 ? parent : child;
  return {w * parent.self + (1 - w) * child.self,
          w * parent.each + (1 - w) * child.each,
          w * parent.crease + (1 - w) * child.crease,
          {pair.crease_ends[0], pair.crease_ends[1]},
          w * parent.face + (1 - w) * child.face};
}

}  // namespace subdivd
