// Seams: which face corners share a face-varying value.
#include <algorithm>
#include <map>
#include <numeric>

#include "tests/shapes/build.h"

namespace subdivd::shapes {
namespace {

Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

// Groups of corners, by the lowest corner of each.
class Groups {
 public:
  explicit Groups(std::size_t corners) : parent_(corners) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index lowest(Index corner) const {
    while (parent_[corner] != corner) corner = parent_[corner];
    return corner;
  }
  void unite(Index a, Index b) {
    const Edge both = ordered(lowest(a), lowest(b));
    parent_[both.second] = both.first;
  }

 private:
  std::vector<Index> parent_;
};

Groups corners_that_share(const ControlMesh& mesh, const std::vector<Edge>& seams) {
  const std::vector<Index>& indices = mesh.face_vertex_indices;
  // Per edge, in either direction: the corner at the edge's lower end, the corner at its upper end.
  std::map<Edge, std::vector<Edge>> sides;
  for (Index c = 0; c < indices.size(); ++c) {
    const Index d = c - c % 3 + (c + 1) % 3;
    const Edge edge = ordered(indices[c], indices[d]);
    sides[edge].push_back(edge.first == indices[c] ? Edge{c, d} : Edge{d, c});
  }
  for (const Edge& seam : seams) sides.erase(ordered(seam.first, seam.second));
  Groups groups(indices.size());
  for (const auto& [edge, corners] : sides)
    for (const Edge& other : corners) {
      groups.unite(corners[0].first, other.first);
      groups.unite(corners[0].second, other.second);
    }
  return groups;
}

}  // namespace

Primvar seamed(const ControlMesh& mesh, std::string name, Index element_size,
               const std::vector<Edge>& seams) {
  Primvar primvar{std::move(name), Interpolation::face_varying, element_size, {}, {}};
  const Groups groups = corners_that_share(mesh, seams);
  std::map<Index, Index> value_of_group;
  std::map<Index, int> groups_at_point;
  for (Index c = 0; c < mesh.face_vertex_indices.size(); ++c) {
    const auto [found, is_new] =
        value_of_group.try_emplace(groups.lowest(c), static_cast<Index>(value_of_group.size()));
    primvar.indices.push_back(found->second);
    if (!is_new) continue;
    const Index point = mesh.face_vertex_indices[c];
    const double jump = 0.45 * groups_at_point[point]++;
    for (Index k = 0; k < element_size; ++k)
      primvar.values.push_back(mesh.points[3 * point + k % 3] * (1 + 0.1 * k) +
                               (k % 2 == 0 ? jump : -jump / 2));
  }
  return primvar;
}

std::vector<Edge> edges_along(const std::vector<Index>& points) {
  std::vector<Edge> edges;
  for (std::size_t k = 1; k < points.size(); ++k) edges.emplace_back(points[k - 1], points[k]);
  return edges;
}

std::vector<Edge> edges_of(const ControlMesh& mesh) {
  std::vector<Edge> edges;
  const std::vector<Index>& indices = mesh.face_vertex_indices;
  for (std::size_t c = 0; c < indices.size(); ++c)
    edges.push_back(ordered(indices[c], indices[c - c % 3 + (c + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace subdivd::shapes
