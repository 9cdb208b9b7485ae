#pragma once
// Which face of the control mesh the parts of a level come from, where places on it have no formula (core/lattice has
// those of splits into triangles and quads): of splits into corners and about centroids.

#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/centroid_split.h"
#include "core/engine/plain/corner_split.h"

namespace subdivd::plain {

// Of every vertex and face. Of what lies between several faces the lowest of the level before is taken; a vertex
// without faces has kNoIndex.
struct BaseFaces {
  std::vector<Index> of_vertices, of_faces;
};

// Of a level 0.
BaseFaces first_base_faces(const Adjacency& faces, const Pace& pace = {});

// Of the next level, from those of `level`. A corner's vertex comes from the corner's face, and one more on a curve from
// the lowest face at its old vertex.
BaseFaces next_base_faces(const BaseFaces& from, const Level& level, const CornerSplit& split,
                          const Pace& pace = {});
// Old vertices keep theirs. The points of a crease come from the lowest face along it, the face of half-edge h from h's.
BaseFaces next_base_faces_by_centroids(const BaseFaces& from, const Level& level, const Pace& pace = {});

}  // namespace subdivd::plain
