#include "core/oracle/correspondence.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/refine/split.h"

namespace subdivd::oracle {
namespace {

struct PlaceHash {
  std::size_t operator()(const std::array<Index, 3>& place) const {
    std::uint64_t h = place[0];
    h = h * 0x9E3779B97F4A7C15u + place[1];
    h = h * 0x9E3779B97F4A7C15u + place[2];
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};
using VertexOfPlace = std::unordered_map<std::array<Index, 3>, Index, PlaceHash>;

// Our vertex at each place. Unreferenced points have none: their number, that of the control point, stands
// in. False when two of our vertices claim one place.
bool list_places(const OurConnectivity& ours, VertexOfPlace& vertex_of) {
  vertex_of.reserve(ours.provenance.size());
  bool unique = true;
  for (Index v = 0; v < ours.provenance.size(); ++v) {
    const Provenance& place = ours.provenance[v];
    const Index i = place.face == kNoIndex ? v : place.i;
    unique &= vertex_of.emplace(std::array{place.face, i, place.j}, v).second;
  }
  return unique;
}

template <class Real>
bool match_vertices(const OurConnectivity& ours, const FarLevel<Real>& far, std::vector<Index>& partner) {
  VertexOfPlace vertex_of;
  bool identical = list_places(ours, vertex_of) && ours.provenance.size() == far.vertices.size();
  partner.assign(far.vertices.size(), kNoIndex);
  for (std::size_t v = 0; v < far.vertices.size(); ++v) {
    const Provenance& place = far.vertices[v].place;
    const auto found = vertex_of.find({place.face, place.i, place.j});
    if (found == vertex_of.end()) {
      identical = false;
      continue;
    }
    partner[v] = found->second;
    vertex_of.erase(found);  // a second Far vertex at this place finds nothing
  }
  return identical && vertex_of.empty();
}

// First triangle of every base face's block of n^2; kNoIndex for faces that are left out. Blocks that are
// torn or of another size are left out too: their triangles then find no partner.
template <class Real>
std::vector<Index> triangle_blocks(const OurConnectivity& ours, const FarLevel<Real>& far) {
  Index base_faces = 0;
  for (const Index face : far.base_faces) base_faces = std::max(base_faces, face + 1);
  std::vector<Index> blocks(base_faces, kNoIndex);
  const Count size = segments(ours.level) * segments(ours.level);
  const std::span<const Index> faces = ours.triangle_faces;
  for (Count begin = 0; begin < faces.size();) {
    Count end = begin;
    while (end < faces.size() && faces[end] == faces[begin]) ++end;
    if (end - begin == size && faces[begin] < base_faces) blocks[faces[begin]] = static_cast<Index>(begin);
    begin = end;
  }
  return blocks;
}

// Number of the triangle with these three corners within its face's block.
Count number_in_block(Count n, std::span<const GridPoint> corners) {
  Count i = n, j = n, total = 0;
  for (const GridPoint& corner : corners) {
    i = std::min<Count>(i, corner.i);
    j = std::min<Count>(j, corner.j);
    total += corner.i + corner.j;
  }
  // upright: (i,j) (i+1,j) (i,j+1)   inverted: (i+1,j) (i+1,j+1) (i,j+1)
  const bool inverted = total == 3 * (i + j) + 4;
  return upright_index(n, i, j) + (inverted ? 1 : 0);
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
bool match_triangles(const OurConnectivity& ours, const FarLevel<Real>& far, Correspondence& result) {
  const Count n = segments(ours.level);
  const Count faces = far.base_faces.size(), triangles = ours.triangle_faces.size();
  const std::vector<Index> blocks = triangle_blocks(ours, far);
  result.triangles.assign(faces, kNoIndex);
  result.corners.assign(3 * faces, kNoIndex);
  bool identical = ours.triangles.size() == 3 * triangles;
  std::vector<unsigned char> taken(triangles, 0);
  Count visible = 0;
  for (Count f = 0; f < faces; ++f) {
    if (far.holes[f] != 0) continue;
    ++visible;
    const Index block = blocks[far.base_faces[f]];
    if (block == kNoIndex) continue;
    const Count t = block + number_in_block(n, std::span(far.corners).subspan(3 * f, 3));
    if (t >= triangles || taken[t] != 0 || 3 * t + 3 > ours.triangles.size()) continue;
    std::array<Index, 3> corners{};
    for (Count k = 0; k < 3; ++k) corners[k] = result.vertices[far.faces[3 * f + k]];
    const Index r = rotation(corners, ours.triangles.subspan(3 * t, 3));
    if (r == 3) continue;
    taken[t] = 1;
    result.triangles[f] = static_cast<Index>(t);
    for (Index k = 0; k < 3; ++k) result.corners[3 * f + k] = static_cast<Index>(3 * t + (k + r) % 3);
  }
  const auto matched = static_cast<Count>(std::count(taken.begin(), taken.end(), 1));
  return identical && matched == visible && matched == triangles;
}

}  // namespace

template <class Real>
Correspondence match(const OurConnectivity& ours, const FarLevel<Real>& far) {
  Correspondence result;
  const bool same_vertices = match_vertices(ours, far, result.vertices);
  const bool same_triangles = match_triangles(ours, far, result);
  result.identical = ours.level == far.level && same_vertices && same_triangles;
  return result;
}

template Correspondence match(const OurConnectivity&, const FarLevel<float>&);
template Correspondence match(const OurConnectivity&, const FarLevel<double>&);

}  // namespace subdivd::oracle
