#include "core/oracle/far_cost.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/base/pace.h"
#include "core/lattice/quads.h"
#include "core/lattice/split.h"
#include "core/mesh/creases.h"
#include "core/mesh/edges.h"
#include "core/oracle/far_scheme.h"

namespace subdivd::oracle {
namespace {

// See the tables in README.md. Per step of a search, per element of a mesh, per corner.
constexpr Picoseconds kPerSearch = 350, kPerCornerSearch = 450, kPerValueSearch = 100;
constexpr Picoseconds kPerTornSearch = 1'000;
constexpr Picoseconds kPerPoint = 70'000, kPerFace = 300'000, kPerFurtherCorner = 60'000;
constexpr Picoseconds kPerFaceAndChannel = 150'000, kPerFurtherCornerAndChannel = 50'000;
constexpr Picoseconds kPerCrease = 30'000;
constexpr Picoseconds kPerCrowdedCorner = 50'000, kPerDistantCorner = 1'500'000;
constexpr Picoseconds kPerElement = 60'000, kPerElementAndChannel = 16'000;
constexpr Picoseconds kPerQuad = 250'000;

constexpr Index kNear = 64;       // difference of numbers of points that probably share cache lines
constexpr Count kFewMembers = 6;  // what Far has room for at every point

Count channel_count(const ControlMesh& mesh) {
  return static_cast<Count>(std::count_if(
      mesh.primvars.begin(), mesh.primvars.end(),
      [](const Primvar& primvar) { return primvar.interpolation == Interpolation::face_varying; }));
}

// Row v of the corners of the points, in the form that find_edges wants.
std::vector<Index> corner_offsets(const ControlMesh& mesh, const Pace& pace) {
  std::vector<Index> offsets(mesh.point_count() + 1, 0);
  for (const Index v : mesh.face_vertex_indices) {
    pace.spend(1);
    ++offsets[v + 1];
  }
  for (std::size_t v = 1; v < offsets.size(); ++v) {
    pace.spend(1);
    offsets[v] += offsets[v - 1];
  }
  return offsets;
}

bool is_near(Index v, std::span<const Index> others) {
  return std::any_of(others.begin(), others.end(),
                     [v](Index w) { return std::max(v, w) - std::min(v, w) <= kNear; });
}

class LoadFinder {
 public:
  LoadFinder(const ControlMesh& mesh, GridShape shape, const FaceRows& rows,
             const std::vector<Index>& offsets, const Edges& edges, const Pace& pace)
      : mesh_(mesh),
        rows_(rows),
        offsets_(offsets),
        edges_(edges),
        pace_(pace),
        edges_of_(mesh.point_count(), 0) {
    load_.shape = shape;
    load_.points = mesh.point_count();
    load_.corners = mesh.face_vertex_indices.size();
    load_.edges = edges.count();
    load_.faces = mesh.face_count();
    load_.face_varying_channels = channel_count(mesh);
  }

  Result<FarLoad> run() {
    count_edges();
    if (auto done = add_points(); !done) return done.error();
    if (auto done = add_faces(); !done) return done.error();
    add_distant_corners();
    add_creases();
    add_torn_edges();
    return load_;
  }

 private:
  Count faces_of(Index v) const { return Count{offsets_[v + 1]} - offsets_[v]; }

  void count_edges() {
    for (const auto& ends : edges_.vertices) {
      pace_.spend(1);
      for (const Index v : ends) ++edges_of_[v];
    }
  }

  Result<void> add_points() {
    for (Index v = 0; v < load_.points; ++v) {
      pace_.spend(1);
      const Count faces = faces_of(v), edges = edges_of_[v];
      if (std::max(faces, edges) > kMostFacesOfAPoint)
        return Error{ErrorCode::unsupported,
                     "OpenSubdiv takes at most " + std::to_string(kMostFacesOfAPoint) +
                         " faces and edges at a point; this one has " + std::to_string(faces) +
                         " faces and " + std::to_string(edges) + " edges",
                     {"points", v}};
      load_.searches += faces * edges;
      load_.value_searches += faces * faces * load_.face_varying_channels;
      if (faces > kFewMembers || edges > kFewMembers) load_.crowded_corners += faces;
      if (faces * edges > load_.busiest_faces * load_.busiest_edges) {
        load_.busiest_point = v;
        load_.busiest_faces = faces;
        load_.busiest_edges = edges;
      }
    }
    return {};
  }

