#include "core/limit/limit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/mesh/positions.h"
#include "core/schemes/all.h"

namespace subdivd {
namespace {

template <class Real>
void cross(const Real a[3], const Real b[3], Real out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

template <class Real>
Real dot(const Real a[3], const Real b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Normal of the plane of two unit vectors; false when they are parallel as far as the type can tell.
template <class Real>
bool plane_normal(const Real u[3], const Real v[3], Real normal[3]) {
  cross(u, v, normal);
  const Real sine = std::sqrt(dot(normal, normal));
  if (!(sine > 16 * std::numeric_limits<Real>::epsilon())) return false;
  normalize(normal);
  return true;
}

}  // namespace

template <class Real>
void normalize(Real vector[3]) {
  const Real largest = std::max({std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2])});
  if (largest == 0) return;
  for (int k = 0; k < 3; ++k) vector[k] /= largest;
  const Real length = std::sqrt(dot(vector, vector));
  for (int k = 0; k < 3; ++k) vector[k] /= length;
}

template <class Real>
void FrameMean<Real>::add(const Frame<Real>& frame) {
  if (count_++ == 0) first_ = frame;
  for (int k = 0; k < 3; ++k) sum_[k] += frame.normal[k];
}

template <class Real>
void FrameMean<Real>::normal(Real out[3]) const {
  std::copy_n(count_ == 1 ? first_.normal : sum_, 3, out);
  if (count_ <= 1) return;
  // Opposite sides cancel up to rounding: no direction is better than a random one.
  if (std::sqrt(dot(out, out)) <= 16 * std::numeric_limits<Real>::epsilon() * static_cast<Real>(count_))
    out[0] = out[1] = out[2] = 0;
  normalize(out);
}

template <class Real>
bool set_normal(Frame<Real>& frame) {
  // A tangent that is nothing beside the other is what rounding left of a sum that cancels.
  const auto size = [](const Real x[3]) {
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  };
  // The short way, where nothing over- or underflows and the tangents are clearly apart.
  cross(frame.u, frame.v, frame.normal);
  const Real uu = dot(frame.u, frame.u), vv = dot(frame.v, frame.v), nn = dot(frame.normal, frame.normal);
  constexpr Real kTiny = sizeof(Real) == 4 ? Real(1e-30) : Real(1e-250);
  if (nn > kTiny && nn < 1 / kTiny && nn > Real(1e-6) * (uu * vv) && uu > Real(1e-6) * vv &&
      vv > Real(1e-6) * uu) {
    const Real length = std::sqrt(nn);
    for (Real& x : frame.normal) x /= length;
    return true;
  }
  const Real u = size(frame.u), v = size(frame.v);
  if (std::min(u, v) <= 16 * std::numeric_limits<Real>::epsilon() * std::max(u, v)) return false;
  Real unit_u[3], unit_v[3];
  std::copy_n(frame.u, 3, unit_u);
  std::copy_n(frame.v, 3, unit_v);
  normalize(unit_u);
  normalize(unit_v);
  return plane_normal(unit_u, unit_v, frame.normal);
}

template <class Real>
template <class Faces>
void Ring<Real>::set_faces(const Topology<Faces>& topology, Index v, const Pace& pace) {
  const Positions in_ring(topology.vertex_edges(v), pace);
  auto position = [&](Index h) { return static_cast<Index>(in_ring(topology.half_edge_edge(h))); };
  const auto corners = topology.vertex_corners(v);
  for (Index h : corners) {
    pace.spend(16);
    wedges.push_back({position(h), position(topology.prev(h))});
  }
  // Where faces are triangles nothing lies opposite to v that is not on the ring's edges.
  constexpr bool kHasOpposite = !std::is_same_v<Faces, Triangles>;
  const Positions in_corners(kHasOpposite ? corners : std::span<const Index>(), pace);
  auto passable = [&](Index e) {
    pace.spend(8);
    return !is_infinite(edge_sharpness[in_ring(e)]);
  };
  const typename Topology<Faces>::Fans fans = topology.fans(v, passable, pace);
  sector_edges.reserve(wedges.size() + fans.size());
  const auto size = [&] { return static_cast<Index>(sector_edges.size()); };
  for (std::size_t k = 0; k < fans.size(); ++k) {
    const typename Topology<Faces>::Fan fan = fans[k];
    Sector sector{size(), 0, fan.closed};
    for (Index h : fan.corners) {
      pace.spend(8);
      sector_edges.push_back(position(h));
      if (kHasOpposite) sector_wedges.push_back(static_cast<Index>(in_corners(h)));
    }
    if (!fan.closed) {
      sector_edges.push_back(position(topology.prev(fan.corners.back())));
      if (kHasOpposite) sector_wedges.push_back(kNoIndex);
    }
    sector.end = size();
    sectors.push_back(sector);
  }
}

template <class Real>
void Ring<Real>::set_fan(Index faces, bool closed, const Pace& pace) {
  const Index edges = closed ? faces : faces + 1;
  pace.for_each(faces, [&](Index k) {
    wedges.push_back({k, (k + 1) % edges});
    sector_edges.push_back(k);
    sector_wedges.push_back(k);
  });
  if (!closed) {
    sector_edges.push_back(faces);
    sector_wedges.push_back(kNoIndex);
  }
  sectors = {{0, edges, closed}};
}

template <class Scheme, class Real>
LimitRing<Scheme, Real>::LimitRing(const Scheme& scheme, CreaseMethod method, Ring<Real> ring,
                                   const Pace& pace)
    : scheme_(scheme), method_(method), ring_(std::move(ring)), pace_(pace) {
  if (ring_.wedges.empty()) return;  // a point without faces stays, sharp or not
  for (std::size_t level = 0; !settled(); ++level) step(level);
  rule_ = rule_of(ring_.vertex_sharpness, ring_.edge_sharpness);
}

template <class Scheme, class Real>
bool LimitRing<Scheme, Real>::settled() const {
  return !is_semi_sharp(ring_.vertex_sharpness) && std::ranges::none_of(ring_.edge_sharpness, is_semi_sharp);
}

// Per edge of the ring: its faces, and the sum of the points opposite to it in them.
template <class Scheme, class Real>
std::vector<Index> LimitRing<Scheme, Real>::count_faces() const {
  std::vector<Index> counts(ring_.edge_sharpness.size(), 0);
  pace_.for_each(ring_.wedges.size(), [&](std::size_t k) {
    ++counts[ring_.wedges[k].from];
    ++counts[ring_.wedges[k].to];
  });
  return counts;
}
template <class Scheme, class Real>
std::vector<Real> LimitRing<Scheme, Real>::sum_opposite() const {
  std::vector<Real> sums(ring_.neighbors.size(), Real(0));
  const auto add = [&](Index edge, Index across) {
    for (Index c = 0; c < ring_.width; ++c)
      sums[std::size_t{edge} * ring_.width + c] += ring_.neighbors[std::size_t{across} * ring_.width + c];
  };
  for (const auto& wedge : ring_.wedges) {
    pace_.spend(1 + ring_.width / 2);
    add(wedge.from, wedge.to);
    add(wedge.to, wedge.from);
  }
  return sums;
}

// The points of the faces, in a ring of quads: the vertices opposite to the center one level on.
template <class Scheme, class Real>
std::vector<Real> LimitRing<Scheme, Real>::face_points() const {
  std::vector<Real> points(ring_.opposite.size());
  const Index width = ring_.width;
  for (std::size_t k = 0; k < ring_.wedges.size(); ++k) {
    pace_.spend(1 + width / 2);
    const Real *from = &ring_.neighbors[std::size_t{ring_.wedges[k].from} * width],
               *to = &ring_.neighbors[std::size_t{ring_.wedges[k].to} * width];
    for (Index c = 0; c < width; ++c)
      points[k * width + c] = ((ring_.center[c] + from[c]) + (ring_.opposite[k * width + c] + to[c])) / 4;
  }
  return points;
}
// Per edge those of its faces together.
template <class Scheme, class Real>
std::vector<Real> LimitRing<Scheme, Real>::sum_face_points(std::span<const Real> points) const {
  std::vector<Real> sums(ring_.neighbors.size(), Real(0));
  const Index width = ring_.width;
  for (std::size_t k = 0; k < ring_.wedges.size(); ++k) {
    pace_.spend(1 + width / 2);
    for (const Index edge : {ring_.wedges[k].from, ring_.wedges[k].to})
      for (Index c = 0; c < width; ++c) sums[std::size_t{edge} * width + c] += points[k * width + c];
  }
  return sums;
}

// One level of refinement of the ring: its own values from its own values.
template <class Scheme, class Real>
void LimitRing<Scheme, Real>::step(std::size_t level) {
  const std::size_t n = ring_.edge_sharpness.size();
  const DecaySum around = level < ring_.around.size() ? ring_.around[level] : DecaySum{};
  std::vector<float> near_child(n);
  pace_.for_each(n, [&](std::size_t k) { near_child[k] = decay_beside(ring_.edge_sharpness[k], around); });
  const std::vector<Index> face_counts = count_faces();
  std::vector<Real> points = kHasFacePoints ? face_points() : std::vector<Real>();
  const std::vector<Real> beside_edges = kHasFacePoints ? sum_face_points(points) : sum_opposite();
  const float child_sharpness = decay(ring_.vertex_sharpness);
  const VertexMask vertex =
      scheme_.vertex_mask({static_cast<Index>(ring_.wedges.size()), method_, ring_.vertex_sharpness,
                           child_sharpness, ring_.edge_sharpness, near_child});
  std::vector<Real> center(ring_.width);
  for (Index c = 0; c < ring_.width; ++c) {
    Real sum = static_cast<Real>(vertex.self) * ring_.center[c];
    pace_.for_each(n, [&](std::size_t k) {
      sum += static_cast<Real>(vertex.each) * ring_.neighbors[k * ring_.width + c];
    });
    for (Index end : vertex.crease_ends)
      sum += static_cast<Real>(vertex.crease) * ring_.neighbors[std::size_t{end} * ring_.width + c];
    if (kHasFacePoints && vertex.face != 0)
      pace_.for_each(ring_.wedges.size(), [&](std::size_t k) {
        sum += static_cast<Real>(vertex.face) * points[k * ring_.width + c];
      });
    center[c] = sum;
  }
  for (std::size_t k = 0; k < n; ++k) {
    pace_.spend(ring_.width + Count{4});
    const EdgeMask edge =
        scheme_.edge_mask({face_counts[k], ring_.edge_sharpness[k], {near_child[k], ring_.far_child[k]}});
    // The far half's other half comes to stand beside the new ring: its sharpness decides, under Chaikin's
    // rule, how the new edge decays at its far end.
    const std::array<float, 2> halves{near_child[k], ring_.far_child[k]};
    std::array<float, 2> next{};
    decay_around_vertex(method_, halves, next);
    ring_.far_child[k] = next[0];
    for (Index c = 0; c < ring_.width; ++c) {
      Real& value = ring_.neighbors[k * ring_.width + c];
      value =
          static_cast<Real>(edge.end) * (ring_.center[c] + value) +
          static_cast<Real>(kHasFacePoints ? edge.face : edge.opposite) * beside_edges[k * ring_.width + c];
    }
  }
  ring_.opposite = std::move(points);
  ring_.center = std::move(center);
  ring_.edge_sharpness = std::move(near_child);
  ring_.vertex_sharpness = child_sharpness;
}

// In cyclic order from the crease on.
template <class Scheme, class Real>
auto LimitRing<Scheme, Real>::dart_order() const -> Order {
  const auto [edges, wedges] = order_of(ring_.sectors[0]);
  // The last edge is the crease again.
  return {edges.first(edges.size() - 1), wedges.empty() ? wedges : wedges.first(wedges.size() - 1)};
}

template <class Scheme, class Real>
template <class F>
void LimitRing<Scheme, Real>::for_each_weight(const RingMask& mask, const Order& order, F&& f) const {
  const auto go_through = [&](const std::vector<double>& weights, std::span<const Index> places,
                              const std::vector<Real>& values) {
    pace_.for_each(weights.size(), [&](std::size_t k) {
      f(static_cast<Real>(weights[k]), &values[std::size_t{places[k]} * ring_.width]);
    });
  };
  go_through(mask.edges, order.edges, ring_.neighbors);
  if (kHasFacePoints) go_through(mask.faces, order.wedges, ring_.opposite);
}

template <class Scheme, class Real>
void LimitRing<Scheme, Real>::apply(const RingMask& mask, const Order& order, Real* out) const {
  for (Index c = 0; c < ring_.width; ++c) out[c] = static_cast<Real>(mask.self) * ring_.center[c];
  for_each_weight(mask, order, [&](Real weight, const Real* values) {
    for (Index c = 0; c < ring_.width; ++c) out[c] += weight * values[c];
  });
}

// A tangent mask's weights sum to 0: applied to differences it loses nothing far from the origin.
template <class Scheme, class Real>
void LimitRing<Scheme, Real>::apply_to_spokes(const RingMask& mask, const Order& order, Real out[3]) const {
  std::fill_n(out, 3, Real(0));
  for_each_weight(mask, order, [&](Real weight, const Real* values) {
    for (std::size_t c = 0; c < 3; ++c) out[c] += weight * (values[c] - ring_.center[c]);
  });
}

template <class Scheme, class Real>
std::vector<Real> LimitRing<Scheme, Real>::position() const {
  std::vector<Real> out(ring_.center);
  VertexMask mask;
  switch (rule_) {
    case Rule::corner:
      return out;
    case Rule::dart: {
      const Order order = dart_order();
      apply(scheme_.dart_limit_mask(static_cast<Index>(order.edges.size()), pace_), order, out.data());
      return out;
    }
    case Rule::smooth:
      mask = scheme_.smooth_limit_mask(static_cast<Index>(ring_.wedges.size()));
      break;
    case Rule::crease: {
      const auto first = std::ranges::find_if(ring_.edge_sharpness, is_sharp);
      const auto second = std::find_if(first + 1, ring_.edge_sharpness.end(), is_sharp);
      mask = scheme_.crease_limit_mask(static_cast<Index>(first - ring_.edge_sharpness.begin()),
                                       static_cast<Index>(second - ring_.edge_sharpness.begin()));
    }
  }
  for (Index c = 0; c < ring_.width; ++c) {
    Real sum = 0;  // the small weights first
    if (mask.each != 0)
      pace_.for_each(ring_.edge_sharpness.size(), [&](std::size_t k) {
        sum += static_cast<Real>(mask.each) * ring_.neighbors[k * ring_.width + c];
      });
    if (mask.crease != 0)
      for (Index end : mask.crease_ends)
        sum += static_cast<Real>(mask.crease) * ring_.neighbors[std::size_t{end} * ring_.width + c];
    if (kHasFacePoints && mask.face != 0)
      pace_.for_each(ring_.wedges.size(), [&](std::size_t k) {
        sum += static_cast<Real>(mask.face) * ring_.opposite[k * ring_.width + c];
      });
    out[c] = sum + static_cast<Real>(mask.self) * ring_.center[c];
  }
  return out;
}

template <class Scheme, class Real>
Frame<Real> LimitRing<Scheme, Real>::mean_frame(const Sector& sector) const {
  const auto edges = edges_of(sector);
  Frame<Real> frame;
  // Divided, not multiplied by the inverse: that of a denormal number is infinite.
  auto spoke = [&](Index edge, Real unit, Real out[3]) {
    for (int c = 0; c < 3; ++c)
      out[c] = (ring_.neighbors[std::size_t{edge} * 3 + c] - ring_.center[c]) / unit;
  };
  Real largest = 0;
  for (Index edge : edges) {
    pace_.spend(2);
    Real along[3];
    spoke(edge, 1, along);
    for (Real x : along) largest = std::max(largest, std::abs(x));
  }
  if (largest == 0) return frame;
  Real total = 0;
  const std::size_t n = edges.size();
  for (std::size_t k = 0; k + 1 < n + (sector.closed ? 1 : 0); ++k) {
    pace_.spend(4);
    Real a[3], b[3], area[3];
    spoke(edges[k], largest, a);
    spoke(edges[(k + 1) % n], largest, b);
    cross(a, b, area);
    for (int c = 0; c < 3; ++c) {
      frame.normal[c] += area[c];
      total += std::abs(area[c]);
    }
  }
  // Sides that cancel up to rounding (a pillow without filling) have no normal.
  const Real noise = 16 * std::numeric_limits<Real>::epsilon() * total;
  if (std::ranges::all_of(frame.normal, [&](Real x) { return std::abs(x) <= noise; })) return {};
  normalize(frame.normal);
  // Any pair that spans the plane: start from the axis that is least along the normal.
  Real axis[3] = {0, 0, 0};
  int least = 0;
  for (int c = 1; c < 3; ++c)
    if (std::abs(frame.normal[c]) < std::abs(frame.normal[least])) least = c;
  axis[least] = 1;
  cross(axis, frame.normal, frame.u);
  normalize(frame.u);
  cross(frame.normal, frame.u, frame.v);
  return frame;
}

template <class Scheme, class Real>
Frame<Real> LimitRing<Scheme, Real>::frame_of(const Sector& sector) const {
  const Order order = order_of(sector);
  const auto edges = order.edges;
  Frame<Real> frame;
  const auto faces = static_cast<Index>(edges.size() - (sector.closed ? 0 : 1));
  const bool returns = !sector.closed && edges.front() == edges.back();
  const Index ends[2] = {edges.front(), edges.back()};
  const Frame<Real> mean = mean_frame(sector);
  if (sector.closed) {
    apply_to_spokes(scheme_.smooth_tangent_u(faces, pace_), order, frame.u);
    apply_to_spokes(scheme_.smooth_tangent_v(faces, pace_), order, frame.v);
  } else if (rule_ == Rule::dart) {
    apply_to_spokes(scheme_.dart_tangent_u(faces, pace_), dart_order(), frame.u);
    apply_to_spokes(scheme_.smooth_tangent_v(faces, pace_), dart_order(), frame.v);
  } else if (rule_ == Rule::crease && !returns) {
    apply_to_spokes({0, {1, -1}}, {ends, {}}, frame.u);
    apply_to_spokes(scheme_.crease_tangent_across(faces, pace_), order, frame.v);
  } else if (rule_ == Rule::corner && faces <= Scheme::flat_corner_faces && !returns) {
    apply_to_spokes({-1, {1, 0}}, {ends, {}}, frame.u);
    apply_to_spokes({-1, {0, 1}}, {ends, {}}, frame.v);
  } else {
    return mean;
  }
  if (!set_normal(frame)) return mean;
  // The border edges of a corner may open by more than 180 degrees: the faces between them tell which side is
  // out.
  if (rule_ == Rule::corner && dot(frame.normal, mean.normal) < 0) {
    std::swap_ranges(frame.u, frame.u + 3, frame.v);
    for (Real& x : frame.normal) x = -x;
  }
  return frame;
}

template <class Scheme, class Real>
std::vector<Frame<Real>> LimitRing<Scheme, Real>::frames() const {
  std::vector<Frame<Real>> result;
  for_each_frame([&](const Frame<Real>& frame) { result.push_back(frame); });
  return result;
}

template struct Ring<float>;
template struct Ring<double>;
#define SUBDIVD_INSTANTIATE(Faces)                                                  \
  template void Ring<float>::set_faces(const Topology<Faces>&, Index, const Pace&); \
  template void Ring<double>::set_faces(const Topology<Faces>&, Index, const Pace&);
SUBDIVD_INSTANTIATE(Triangles)
SUBDIVD_INSTANTIATE(Quads)
#undef SUBDIVD_INSTANTIATE
template bool set_normal(Frame<float>&);
template bool set_normal(Frame<double>&);
#define SUBDIVD_INSTANTIATE(S)        \
  template class LimitRing<S, float>; \
  template class LimitRing<S, double>;
SUBDIVD_FOR_EACH_GRID_SCHEME(SUBDIVD_INSTANTIATE)
#undef SUBDIVD_INSTANTIATE
template void normalize<float>(float[3]);
template void normalize<double>(double[3]);
template class FrameMean<float>;
template class FrameMean<double>;

}  // namespace subdivd
