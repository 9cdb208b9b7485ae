#include "core/limit/limit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/mesh/positions.h"
#include "core/schemes/loop.h"

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
void mean_normal(std::span<const Frame<Real>> frames, Real out[3]) {
  out[0] = out[1] = out[2] = 0;
  if (frames.size() == 1) {
    std::copy_n(frames[0].normal, 3, out);
    return;
  }
  for (const Frame<Real>& frame : frames)
    for (int k = 0; k < 3; ++k) out[k] += frame.normal[k];
  // Opposite sides cancel up to rounding: no direction is better than a random one.
  if (std::sqrt(dot(out, out)) <=
      16 * std::numeric_limits<Real>::epsilon() * static_cast<Real>(frames.size()))
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

// What decides how the ring's sharpness decays: the edges around the same point of the mesh, and, at the far
// ends of the ring's edges, those around theirs.
template <class Real>
void gather_decay(CreaseMethod method, const Sharp& own, const Sharp& mesh, Index v, Ring<Real>& ring) {
  const Index h0 = own.topology.vertex_corners(v)[0];
  const auto around = mesh.topology.vertex_edges(mesh.topology.corner_vertex(h0));
  auto sharpness_of = [&](std::span<const Index> edges) {
    std::vector<float> result;
    for (Index e : edges) result.push_back(mesh.sharpness.edges[e]);
    return result;
  };
  const Positions in_around(around);
  ring.around = sharpness_of(around);
  for (Index e : own.topology.vertex_edges(v)) {
    const Index in_mesh = mesh.topology.half_edge_edge(own.topology.edge_half_edges(e)[0]);
    ring.in_mesh.push_back(in_around(in_mesh));
    if (is_infinite(own.sharpness.edges[e])) {
      ring.far_child.push_back(kInfiniteSharpness);
      continue;
    }
    const auto at_end =
        mesh.topology.vertex_edges(mesh.topology.other_end(in_mesh, mesh.topology.corner_vertex(h0)));
    const std::vector<float> parent = sharpness_of(at_end);
    std::vector<float> child(parent.size());
    decay_around_vertex(method, parent, child);
    ring.far_child.push_back(
        child[static_cast<std::size_t>(std::ranges::find(at_end, in_mesh) - at_end.begin())]);
  }
}

template <class Real>
void Ring<Real>::set_faces(const Topology& topology, Index v) {
  const Positions in_ring(topology.vertex_edges(v));
  auto position = [&](Index h) { return static_cast<Index>(in_ring(topology.half_edge_edge(h))); };
  for (Index h : topology.vertex_corners(v)) wedges.push_back({position(h), position(Topology::prev(h))});
  auto passable = [&](Index e) { return !is_infinite(edge_sharpness[in_ring(e)]); };
  for (const Topology::Fan& fan : topology.fans(v, passable)) {
    Sector sector{{}, fan.closed};
    for (Index h : fan.corners) sector.edges.push_back(position(h));
    if (!fan.closed) sector.edges.push_back(position(Topology::prev(fan.corners.back())));
    sectors.push_back(std::move(sector));
  }
}

template <class Real>
Ring<Real> ring_of(CreaseMethod method, const Sharp& own, const Sharp& mesh, Index v,
                   std::span<const Real> values, Index width) {
  Ring<Real> ring;
  ring.width = width;
  auto append = [&](std::vector<Real>& to, Index vertex) {
    const auto at = values.subspan(std::size_t{vertex} * width, width);
    to.insert(to.end(), at.begin(), at.end());
  };
  append(ring.center, v);
  ring.vertex_sharpness = own.sharpness.vertices[v];
  for (Index e : own.topology.vertex_edges(v)) {
    append(ring.neighbors, own.topology.other_end(e, v));
    ring.edge_sharpness.push_back(own.sharpness.edges[e]);
  }
  ring.set_faces(own.topology, v);
  if (!ring.wedges.empty()) gather_decay(method, own, mesh, v, ring);
  return ring;
}

template <class Scheme, class Real>
LimitRing<Scheme, Real>::LimitRing(const Scheme& scheme, CreaseMethod method, Ring<Real> ring)
    : scheme_(scheme), method_(method), ring_(std::move(ring)) {
  if (ring_.wedges.empty()) return;  // a point without faces stays, sharp or not
  while (!settled()) step();
}

template <class Scheme, class Real>
bool LimitRing<Scheme, Real>::settled() const {
  return !is_semi_sharp(ring_.vertex_sharpness) && std::ranges::none_of(ring_.edge_sharpness, is_semi_sharp);
}

// One level of refinement of the ring: its own values from its own values.
template <class Scheme, class Real>
void LimitRing<Scheme, Real>::step() {
  const std::size_t n = ring_.edge_sharpness.size();
  std::vector<float> around(ring_.around.size()), near_child(n);
  decay_around_vertex(method_, ring_.around, around);
  for (std::size_t k = 0; k < n; ++k)
    near_child[k] = is_infinite(ring_.edge_sharpness[k]) ? kInfiniteSharpness : around[ring_.in_mesh[k]];
  std::vector<Index> face_counts(n, 0);
  std::vector<Real> opposite(ring_.neighbors.size(), Real(0));
  for (const auto& wedge : ring_.wedges)
    for (auto [edge, across] : {std::pair{wedge.from, wedge.to}, std::pair{wedge.to, wedge.from}}) {
      ++face_counts[edge];
      for (Index c = 0; c < ring_.width; ++c)
        opposite[std::size_t{edge} * ring_.width + c] +=
            ring_.neighbors[std::size_t{across} * ring_.width + c];
    }
  const float child_sharpness = decay(ring_.vertex_sharpness);
  const VertexMask vertex =
      scheme_.vertex_mask({static_cast<Index>(ring_.wedges.size()), method_, ring_.vertex_sharpness,
                           child_sharpness, ring_.edge_sharpness, near_child});
  std::vector<Real> center(ring_.width);
  for (Index c = 0; c < ring_.width; ++c) {
    Real sum = static_cast<Real>(vertex.self) * ring_.center[c];
    for (std::size_t k = 0; k < n; ++k)
      sum += static_cast<Real>(vertex.each) * ring_.neighbors[k * ring_.width + c];
    for (Index end : vertex.crease_ends)
      sum += static_cast<Real>(vertex.crease) * ring_.neighbors[std::size_t{end} * ring_.width + c];
    center[c] = sum;
  }
  for (std::size_t k = 0; k < n; ++k) {
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
      value = static_cast<Real>(edge.end) * (ring_.center[c] + value) +
              static_cast<Real>(edge.opposite) * opposite[k * ring_.width + c];
    }
  }
  ring_.center = std::move(center);
  ring_.around = std::move(around);
  ring_.edge_sharpness = std::move(near_child);
  ring_.vertex_sharpness = child_sharpness;
}

