#include "core/engine/plain/sectors.h"

namespace subdivd::plain {

std::vector<unsigned char> crossed_edges(const Adjacency& faces, const Sharpness& sharpness,
                                         const Pace& pace) {
  std::vector<unsigned char> crossed;
  pace.fill(crossed, faces.edge_count(), static_cast<unsigned char>(0));
  pace.for_each(faces.edge_count(), [&](Index e) {
    crossed[e] = !is_infinite(sharpness.edges[e]) && faces.mate(faces.edge_half_edges(e)[0]) != kNoIndex;
  });
  return crossed;
}

Sectors::Sectors(const Adjacency& faces, std::span<const unsigned char> crossed, const Pace& pace) {
  const auto is_crossed = [&](Index h) { return crossed[faces.half_edge_edge(h)] != 0; };
  pace.fill(of_corner_, faces.half_edge_count(), kNoIndex);
  pace.fill(place_, faces.half_edge_count(), kNoIndex);
  corners_.reserve(faces.half_edge_count());
  const auto add = [&](Index lowest) {
    Index start = lowest;
    bool closed = false;
    while (!closed && is_crossed(start)) {  // clockwise
      pace.spend(2);
      start = faces.next(faces.mate(start));
      closed = start == lowest;
    }
    Index h = start;
    do {
      pace.spend(2);
      of_corner_[h] = count();
      place_[h] = static_cast<Index>(corners_.size());
      corners_.push_back(h);
      const Index last = faces.prev(h);
      h = is_crossed(last) ? faces.mate(last) : start;
    } while (h != start);
    begins_.push_back(static_cast<Index>(corners_.size()));
    closed_.push_back(closed);
  };
  pace.for_each(faces.vertex_count(), [&](Index v) {
    for (const Index h : faces.vertex_corners(v))
      if (of_corner_[h] == kNoIndex) add(h);
  });
}

}  // namespace subdivd::plain
