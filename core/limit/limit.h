#pragma once
// Where a vertex goes when refinement never ends, and the surface's tangent plane there. Works on one ring at
// a time: the ring of a vertex at the next level depends on its ring at this level alone, so semi-sharp rings
// are refined by themselves until their sharpness has run out, and the limit masks then hold exactly.

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"
#include "core/schemes/mask.h"
#include "core/schemes/scheme.h"

namespace subdivd {

// Tangents and normal of the surface on one side of a vertex: of a sector, the faces between two sharp edges.
template <class Real>
struct Frame {
  Real u[3] = {0, 0, 0}, v[3] = {0, 0, 0};  // span the tangent plane
  Real normal[3] = {0, 0, 0};               // unit, along u x v; zero where the geometry has no normal
};

// A vertex with its neighbours: values, sharpness, and how its faces hang together.
template <class Real>
struct Ring {
  struct Wedge {  // a face: from ring edge `from` counter-clockwise to ring edge `to`
    Index from = 0, to = 0;
  };
  struct Sector {              // the faces between two infinitely sharp edges, or all
    Index begin = 0, end = 0;  // in sector_edges; open: one more than there are faces
    bool closed = false;
  };

  Index width = 3;
  std::vector<Real> center, neighbors;  // width scalars; width per ring edge
  // Where faces are quads: the vertex opposite to the center, width scalars per wedge. Elsewhere empty.
  std::vector<Real> opposite;
  float vertex_sharpness = 0;
  std::vector<float> edge_sharpness;  // of the ring's edges
  // How semi-sharp edges decay: of all the mesh's edges at the vertex, at this level and the following ones;
  // empty where none decays with others. (The ring of a channel has but some of these edges. A hub may have a
  // million such rings: only sums, so that not every one of them goes through all its edges.)
  std::vector<DecaySum> around;
  std::vector<float> far_child;  // per edge: sharpness, one level on, of its half away from the vertex
  std::vector<Wedge> wedges;
  std::vector<Index> sector_edges;  // of the ring, sector by sector, counter-clockwise
  // Where faces are quads, per sector edge the wedge that follows it; behind an open sector's last edge there is
  // none: kNoIndex.
  std::vector<Index> sector_wedges;
  std::vector<Sector> sectors;

  // Sets wedges and sectors from the faces at v, the ring's edges being topology.vertex_edges(v), wedge k
  // topology.vertex_corners(v)[k].
  template <class Faces>
  void set_faces(const Topology<Faces>& topology, Index v, const Pace& pace = {});
  // The same where all are one fan of `faces` faces, in order: closed, or open with one more edge.
  void set_fan(Index faces, bool closed, const Pace& pace = {});
};

// A ring ready for limits. Linear in the ring, however many sectors it has. Scheme: see
// core/schemes/scheme.h.
template <class Scheme, class Real>
class LimitRing {
 public:
  LimitRing(const Scheme& scheme, CreaseMethod method, Ring<Real> ring, const Pace& pace = {});

  // Limit of the vertex: width scalars.
  std::vector<Real> position() const;

  // One frame per sector, for width 3. Smooth vertices and darts have one sector. Which frame:
  //   smooth, dart   the tangent masks of the scheme
  //   crease         along the crease and across the sector
  //   corner         of up to Scheme::flat_corner_faces: its two border edges. Of more faces the limit surface has no
  //                  tangent plane: the mean of the sector's triangles (center, two edges that follow one another),
  //                  weighted by area
  // Where the tangents are parallel (degenerate geometry) the mean of the triangles takes their place.
  std::vector<Frame<Real>> frames() const;
  // Calls f(frame) for one after the other: a hub may have a million.
  template <class F>
  void for_each_frame(F&& f) const {
    for (const Sector& sector : ring_.sectors) {
      pace_.spend(16);
      f(frame_of(sector));
    }
  }

 private:
  using Sector = typename Ring<Real>::Sector;

  bool settled() const;
  static constexpr bool kHasFacePoints = Scheme::split == Split::quads;
  std::span<const Index> edges_of(const Sector& sector) const {
    return std::span(ring_.sector_edges).subspan(sector.begin, sector.end - sector.begin);
  }
  std::span<const Index> wedges_of(const Sector& sector) const {
    if (!kHasFacePoints) return {};
    return std::span(ring_.sector_wedges).subspan(sector.begin, sector.end - sector.begin);
  }
  void step(std::size_t level);
  std::vector<Index> count_faces() const;
  std::vector<Real> sum_opposite() const;
  std::vector<Real> face_points() const;
  std::vector<Real> sum_face_points(std::span<const Real> points) const;
  // Edges and wedges that a ring mask's weights belong to.
  struct Order {
    std::span<const Index> edges, wedges;
  };
  Order order_of(const Sector& sector) const { return {edges_of(sector), wedges_of(sector)}; }
  Order dart_order() const;
  // Calls f(weight, values) for the neighbours that the mask weighs.
  template <class F>
  void for_each_weight(const RingMask& mask, const Order& order, F&& f) const;
  void apply(const RingMask& mask, const Order& order, Real* out) const;
  void apply_to_spokes(const RingMask& mask, const Order& order, Real out[3]) const;
  Frame<Real> frame_of(const Sector& sector) const;
  Frame<Real> mean_frame(const Sector& sector) const;

  Scheme scheme_;
  CreaseMethod method_;
  Ring<Real> ring_;
  Pace pace_;
  Rule rule_ = Rule::corner;
};

// Sets the normal from the tangents; false when they are parallel as far as the type can tell.
template <class Real>
bool set_normal(Frame<Real>& frame);

// Unit vector along (x, y, z) without over- or underflow; zero when it is zero.
template <class Real>
void normalize(Real vector[3]);

// What is kept of the frames at a vertex: the first, and the unit vector in the middle of all their normals;
// zero where they cancel or there is none.
template <class Real>
class FrameMean {
 public:
  void add(const Frame<Real>& frame);
  const Frame<Real>& first() const { return first_; }
  void normal(Real out[3]) const;

 private:
  Frame<Real> first_;
  Real sum_[3] = {0, 0, 0};
  Count count_ = 0;
};

}  // namespace subdivd
