#include "core/lattice/lattice.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/lattice/numbering.h"
#include "core/lattice/quad_faces.h"
#include "core/lattice/quads.h"
#include "core/lattice/triangles.h"

namespace subdivd {
namespace {

constexpr Count kWorthSharing = 1 << 16;  // indices: starting a thread takes as long

Result<void> write_quads(const Connectivity<Quads>& connectivity, Index level,
                         std::span<const unsigned char> holes, Index* out, Index threads,
                         const Budget& budget) {
  const Count per_face = 4 * segments(level) * segments(level);
  if (per_face * connectivity.face_count() < kWorthSharing) threads = 1;
  return Team::run(threads, budget, [&](Worker& worker) {
    const Pace pace(worker);
    const QuadWriter<QuadForm::quads> writer(connectivity, level, pace);
    const Range share = worker.share(connectivity.face_count());
    Index* at =
        out + per_face * static_cast<Count>(std::count(
                             holes.begin(), holes.begin() + static_cast<std::ptrdiff_t>(share.begin), 0));
    for (Count face = share.begin; face < share.end; ++face)
      if (holes[face] == 0) at = writer.write(static_cast<Index>(face), at);
  });
}

void place_triangles(const Connectivity<Triangles>& connectivity, Index level, std::span<Provenance> out,
                     const Pace& pace) {
  const Numbering numbering(connectivity, level);
  const Count n = numbering.segment_count();
  for (Index f = connectivity.face_count(); f-- > 0;)  // backwards: the lowest-numbered face wins
    for (Count j = 0; j <= n; ++j) {
      pace.spend(n + 1 - j);
      for (Count i = 0; i + j <= n; ++i)
        out[numbering.vertex(f, i, j)] = {f, static_cast<Index>(i), static_cast<Index>(j)};
    }
}

void place_quads(const Connectivity<Quads>& connectivity, Index level, std::span<Provenance> out,
                 const Pace& pace) {
  const Numbering numbering(connectivity, level);
  const Count n = numbering.segment_count();
  for (Index f = connectivity.face_count(); f-- > 0;)
    for (Count j = 0; j <= n; ++j) {
      pace.spend(n + 1);
      for (Count i = 0; i <= n; ++i)
        out[numbering.vertex(f, i, j)] = {f, static_cast<Index>(i), static_cast<Index>(j)};
    }
}

// The place on a quad, whose corners follow one another counter-clockwise, of point (i, j) on the grid of its
// k-th quarter: n segments an edge of the whole.
GridPoint on_whole_quad(Index k, Index i, Index j, Index n) {
  switch (k) {
    case 0:
      return {i, j};
    case 1:
      return {n - j, i};
    case 2:
      return {n - i, n - j};
    default:
      return {j, n - i};
  }
}

// Of polygons at levels from 1 on.
void place_polygons(const Connectivity<Polygons>& polygons, const Connectivity<Quads>& quads, Index level,
                    std::span<Provenance> out, const Pace& pace) {
  const Numbering numbering(quads, level - 1);
  const auto n = static_cast<Index>(numbering.segment_count());
  for (Index f = polygons.face_count(); f-- > 0;) {
    const Index begin = polygons.faces().begin(f), size = polygons.faces().begin(f + 1) - begin;
    for (Index k = size; k-- > 0;)
      for (Index j = 0; j <= n; ++j) {
        pace.spend(n + 1);
        for (Index i = 0; i <= n; ++i) {
          Provenance& place = out[numbering.vertex(begin + k, i, j)];
          if (size == 4) {
            const GridPoint whole = on_whole_quad(k, i, j, 2 * n);
            place = {f, whole.i, whole.j};
          } else {
            place = {f, 2 * i, 2 * j, k};
          }
        }
      }
  }
}

// Of polygons themselves.
void place_corners(const Connectivity<Polygons>& polygons, std::span<Provenance> out, const Pace& pace) {
  for (Index f = polygons.face_count(); f-- > 0;) {
    const Index begin = polygons.faces().begin(f), size = polygons.faces().begin(f + 1) - begin;
    for (Index k = size; k-- > 0;) {
      pace.spend(1);
      Provenance& place = out[polygons.corner_vertex(begin + k)];
      if (size == 4) {
        const GridPoint whole = on_whole_quad(k, 0, 0, 1);
        place = {f, whole.i, whole.j};
      } else {
        place = {f, 0, 0, k};
      }
    }
  }
}

}  // namespace

Index Lattice::base_face_count() const {
  if (polygons_) return polygons_->face_count();
  return std::visit([](const auto& grids) { return grids->face_count(); }, grids_);
}

Index Lattice::base_vertex_count() const {
  if (polygons_) return polygons_->vertex_count();
  return std::visit([](const auto& grids) { return grids->vertex_count(); }, grids_);
}

std::span<const Index> Lattice::base_corners() const {
  if (polygons_) return polygons_->corner_vertices();
  return std::visit([](const auto& grids) { return grids->corner_vertices(); }, grids_);
}

Index Lattice::base_face_size(Index f) const {
  if (polygons_) return polygons_->faces().begin(f + 1) - polygons_->faces().begin(f);
  return has_triangles() ? 3 : 4;
}

Count Lattice::vertex_count(Index level) const {
  if (polygons_ && level == 0) return polygons_->vertex_count();
  return std::visit([&](const auto& grids) { return refined_vertex_count(*grids, level - first_level()); },
                    grids_);
}

Count Lattice::edge_count(Index level) const {
  if (polygons_ && level == 0) return polygons_->edge_count();
  const Index depth = level - first_level();
  if (has_triangles())
    return refined_counts(triangles().vertex_count(), triangles().edge_count(), triangles().face_count(),
                          depth)
        .edges;
  return refined_quad_counts(quads().vertex_count(), quads().edge_count(), quads().face_count(), depth).edges;
}

Count Lattice::faces_of(Index face, Index level) const {
  if (!polygons_) return Count{1} << (2 * level);
  return level == 0 ? 1 : Count{base_face_size(face)} << (2 * (level - 1));
}

Count Lattice::face_count(Index level) const {
  if (polygons_ && level == 0) return polygons_->face_count();
  return std::visit(
      [&](const auto& grids) { return Count{grids->face_count()} << (2 * (level - first_level())); }, grids_);
}

Count Lattice::face_count(Index level, std::span<const unsigned char> holes, const Pace& pace) const {
  Count faces = 0;
  pace.for_each(holes.size(), [&](std::size_t f) {
    if (holes[f] == 0) faces += faces_of(static_cast<Index>(f), level);
  });
  return faces;
}

Count Lattice::triangle_count(Index level, std::span<const unsigned char> holes, const Pace& pace) const {
  const Index size = face_size(level);
  if (size != 0) return (size - 2) * face_count(level, holes, pace);
  return corner_count(level, holes, pace) - 2 * face_count(level, holes, pace);
}

Index Lattice::face_size(Index level) const {
  if (has_triangles()) return 3;
  return polygons_ && level == 0 ? 0 : 4;
}

Count Lattice::corner_count(Index level) const {
  const Index size = face_size(level);
  return size == 0 ? polygons_->corner_vertices().size() : face_count(level) * size;
}

LevelCounts Lattice::counts(Index level) const {
  return {vertex_count(level), edge_count(level), face_count(level), face_size(level)};
}

Count Lattice::corner_count(Index level, std::span<const unsigned char> holes, const Pace& pace) const {
  const Index size = face_size(level);
  if (size != 0) return size * face_count(level, holes, pace);
  Count corners = 0;
  pace.for_each(holes.size(), [&](std::size_t f) {
    if (holes[f] == 0) corners += base_face_size(static_cast<Index>(f));
  });
  return corners;
}

Result<void> Lattice::write_faces(Index level, std::span<const unsigned char> holes, Index* out,
                                  Index threads, const Budget& budget) const {
  if (has_triangles()) return write_triangles(triangles(), level, holes, out, threads, budget);
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    if (!polygons_) return write_quads(quads(), level, holes, out, threads, budget);
    if (level > 0)
      return write_quads(quads(), level - 1, holes_of_grids(*this, holes, pace), out, threads, budget);
    pace.for_each(holes.size(), [&](std::size_t f) {
      if (holes[f] != 0) return;
      const auto face = static_cast<Index>(f);
      const auto corners =
          polygons_->corner_vertices().subspan(polygons_->faces().begin(face), base_face_size(face));
      pace.spend(corners.size());
      out = std::copy(corners.begin(), corners.end(), out);
    });
    return {};
  });
}

