#include "tests/properties/curves/mesh_lines.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>

#include "core/lattice/split.h"
#include "tests/shapes/build.h"
#include "tests/shapes/random.h"

namespace subdivd::testing {
namespace {

using Path = std::vector<Index>;

// Symmetry would hide wrong weights.
void scatter(ControlMesh& mesh, shapes::Random& random) {
  for (double& x : mesh.points) x = random.centred();
}

// --- Borders ----------------------------------------------------------------------------------------------

// Every border of the mesh, against its faces' sense from its lowest point on.
std::vector<Path> border_loops(const ControlMesh& mesh) {
  const auto& corners = mesh.face_vertex_indices;
  std::set<shapes::Edge> half_edges;
  for (std::size_t h = 0; h < corners.size(); ++h)
    half_edges.emplace(corners[h], corners[h % 3 == 2 ? h - 2 : h + 1]);
  std::map<Index, Index> next;  // along what no face runs along
  for (const auto& [a, b] : half_edges)
    if (!half_edges.contains({b, a})) next[b] = a;
  std::vector<Path> loops;
  while (!next.empty()) {
    Path loop;
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back(at->first);
      const Index to = at->second;
      next.erase(at);
      at = next.find(to);
    }
    loops.push_back(loop);
  }
  return loops;
}

// Points where a border is pinned: sharp ones, and by default those of a single face.
std::set<Index> pinned_points(const ControlMesh& mesh) {
  std::set<Index> pinned(mesh.corner_indices.begin(), mesh.corner_indices.end());
  if (mesh.interpolate_boundary != BoundaryInterpolation::edge_and_corner) return pinned;
  std::map<Index, int> faces;
  for (const Index v : mesh.face_vertex_indices) ++faces[v];
  for (const auto& [v, count] : faces)
    if (count == 1) pinned.insert(v);
  return pinned;
}

// The parts of a closed path between pinned points, or the whole.
std::vector<Path> parts_of(const Path& loop, const std::set<Index>& pinned) {
  std::vector<std::size_t> stops;
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (pinned.contains(loop[k])) stops.push_back(k);
  if (stops.empty()) return {loop};
  std::vector<Path> parts;
  for (std::size_t s = 0; s < stops.size(); ++s) {
    const std::size_t end = s + 1 < stops.size() ? stops[s + 1] : stops[0] + loop.size();
    Path part;
    for (std::size_t k = stops[s]; k <= end; ++k) part.push_back(loop[k % loop.size()]);
    parts.push_back(part);
  }
  return parts;
}

void add_borders(std::vector<MeshLine>& lines, const std::string& name, ControlMesh mesh,
                 BoundaryInterpolation boundary) {
  shapes::Random random(lines.size() + 1);
  scatter(mesh, random);
  mesh.interpolate_boundary = boundary;
  const std::set<Index> pinned = pinned_points(mesh);
  int number = 0;
  for (const Path& loop : border_loops(mesh))
    for (const Path& part : parts_of(loop, pinned)) {
      const bool closed = std::ranges::none_of(part, [&](Index v) { return pinned.contains(v); });
      lines.push_back({name + "_" + std::to_string(number++), mesh, part, closed});
    }
}

// --- Creases ----------------------------------------------------------------------------------------------

// A path along edges that meets no point twice and stops where it cannot go on, or after `most` points.
Path random_walk(const ControlMesh& mesh, std::size_t most, shapes::Random& random) {
  std::map<Index, Path> neighbours;
  for (const auto& [a, b] : shapes::edges_of(mesh)) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  Path path{random.below(mesh.point_count())};
  std::set<Index> met{path[0]};
  while (path.size() < most) {
    Path choice;
    for (const Index v : neighbours[path.back()])
      if (!met.contains(v)) choice.push_back(v);
    if (choice.empty()) break;
    path.push_back(choice[random.below(choice.size())]);
    met.insert(path.back());
  }
  return path;
}

void add_open_crease(std::vector<MeshLine>& lines, const std::string& name, ControlMesh mesh,
                     shapes::Random& random) {
  scatter(mesh, random);
  const Path path = random_walk(mesh, 2 + random.below(6), random);
  shapes::crease(mesh, path, kInfiniteSharpness);
  shapes::corner(mesh, path.front(), kInfiniteSharpness);
  shapes::corner(mesh, path.back(), kInfiniteSharpness);
  lines.push_back({name + "_open", mesh, path, false});
}

// The longest closed part of a random walk.
void add_closed_crease(std::vector<MeshLine>& lines, const std::string& name, ControlMesh mesh,
                       shapes::Random& random) {
  scatter(mesh, random);
  const auto edges = shapes::edges_of(mesh);
  Path loop = random_walk(mesh, mesh.point_count(), random);
  const auto closes = [&] {
    const shapes::Edge edge = std::minmax(loop.front(), loop.back());
    return std::ranges::find(edges, edge) != edges.end();
  };
  while (loop.size() > 3 && !closes()) loop.pop_back();
  assert(closes());
  Path tagged = loop;
  tagged.push_back(loop[0]);
  shapes::crease(mesh, tagged, 1e38f);
  lines.push_back({name + "_closed", mesh, loop, true});
}

// Two creases that cross, from border to border: what crosses is a corner without being tagged.
void add_crossing(std::vector<MeshLine>& lines, shapes::Random& random) {
  ControlMesh mesh = shapes::grid(6, 4);
  scatter(mesh, random);
  const Path across{14, 15, 16, 17, 18, 19, 20}, up{3, 10, 17, 24, 31};
  shapes::crease(mesh, across, kInfiniteSharpness);
  shapes::crease(mesh, up, kInfiniteSharpness);
  lines.push_back({"crossing_left", mesh, {14, 15, 16, 17}, false});
  lines.push_back({"crossing_right", mesh, {17, 18, 19, 20}, false});
  lines.push_back({"crossing_up", mesh, {17, 24, 31}, false});
}

// --- Places -----------------------------------------------------------------------------------------------

// The lowest-numbered face with an edge from a to b or back, and how the edge lies in it.
Provenance place_between(const ControlMesh& mesh, Index a, Index b, Index step, Index n) {
  const auto& corners = mesh.face_vertex_indices;
  for (std::size_t h = 0; h < corners.size(); ++h) {
    const Index from = corners[h], to = corners[h % 3 == 2 ? h - 2 : h + 1];
    if ((from != a || to != b) && (from != b || to != a)) continue;
    const Index s = from == a ? step : n - step;
    const auto face = static_cast<Index>(h / 3);
    switch (h % 3) {
      case 0:
        return {face, s, 0};
      case 1:
        return {face, n - s, s};
      default:
        return {face, 0, n - s};
    }
  }
  assert(false);
  return {};
}

}  // namespace

