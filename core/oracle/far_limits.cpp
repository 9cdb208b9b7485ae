#include "core/oracle/far_limits.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/sdc/catmarkScheme.h>

#include <algorithm>
#include <vector>

#include "core/oracle/far_rows.h"

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// Far's Limit has room for as many faces at a vertex as edges at some vertex or corners of some face (Level's
// _maxValence), and writes the Catmull-Clark tangents of a vertex of more, at an edge of several faces, over
// what follows: from 14 faces on beyond the end of its buffer.
bool has_vertices_of_too_many_faces(const Far::TopologyLevel& level, const Pace& pace) {
  int most_faces = 0, most_edges = 0;
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    pace.spend(1);
    most_faces = std::max(most_faces, level.GetVertexFaces(v).size());
    most_edges = std::max(most_edges, level.GetVertexEdges(v).size());
  }
  return most_faces > most_edges;
}

// A vertex as Sdc's masks want to see it.
struct Neighborhood {
  const Far::TopologyLevel* level;
  int vertex;

  int GetNumEdges() const { return level->GetVertexEdges(vertex).size(); }
  int GetNumFaces() const { return level->GetVertexFaces(vertex).size(); }
  float* GetSharpnessPerEdge(float* sharpness) const {
    const Far::ConstIndexArray edges = level->GetVertexEdges(vertex);
    for (int k = 0; k < edges.size(); ++k) sharpness[k] = level->GetEdgeSharpness(edges[k]);
    return sharpness;
  }
};

// And a mask, with room for every neighbour.
template <class Real>
class SdcMask {
 public:
  using Weight = Real;

  void SetNumVertexWeights(int) {}
  void SetNumEdgeWeights(int count) { edges_.assign(static_cast<std::size_t>(count), 0); }
  void SetNumFaceWeights(int count) { faces_.assign(static_cast<std::size_t>(count), 0); }
  void SetFaceWeightsForFaceCenters(bool) {}
  Weight& VertexWeight(int) { return self_; }
  Weight& EdgeWeight(int k) { return edges_[static_cast<std::size_t>(k)]; }
  Weight& FaceWeight(int k) { return faces_[static_cast<std::size_t>(k)]; }

  // Of manifold vertices.
  template <class Rows>
  void apply(const Far::TopologyLevel& level, int v, const Rows& from, const Rows& to) const {
    auto row = to[v];
    row.Clear();
    row.AddWithWeight(from[v], self_);
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const Far::ConstIndexArray ends = level.GetEdgeVertices(level.GetVertexEdges(v)[static_cast<int>(k)]);
      row.AddWithWeight(from[ends[0] == v ? ends[1] : ends[0]], edges_[k]);
    }
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      const int at = static_cast<int>(k);
      const Far::ConstIndexArray corners = level.GetFaceVertices(level.GetVertexFaces(v)[at]);
      const int opposite = (level.GetVertexFaceLocalIndices(v)[at] + 2) % corners.size();
      row.AddWithWeight(from[corners[opposite]], faces_[k]);
    }
  }

 private:
  Real self_ = 0;
  std::vector<Real> edges_, faces_;
};

// By the masks that Far's Limit takes, vertex by vertex, where Limit itself must not be called.
template <class Real>
void take_tangents(const Far::TopologyRefiner& refiner, const Rows<Real>& points, const Rows<Real>& u,
                   const Rows<Real>& v) {
  const Sdc::Scheme<Sdc::SCHEME_CATMARK> scheme(refiner.GetSchemeOptions());
  const Far::TopologyLevel& level = refiner.GetLevel(refiner.GetMaxLevel());
  SdcMask<Real> limit, along_u, along_v;
  for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
    u[vertex].Clear();
    v[vertex].Clear();
    if (level.GetVertexFaces(vertex).size() == 0 || level.IsVertexNonManifold(vertex)) continue;
    scheme.ComputeVertexLimitMask(Neighborhood{&level, vertex}, limit, along_u, along_v,
                                  level.GetVertexRule(vertex));
    along_u.apply(level, vertex, points, u);
    along_v.apply(level, vertex, points, v);
  }
}

}  // namespace

template <class Real>
Buffer<Real> far_limits(const Far::TopologyRefiner& refiner, Buffer<Real>& values, Index width,
                        const Pace& pace) {
  Buffer<Real> result(values.size());
  Rows<Real> to(result, width, pace);
  Far::PrimvarRefinerReal<Real>(refiner).Limit(Rows<Real>(values, width, pace), to);
  return result;
}

template <class Real>
FarFrames<Real> far_frames(const Far::TopologyRefiner& refiner, FarScheme scheme, Buffer<Real>& points,
                           const Pace& pace) {
  const bool apart = scheme == FarScheme::catmull_clark &&
                     has_vertices_of_too_many_faces(refiner.GetLevel(refiner.GetMaxLevel()), pace);
  FarFrames<Real> frames;
  frames.points.resize(points.size());
  frames.tangents_u.resize(points.size());
  frames.tangents_v.resize(points.size());
  const Rows<Real> from(points, 3, pace);
  Rows<Real> limit(frames.points, 3, pace), u(frames.tangents_u, 3, pace), v(frames.tangents_v, 3, pace);
  if (apart) {
    Far::PrimvarRefinerReal<Real>(refiner).Limit(from, limit);
    take_tangents(refiner, from, u, v);
  } else {
    Far::PrimvarRefinerReal<Real>(refiner).Limit(from, limit, u, v);
  }
  return frames;
}

template Buffer<float> far_limits(const Far::TopologyRefiner&, Buffer<float>&, Index, const Pace&);
template Buffer<double> far_limits(const Far::TopologyRefiner&, Buffer<double>&, Index, const Pace&);
template FarFrames<float> far_frames(const Far::TopologyRefiner&, FarScheme, Buffer<float>&, const Pace&);
template FarFrames<double> far_frames(const Far::TopologyRefiner&, FarScheme, Buffer<double>&, const Pace&);

}  // namespace subdivd::oracle
