// CGAL's Subdivision_method_3 on a Surface_mesh of double points.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include "tests/core/engine/peers.h"

namespace subdivd::peers {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool build(const ControlMesh& from, Mesh& mesh) {
  for (std::size_t k = 0; k < from.points.size(); k += 3)
    mesh.add_vertex(Kernel::Point_3(from.points[k], from.points[k + 1], from.points[k + 2]));
  std::size_t corner = 0;
  for (std::size_t f = 0; f < from.face_count(); ++f) {
    std::vector<Mesh::Vertex_index> face;
    const std::size_t n = from.face_size(f);
    for (std::size_t k = 0; k < n; ++k) face.emplace_back(from.face_vertex_indices[corner++]);
    if (mesh.add_face(face) == Mesh::null_face()) return false;
  }
  return true;
}

std::vector<double> points_of(const Mesh& mesh) {
  std::vector<double> points;
  for (const auto vertex : mesh.vertices())
    for (int axis = 0; axis < 3; ++axis) points.push_back(mesh.point(vertex)[axis]);
  return points;
}

}  // namespace

std::vector<double> cgal_doo_sabin(const ControlMesh& from, int steps) {
  Mesh mesh;
  if (!build(from, mesh)) return {};
  CGAL::Subdivision_method_3::DooSabin_subdivision(
      mesh, CGAL::parameters::number_of_iterations(static_cast<unsigned>(steps)));
  return points_of(mesh);
}

std::vector<double> cgal_sqrt3(const ControlMesh& from, int steps) {
  Mesh mesh;
  if (!build(from, mesh)) return {};
  CGAL::Subdivision_method_3::Sqrt3_subdivision(
      mesh, CGAL::parameters::number_of_iterations(static_cast<unsigned>(steps)));
  return points_of(mesh);
}

}  // namespace subdivd::peers
