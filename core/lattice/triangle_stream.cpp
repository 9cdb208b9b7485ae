#include "core/lattice/triangle_stream.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel.h"
#include "core/lattice/quad_faces.h"
#include "core/lattice/triangles.h"

namespace subdivd {
namespace {

const Pace kUnlimited;

using QuadsAsTriangles = QuadWriter<QuadForm::triangles>;

// What a face of any writer needs in one piece, in indices.
Count room_of(const TriangleWriter& writer) {
  return writer.has_rows() ? writer.indices_of_row(0) + TriangleWriter::kRoomBehindRow
                           : writer.indices_of_face();
}
Count room_of(const QuadsAsTriangles& writer) { return writer.indices_of_row(0); }

Count room_behind(const TriangleWriter& writer) {
  return writer.has_rows() ? TriangleWriter::kRoomBehindRow : 0;
}
Count room_behind(const QuadsAsTriangles&) { return 0; }

Count triangles_of(Index corners) { return corners - 2; }

}  // namespace

TriangleStream::TriangleStream(std::shared_ptr<const Lattice> lattice, Index level,
                               std::span<const unsigned char> holes, const Pace& pace)
    : lattice_(std::move(lattice)), level_(level) {
  if (lattice_->face_size(level) == 0) {
    pace.copy(holes, holes_);
    pace.for_each(static_cast<Index>(holes_.size()), [&](Index f) {
      if (holes_[f] == 0) index_count_ += 3 * triangles_of(lattice_->base_face_size(f));
    });
    least_room_ = 3;
    return;
  }
  holes_ = holes_of_grids(*lattice_, holes, pace);
  Count faces = 0;
  pace.for_each(holes_.size(), [&](Count f) { faces += holes_[f] == 0; });
  const Index depth = level - lattice_->first_level();
  if (lattice_->has_triangles()) {
    const TriangleWriter writer(lattice_->triangles(), depth, kUnlimited);
    index_count_ = faces * writer.indices_of_face();
    least_room_ = room_of(writer);
  } else {
    const QuadsAsTriangles writer(lattice_->quads(), depth, kUnlimited);
    index_count_ = faces * writer.indices_of_face();
    least_room_ = room_of(writer);
  }
}

Count TriangleStream::least_room() const { return least_room_; }

// A topology, if that is what the connectivity belongs to: corners, their edges and their places around
// vertices; ends, sides, kind and two places of every edge, with room for half as many more; two offsets of
// every vertex.
Count TriangleStream::held_bytes() const {
  if (!lattice_) return 0;
  constexpr Count kOfCorner = 12, kOfEdge = 34, kOfVertex = 16;
  const auto bytes_of = [](const auto& connectivity) {
    return kOfCorner * connectivity.corner_vertices().size() + kOfEdge * connectivity.edge_count() +
           kOfVertex * connectivity.vertex_count();
  };
  Count bytes = holes_.size();
  bytes += lattice_->has_triangles() ? bytes_of(lattice_->triangles()) : bytes_of(lattice_->quads());
  if (lattice_->shared_polygons()) bytes += bytes_of(*lattice_->shared_polygons());
  return bytes;
}

template <class Writer>
Count TriangleStream::next_of_grids(const Writer& writer, std::span<Index> out) {
  const Count n = segments(level_ - lattice_->first_level()), behind = room_behind(writer);
  Count written = 0;
  const auto room = [&] { return out.size() - written; };
  for (; face_ < holes_.size(); ++face_) {
    if (holes_[face_] != 0) continue;
    if (row_ == 0 && room() >= writer.indices_of_face() + behind) {
      writer.write(face_, &out[written]);
      written += writer.indices_of_face();
      continue;
    }
    if (!writer.has_rows()) break;
    Count end = row_, size = 0;
    while (end < n && room() >= size + writer.indices_of_row(end) + behind)
      size += writer.indices_of_row(end++);
    if (end > row_) writer.write_rows(face_, row_, end, &out[written]);
    written += size;
    row_ = end % n;
    if (end < n) break;
  }
  return written;
}

// Faces that are no grids, from the corner on that tells them apart.
template <class Faces>
Count TriangleStream::next_of_faces(const Connectivity<Faces>& faces, std::span<Index> out) {
  const auto corners = faces.corner_vertices();
  Count written = 0;
  for (; face_ < holes_.size(); ++face_, row_ = 0) {
    if (holes_[face_] != 0) continue;
    const Index begin = faces.faces().begin(face_), size = faces.faces().begin(face_ + 1) - begin;
    if (row_ == 0) start_ = told_apart_ && corners[begin] == last_start_ ? 1 : 0;
    const auto vertex = [&](Count k) { return corners[begin + (start_ + k) % size]; };
    for (; row_ < triangles_of(size); ++row_) {
      if (out.size() - written < 3) return written;
      for (const Count corner : {Count{0}, row_ + 1, row_ + 2}) out[written++] = vertex(corner);
    }
    last_start_ = vertex(0);
  }
  return written;
}

// A grid of more than one quad ends with one that begins inside it, and the next begins at a corner; the quads of a
// row, and those that begin rows, begin at different points. So only grids of one quad can have neighbours that begin
// at one vertex, and polygons.
bool TriangleStream::cuts_whole_faces() const {
  return lattice_->face_size(level_) == 0 || (told_apart_ && level_ == lattice_->first_level());
}

bool TriangleStream::tell_faces_apart() {
  told_apart_ = index_count_ > 0 && !lattice_->has_triangles();
  return told_apart_;
}

Count TriangleStream::next(std::span<Index> out) {
  if (holes_.empty()) return 0;
  if (cuts_whole_faces())
    return lattice_->face_size(level_) == 0 ? next_of_faces(*lattice_->shared_polygons(), out)
                                            : next_of_faces(lattice_->quads(), out);
  const Index depth = level_ - lattice_->first_level();
  if (lattice_->has_triangles())
    return next_of_grids(TriangleWriter(lattice_->triangles(), depth, kUnlimited), out);
  return next_of_grids(QuadsAsTriangles(lattice_->quads(), depth, kUnlimited), out);
}

Result<Buffer<Index>> TriangleStream::all(Index threads, const Budget& budget) const {
  Buffer<Index> indices(index_count_);
  if (holes_.empty()) return indices;
  if (lattice_->has_triangles()) {
    if (auto done = write_triangles(lattice_->triangles(), level_, holes_, indices.data(), threads, budget);
        !done)
      return std::move(done).error();
    return indices;
  }
  if (cuts_whole_faces()) {
    constexpr Count kPiece = 3 * 4096;
    return stoppable(budget, [&](const Pace& pace) -> Result<Buffer<Index>> {
      TriangleStream whole;
      whole.lattice_ = lattice_;
      whole.level_ = level_;
      whole.told_apart_ = told_apart_;
      pace.copy(holes_, whole.holes_);
      for (Count written = 0; written < indices.size();) {
        pace.spend(kPiece / 4);
        written +=
            whole.next(std::span(indices).subspan(written, std::min(kPiece, indices.size() - written)));
      }
      return std::move(indices);
    });
  }
  const auto written = Team::run(1, budget, [&](Worker& worker) {
    const Pace pace(worker);
    const QuadsAsTriangles writer(lattice_->quads(), level_ - lattice_->first_level(), pace);
    Index* at = indices.data();
    for (Index face = 0; face < holes_.size(); ++face)
      if (holes_[face] == 0) at = writer.write(face, at);
  });
  if (!written) return written.error();
  return indices;
}

}  // namespace subdivd
