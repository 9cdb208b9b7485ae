#include "tests/core/engine/levels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/mesh/topology.h"
#include "tests/shapes/random.h"

namespace subdivd::plain {

Polygons faces_of(const ControlMesh& mesh) {
  std::vector<Index> offsets{0};
  const Count faces = mesh.face_count();
  for (Count f = 0; f < faces; ++f) offsets.push_back(offsets.back() + mesh.face_size(f));
  return Polygons(std::move(offsets), mesh.face_vertex_indices);
}

Level base_level(const ControlMesh& mesh, CreaseMethod method) {
  const auto vertices = static_cast<Index>(mesh.point_count());
  const Topology<Polygons> topology(vertices, faces_of(mesh));
  return first_level(Adjacency(vertices, faces_of(mesh)), control_sharpness(mesh, topology), method);
}

double diagonal(const std::vector<double>& points) {
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = points[axis], most = points[axis];
    for (std::size_t k = axis; k < points.size(); k += 3) {
      least = std::min(least, points[k]);
      most = std::max(most, points[k]);
    }
    square += (most - least) * (most - least);
  }
  return std::sqrt(square);
}

SparseRows written_out(const StepRows& step) {
  SparseRows all;
  for (Count r = 0; r < step.rows.row_count(); ++r) {
    std::map<Index, double> row;
    for (Count k = step.rows.offsets[r]; k < step.rows.offsets[r + 1]; ++k) {
      const Index column = step.rows.columns[k];
      if (column < step.old_count) {
        row[column] += step.rows.weights[k];
        continue;
      }
      const Index sum = column - step.old_count;
      for (Count j = step.sums.offsets[sum]; j < step.sums.offsets[sum + 1]; ++j)
        row[step.sums.columns[j]] += step.rows.weights[k] * step.sums.weights[j];
    }
    for (const auto& [column, weight] : row) all.add(column, weight);
    all.end_row();
  }
  return all;
}

double sum_of_row(const SparseRows& rows, Count row) {
  return std::accumulate(rows.weights.begin() + static_cast<std::ptrdiff_t>(rows.offsets[row]),
                         rows.weights.begin() + static_cast<std::ptrdiff_t>(rows.offsets[row + 1]), 0.0);
}

namespace {

std::vector<Index> permutation(Index size, shapes::Random& random) {
  std::vector<Index> order(size);
  std::iota(order.begin(), order.end(), 0);
  for (Index k = size; k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order;
}

}  // namespace

Renumbered renumbered(const ControlMesh& mesh, std::uint64_t seed) {
  shapes::Random random(seed);
  const Polygons faces = faces_of(mesh);
  Renumbered to{mesh, permutation(static_cast<Index>(mesh.point_count()), random),
                permutation(faces.count(), random), std::vector<Index>(faces.count())};
  for (Index v = 0; v < mesh.point_count(); ++v)
    for (Index axis = 0; axis < 3; ++axis)
      to.mesh.points[3 * to.vertex_at[v] + axis] = mesh.points[3 * v + axis];
  std::vector<Index> face_from(faces.count());
  for (Index f = 0; f < faces.count(); ++f) face_from[to.face_at[f]] = f;
  to.mesh.face_vertex_counts.clear();
  to.mesh.face_vertex_indices.clear();
  for (const Index f : face_from) {
    const Index n = faces.begin(f + 1) - faces.begin(f);
    to.turned[f] = random.below(n);
    to.mesh.face_vertex_counts.push_back(n);
    for (Index k = 0; k < n; ++k)
      to.mesh.face_vertex_indices.push_back(
          to.vertex_at[faces.corners()[faces.begin(f) + (k + to.turned[f]) % n]]);
  }
  for (auto* tags : {&to.mesh.crease_indices, &to.mesh.corner_indices})
    for (Index& v : *tags) v = to.vertex_at[v];
  to.mesh.primvars.clear();
  to.mesh.hole_indices.clear();
  to.mesh.render_meshes.clear();
  return to;
}

bool is_manifold(const Adjacency& faces) {
  for (Index e = 0; e < faces.edge_count(); ++e) {
    const auto along = faces.edge_half_edges(e);
    if (along.size() > 2 || (along.size() == 2 && faces.mate(along[0]) == kNoIndex)) return false;
  }
  return true;
}

}  // namespace subdivd::plain
