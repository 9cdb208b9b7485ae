#include "core/oracle/far_grid.h"

#include <array>
#include <span>

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;

GridPoint sum(GridPoint a, GridPoint b) { return {a.i + b.i, a.j + b.j}; }

// Vertices of the next level and their places: those that the corners of a child face may be.
class Children {
 public:
  void clear() { size_ = 0; }
  void add(int vertex, GridPoint place) { all_[size_++] = {vertex, place}; }
  GridPoint place_of(int vertex) const {
    for (std::size_t k = 0; k < size_; ++k)
      if (all_[k].vertex == vertex) return all_[k].place;
    return {kNoIndex, kNoIndex};
  }

 private:
  struct Child {
    int vertex;
    GridPoint place;
  };
  std::array<Child, 6> all_{};
  std::size_t size_ = 0;
};

// What a face of the parent level has been split into.
class ParentFace {
 public:
  ParentFace(const Far::TopologyLevel& parent, int face, std::span<const GridPoint> places)
      : parent_(&parent),
        face_(face),
        vertices_(parent.GetFaceVertices(face)),
        edges_(parent.GetFaceEdges(face)),
        places_(places) {}

  int size() const { return vertices_.size(); }

  // All children of a triangle: of its corners and its edges.
  Children of_triangle() const {
    Children children;
    for (int k = 0; k < 3; ++k) {
      children.add(parent_->GetVertexChildVertex(vertices_[k]), sum(place(k), place(k)));
      children.add(parent_->GetEdgeChildVertex(edges_[k]), sum(place(k), place(k + 1)));
    }
    return children;
  }
  // Those at corner k: of the corner, the two edges there and the face.
  Children of_corner(int k) const {
    Children children;
    // Of a quad: the middle is half the sum of the four corners, whose coordinates differ by the same
    // everywhere.
    const GridPoint all = sum(sum(place(0), place(1)), sum(place(2), place(3)));
    add_corner(children, k,
               {sum(place(k), place(k)),
                sum(place(k), place(k + 1)),
                {all.i / 2, all.j / 2},
                sum(place(k), place(k + size() - 1))});
    return children;
  }
  // The same where the corner's quad begins here: its grid has two segments then, as a quad's would have.
  Children of_corner_alone(int k) const {
    Children children;
    add_corner(children, k, {GridPoint{0, 0}, GridPoint{2, 0}, GridPoint{2, 2}, GridPoint{0, 2}});
    return children;
  }

 private:
  GridPoint place(int k) const { return places_[static_cast<std::size_t>(k % size())]; }
  // `at`: counter-clockwise from the corner.
  void add_corner(Children& children, int k, const std::array<GridPoint, 4>& at) const {
    children.add(parent_->GetVertexChildVertex(vertices_[k]), at[0]);
    children.add(parent_->GetEdgeChildVertex(edges_[k]), at[1]);
    children.add(parent_->GetFaceChildVertex(face_), at[2]);
    children.add(parent_->GetEdgeChildVertex(edges_[(k + size() - 1) % size()]), at[3]);
  }

  const Far::TopologyLevel* parent_;
  int face_;
  Far::ConstIndexArray vertices_, edges_;
  std::span<const GridPoint> places_;
};

FarGrid base_grid(const Far::TopologyLevel& base, GridShape shape, const Pace& pace) {
  FarGrid grid;
  grid.corners.reserve(static_cast<std::size_t>(base.GetNumFaceVertices()));
  grid.base_faces.reserve(static_cast<std::size_t>(base.GetNumFaces()));
  for (int face = 0; face < base.GetNumFaces(); ++face) {
    const auto size = static_cast<std::size_t>(base.GetFaceVertices(face).size());
    pace.spend(size);
    if (shape == GridShape::triangles)
      grid.corners.insert(grid.corners.end(), {GridPoint{0, 0}, GridPoint{1, 0}, GridPoint{0, 1}});
    else if (size == 4)
      grid.corners.insert(grid.corners.end(),
                          {GridPoint{0, 0}, GridPoint{1, 0}, GridPoint{1, 1}, GridPoint{0, 1}});
    else
      grid.corners.insert(grid.corners.end(), size, GridPoint{0, 0});  // each on a quad of its own, to be
    grid.base_faces.push_back(static_cast<Index>(face));
  }
  return grid;
}

FarGrid child_grid(const FarGrid& grid, GridShape shape, const Far::TopologyLevel& parent,
                   const Far::TopologyLevel& child, const Pace& pace) {
  const auto faces = static_cast<std::size_t>(child.GetNumFaces());
  const std::size_t face_size = shape == GridShape::triangles ? 3 : 4;
  FarGrid next;
  next.corners.resize(faces * face_size);
  next.base_faces.resize(faces);
  if (shape == GridShape::corners) next.base_corners.resize(faces);
  std::size_t begin = 0;  // of the face's corners
  for (int face = 0; face < parent.GetNumFaces(); ++face) {
    const auto f = static_cast<std::size_t>(face);
    const ParentFace whole(parent, face, std::span(grid.corners).subspan(begin));
    const auto size = static_cast<std::size_t>(whole.size());
    begin += size;
    pace.spend(8 * size);
    Children known;
    if (shape == GridShape::triangles) known = whole.of_triangle();
    const Far::ConstIndexArray children = parent.GetFaceChildFaces(face);
    for (int c = 0; c < children.size(); ++c) {
      const auto child_face = static_cast<std::size_t>(children[c]);
      if (shape != GridShape::triangles) known = size == 4 ? whole.of_corner(c) : whole.of_corner_alone(c);
      next.base_faces[child_face] = grid.base_faces[f];
      if (shape == GridShape::corners)
        next.base_corners[child_face] = size != 4                   ? static_cast<Index>(c)
                                        : grid.base_corners.empty() ? 0
                                                                    : grid.base_corners[f];
      const Far::ConstIndexArray vertices = child.GetFaceVertices(children[c]);
      for (std::size_t k = 0; k < face_size; ++k)
        next.corners[face_size * child_face + k] = known.place_of(vertices[static_cast<int>(k)]);
    }
  }
  return next;
}

}  // namespace

FarGrid grid_of(const Far::TopologyRefiner& refiner, GridShape shape, Index depth, const Pace& pace) {
  FarGrid grid = base_grid(refiner.GetLevel(0), shape, pace);
  for (int l = 0; l < static_cast<int>(depth); ++l)
    grid = child_grid(grid, shape, refiner.GetLevel(l), refiner.GetLevel(l + 1), pace);
  return grid;
}

}  // namespace subdivd::oracle
