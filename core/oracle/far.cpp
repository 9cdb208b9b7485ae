#include "core/oracle/far.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/pace.h"
#include "core/oracle/far_cost.h"
#include "core/oracle/far_grid.h"
#include "core/oracle/far_limits.h"
#include "core/oracle/far_quirks.h"
#include "core/oracle/far_refiner.h"
#include "core/oracle/far_rows.h"

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// Values spread out by their indices; without indices as they stand.
template <class Real, class Indices>
Buffer<Real> spread(Buffer<Real> values, const Indices& indices, Index width, const Pace& pace) {
  if (indices.empty()) return values;
  Buffer<Real> result(std::size_t{width} * indices.size());
  auto to = result.begin();
  for (const Index index : indices) {
    pace.spend(width);
    to = std::copy_n(values.begin() + std::ptrdiff_t{index} * width, width, to);
  }
  return result;
}

FarRule rule_of(const Far::TopologyLevel& level, int vertex) {
  switch (level.GetVertexRule(vertex)) {
    case Sdc::Crease::RULE_DART:
      return FarRule::dart;
    case Sdc::Crease::RULE_CREASE:
      return FarRule::crease;
    case Sdc::Crease::RULE_CORNER:
      return FarRule::corner;
    default:
      return FarRule::smooth;
  }
}

// `face_size`: corners of the faces that the scheme makes.
FarVertex describe(const Far::TopologyLevel& level, int vertex, int face_size) {
  FarVertex described;
  described.rule = rule_of(level, vertex);
  described.faces = static_cast<Index>(level.GetVertexFaces(vertex).size());
  described.boundary = level.IsVertexBoundary(vertex);
  described.non_manifold = level.IsVertexNonManifold(vertex);
  described.semi_sharp = level.IsVertexSemiSharp(vertex);
  const Far::ConstIndexArray edges = level.GetVertexEdges(vertex);
  for (int k = 0; k < edges.size(); ++k) described.semi_sharp |= level.IsEdgeSemiSharp(edges[k]);
  const Far::ConstIndexArray faces = level.GetVertexFaces(vertex);
  for (int k = 0; k < faces.size(); ++k)
    described.has_other_faces |= level.GetFaceVertices(faces[k]).size() != face_size;
  return described;
}

// Far's vertices at the corners of every face.
template <class Real>
void take_faces(const Far::TopologyLevel& level, FarLevel<Real>& result, const Pace& pace) {
  const int faces = level.GetNumFaces();
  // Only the control mesh has faces of several sizes.
  result.rows = result.level == 0
                    ? result.base_rows
                    : FaceRows(result.shape == GridShape::triangles ? 3 : 4, static_cast<Count>(faces));
  result.faces.reserve(result.rows.corner_count());
  result.holes.reserve(static_cast<std::size_t>(faces));
  for (int face = 0; face < faces; ++face) {
    const Far::ConstIndexArray vertices = level.GetFaceVertices(face);
    pace.spend(static_cast<Count>(vertices.size()) + 1);
    for (int k = 0; k < vertices.size(); ++k) result.faces.push_back(static_cast<Index>(vertices[k]));
    result.holes.push_back(level.IsFaceHole(face) ? 1 : 0);
  }
}

// The lowest base face of every vertex and its place there, on the quad of the lowest corner where there are
// such. The faces must stand in `result`.
template <class Real>
void place_vertices(FarLevel<Real>& result, const Pace& pace) {
  for (Count face = 0; face < result.rows.count(); ++face)
    for (Count at = result.rows.begin(face); at < result.rows.end(face); ++at) {
      pace.spend(1);
      const Provenance here = result.place(face, at);
      Provenance& place = result.vertices[result.faces[at]].place;
      if (here.face < place.face || (here.face == place.face && here.corner < place.corner)) place = here;
    }
}

// Everything about one level but values.
template <class Real>
void take_topology(const Far::TopologyRefiner& refiner, Index depth, FarLevel<Real>& result,
                   const Pace& pace) {
  FarGrid grid = grid_of(refiner, result.shape, depth, pace);
  result.corners = std::move(grid.corners);
  result.base_faces = std::move(grid.base_faces);
  result.base_corners = std::move(grid.base_corners);
  const Far::TopologyLevel& level = refiner.GetLevel(static_cast<int>(depth));
  result.vertices.reserve(static_cast<std::size_t>(level.GetNumVertices()));
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    pace.spend(4 + 2 * static_cast<Count>(level.GetVertexEdges(v).size()));
    result.vertices.push_back(describe(level, v, result.shape == GridShape::triangles ? 3 : 4));
  }
  take_faces(level, result, pace);
  place_vertices(result, pace);

  const Far::TopologyLevel& base = refiner.GetLevel(0);
  for (int v = 0; v < base.GetNumVertices(); ++v) {  // unreferenced points
    pace.spend(1 + depth);
    if (base.GetVertexFaces(v).size() != 0) continue;
    int child = v;
    for (int l = 0; l < static_cast<int>(depth); ++l) child = refiner.GetLevel(l).GetVertexChildVertex(child);
    result.vertices[static_cast<std::size_t>(child)].place = {kNoIndex, static_cast<Index>(v), 0};
  }
}

