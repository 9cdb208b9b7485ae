#include "tests/reference/plain.h"

#include <utility>

#include "core/lattice/numbering.h"

namespace subdivd::plain {
namespace {

// With the edges as the topology numbers them: sharpness is given by those numbers.
Adjacency polygons_of(const Topology<Triangles>& topology) {
  const auto corners = topology.corner_vertices(), edges = topology.half_edge_edges();
  const auto ends = topology.edge_vertices();
  std::vector<Index> offsets;
  for (Index f = 0; f <= topology.face_count(); ++f) offsets.push_back(3 * f);
  return Adjacency(topology.vertex_count(), Polygons(std::move(offsets), {corners.begin(), corners.end()}),
                   {edges.begin(), edges.end()}, {ends.begin(), ends.end()});
}

std::vector<GridPoint> child_corners(const std::vector<GridPoint>& corners) {
  std::vector<GridPoint> children;
  children.reserve(corners.size() * 4);
  auto sum = [](GridPoint a, GridPoint b) { return GridPoint{a.i + b.i, a.j + b.j}; };
  for (std::size_t f = 0; f < corners.size(); f += 3) {
    const GridPoint c[3] = {corners[f], corners[f + 1], corners[f + 2]};
    const GridPoint v[3] = {sum(c[0], c[0]), sum(c[1], c[1]), sum(c[2], c[2])};
    const GridPoint e[3] = {sum(c[0], c[1]), sum(c[1], c[2]), sum(c[2], c[0])};
    children.insert(children.end(), {v[0], e[0], e[2], e[0], v[1], e[1], e[2], e[1], v[2], e[0], e[1], e[2]});
  }
  return children;
}

}  // namespace

Level first_level(const Topology<Triangles>& topology, Sharpness sharpness, CreaseMethod method) {
  return first_level(polygons_of(topology), std::move(sharpness), method);
}

Level first_level(const Channel<Triangles>& channel, const Level& mesh) {
  return first_level(polygons_of(*channel.topology), channel.sharpness, channel.linear,
                     channel.linear_borders, mesh);
}

Topology<Triangles> topology_of(const Adjacency& faces) {
  const auto corners = faces.corners(), edges = faces.half_edge_edges();
  const auto ends = faces.edge_vertices();
  return Topology<Triangles>(faces.vertex_count(), Triangles({corners.begin(), corners.end()}),
                             {edges.begin(), edges.end()}, {ends.begin(), ends.end()});
}

std::vector<Index> closed_form_numbers(const Topology<Triangles>& base, Index depth, const Adjacency& faces) {
  std::vector<GridPoint> corners;  // of the children of one face: where each lies on its grid
  corners = {{0, 0}, {1, 0}, {0, 1}};
  for (Index level = 0; level < depth; ++level) corners = child_corners(corners);
  const Numbering numbering(base, depth);
  std::vector<Index> numbers(faces.vertex_count());
  for (Index v = 0; v < base.vertex_count(); ++v) numbers[v] = v;
  for (Index h = 0; h < faces.half_edge_count(); ++h) {
    const GridPoint at = corners[h % corners.size()];
    numbers[faces.corner_vertex(h)] = numbering.vertex(static_cast<Index>(h / corners.size()), at.i, at.j);
  }
  return numbers;
}

}  // namespace subdivd::plain
