// OpenMesh: Subdivider::Uniform::LoopT on a triangle mesh of float points.
#include <cmath>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include "tests/bench/peers.h"
#include "tests/bench/stopwatch.h"

namespace subdivd::bench {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3f;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

bool build(const PeerJob& job, Mesh& mesh) {
  const std::size_t points = job.points.size() / 3, faces = job.corners.size() / 3;
  mesh.reserve(points, faces * 3 / 2, faces);
  for (std::size_t k = 0; k < job.points.size(); k += 3)
    mesh.add_vertex(Mesh::Point(job.points[k], job.points[k + 1], job.points[k + 2]));
  const auto vertex = [&](std::size_t corner) { return Mesh::VertexHandle(job.corners[corner]); };
  for (std::size_t k = 0; k < job.corners.size(); k += 3)
    if (!mesh.add_face(vertex(k), vertex(k + 1), vertex(k + 2)).is_valid()) return false;
  return true;
}

void extract(const Mesh& mesh, float* points, std::uint32_t* triangles) {
  for (const auto vertex : mesh.vertices())
    for (unsigned c = 0; c < 3; ++c) *points++ = mesh.point(vertex)[c];
  for (const auto face : mesh.faces())
    for (const auto vertex : mesh.fv_range(face)) *triangles++ = static_cast<std::uint32_t>(vertex.idx());
}

}  // namespace

PeerTimes run_openmesh(const PeerJob& job) {
  PeerTimes times;
  Stopwatch stopwatch;
  Mesh mesh;
  if (!build(job, mesh)) return times;
  times.build = stopwatch.lap();
  OpenMesh::Subdivider::Uniform::LoopT<Mesh, float> subdivider;
  subdivider.attach(mesh);
  subdivider(static_cast<std::size_t>(job.level));
  subdivider.detach();
  times.refine = stopwatch.lap();
  times.ok = 3 * mesh.n_vertices() == job.out_points.size() && 3 * mesh.n_faces() == job.out_corners.size();
  if (!times.ok) return times;
  stopwatch.lap();
  extract(mesh, job.out_points.data(), job.out_corners.data());
  times.extract = stopwatch.lap();
  return times;
}

}  // namespace subdivd::bench
