#include "core/engine/plain/base_faces.h"

namespace subdivd::plain {

BaseFaces first_base_faces(const Adjacency& faces, const Pace& pace) {
  BaseFaces base;
  base.of_faces.reserve(faces.face_count());
  pace.for_each(faces.face_count(), [&](Index f) { base.of_faces.push_back(f); });
  base.of_vertices.reserve(faces.vertex_count());
  pace.for_each(faces.vertex_count(), [&](Index v) {
    const auto corners = faces.vertex_corners(v);  // ascending
    base.of_vertices.push_back(corners.empty() ? kNoIndex : faces.face_of(corners[0]));
  });
  return base;
}

BaseFaces next_base_faces(const BaseFaces& from, const Level& level, const CornerSplit& split,
                          const Pace& pace) {
  const Adjacency& old = level.faces;
  BaseFaces next;
  next.of_vertices.reserve(split.faces.vertex_count());
  pace.for_each(old.half_edge_count(),
                [&](Index h) { next.of_vertices.push_back(from.of_faces[old.face_of(h)]); });
  pace.for_each(split.more.size(), [&](std::size_t k) {
    next.of_vertices.push_back(from.of_faces[old.face_of(old.vertex_corners(split.more[k].vertex)[0])]);
  });
  next.of_faces.reserve(split.faces.face_count());
  pace.for_each(split.faces.face_count(),
                [&](Index f) { next.of_faces.push_back(from.of_faces[split.face_parents[f]]); });
  return next;
}

BaseFaces next_base_faces_by_centroids(const BaseFaces& from, const Level& level, const Pace& pace) {
  const Adjacency& old = level.faces;
  const CentroidNumbers numbers(level, pace);
  BaseFaces next;
  pace.copy(from.of_vertices, next.of_vertices);
  pace.for_each(old.edge_count(), [&](Index e) {
    if (numbers.edge_points[e] == kNoIndex) return;
    next.of_vertices.insert(next.of_vertices.end(), 2, from.of_faces[old.face_of(old.edge_half_edges(e)[0])]);
  });
  pace.for_each(old.face_count(), [&](Index f) {
    if (numbers.face_points[f] != kNoIndex) next.of_vertices.push_back(from.of_faces[f]);
  });
  next.of_faces.reserve(old.half_edge_count());
  pace.for_each(old.half_edge_count(),
                [&](Index h) { next.of_faces.push_back(from.of_faces[old.face_of(h)]); });
  return next;
}

}  // namespace subdivd::plain
