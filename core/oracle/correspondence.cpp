#include "core/oracle/correspondence.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace subdivd::oracle {
namespace {

// The vertex at every place: in a table, not a hash, because places have numbers.
class VertexOfPlace {
 public:
  VertexOfPlace(const Grids& grids, Count base_points)
      : grids_(&grids), on_faces_(grids.place_count()), points_(base_points) {}

  // Where the table has the place; null where there is no such place. A vertex of no face (an unreferenced
  // point) has face = kNoIndex and the number of the control point in i.
  Index* at(const Provenance& place) {
    if (place.face == kNoIndex) return place.i < points_.size() ? &points_[place.i] : nullptr;
    const Count slot = grids_->place_number(place);
    return slot < on_faces_.size() ? &on_faces_[slot] : nullptr;
  }
  void clear(const Pace& pace) {
    for (auto* table : {&on_faces_, &points_})
      for (Index& vertex : *table) {
        pace.spend(1);
        vertex = kNoIndex;
      }
  }

 private:
  const Grids* grids_;
  Buffer<Index> on_faces_, points_;
};

// Our vertex at each place. The number of one that is unreferenced is that of its control point, as in the
// input. False when one of our vertices is nowhere, or two claim one place.
bool list_places(const OurConnectivity& ours, VertexOfPlace& vertex_of, const Pace& pace) {
  bool unique = true;
  for (Index v = 0; v < ours.provenance.size(); ++v) {
    pace.spend(2);
    Provenance place = ours.provenance[v];
    if (place.face == kNoIndex) place.i = v;
    Index* slot = vertex_of.at(place);
    if (slot == nullptr || *slot != kNoIndex)
      unique = false;
    else
      *slot = v;
  }
  return unique;
}

template <class Real>
bool match_vertices(const OurConnectivity& ours, const FarLevel<Real>& far, const Grids& grids,
                    Buffer<Index>& partner, const Pace& pace) {
  VertexOfPlace vertex_of(grids, far.base_points);
  vertex_of.clear(pace);
  bool identical = list_places(ours, vertex_of, pace) && ours.provenance.size() == far.vertices.size();
  partner.resize(far.vertices.size());
  for (std::size_t v = 0; v < far.vertices.size(); ++v) {
    pace.spend(2);
    Index* slot = vertex_of.at(far.vertices[v].place);
    partner[v] = slot == nullptr ? kNoIndex : std::exchange(*slot, kNoIndex);  // a second one finds nothing
    identical &= partner[v] != kNoIndex;
  }
  return identical;  // as many on both sides, all different: none of ours is left over
}

// First face of every base face's block; kNoIndex for base faces that are left out. Blocks that are torn or
// of another size are left out too: their faces then find no partner.
std::vector<Index> face_blocks(const OurConnectivity& ours, const Grids& grids, Count base_faces,
                               const Pace& pace) {
  std::vector<Index> blocks(base_faces, kNoIndex);
  const std::span<const Index> faces = ours.base_faces;
  for (Count begin = 0; begin < faces.size();) {
    Count end = begin;
    while (end < faces.size() && faces[end] == faces[begin]) ++end;
    pace.spend(end - begin);
    if (faces[begin] < base_faces && end - begin == grids.face_count(faces[begin]))
      blocks[faces[begin]] = static_cast<Index>(begin);
    begin = end;
  }
  return blocks;
}

// One face after the other.
template <class Real>
class FaceMatcher {
 public:
  FaceMatcher(const OurConnectivity& ours, const FarLevel<Real>& far, const Grids& grids,
              Correspondence& result, const Pace& pace)
      : ours_(ours),
        far_(far),
        grids_(grids),
        result_(result),
        pace_(pace),
        blocks_(face_blocks(ours, grids, far.base_rows.count(), pace)),
        taken_(ours.base_faces.size(), 0) {}

  // Whether all have found a partner.
  bool run() {
    pace_.fill(result_.faces, far_.base_faces.size(), kNoIndex);
    pace_.fill(result_.corners, far_.faces.size(), kNoIndex);
    Count visible = 0, matched = 0;
    for (Count f = 0; f < far_.base_faces.size(); ++f) {
      pace_.spend(2 * far_.rows.size(f));
      if (far_.holes[f] != 0) continue;
      ++visible;
      if (match_face(f)) ++matched;
    }
    return matched == visible && matched == taken_.size() && ours_.rows.count() == taken_.size() &&
           ours_.rows.corner_count() == ours_.faces.size();
  }

 private:
  bool match_face(Count f) {
    const Count begin = far_.rows.begin(f), size = far_.rows.size(f);
    const Index base = far_.base_faces[f], block = blocks_[base];
    if (block == kNoIndex) return false;
    const Index base_corner = far_.base_corners.empty() ? 0 : far_.base_corners[f];
    const Count number = grids_.face_number(base, base_corner, std::span(far_.corners).subspan(begin, size));
    if (number >= grids_.face_count(base)) return false;
    const Count ours = block + number;
    if (taken_[ours] != 0 || ours >= ours_.rows.count() || ours_.rows.size(ours) != size ||
        ours_.rows.end(ours) > ours_.faces.size())
      return false;
    const Count turn = turn_of(begin, size, ours_.rows.begin(ours));
    if (turn == size) return false;
    taken_[ours] = 1;
    result_.faces[f] = static_cast<Index>(ours);
    for (Count k = 0; k < size; ++k)
      result_.corners[begin + k] = static_cast<Index>(ours_.rows.begin(ours) + (k + turn) % size);
    return true;
  }

  // For which our corner k + turn, modulo the size, is Far's corner k; the size when there is none.
  Count turn_of(Count theirs, Count size, Count ours) const {
    const auto vertex = [&](Count k) { return result_.vertices[far_.faces[theirs + k]]; };
    Count turn = 0;  // no face has a vertex twice, so that the first is found in one place
    while (turn < size && ours_.faces[ours + turn] != vertex(0)) ++turn;
    for (Count k = 1; turn < size && k < size; ++k)
      if (ours_.faces[ours + (k + turn) % size] != vertex(k)) return size;
    return turn;
  }

  const OurConnectivity& ours_;
  const FarLevel<Real>& far_;
  const Grids& grids_;
  Correspondence& result_;
  const Pace& pace_;
  std::vector<Index> blocks_;
  std::vector<unsigned char> taken_;
};

}  // namespace

template <class Real>
OurConnectivity connectivity_of(const RefinedMesh<Real>& ours, const Pace& pace) {
  FaceRows rows = ours.face_size > 0 ? FaceRows(ours.face_size, ours.base_faces.size())
                                     : FaceRows(ours.face_vertex_counts, pace);
  return {ours.level, std::move(rows), ours.faces, ours.base_faces, ours.provenance};
}

template <class Real>
Correspondence match(const OurConnectivity& ours, const FarLevel<Real>& far, const Pace& pace) {
  const Grids grids(far.shape, far.level, far.base_rows, pace);
  Correspondence result;
  const bool same_vertices = match_vertices(ours, far, grids, result.vertices, pace);
  const bool same_faces = FaceMatcher<Real>(ours, far, grids, result, pace).run();
  result.identical = ours.level == far.level && same_vertices && same_faces;
  return result;
}

template OurConnectivity connectivity_of(const RefinedMesh<float>&, const Pace&);
template OurConnectivity connectivity_of(const RefinedMesh<double>&, const Pace&);
template Correspondence match(const OurConnectivity&, const FarLevel<float>&, const Pace&);
template Correspondence match(const OurConnectivity&, const FarLevel<double>&, const Pace&);

}  // namespace subdivd::oracle