template <class Scheme, class Real>
Rule LimitRing<Scheme, Real>::rule() const {
  return ring_.wedges.empty() ? Rule::corner : rule_of(ring_.vertex_sharpness, ring_.edge_sharpness);
}

// The ring's edges in cyclic order from the crease on.
template <class Scheme, class Real>
std::vector<Index> LimitRing<Scheme, Real>::dart_order() const {
  std::vector<Index> order = ring_.sectors[0].edges;
  order.pop_back();  // the crease again
  return order;
}

template <class Scheme, class Real>
void LimitRing<Scheme, Real>::apply(const RingMask& mask, std::span<const Index> order, Real* out) const {
  for (Index c = 0; c < ring_.width; ++c) {
    Real sum = static_cast<Real>(mask.self) * ring_.center[c];
    for (std::size_t k = 0; k < mask.edges.size(); ++k)
      sum += static_cast<Real>(mask.edges[k]) * ring_.neighbors[std::size_t{order[k]} * ring_.width + c];
    out[c] = sum;
  }
}

// A tangent mask's weights sum to 0: applied to differences it loses nothing far from the origin.
template <class Scheme, class Real>
void LimitRing<Scheme, Real>::apply_to_spokes(const RingMask& mask, std::span<const Index> order,
                                              Real out[3]) const {
  for (std::size_t c = 0; c < 3; ++c) {
    Real sum = 0;
    for (std::size_t k = 0; k < mask.edges.size(); ++k)
      sum += static_cast<Real>(mask.edges[k]) *
             (ring_.neighbors[std::size_t{order[k]} * 3 + c] - ring_.center[c]);
    out[c] = sum;
  }
}

