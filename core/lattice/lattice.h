#pragma once
// What a refined mesh has and how it is numbered, known from its control mesh's adjacency alone: the one view of a
// refined mesh that callers have, whatever its faces are. A control mesh has a lattice, so has every face-varying
// channel and every render mesh of it, all over the same faces.

#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/lattice/provenance.h"
#include "core/lattice/split.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// Triangles are grids of triangles from level 0 on (split.h), quads grids of quads (quads.h). Where a face has another
// number of corners all faces are cut into quads by the first step, one for each corner in turn, and those are grids
// from level 1 on.
class Lattice {
 public:
  explicit Lattice(std::shared_ptr<const Connectivity<Triangles>> triangles) : grids_(std::move(triangles)) {}
  explicit Lattice(std::shared_ptr<const Connectivity<Quads>> quads) : grids_(std::move(quads)) {}
  // `quads`: those of level 1; vertices numbered as vertices, points of edges, points of faces.
  Lattice(std::shared_ptr<const Connectivity<Polygons>> polygons,
          std::shared_ptr<const Connectivity<Quads>> quads)
      : grids_(std::move(quads)), polygons_(std::move(polygons)) {}

  // The grids, and the level that they start at.
  bool has_triangles() const { return grids_.index() == 0; }
  const Connectivity<Triangles>& triangles() const { return *std::get<0>(grids_); }
  const Connectivity<Quads>& quads() const { return *std::get<1>(grids_); }
  Index first_level() const { return polygons_ ? 1 : 0; }
  const std::shared_ptr<const Connectivity<Triangles>>& shared_triangles() const {
    return std::get<0>(grids_);
  }
  const std::shared_ptr<const Connectivity<Quads>>& shared_quads() const { return std::get<1>(grids_); }
  // Null: there are only grids.
  const std::shared_ptr<const Connectivity<Polygons>>& shared_polygons() const { return polygons_; }

  Index base_face_count() const;
  Index base_vertex_count() const;
  std::span<const Index> base_corners() const;
  Index base_face_size(Index f) const;

  Count vertex_count(Index level) const;
  Count edge_count(Index level) const;
  // Refined faces of a base face; all of them together, and those of faces whose `holes` flag is 0.
  Count faces_of(Index face, Index level) const;
  Count face_count(Index level) const;
  Count face_count(Index level, std::span<const unsigned char> holes, const Pace& pace) const;
  // Triangles that the faces are cut into for renderers: see triangle_stream.h.
  Count triangle_count(Index level, std::span<const unsigned char> holes, const Pace& pace) const;
  // Corners of every refined face: 3 or 4; 0: they are polygons of the control mesh, at level 0.
  Index face_size(Index level) const;
  Count corner_count(Index level) const;  // of all refined faces
  LevelCounts counts(Index level) const;
  Count corner_count(Index level, std::span<const unsigned char> holes, const Pace& pace) const;

  // The refined faces of the base faces whose `holes` flag is 0, corner by corner: corner_count() indices into `out`.
  // Independent of the number of threads.
  Result<void> write_faces(Index level, std::span<const unsigned char> holes, Index* out, Index threads,
                           const Budget& budget) const;
  // How many corners each of them has, where face_size() is 0.
  void write_face_sizes(std::span<const unsigned char> holes, Index* out, const Pace& pace) const;
  // The base face of each.
  void write_base_faces(Index level, std::span<const unsigned char> holes, Index* out,
                        const Pace& pace) const;
  // Of every refined vertex in turn.
  void write_provenance(Index level, std::span<Provenance> out, const Pace& pace) const;

 private:
  std::variant<std::shared_ptr<const Connectivity<Triangles>>, std::shared_ptr<const Connectivity<Quads>>>
      grids_;
  std::shared_ptr<const Connectivity<Polygons>> polygons_;
};

// The flags of base faces as flags of the faces that the grids start from.
std::vector<unsigned char> holes_of_grids(const Lattice& lattice, std::span<const unsigned char> holes,
                                          const Pace& pace);

}  // namespace subdivd
