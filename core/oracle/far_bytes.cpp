#include <algorithm>

#include "core/lattice/quads.h"
#include "core/lattice/split.h"
#include "core/oracle/far.h"
#include "core/oracle/far_scheme.h"
#include "core/oracle/verify.h"

// In double: sums of products of what a caller may ask for leave 64 bits, and a bound needs no last digit.

namespace subdivd::oracle {
namespace {

// How many values there are at a level, with as many edges as faces can have.
struct Counts {
  double points, vertices, edges, faces;
  double further_corners;  // than faces of three have
  double face_varying;     // values of a channel in which every corner has its own
};

// Of `points` points, as many edges as corners.
LevelCounts most_of(const ControlMesh& mesh, Count points, bool triangles, Index level) {
  const Count faces = mesh.face_count(), corners = mesh.face_vertex_indices.size();
  if (level == 0) return {points, corners, faces, 0};
  if (triangles) return refined_counts(points, corners, faces, level);
  return refined_quad_counts(points + corners + faces, 3 * corners, corners, level - 1);
}

Counts counts_at(const ControlMesh& mesh, Index level) {
  const bool triangles = makes_triangles(mesh);
  const Count corners = mesh.face_vertex_indices.size();
  const LevelCounts all = most_of(mesh, mesh.point_count(), triangles, level);
  const LevelCounts torn = most_of(mesh, corners, triangles, level);
  const auto size = [](Count count) { return static_cast<double>(count); };
  return {size(mesh.point_count()),
          size(all.vertices),
          size(all.edges),
          size(all.faces),
          size(corners * triangles_per_face(level)) - 3 * size(all.faces),
          size(torn.vertices)};
}

double channels(const ControlMesh& mesh) {
  return static_cast<double>(std::count_if(
      mesh.primvars.begin(), mesh.primvars.end(),
      [](const Primvar& primvar) { return primvar.interpolation == Interpolation::face_varying; }));
}

// Far's own tables. Measured with every vector's spare capacity: README.md.
double control_tables(const Counts& base, double channels) {
  return 130 * base.points + (300 + 70 * channels) * base.faces + (45 + 15 * channels) * base.further_corners;
}
double level_tables(const Counts& level, double channels) {
  return (45 + 20 * channels) * level.vertices + 33 * level.edges + (105 + 30 * channels) * level.faces +
         (8 + 4 * channels) * level.further_corners;
}

// FarLevel<double> without primvars: place, rule, point, limit and two tangents of every vertex; corners,
// their places, base face and hole of every face. And the level below of what is carried from level to level.
double level_arrays(const Counts& level) {
  return 130 * level.vertices + 55 * level.faces + 16 * level.further_corners;
}

// Values and limits of the last level, values of the one before, and control values in double.
double primvar_arrays(const Primvar& primvar, const Counts& level) {
  const double row = 8.0 * primvar.element_size, control = 8.0 * static_cast<double>(primvar.values.size());
  switch (primvar.interpolation) {
    case Interpolation::constant:
      return 2 * row;
    case Interpolation::uniform:
      return row * level.faces + 2 * control;
    case Interpolation::vertex:
    case Interpolation::varying:
      return 2.5 * row * level.vertices + control;
    case Interpolation::face_varying:
      break;
  }
  return 2.5 * row * level.face_varying + 12 * level.faces + 4 * level.further_corners + control;
}

Count as_count(double bytes) {
  constexpr double kMost = 9.2e18;
  return static_cast<Count>(std::min(bytes, kMost));
}

}  // namespace

Count far_mesh_bytes(const ControlMesh& mesh, Index level) {
  level = std::min(level, kMaxFarLevel);
  const double channel_count = channels(mesh);
  const Counts last = counts_at(mesh, level);
  double bytes = control_tables(counts_at(mesh, 0), channel_count) + level_arrays(last);
  for (Index l = 1; l <= level; ++l) bytes += level_tables(counts_at(mesh, l), channel_count);
  for (const Primvar& primvar : mesh.primvars) bytes += primvar_arrays(primvar, last);
  return as_count(bytes);
}

Count report_bytes(const ControlMesh& mesh, Index level) {
  // A deviation as it is kept, as a tree of JSON members and as text; its name stands in all three.
  constexpr double kPerDeviation = 4096, kPerLetter = 4;
  double per_level = 3 * kPerDeviation;
  for (const Primvar& primvar : mesh.primvars)
    per_level += 2 * (kPerDeviation + kPerLetter * static_cast<double>(primvar.name.size()));
  return as_count(per_level * std::max<Index>(1, level));
}

}  // namespace subdivd::oracle
