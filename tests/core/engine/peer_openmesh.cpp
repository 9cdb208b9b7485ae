// OpenMesh's uniform subdividers on a triangle mesh of double points.
#include <cmath>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>

#include "tests/core/engine/peers.h"

namespace subdivd::peers {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

template <class Subdivider>
std::vector<double> refine(const ControlMesh& from, int steps) {
  Mesh mesh;
  for (std::size_t k = 0; k < from.points.size(); k += 3)
    mesh.add_vertex(Mesh::Point(from.points[k], from.points[k + 1], from.points[k + 2]));
  const auto vertex = [&](std::size_t corner) {
    return Mesh::VertexHandle(static_cast<int>(from.face_vertex_indices[corner]));
  };
  for (std::size_t k = 0; k < from.face_vertex_indices.size(); k += 3)
    if (!mesh.add_face(vertex(k), vertex(k + 1), vertex(k + 2)).is_valid()) return {};
  Subdivider subdivider;
  subdivider.attach(mesh);
  subdivider(static_cast<std::size_t>(steps));
  subdivider.detach();
  std::vector<double> points;
  for (const auto handle : mesh.vertices())
    for (unsigned axis = 0; axis < 3; ++axis) points.push_back(mesh.point(handle)[axis]);
  return points;
}

}  // namespace

std::vector<double> openmesh_sqrt3(const ControlMesh& mesh, int steps) {
  return refine<OpenMesh::Subdivider::Uniform::Sqrt3T<Mesh, double>>(mesh, steps);
}

std::vector<double> openmesh_butterfly(const ControlMesh& mesh, int steps) {
  return refine<OpenMesh::Subdivider::Uniform::ModifiedButterflyT<Mesh, double>>(mesh, steps);
}

}  // namespace subdivd::peers