// How a value is carried from level to level.
enum class Carrier { vertex, varying, face_varying };

template <class Real>
Buffer<Real> interpolate(const Far::TopologyRefiner& refiner, Index depth, Carrier carrier, int channel,
                         Buffer<Real> values, Index width, const Pace& pace) {
  const Far::PrimvarRefinerReal<Real> primvars(refiner);
  for (int l = 1; l <= static_cast<int>(depth); ++l) {
    const Far::TopologyLevel& level = refiner.GetLevel(l);
    const int count =
        carrier == Carrier::face_varying ? level.GetNumFVarValues(channel) : level.GetNumVertices();
    Buffer<Real> next(static_cast<std::size_t>(count) * width);
    const Rows<Real> from(values, width, pace);
    Rows<Real> to(next, width, pace);
    switch (carrier) {
      case Carrier::vertex:
        primvars.Interpolate(l, from, to);
        break;
      case Carrier::varying:
        primvars.InterpolateVarying(l, from, to);
        break;
      case Carrier::face_varying:
        primvars.InterpolateFaceVarying(l, from, to, channel);
        break;
    }
    values = std::move(next);
  }
  return values;
}

template <class Real>
void take_face_varying(const Far::TopologyRefiner& refiner, const RefineOptions& options, int channel,
                       Buffer<Real> control, Index width, FarPrimvar<Real>& result, const Pace& pace) {
  const Far::TopologyLevel& level = refiner.GetLevel(static_cast<int>(options.level));
  result.values =
      interpolate(refiner, options.level, Carrier::face_varying, channel, std::move(control), width, pace);
  result.indices.reserve(static_cast<std::size_t>(level.GetNumFaceVertices()));
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    const Far::ConstIndexArray values = level.GetFaceFVarValues(face, channel);
    pace.spend(static_cast<Count>(values.size()));
    for (int k = 0; k < values.size(); ++k) result.indices.push_back(static_cast<Index>(values[k]));
  }
  result.torn_faces = faces_at_torn_values(refiner, channel, pace);
  // At the control mesh LimitFaceVarying takes indices of values for indices of its own tags: wrong tags, and
  // a read past their end when values are left unused.
  if (!options.limit || options.level == 0) return;
  result.limit_values.resize(result.values.size());
  Rows<Real> to(result.limit_values, width, pace);
  Far::PrimvarRefinerReal<Real>(refiner).LimitFaceVarying(Rows<Real>(result.values, width, pace), to,
                                                          channel);
}

template <class Real>
Result<FarPrimvar<Real>> take_primvar(const Far::TopologyRefiner& refiner, const RefineOptions& options,
                                      const Primvar& primvar, int channel, const FarLevel<Real>& level,
                                      const Pace& pace) {
  auto control = convert_values<Real>(primvar.values, {"primvars", primvar.name, "values"}, pace);
  if (!control) return control.error();
  const Index width = primvar.element_size;
  FarPrimvar<Real> result;
  if (primvar.interpolation == Interpolation::face_varying) {
    take_face_varying(refiner, options, channel, std::move(*control), width, result, pace);
    return result;
  }
  result.values = spread(std::move(*control), primvar.indices, width, pace);
  switch (primvar.interpolation) {
    case Interpolation::uniform:
      result.values = spread(std::move(result.values), level.base_faces, width, pace);
      break;
    case Interpolation::vertex:
      result.values =
          interpolate(refiner, options.level, Carrier::vertex, 0, std::move(result.values), width, pace);
      if (options.limit) result.limit_values = far_limits(refiner, result.values, width, pace);
      break;
    case Interpolation::varying:
      result.values =
          interpolate(refiner, options.level, Carrier::varying, 0, std::move(result.values), width, pace);
      break;
    default:
      break;
  }
  return result;
}

}  // namespace

template <class Real>
Provenance FarLevel<Real>::place(Count face, Count corner) const {
  const GridPoint at = corners[corner];
  Index base_corner = base_corners.empty() ? 0 : base_corners[face];
  if (level == 0 && shape == GridShape::corners && rows.size(face) != 4)
    base_corner = static_cast<Index>(corner - rows.begin(face));
  return {base_faces[face], at.i, at.j, base_corner};
}

