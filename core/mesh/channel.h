#pragma once
// A face-varying channel as a mesh of its own: the same faces over the channel's values, in which a seam is a
// border. The engine that refines positions then refines the channel; what differs between the six
// modes of faceVaryingLinearInterpolation is decided here, once, at the control mesh.

#include <memory>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/cage.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"

namespace subdivd {

// Instantiated, like what follows, for Triangles, Quads and Polygons.
template <class Faces>
struct Channel {
  // Vertices are (point, value) pairs. The mesh's own where every point has one value, under its own number.
  std::shared_ptr<const Topology<Faces>> topology;
  Sharpness sharpness;
  // Channel vertex -> index of its value. Values are vertices under their own number; a value that several
  // points share gets one more vertex, numbered after them, for each further point.
  std::vector<Index> values;
  bool linear = false;          // mode all: edge points are midpoints, vertex points stay
  bool linear_borders = false;  // mode boundaries: every point of the channel's border is a corner
};

// The vertices that have faces, ascending: what a channel goes through, for a mesh may have more points that
// no face uses than all its channels together have values.
template <class Faces>
std::vector<Index> vertices_with_faces(const Topology<Faces>& topology, const Pace& pace = {});

// `corner_values`: one value index per face corner, each < value_count. `base` and `base_sharpness` are the
// control mesh's own (control_sharpness), `vertices` is vertices_with_faces(*base); the crease method tells
// how long a semi-sharp crease holds. Linear in the faces and values, but values are sorted at each vertex.
template <class Faces>
Channel<Faces> make_channel(const Cage& cage, CreaseMethod crease_method,
                            std::shared_ptr<const Topology<Faces>> base, const Sharpness& base_sharpness,
                            std::span<const Index> vertices, std::span<const Index> corner_values,
                            Index value_count, const Pace& pace = {});

// Whether every point has one value under its own number, and nothing that the channel's mode decides: no
// border, no linear interpolation. Such a channel is refined as a vertex primvar is, with the mesh's rules.
template <class Faces>
bool is_as_mesh(const Cage& cage, const Topology<Faces>& base, std::span<const Index> corner_values,
                Index value_count, const Pace& pace = {});

}  // namespace subdivd
