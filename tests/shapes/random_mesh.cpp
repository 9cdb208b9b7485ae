#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/shapes/build.h"
#include "tests/shapes/random.h"
#include "tests/shapes/shapes.h"

namespace subdivd::shapes {
namespace {

Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

Index& at(ControlMesh& mesh, Index face, Index corner) {
  return mesh.face_vertex_indices[3 * face + corner % 3];
}

// Faces by edge; kept up to date by flips.
class Triangulation {
 public:
  explicit Triangulation(ControlMesh& mesh) : mesh_(mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (Index k = 0; k < 3; ++k) faces_of_[ordered(at(mesh, f, k), at(mesh, f, k + 1))].insert(f);
  }

  // Replaces the diagonal opposite corner k + 2 of face f by the other one, if the mesh stays a mesh.
  void flip(Index f, Index k) {
    const Index a = at(mesh_, f, k), b = at(mesh_, f, k + 1), c = at(mesh_, f, k + 2);
    const std::set<Index>& faces = faces_of_[ordered(a, b)];
    if (faces.size() != 2) return;
    const Index g = *faces.begin() == f ? *faces.rbegin() : *faces.begin();
    Index m = 0;
    while (at(mesh_, g, m) == a || at(mesh_, g, m) == b) ++m;
    const Index d = at(mesh_, g, m);
    if (c == d || at(mesh_, g, m + 1) != a || faces_of_.contains(ordered(c, d))) return;
    // (a b c) (b a d)  ->  (a d c) (d b c)
    faces_of_.erase(ordered(a, b));
    faces_of_[ordered(c, d)] = {f, g};
    move(ordered(b, c), f, g);
    move(ordered(a, d), g, f);
    for (const auto& [face, triangle] : {std::pair{f, Triangle{a, d, c}}, {g, Triangle{d, b, c}}})
      for (Index corner = 0; corner < 3; ++corner) at(mesh_, face, corner) = triangle[corner];
  }

 private:
  void move(Edge edge, Index from, Index to) {
    faces_of_[edge].erase(from);
    faces_of_[edge].insert(to);
  }

  ControlMesh& mesh_;
  std::map<Edge, std::set<Index>> faces_of_;
};

void flip_some(ControlMesh& mesh, Random& random) {
  Triangulation triangulation(mesh);
  for (Count tries = random.below(2 * mesh.face_count() + 1); tries > 0; --tries)
    triangulation.flip(random.below(mesh.face_count()), random.below(3));
}

// A new point in the middle of a face: valence 3.
void split_face(ControlMesh& mesh, Index face) {
  const auto middle = static_cast<Index>(mesh.point_count());
  const Index a = at(mesh, face, 0), b = at(mesh, face, 1), c = at(mesh, face, 2);
  for (std::size_t k = 0; k < 3; ++k)
    mesh.points.push_back((mesh.points[3 * a + k] + mesh.points[3 * b + k] + mesh.points[3 * c + k]) / 3);
  at(mesh, face, 2) = middle;
  mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {b, c, middle, c, a, middle});
}

ControlMesh random_connectivity(Random& random) {
  const Index a = 3 + random.below(5), b = 3 + random.below(5);
  ControlMesh mesh;
  switch (random.below(6)) {
    case 0:
      mesh = grid(a - 2, b - 2);
      break;
    case 1:
      mesh = torus(a, b);
      break;
    case 2:
      mesh = tube(a, b - 2);
      break;
    case 3:
      mesh = icosahedron();
      break;
    case 4:
      mesh = double_pyramid(a);
      break;
    default:
      mesh = join(disk(a), tetrahedron(), {1.5, 0, 0});
  }
  for (Index n = random.below(6); n > 0; --n) split_face(mesh, random.below(mesh.face_count()));
  if (!random.one_in(4)) flip_some(mesh, random);
  return mesh;
}

void remove_face(ControlMesh& mesh, Index face) {
  const auto first = mesh.face_vertex_indices.begin() + 3 * static_cast<std::ptrdiff_t>(face);
  mesh.face_vertex_indices.erase(first, first + 3);
}

// Removed faces make borders, bow-ties and unreferenced points; fins and turned faces make edges
// non-manifold.
void damage(ControlMesh& mesh, Random& random) {
  if (random.one_in(2))
    for (Index n = random.below(6); n > 0 && mesh.face_count() > 1; --n)
      remove_face(mesh, random.below(mesh.face_count()));
  if (random.one_in(6)) {
    const Index face = random.below(mesh.face_count()), k = random.below(3);
    const auto tip = static_cast<Index>(mesh.point_count());
    for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(1.5 * random.centred());
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(),
                                    {at(mesh, face, k), at(mesh, face, k + 1), tip});
  }
  if (random.one_in(10)) {
    const Index face = random.below(mesh.face_count());
    std::swap(at(mesh, face, 0), at(mesh, face, 1));
  }
}