  Result<void> add_faces() {
    for (Count f = 0; f < rows_.count(); ++f) {
      pace_.spend(1);
      const Count size = rows_.size(f);
      if (size > kMostFacesOfAPoint)
        return Error{ErrorCode::unsupported,
                     "OpenSubdiv takes faces of at most " + std::to_string(kMostFacesOfAPoint) +
                         " corners; this one has " + std::to_string(size),
                     {"faceVertexCounts", static_cast<Index>(f)}};
      if (size > 3) load_.corner_searches += size * size;  // what a triangle takes is its share of kPerFace
      if (size <= load_.most_corners) continue;
      load_.largest_face = static_cast<Index>(f);
      load_.most_corners = size;
    }
    return {};
  }

  // Of a large face the first corners are looked at, and every corner from there on beside the one before it.
  void add_distant_corners() {
    constexpr Count kLookedAt = 4;
    const std::span<const Index> corners = mesh_.face_vertex_indices;
    for (Count f = 1; f < rows_.count(); ++f) {
      const auto last = corners.subspan(rows_.begin(f - 1), std::min(kLookedAt, rows_.size(f - 1)));
      const Count begin = rows_.begin(f);
      for (Count h = begin; h < rows_.end(f); ++h) {
        pace_.spend(1);
        const bool is_distant = h < begin + kLookedAt ? !is_near(corners[h], last)
                                                      : !is_near(corners[h], corners.subspan(h - 1, 1));
        if (is_distant) ++load_.distant_corners;
      }
    }
  }

  void add_creases() {
    for_each_crease_edge(mesh_, [&](Count, Index a, Index b, float) {
      pace_.spend(1);
      ++load_.creases;
      load_.crease_searches += std::min(edges_of_[a], edges_of_[b]);
    });
  }

  void add_torn_edges() {
    std::vector<Index> faces_of_edge(edges_.count(), 0);
    for (const Index e : edges_.of_half_edges) {
      pace_.spend(1);
      ++faces_of_edge[e];
    }
    for (const Index e : edges_.non_manifold) {
      pace_.spend(1);
      const Count faces = faces_of_edge[e];
      load_.most_faces_of_an_edge = std::max(load_.most_faces_of_an_edge, faces);
      if (faces > 2) load_.torn_searches += 3 * faces * faces * load_.face_varying_channels;
    }
  }