std::vector<MeshLine> border_lines() {
  using enum BoundaryInterpolation;
  std::vector<MeshLine> lines;
  add_borders(lines, "grid_with_two_corners", shapes::grid(5, 3), edge_and_corner);
  add_borders(lines, "grid_without_corners", shapes::grid(6, 2), edge_only);
  ControlMesh square = shapes::grid(4, 4);
  for (const Index v : {0u, 4u, 20u, 24u}) shapes::corner(square, v, kInfiniteSharpness);
  add_borders(lines, "grid_with_four_corners", square, edge_only);
  for (const Index valence : {3u, 7u, 12u})
    add_borders(lines, "disk_" + std::to_string(valence), shapes::disk(valence), edge_only);
  add_borders(lines, "tube", shapes::tube(5, 2), edge_and_corner);
  for (const Index faces : {1u, 4u, 9u}) {
    const std::string name = "fan_" + std::to_string(faces);
    add_borders(lines, name + "_rounded", shapes::open_fan(faces), edge_only);
    add_borders(lines, name + "_pinned", shapes::open_fan(faces), edge_and_corner);
  }
  return lines;
}

std::vector<MeshLine> crease_lines() {
  std::vector<shapes::NamedShape> meshes{
      {"tetrahedron", shapes::tetrahedron()}, {"octahedron", shapes::octahedron()},
      {"icosahedron", shapes::icosahedron()}, {"cube", shapes::cube()},
      {"torus", shapes::torus(4, 5)},         {"uneven_torus", shapes::big_torus(5, 4, 3)}};
  for (const Index valence : {3u, 5u, 8u, 12u})
    meshes.push_back({"pyramid_" + std::to_string(valence), shapes::double_pyramid(valence)});
  std::vector<MeshLine> lines;
  shapes::Random random(19);
  for (const auto& [name, mesh] : meshes) {
    add_open_crease(lines, name, mesh, random);
    add_closed_crease(lines, name, mesh, random);
  }
  add_crossing(lines, random);
  return lines;
}

std::vector<MeshLine> all_mesh_lines() {
  std::vector<MeshLine> lines;
  for (MeshLine& line : border_lines()) {
    line.name = "border_of_" + line.name;
    lines.push_back(std::move(line));
  }
  for (MeshLine& line : crease_lines()) {
    line.name = "crease_on_" + line.name;
    lines.push_back(std::move(line));
  }
  return lines;
}

ControlCurves curve_of(const MeshLine& line) {
  ControlCurves curve;
  curve.wrap = line.closed ? CurveWrap::periodic : CurveWrap::pinned;
  for (const Index v : line.points)
    for (Index k = 0; k < 3; ++k) curve.points.push_back(line.mesh.points[3 * v + k]);
  return curve;
}

double extent(const MeshLine& line) {
  const ControlCurves curve = curve_of(line);
  double result = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = curve.points[k], high = low;
    for (std::size_t at = k; at < curve.points.size(); at += 3) {
      low = std::min(low, curve.points[at]);
      high = std::max(high, curve.points[at]);
    }
    result = std::hypot(result, high - low);
  }
  return result;
}

std::vector<Provenance> places_along(const MeshLine& line, Index level) {
  const auto n = static_cast<Index>(segments(level));
  const std::size_t count = line.points.size(), edges = line.closed ? count : count - 1;
  std::vector<Provenance> places;
  for (std::size_t k = 0; k < edges; ++k)
    for (Index s = 0; s < n; ++s)
      places.push_back(place_between(line.mesh, line.points[k], line.points[(k + 1) % count], s, n));
  if (!line.closed)
    places.push_back(place_between(line.mesh, line.points[count - 2], line.points[count - 1], n, n));
  return places;
}

}  // namespace subdivd::testing
