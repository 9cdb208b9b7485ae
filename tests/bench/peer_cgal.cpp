// CGAL: Subdivision_method_3::Loop_subdivision on a Surface_mesh of float points.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include "tests/bench/peers.h"
#include "tests/bench/stopwatch.h"

namespace subdivd::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<float>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool build(const PeerJob& job, Mesh& mesh) {
  const std::size_t points = job.points.size() / 3, faces = job.corners.size() / 3;
  mesh.reserve(static_cast<Mesh::size_type>(points), static_cast<Mesh::size_type>(faces * 3 / 2),
               static_cast<Mesh::size_type>(faces));
  for (std::size_t k = 0; k < job.points.size(); k += 3)
    mesh.add_vertex(Kernel::Point_3(job.points[k], job.points[k + 1], job.points[k + 2]));
  const auto vertex = [&](std::size_t corner) {
    return Mesh::Vertex_index(static_cast<Mesh::size_type>(job.corners[corner]));
  };
  for (std::size_t k = 0; k < job.corners.size(); k += 3)
    if (mesh.add_face(vertex(k), vertex(k + 1), vertex(k + 2)) == Mesh::null_face()) return false;
  return true;
}

void extract(const Mesh& mesh, float* points, std::uint32_t* triangles) {
  for (const auto vertex : mesh.vertices())
    for (int c = 0; c < 3; ++c) *points++ = mesh.point(vertex)[c];
  for (const auto face : mesh.faces()) {
    auto half_edge = mesh.halfedge(face);
    for (int k = 0; k < 3; ++k, half_edge = mesh.next(half_edge)) *triangles++ = mesh.target(half_edge);
  }
}

}  // namespace

PeerTimes run_cgal(const PeerJob& job) {
  PeerTimes times;
  Stopwatch stopwatch;
  Mesh mesh;
  if (!build(job, mesh)) return times;
  times.build = stopwatch.lap();
  CGAL::Subdivision_method_3::Loop_subdivision(
      mesh, CGAL::parameters::number_of_iterations(static_cast<unsigned>(job.level)));
  times.refine = stopwatch.lap();
  times.ok = 3 * mesh.number_of_vertices() == job.out_points.size() &&
             3 * mesh.number_of_faces() == job.out_corners.size();
  if (!times.ok) return times;
  stopwatch.lap();
  extract(mesh, job.out_points.data(), job.out_corners.data());
  times.extract = stopwatch.lap();
  return times;
}

}  // namespace subdivd::bench