  const ControlMesh& mesh_;
  const FaceRows& rows_;
  const std::vector<Index>& offsets_;
  const Edges& edges_;
  const Pace& pace_;
  std::vector<Index> edges_of_;
  FarLoad load_;
};

Edges edges_of(const ControlMesh& mesh, const std::vector<Index>& offsets, const Pace& pace) {
  const auto points = static_cast<Index>(mesh.point_count());
  std::vector<Index> corners;
  pace.copy(mesh.face_vertex_indices, corners);
  if (mesh.face_vertex_counts.empty())
    return find_edges(points, Triangles(std::move(corners)), offsets, pace);
  std::vector<Index> begins{0};
  begins.reserve(mesh.face_vertex_counts.size() + 1);
  pace.for_each(mesh.face_vertex_counts.size(),
                [&](std::size_t f) { begins.push_back(begins.back() + mesh.face_vertex_counts[f]); });
  return find_edges(points, Polygons(std::move(begins), std::move(corners), pace), offsets, pace);
}

// Of one level.
LevelCounts counts_of(const FarLoad& load, Index level) {
  if (level == 0) return {load.points, load.edges, load.faces, 0};
  if (load.shape == GridShape::triangles) return refined_counts(load.points, load.edges, load.faces, level);
  return refined_quad_counts(load.points + load.edges + load.faces, 2 * load.edges + load.corners,
                             load.corners, level - 1);
}

std::string milliseconds(Picoseconds time) {
  return std::to_string(time / 1'000'000'000) + " milliseconds, in which it cannot be stopped; " +
         std::to_string(kLongestFarCall / 1'000'000'000) + " are allowed";
}

Error too_long(std::string message, Path where, Picoseconds time) {
  return Error{.code = ErrorCode::too_large,
               .message = std::move(message),
               .where = std::move(where),
               .predicted = time / 1'000'000'000,
               .allowed = kLongestFarCall / 1'000'000'000};
}

}  // namespace

Result<FarLoad> far_load(const ControlMesh& mesh, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<FarLoad> {
    const auto scheme = far_scheme_of(mesh, pace);
    if (!scheme) return scheme.error();
    const std::vector<Index> offsets = corner_offsets(mesh, pace);
    const Edges edges = edges_of(mesh, offsets, pace);
    const FaceRows rows = base_rows_of(mesh, pace);
    return LoadFinder(mesh, grid_shape_of(mesh, *scheme, pace), rows, offsets, edges, pace).run();
  });
}

Picoseconds far_build_time(const FarLoad& load) {
  const Count further = load.corners - 3 * load.faces;  // than a triangle's
  return load.points * kPerPoint + load.faces * kPerFace + further * kPerFurtherCorner +
         load.face_varying_channels *
             (load.faces * kPerFaceAndChannel + further * kPerFurtherCornerAndChannel) +
         load.searches * kPerSearch + load.corner_searches * kPerCornerSearch +
         load.value_searches * kPerValueSearch + load.creases * kPerCrease +
         load.crease_searches * kPerSearch + load.crowded_corners * kPerCrowdedCorner +
         load.distant_corners * kPerDistantCorner;
}

Picoseconds far_refine_time(const FarLoad& load, Index level) {
  Count elements = 0;
  for (Index l = 1; l <= level; ++l) {
    const LevelCounts counts = counts_of(load, l);
    elements += counts.vertices + counts.edges + counts.faces;
  }
  // An edge becomes two of as many faces at every level.
  return elements * (kPerElement + kPerElementAndChannel * load.face_varying_channels) +
         load.torn_searches * (segments(level) - 1) * kPerTornSearch;
}

Result<void> check_far_time(const FarLoad& load, Index level) {
  if (const Picoseconds time = far_build_time(load); time > kLongestFarCall) {
    const bool one_point = load.busiest_faces * load.busiest_edges >= load.searches / 2 &&
                           load.searches * kPerSearch >= time / 2;
    if (one_point)
      return too_long("OpenSubdiv looks for every face of a point among all edges there: this one has " +
                          std::to_string(load.busiest_faces) + " faces and " +
                          std::to_string(load.busiest_edges) + " edges, which would take it about " +
                          milliseconds(time),
                      {"points", load.busiest_point}, time);
    if (load.most_corners * load.most_corners >= load.corner_searches / 2 &&
        load.corner_searches * kPerCornerSearch >= time / 2)
      return too_long("OpenSubdiv looks for every point of a face among all its corners: this one has " +
                          std::to_string(load.most_corners) + ", which would take it about " +
                          milliseconds(time),
                      {"faceVertexCounts", load.largest_face}, time);
    return too_long("OpenSubdiv would look for the neighbours of " + std::to_string(load.faces) +
                        " faces for about " + milliseconds(time) + ": verify a smaller mesh",
                    {}, time);
  }
  if (const Picoseconds time = far_refine_time(load, level); time > kLongestFarCall) {
    const bool torn = load.torn_searches * (segments(level) - 1) * kPerTornSearch >= time / 2;
    const std::string found =
        torn ? "face-varying values along an edge of " + std::to_string(load.most_faces_of_an_edge) + " faces"
             : std::to_string(load.faces) + " faces";
    return too_long("OpenSubdiv would refine " + found + " to level " + std::to_string(level) +
                        " in one go of about " + milliseconds(time) + ": choose a lower level",
                    {}, time);
  }
  return {};
}

Result<void> check_far_grid_time(Count quads) {
  const Picoseconds time = quads * kPerQuad;
  if (time <= kLongestFarCall) return {};
  return too_long("OpenSubdiv would refine a grid to " + std::to_string(quads) +
                      " quads in one go of about " + milliseconds(time) + ": choose a lower level",
                  {}, time);
}

}  // namespace subdivd::oracle
