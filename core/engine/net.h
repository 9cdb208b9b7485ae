#pragma once
// A control net: the mesh, or one face-varying channel of it, as the engine sees it. Base vertices and base
// edges carry all the rules there are; the inside of every base face is regular and smooth.

#include <algorithm>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"
#include "core/lattice/split.h"
#include "core/mesh/channel.h"
#include "core/mesh/control_mesh.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"
#include "core/schemes/all.h"

namespace subdivd {

// How a base vertex is refined once all semi-sharpness has run out. A dart is refined as if smooth; its limit
// is not.
enum class VertexRule : unsigned char { smooth, dart, crease, corner };
// The same for the points of a base edge. `linear`: midpoints, and points stay where they are.
enum class EdgeRule : unsigned char { smooth, crease, linear };

// Vertices of up to so many edges have their masks in tables.
inline constexpr Index kListedValence = 64;

// linear: midpoints throughout, limits are the values (varying primvars, and channels that ask for it).
enum class Smoothing { smooth, linear };

// The semi-sharp edges and vertices of a level, all others left out.
struct SemiSharp {
  std::vector<Index> edges;     // base edges, ascending
  std::vector<float> segments;  // sharpness, from the edge's lower end on: see segment()
  std::vector<Index> vertices;  // base vertices whose own sharpness is semi-sharp, ascending
  std::vector<float> vertex_sharpness;
  Count per_edge = 1;  // numbers in `segments` per edge: 1, the same for all, or one per segment

  bool empty() const { return edges.empty() && vertices.empty(); }
  float segment(std::size_t edge_position, Count k) const {
    return segments[edge_position * per_edge + (per_edge == 1 ? 0 : k)];
  }
  float vertex(Index v) const;  // 0 when it is not listed
};

// What sharpness takes that varies along so many edges, at most: twice as many numbers at every level, until
// even the sharpest have run out.
inline Count chaikin_bytes(Count edges, Index max_level) {
  return edges * sizeof(float) << (2 + std::min(max_level + 1, static_cast<Index>(kInfiniteSharpness) + 1));
}

// The faces of a scheme's refined meshes.
template <class Scheme>
using FacesOf = std::conditional_t<Scheme::split == Split::triangles, Triangles, Quads>;

// Instantiated for Triangles and Quads.
template <class Faces>
class Net {
 public:
  // Of the mesh.
  static Net build(const AnyGridScheme& scheme, CreaseMethod method,
                   std::shared_ptr<const Topology<Faces>> topology, Sharpness&& sharpness, Index max_level,
                   const Pace& pace);
  // Of a channel of it, whose semi-sharp edges decay with the mesh's.
  static Net build(std::shared_ptr<const Net> mesh, Channel<Faces> channel, const Pace& pace);

  const Topology<Faces>& topology() const { return *topology_; }
  // The same, to be kept: nets and render meshes that connect alike share it.
  const std::shared_ptr<const Topology<Faces>>& shared_topology() const { return topology_; }
  const Sharpness& sharpness() const { return sharpness_; }
  const AnyGridScheme& scheme() const { return scheme_; }
  CreaseMethod crease_method() const { return method_; }
  Index max_level() const { return max_level_; }
  Smoothing smoothing() const { return linear_ ? Smoothing::linear : Smoothing::smooth; }
  // Of a channel: the mesh's net. Of the mesh: itself.
  const Net& mesh() const { return mesh_ ? *mesh_ : *this; }

  // Of the net once it stands, and what building it takes beside that, at most; rounded up from what meshes
  // of many kinds were measured to take.
  Count resident_bytes() const;
  Count building_bytes() const;

  Count value_count(Index level) const { return refined_vertex_count(*topology_, level); }
  // Which of the values that were given each of the net's vertices takes. Empty: its own number.
  std::span<const Index> value_indices() const { return value_indices_; }

  std::span<const VertexRule> vertex_rules() const { return vertex_rules_; }
  std::span<const EdgeRule> edge_rules() const { return edge_rules_; }
  // Valences of smooth vertices and darts, ascending; those above kListedValence are left out.
  std::span<const Index> valences() const { return valences_; }
  // The vertices that are neither smooth nor darts, or of more edges than are listed, ascending.
  std::span<const Index> special_vertices() const { return special_vertices_; }
  std::span<const Index> darts() const { return darts_; }  // ascending
  // At levels 0 to max_level + 1; nothing is semi-sharp at levels beyond those listed.
  const SemiSharp& semi_sharp(Index level) const;
  // Sharpness at `level` of a segment of edge e, counted from its lower end; of the one next to its end v.
  float segment_sharpness(Index level, Index e, Count from_low) const;
  float sharpness_beside(Index level, Index e, Index v) const;
  // Sharpness one level on of that segment's other half, the one away from v.
  float sharpness_far(Index level, Index e, Index v) const;
  // Base vertices whose point one level on from `level` is that of no settled rule, ascending.
  std::span<const Index> unsettled_vertices(Index level) const;

 private:
  void set_rules(bool linear_borders, const Pace& pace);
  void list_vertices(const Pace& pace);
  void list_semi_sharp_vertices(SemiSharp& base, const Pace& pace) const;
  void list_unsettled(const Pace& pace);
  void decay_all(const Pace& pace);
  SemiSharp decayed(const SemiSharp& level, Index index, const Pace& pace) const;
  void decay_ends(const SemiSharp& from, Index level, SemiSharp& to, const Pace& pace) const;
  std::vector<Index> with_ends(std::span<const Index> vertices, std::span<const Index> edges,
                               const Pace& pace) const;

  std::shared_ptr<const Net> mesh_;
  AnyGridScheme scheme_;
  CreaseMethod method_ = CreaseMethod::uniform;
  Index max_level_ = 0;
  bool linear_ = false;
  std::shared_ptr<const Topology<Faces>> topology_;
  Sharpness sharpness_;
  std::vector<Index> value_indices_;
  std::vector<VertexRule> vertex_rules_;
  std::vector<EdgeRule> edge_rules_;
  std::vector<Index> valences_, special_vertices_, darts_;
  std::vector<Index> semi_sharp_edges_;        // while the net is built
  std::vector<SemiSharp> levels_;              // until nothing is semi-sharp
  std::vector<std::vector<Index>> unsettled_;  // per level of levels_
};

}  // namespace subdivd
