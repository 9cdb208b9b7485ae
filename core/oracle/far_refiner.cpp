#include "core/oracle/far_refiner.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <numeric>
#include <utility>

#include "core/mesh/creases.h"

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// The callbacks know no other way to tell whose call failed. They may be called without a text (null), and
// from within Far, which no exception may leave by this way: so nothing is allocated here.
thread_local bool complained = false;

void note_error(Far::ErrorType, const char*) { complained = true; }
void note_warning(const char*) { complained = true; }

// Setting the callbacks is not thread-safe in Far; the initialisation of a static is.
void install_callbacks() {
  [[maybe_unused]] static const bool installed = [] {
    Far::SetErrorCallback(note_error);
    Far::SetWarningCallback(note_warning);
    return true;
  }();
}

Sdc::Options::VtxBoundaryInterpolation far_boundary(BoundaryInterpolation boundary) {
  switch (boundary) {
    case BoundaryInterpolation::none:
      return Sdc::Options::VTX_BOUNDARY_NONE;
    case BoundaryInterpolation::edge_only:
      return Sdc::Options::VTX_BOUNDARY_EDGE_ONLY;
    case BoundaryInterpolation::edge_and_corner:
      break;
  }
  return Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
}

Sdc::Options::FVarLinearInterpolation far_linear(FaceVaryingInterpolation mode) {
  switch (mode) {
    case FaceVaryingInterpolation::none:
      return Sdc::Options::FVAR_LINEAR_NONE;
    case FaceVaryingInterpolation::corners_only:
      return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
    case FaceVaryingInterpolation::corners_plus1:
      return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
    case FaceVaryingInterpolation::corners_plus2:
      return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
    case FaceVaryingInterpolation::boundaries:
      return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
    case FaceVaryingInterpolation::all:
      break;
  }
  return Sdc::Options::FVAR_LINEAR_ALL;
}

Sdc::SchemeType far_type(FarScheme scheme) {
  switch (scheme) {
    case FarScheme::catmull_clark:
      return Sdc::SCHEME_CATMARK;
    case FarScheme::bilinear:
      return Sdc::SCHEME_BILINEAR;
    case FarScheme::loop:
      break;
  }
  return Sdc::SCHEME_LOOP;
}

std::vector<int> as_ints(const std::vector<Index>& indices) { return {indices.begin(), indices.end()}; }

// How many corners every point has: near enough to the number of its edges.
std::vector<Index> corner_counts(const ControlMesh& mesh) {
  std::vector<Index> counts(mesh.point_count(), 0);
  for (const Index v : mesh.face_vertex_indices) ++counts[v];
  return counts;
}

// Crease polylines as edges, in the order given: Far, too, keeps the last sharpness of an edge. It looks for
// them among the edges of the end that is named first: that is the one with fewer.
struct CreaseEdges {
  std::vector<int> ends;  // two per edge
  std::vector<float> sharpnesses;
};

CreaseEdges crease_edges(const ControlMesh& mesh) {
  CreaseEdges edges;
  if (mesh.crease_lengths.empty()) return edges;
  const std::vector<Index> corners = corner_counts(mesh);
  for_each_crease_edge(mesh, [&](Count, Index a, Index b, float sharpness) {
    const bool a_first = corners[a] <= corners[b];
    edges.ends.push_back(static_cast<int>(a_first ? a : b));
    edges.ends.push_back(static_cast<int>(a_first ? b : a));
    edges.sharpnesses.push_back(sharpness);
  });
  return edges;
}

int size_of(const auto& container) { return static_cast<int>(container.size()); }

}  // namespace

bool far_has_complained() { return std::exchange(complained, false); }

Error far_refusal() {
  return {ErrorCode::unsupported,
          "OpenSubdiv refuses this topology; it can be refined here, but not verified"};
}

std::vector<int> corner_values(const Primvar& primvar, Count corners) {
  if (!primvar.indices.empty()) return as_ints(primvar.indices);
  std::vector<int> indices(corners);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

Result<FarRefiner> create_refiner(const Far::TopologyDescriptor& topology, Sdc::SchemeType scheme,
                                  Sdc::Options rules) {
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  install_callbacks();
  far_has_complained();  // forget what came before
  FarRefiner refiner(Factory::Create(topology, Factory::Options(scheme, rules)));
  if (refiner == nullptr || far_has_complained()) return far_refusal();
  return refiner;
}

Result<FarRefiner> make_refiner(const ControlMesh& mesh, CreaseMethod crease_method, FarScheme scheme) {
  Sdc::Options rules;  // Far's defaults are not OpenUSD's: set all of them
  rules.SetVtxBoundaryInterpolation(far_boundary(mesh.interpolate_boundary));
  rules.SetFVarLinearInterpolation(far_linear(mesh.face_varying_linear_interpolation));
  rules.SetCreasingMethod(crease_method == CreaseMethod::chaikin ? Sdc::Options::CREASE_CHAIKIN
                                                                 : Sdc::Options::CREASE_UNIFORM);
  rules.SetTriangleSubdivision(mesh.triangle_subdivision_rule == TriangleRule::smooth
                                   ? Sdc::Options::TRI_SUB_SMOOTH
                                   : Sdc::Options::TRI_SUB_CATMARK);

  const std::vector<int> counts = mesh.face_vertex_counts.empty() ? std::vector<int>(mesh.face_count(), 3)
                                                                  : as_ints(mesh.face_vertex_counts);
  const std::vector<int> indices = as_ints(mesh.face_vertex_indices), holes = as_ints(mesh.hole_indices),
                         corners = as_ints(mesh.corner_indices);
  const CreaseEdges creases = crease_edges(mesh);
  std::vector<std::vector<int>> channel_indices;
  std::vector<Far::TopologyDescriptor::FVarChannel> channels;
  for (const Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation != Interpolation::face_varying) continue;
    channel_indices.push_back(corner_values(primvar, indices.size()));
    auto& channel = channels.emplace_back();
    channel.numValues = static_cast<int>(primvar.values.size() / primvar.element_size);
    channel.valueIndices = channel_indices.back().data();  // moving the outer vector leaves it in place
  }

  Far::TopologyDescriptor topology;
  topology.numVertices = static_cast<int>(mesh.point_count());
  topology.numFaces = size_of(counts);
  topology.numVertsPerFace = counts.data();
  topology.vertIndicesPerFace = indices.data();
  topology.numCreases = size_of(creases.sharpnesses);
  topology.creaseVertexIndexPairs = creases.ends.data();
  topology.creaseWeights = creases.sharpnesses.data();
  topology.numCorners = size_of(corners);
  topology.cornerVertexIndices = corners.data();
  topology.cornerWeights = mesh.corner_sharpnesses.data();
  topology.numHoles = size_of(holes);
  topology.holeIndices = holes.data();
  topology.numFVarChannels = size_of(channels);
  topology.fvarChannels = channels.data();

  return create_refiner(topology, far_type(scheme), rules);
}

}  // namespace subdivd::oracle
