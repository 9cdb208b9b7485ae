#include "core/oracle/correspondence.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/lattice/split.h"

namespace subdivd::oracle {
namespace {

// The vertex at every place: in a table, not a hash, because places are numbers of grid points.
class VertexOfPlace {
 public:
  VertexOfPlace(Index level, Count base_faces, Count base_points)
      : n_(segments(level)),
        per_face_(face_points(n_)),
        faces_(base_faces * per_face_),
        points_(base_points) {}

  // Where the table has the place; null where there is no such place. A vertex of no face (an unreferenced
  // point) has face = kNoIndex and the number of the control point in i.
  Index* at(const Provenance& place) {
    if (place.face == kNoIndex) return place.i < points_.size() ? &points_[place.i] : nullptr;
    const Count i = place.i, j = place.j;
    if (i + j > n_) return nullptr;
    const Count slot = place.face * per_face_ + face_point_index(n_, i, j);
    return slot < faces_.size() ? &faces_[slot] : nullptr;
  }
  void clear(const Pace& pace) {
    for (auto* table : {&faces_, &points_})
      for (Index& vertex : *table) {
        pace.spend(1);
        vertex = kNoIndex;
      }
  }

 private:
  Count n_, per_face_;
  Buffer<Index> faces_, points_;
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
Index base_face_count(const FarLevel<Real>& far, const Pace& pace) {
  Index count = 0;
  for (const Index face : far.base_faces) {
    pace.spend(1);
    count = std::max(count, face + 1);
  }
  return count;
}

template <class Real>
bool match_vertices(const OurConnectivity& ours, const FarLevel<Real>& far, Buffer<Index>& partner,
                    const Pace& pace) {
  VertexOfPlace vertex_of(far.level, base_face_count(far, pace), far.base_points);
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

// First triangle of every base face's block of n^2; kNoIndex for faces that are left out. Blocks that are
// torn or of another size are left out too: their triangles then find no partner.
template <class Real>
std::vector<Index> triangle_blocks(const OurConnectivity& ours, const FarLevel<Real>& far, const Pace& pace) {
  const Index base_faces = base_face_count(far, pace);
  std::vector<Index> blocks(base_faces, kNoIndex);
  const Count size = triangles_per_face(ours.level);
  const std::span<const Index> faces = ours.base_faces;
  for (Count begin = 0; begin < faces.size();) {
    Count end = begin;
    while (end < faces.size() && faces[end] == faces[begin]) ++end;
    pace.spend(end - begin);
    if (end - begin == size && faces[begin] < base_faces) blocks[faces[begin]] = static_cast<Index>(begin);
    begin = end;
  }
  return blocks;
}

// The rotation r for which our corner (k + r) mod 3 is Far's corner k; 3 when there is none.
Index rotation(const std::array<Index, 3>& far_corners, std::span<const Index> our_corners) {
  for (Index r = 0; r < 3; ++r)
    if (far_corners[0] == our_corners[r] && far_corners[1] == our_corners[(r + 1) % 3] &&
        far_corners[2] == our_corners[(r + 2) % 3])
      return r;
  return 3;
}

template <class Real>
bool match_triangles(const OurConnectivity& ours, const FarLevel<Real>& far, Correspondence& result,
                     const Pace& pace) {
  const Count n = segments(ours.level);
  const Count faces = far.base_faces.size(), triangles = ours.base_faces.size();
  const std::vector<Index> blocks = triangle_blocks(ours, far, pace);
  result.triangles.resize(faces);
  result.corners.resize(3 * faces);
  const bool identical = ours.faces.size() == 3 * triangles;
  std::vector<unsigned char> taken(triangles, 0);
  Count visible = 0, matched = 0;
  for (Count f = 0; f < faces; ++f) {
    pace.spend(6);
    result.triangles[f] = kNoIndex;
    std::fill_n(result.corners.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, kNoIndex);
    if (far.holes[f] != 0) continue;
    ++visible;
    const Index block = blocks[far.base_faces[f]];
    if (block == kNoIndex) continue;
    const Count t = block + triangle_index(n, std::span(far.corners).subspan(3 * f).template first<3>());
    if (t >= triangles || taken[t] != 0 || 3 * t + 3 > ours.faces.size()) continue;
    std::array<Index, 3> corners{};
    for (Count k = 0; k < 3; ++k) corners[k] = result.vertices[far.faces[3 * f + k]];
    const Index r = rotation(corners, ours.faces.subspan(3 * t, 3));
    if (r == 3) continue;
    taken[t] = 1;
    ++matched;
    result.triangles[f] = static_cast<Index>(t);
    for (Index k = 0; k < 3; ++k) result.corners[3 * f + k] = static_cast<Index>(3 * t + (k + r) % 3);
  }
  return identical && matched == visible && matched == triangles;
}

}  // namespace

template <class Real>
Correspondence match(const OurConnectivity& ours, const FarLevel<Real>& far, const Pace& pace) {
  Correspondence result;
  const bool same_vertices = match_vertices(ours, far, result.vertices, pace);
  const bool same_triangles = match_triangles(ours, far, result, pace);
  result.identical = ours.level == far.level && same_vertices && same_triangles;
  return result;
}

template Correspondence match(const OurConnectivity&, const FarLevel<float>&, const Pace&);
template Correspondence match(const OurConnectivity&, const FarLevel<double>&, const Pace&);

}  // namespace subdivd::oracle