template <class Scheme, class Real>
std::vector<Real> LimitRing<Scheme, Real>::position() const {
  std::vector<Real> out(ring_.center);
  VertexMask mask;
  switch (rule()) {
    case Rule::corner:
      return out;
    case Rule::dart: {
      const std::vector<Index> order = dart_order();
      apply(scheme_.dart_limit_mask(static_cast<Index>(order.size())), order, out.data());
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
      for (std::size_t k = 0; k < ring_.edge_sharpness.size(); ++k)
        sum += static_cast<Real>(mask.each) * ring_.neighbors[k * ring_.width + c];
    if (mask.crease != 0)
      for (Index end : mask.crease_ends)
        sum += static_cast<Real>(mask.crease) * ring_.neighbors[std::size_t{end} * ring_.width + c];
    out[c] = sum + static_cast<Real>(mask.self) * ring_.center[c];
  }
  return out;
}

template <class Scheme, class Real>
Frame<Real> LimitRing<Scheme, Real>::mean_frame(const Sector& sector) const {
  Frame<Real> frame;
  auto spoke = [&](Index edge, Real scale, Real out[3]) {
    for (int c = 0; c < 3; ++c)
      out[c] = (ring_.neighbors[std::size_t{edge} * 3 + c] - ring_.center[c]) * scale;
  };
  Real largest = 0;
  for (Index edge : sector.edges) {
    Real along[3];
    spoke(edge, 1, along);
    for (Real x : along) largest = std::max(largest, std::abs(x));
  }
  if (largest == 0) return frame;
  Real total = 0;
  const std::size_t n = sector.edges.size();
  for (std::size_t k = 0; k + 1 < n + (sector.closed ? 1 : 0); ++k) {
    Real a[3], b[3], area[3];
    spoke(sector.edges[k], 1 / largest, a);
    spoke(sector.edges[(k + 1) % n], 1 / largest, b);
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
  Frame<Real> frame;
  const Rule rule = this->rule();
  const auto faces = static_cast<Index>(sector.edges.size() - (sector.closed ? 0 : 1));
  const bool returns = !sector.closed && sector.edges.front() == sector.edges.back();
  const Frame<Real> mean = mean_frame(sector);
  if (sector.closed) {
    apply_to_spokes(scheme_.smooth_tangent_u(faces), sector.edges, frame.u);
    apply_to_spokes(scheme_.smooth_tangent_v(faces), sector.edges, frame.v);
  } else if (rule == Rule::dart) {
    const std::vector<Index> order = dart_order();
    apply_to_spokes(scheme_.dart_tangent_u(faces), order, frame.u);
    apply_to_spokes(scheme_.smooth_tangent_v(faces), order, frame.v);
  } else if (rule == Rule::crease && !returns) {
    const Index ends[2] = {sector.edges.front(), sector.edges.back()};
    apply_to_spokes({0, {1, -1}}, ends, frame.u);
    apply_to_spokes(scheme_.crease_tangent_across(faces), sector.edges, frame.v);
  } else if (rule == Rule::corner && faces <= 2 && !returns) {
    const Index ends[2] = {sector.edges.front(), sector.edges.back()};
    apply_to_spokes({-1, {1, 0}}, ends, frame.u);
    apply_to_spokes({-1, {0, 1}}, ends, frame.v);
  } else {
    return mean;
  }
  if (!set_normal(frame)) return mean;
  // The border edges of a corner may open by more than 180 degrees: the faces between them tell which side is
  // out.
  if (rule == Rule::corner && dot(frame.normal, mean.normal) < 0) {
    std::swap_ranges(frame.u, frame.u + 3, frame.v);
    for (Real& x : frame.normal) x = -x;
  }
  return frame;
}

template <class Scheme, class Real>
std::vector<Frame<Real>> LimitRing<Scheme, Real>::frames() const {
  std::vector<Frame<Real>> result;
  for (const Sector& sector : ring_.sectors) result.push_back(frame_of(sector));
  return result;
}

template struct Ring<float>;
template struct Ring<double>;
template Ring<float> ring_of(CreaseMethod, const Sharp&, const Sharp&, Index, std::span<const float>, Index);
template Ring<double> ring_of(CreaseMethod, const Sharp&, const Sharp&, Index, std::span<const double>,
                              Index);
template bool set_normal(Frame<float>&);
template bool set_normal(Frame<double>&);
template class LimitRing<Loop, float>;
template class LimitRing<Loop, double>;
template void normalize<float>(float[3]);
template void normalize<double>(double[3]);
template void mean_normal<float>(std::span<const Frame<float>>, float[3]);
template void mean_normal<double>(std::span<const Frame<double>>, double[3]);

}  // namespace subdivd
