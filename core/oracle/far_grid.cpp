#include "core/oracle/far_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;

GridPoint sum(GridPoint a, GridPoint b) { return {a.i + b.i, a.j + b.j}; }

// The places of a face's six children (three of its corners, three of its edges), through parent relations.
struct ChildPlaces {
  std::array<int, 6> vertices{};
  std::array<GridPoint, 6> places{};

  GridPoint of(int vertex) const {
    const auto found = std::find(vertices.begin(), vertices.end(), vertex);
    assert(found != vertices.end());
    return places[static_cast<std::size_t>(found - vertices.begin())];
  }
};

ChildPlaces child_places(const Far::TopologyLevel& parent, int face, std::span<const GridPoint> corners) {
  const Far::ConstIndexArray vertices = parent.GetFaceVertices(face), edges = parent.GetFaceEdges(face);
  const auto place_of = [&](int vertex) {
    std::size_t k = 0;
    while (vertices[static_cast<int>(k)] != vertex) ++k;
    return corners[k];
  };
  ChildPlaces children;
  for (int k = 0; k < 3; ++k) {
    const auto slot = static_cast<std::size_t>(k);
    children.vertices[slot] = parent.GetVertexChildVertex(vertices[k]);
    children.places[slot] = sum(corners[slot], corners[slot]);
    const Far::ConstIndexArray ends = parent.GetEdgeVertices(edges[k]);
    children.vertices[3 + slot] = parent.GetEdgeChildVertex(edges[k]);
    children.places[3 + slot] = sum(place_of(ends[0]), place_of(ends[1]));
  }
  return children;
}

FarGrid base_grid(const Far::TopologyLevel& base, const Pace& pace) {
  FarGrid grid;
  grid.corners.reserve(static_cast<std::size_t>(base.GetNumFaces()) * 3);
  grid.base_faces.reserve(static_cast<std::size_t>(base.GetNumFaces()));
  for (int face = 0; face < base.GetNumFaces(); ++face) {
    pace.spend(1);
    grid.corners.insert(grid.corners.end(), {GridPoint{0, 0}, GridPoint{1, 0}, GridPoint{0, 1}});
    grid.base_faces.push_back(static_cast<Index>(face));
  }
  return grid;
}

FarGrid child_grid(const FarGrid& grid, const Far::TopologyLevel& parent, const Far::TopologyLevel& child,
                   const Pace& pace) {
  FarGrid next;
  next.corners.resize(static_cast<std::size_t>(child.GetNumFaces()) * 3);
  next.base_faces.resize(static_cast<std::size_t>(child.GetNumFaces()));
  for (int face = 0; face < parent.GetNumFaces(); ++face) {
    pace.spend(16);
    const auto f = static_cast<std::size_t>(face);
    const ChildPlaces places = child_places(parent, face, std::span(grid.corners).subspan(3 * f, 3));
    const Far::ConstIndexArray children = parent.GetFaceChildFaces(face);
    for (int c = 0; c < children.size(); ++c) {
      const auto child_face = static_cast<std::size_t>(children[c]);
      const Far::ConstIndexArray vertices = child.GetFaceVertices(children[c]);
      next.base_faces[child_face] = grid.base_faces[f];
      for (int k = 0; k < 3; ++k)
        next.corners[3 * child_face + static_cast<std::size_t>(k)] = places.of(vertices[k]);
    }
  }
  return next;
}

}  // namespace

FarGrid grid_of(const Far::TopologyRefiner& refiner, Index depth, const Pace& pace) {
  FarGrid grid = base_grid(refiner.GetLevel(0), pace);
  for (int l = 0; l < static_cast<int>(depth); ++l)
    grid = child_grid(grid, refiner.GetLevel(l), refiner.GetLevel(l + 1), pace);
  return grid;
}

}  // namespace subdivd::oracle