template struct FarLevel<float>;
template struct FarLevel<double>;

struct FarMesh::State {
  const ControlMesh* mesh;
  FarScheme scheme;
  FarRefiner refiner;
  Index deepest;
  std::optional<Index> refined_to;

  void refine_to(Index level) {
    if (refined_to == level) return;
    unrefine();
    Far::TopologyRefiner::UniformOptions uniform(static_cast<int>(level));
    // Without it Far leaves the last level's edges out, which limits and every question about vertices need.
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    refined_to = level;
  }
  void unrefine() {
    if (refined_to) refiner->Unrefine();
    refined_to.reset();
  }
};

FarMesh::FarMesh(std::unique_ptr<State> state) : state_(std::move(state)) {}
FarMesh::FarMesh(FarMesh&&) noexcept = default;
FarMesh& FarMesh::operator=(FarMesh&&) noexcept = default;
FarMesh::~FarMesh() = default;

Result<FarMesh> FarMesh::build(const ControlMesh& mesh, CreaseMethod crease_method, Index deepest,
                               const Budget& budget) {
  if (auto fits = check_far_size(mesh, deepest, budget); !fits) return fits.error();
  if (auto stop = budget.poll()) return *stop;
  const auto scheme = stoppable(budget, [&](const Pace& pace) { return far_scheme_of(mesh, pace); });
  if (!scheme) return scheme.error();
  Result<FarRefiner> made = make_refiner(mesh, crease_method, *scheme);
  if (!made) return made.error();
  if (auto stop = budget.poll()) return *stop;
  return FarMesh(std::make_unique<State>(State{&mesh, *scheme, std::move(*made), deepest, {}}));
}

namespace {

// The refiner has been refined to options.level; beyond it only where no limits are asked for.
template <class Real>
Result<FarLevel<Real>> take_level(const ControlMesh& mesh, FarScheme scheme,
                                  const Far::TopologyRefiner& refiner, const RefineOptions& options,
                                  const Pace& pace) {
  FarLevel<Real> result;
  result.level = options.level;
  result.scheme = scheme;
  result.shape = grid_shape_of(mesh, scheme, pace);
  result.base_rows = base_rows_of(mesh, pace);
  result.base_points = static_cast<Index>(mesh.point_count());
  take_topology(refiner, options.level, result, pace);
  auto control = convert_values<Real>(mesh.points, {"points"}, pace);
  if (!control) return control.error();
  result.points = interpolate(refiner, options.level, Carrier::vertex, 0, std::move(*control), 3, pace);
  if (options.limit || options.tangents || options.normals) {
    FarFrames<Real> frames = far_frames(refiner, scheme, result.points, pace);
    result.limit_points = std::move(frames.points);
    result.tangents_u = std::move(frames.tangents_u);
    result.tangents_v = std::move(frames.tangents_v);
  }

  int channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    pace.spend(1);
    auto taken = take_primvar(refiner, options, primvar, channel, result, pace);
    if (!taken) return taken.error();
    result.primvars.push_back(std::move(*taken));
    if (primvar.interpolation == Interpolation::face_varying) ++channel;
  }
  if (far_has_complained()) return far_refusal();
  return result;
}

}  // namespace

template <class Real>
Result<FarLevel<Real>> FarMesh::refine(const RefineOptions& options, const Budget& budget) {
  if (auto stop = budget.poll()) return *stop;
  // Far's limits are those of its last level; all else is the same below it.
  const bool limits = options.limit || options.tangents || options.normals;
  const Index last = limits ? options.level : state_->deepest;
  far_has_complained();  // forget what came before
  state_->refine_to(last);
  auto result = stoppable(budget, [&](const Pace& pace) {
    return take_level<Real>(*state_->mesh, state_->scheme, *state_->refiner, options, pace);
  });
  if (options.level == last) state_->unrefine();  // its memory is needed for the comparison
  return result;
}

template Result<FarLevel<float>> FarMesh::refine(const RefineOptions&, const Budget&);
template Result<FarLevel<double>> FarMesh::refine(const RefineOptions&, const Budget&);

template <class Real>
Result<FarLevel<Real>> far_refine(const ControlMesh& mesh, const RefineOptions& options,
                                  const Budget& budget) {
  Result<FarMesh> built = FarMesh::build(mesh, options.crease_method, options.level, budget);
  if (!built) return built.error();
  return built->refine<Real>(options, budget);
}

template Result<FarLevel<float>> far_refine(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<FarLevel<double>> far_refine(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd::oracle