void Lattice::write_face_sizes(std::span<const unsigned char> holes, Index* out, const Pace& pace) const {
  pace.for_each(holes.size(), [&](std::size_t f) {
    if (holes[f] == 0) *out++ = base_face_size(static_cast<Index>(f));
  });
}

void Lattice::write_base_faces(Index level, std::span<const unsigned char> holes, Index* out,
                               const Pace& pace) const {
  for (Index f = 0; f < holes.size(); ++f) {
    pace.spend(1);
    if (holes[f] != 0) continue;
    pace.in_blocks(faces_of(f, level),
                   [&](Count begin, Count end) { out = std::fill_n(out, end - begin, f); });
  }
}

void Lattice::write_provenance(Index level, std::span<Provenance> out, const Pace& pace) const {
  pace.for_each(base_vertex_count(), [&](Index v) { out[v] = Provenance{}; });
  if (has_triangles())
    place_triangles(triangles(), level, out, pace);
  else if (!polygons_)
    place_quads(quads(), level, out, pace);
  else if (level == 0)
    place_corners(*polygons_, out, pace);
  else
    place_polygons(*polygons_, quads(), level, out, pace);
}

std::vector<unsigned char> holes_of_grids(const Lattice& lattice, std::span<const unsigned char> holes,
                                          const Pace& pace) {
  std::vector<unsigned char> flags;
  if (!lattice.shared_polygons()) {
    pace.copy(holes, flags);
    return flags;
  }
  flags.reserve(lattice.quads().face_count());
  pace.for_each(holes.size(), [&](std::size_t f) {
    const Index size = lattice.base_face_size(static_cast<Index>(f));
    pace.spend(size);
    flags.insert(flags.end(), size, holes[f]);
  });
  return flags;
}

}  // namespace subdivd