// Whole numbers, fractions, infinite ones, and nothing at all.
float random_sharpness(Random& random) {
  switch (random.below(6)) {
    case 0:
      return static_cast<float>(random.below(5));
    case 1:
      return random.one_in(2) ? 10.0f : 1e38f;
    case 2:
      return 0.1f * static_cast<float>(random.below(50));
    default:
      return static_cast<float>(4 * random.unit());
  }
}

// A walk along edges, which may cross itself and other creases.
void add_crease(ControlMesh& mesh, const std::map<Index, std::vector<Index>>& neighbours, bool by_edge,
                Random& random) {
  auto here = std::next(neighbours.begin(), random.below(neighbours.size()))->first;
  std::vector<Index> path = {here};
  for (Index steps = 1 + random.below(6); steps > 0; --steps) {
    const std::vector<Index>& next = neighbours.at(here);
    path.push_back(here = next[random.below(next.size())]);
  }
  if (!by_edge) return crease(mesh, path, random_sharpness(random));
  std::vector<float> sharpnesses(path.size() - 1);
  for (float& s : sharpnesses) s = random_sharpness(random);
  crease_by_edge(mesh, path, sharpnesses);
}

void add_tags(ControlMesh& mesh, const std::vector<Edge>& edges, Random& random) {
  std::map<Index, std::vector<Index>> neighbours;
  for (const auto& [a, b] : edges) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  const bool by_edge = random.one_in(2);
  for (Index n = random.below(5); n > 0; --n) add_crease(mesh, neighbours, by_edge, random);

  std::set<Index> corners;
  for (Index n = random.below(4); n > 0; --n) corners.insert(random.below(mesh.point_count()));
  for (const Index point : corners) corner(mesh, point, random_sharpness(random));

  std::set<Index> holes;
  if (random.one_in(3))
    for (Index n = random.below(4); n > 0; --n) holes.insert(random.below(mesh.face_count()));
  mesh.hole_indices.assign(holes.begin(), holes.end());
}

void add_primvars(ControlMesh& mesh, const std::vector<Edge>& edges, Random& random) {
  const Index odds = 1 + random.below(8);  // 1: every edge is a seam
  std::vector<Edge> seams;
  for (const Edge& edge : edges)
    if (random.one_in(odds)) seams.push_back(edge);
  if (random.one_in(8)) seams.clear();
  Primvar st = random.one_in(8) ? unindexed(mesh, "st", 1 + random.below(4))
                                : seamed(mesh, "st", 1 + random.below(4), seams);
  for (double& value : st.values) value = random.centred();
  mesh.primvars.push_back(std::move(st));
  if (random.one_in(3))
    mesh.primvars.push_back(plain_primvar(mesh, "v", Interpolation::vertex, 1 + random.below(5)));
  if (random.one_in(3))
    mesh.primvars.push_back(plain_primvar(mesh, "w", Interpolation::varying, 1 + random.below(3)));
  if (random.one_in(4)) mesh.primvars.push_back(plain_primvar(mesh, "u", Interpolation::uniform, 1));
}

}  // namespace

ControlMesh random_mesh(std::uint64_t seed) {
  Random random(seed);
  ControlMesh mesh = random_connectivity(random);
  damage(mesh, random);
  for (double& x : mesh.points) x += 0.15 * random.centred();
  const std::vector<Edge> edges = edges_of(mesh);
  add_tags(mesh, edges, random);
  add_primvars(mesh, edges, random);
  mesh.interpolate_boundary = static_cast<BoundaryInterpolation>(random.below(3));
  mesh.face_varying_linear_interpolation = static_cast<FaceVaryingInterpolation>(random.below(6));
  mesh.name = "random_" + std::to_string(seed);
  return mesh;
}

ControlMesh big_torus(Index rows, Index columns, std::uint64_t seed) {
  ControlMesh mesh = torus(rows, columns);
  Random random(seed);
  for (Index quad = 0; quad < rows * columns; ++quad) {
    if (!random.one_in(10)) continue;
    // (a b c) (a c d)  ->  (a b d) (b c d)
    const Index b = at(mesh, 2 * quad, 1), d = at(mesh, 2 * quad + 1, 2);
    at(mesh, 2 * quad, 2) = d;
    at(mesh, 2 * quad + 1, 0) = b;
  }
  for (double& x : mesh.points) x += 0.02 * random.centred();
  return mesh;
}

}  // namespace subdivd::shapes
