#include "core/oracle/far.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/pace.h"
#include "core/oracle/far_cost.h"
#include "core/oracle/far_grid.h"
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

FarVertex describe(const Far::TopologyLevel& level, int vertex) {
  FarVertex described;
  described.rule = rule_of(level, vertex);
  described.faces = static_cast<Index>(level.GetVertexFaces(vertex).size());
  described.boundary = level.IsVertexBoundary(vertex);
  described.non_manifold = level.IsVertexNonManifold(vertex);
  described.semi_sharp = level.IsVertexSemiSharp(vertex);
  const Far::ConstIndexArray edges = level.GetVertexEdges(vertex);
  for (int k = 0; k < edges.size(); ++k) described.semi_sharp |= level.IsEdgeSemiSharp(edges[k]);
  return described;
}

// The lowest base face of every vertex and the place there; the corners must stand in `result`.
template <class Real>
void take_faces(const Far::TopologyLevel& level, FarLevel<Real>& result, const Pace& pace) {
  const auto faces = static_cast<std::size_t>(level.GetNumFaces());
  result.faces.resize(3 * faces);
  result.holes.resize(faces);
  for (std::size_t face = 0; face < faces; ++face) {
    pace.spend(4);
    const Far::ConstIndexArray vertices = level.GetFaceVertices(static_cast<int>(face));
    const Index base = result.base_faces[face];
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = 3 * face + static_cast<std::size_t>(k);
      const GridPoint corner = result.corners[at];
      Provenance& place = result.vertices[static_cast<std::size_t>(vertices[k])].place;
      if (base < place.face) place = {base, corner.i, corner.j};  // kNoIndex is the largest
      result.faces[at] = static_cast<Index>(vertices[k]);
    }
    result.holes[face] = level.IsFaceHole(static_cast<int>(face)) ? 1 : 0;
  }
}

// Everything about one level but values.
template <class Real>
void take_topology(const Far::TopologyRefiner& refiner, Index depth, FarLevel<Real>& result,
                   const Pace& pace) {
  FarGrid grid = grid_of(refiner, depth, pace);
  result.corners = std::move(grid.corners);
  result.base_faces = std::move(grid.base_faces);
  const Far::TopologyLevel& level = refiner.GetLevel(static_cast<int>(depth));
  result.vertices.reserve(static_cast<std::size_t>(level.GetNumVertices()));
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    pace.spend(4 + static_cast<Count>(level.GetVertexEdges(v).size()));
    result.vertices.push_back(describe(level, v));
  }
  take_faces(level, result, pace);

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
Buffer<Real> limits(const Far::TopologyRefiner& refiner, Buffer<Real>& values, Index width,
                    const Pace& pace) {
  Buffer<Real> result(values.size());
  Rows<Real> to(result, width, pace);
  Far::PrimvarRefinerReal<Real>(refiner).Limit(Rows<Real>(values, width, pace), to);
  return result;
}

template <class Real>
void take_limit_frame(const Far::TopologyRefiner& refiner, FarLevel<Real>& result, const Pace& pace) {
  const std::size_t size = result.points.size();
  result.limit_points.resize(size);
  result.tangents_u.resize(size);
  result.tangents_v.resize(size);
  Rows<Real> limit(result.limit_points, 3, pace), u(result.tangents_u, 3, pace),
      v(result.tangents_v, 3, pace);
  Far::PrimvarRefinerReal<Real>(refiner).Limit(Rows<Real>(result.points, 3, pace), limit, u, v);
}

template <class Real>
void take_face_varying(const Far::TopologyRefiner& refiner, const RefineOptions& options, int channel,
                       Buffer<Real> control, Index width, FarPrimvar<Real>& result, const Pace& pace) {
  const Far::TopologyLevel& level = refiner.GetLevel(static_cast<int>(options.level));
  result.values =
      interpolate(refiner, options.level, Carrier::face_varying, channel, std::move(control), width, pace);
  result.indices.reserve(static_cast<std::size_t>(level.GetNumFaces()) * 3);
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    pace.spend(3);
    const Far::ConstIndexArray values = level.GetFaceFVarValues(face, channel);
    for (int k = 0; k < 3; ++k) result.indices.push_back(static_cast<Index>(values[k]));
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
      if (options.limit) result.limit_values = limits(refiner, result.values, width, pace);
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

Result<void> check_far_corners(Count corners) {
  constexpr Count kMost = std::numeric_limits<int>::max();
  if (corners <= kMost) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "the refined mesh has more face corners than OpenSubdiv can number",
               .predicted = corners,
               .allowed = kMost};
}

Result<void> check_far_bytes(Count bytes, const Budget& budget) {
  if (bytes <= budget.max_bytes) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "verification would take about " + std::to_string(bytes) + " bytes; " +
                          std::to_string(budget.max_bytes) + " are allowed: choose a lower level",
               .predicted = bytes,
               .allowed = budget.max_bytes};
}

Result<void> check_far_size(const ControlMesh& mesh, Index level, const Budget& budget) {
  if (level > kMaxFarLevel)
    return Error{.code = ErrorCode::out_of_range,
                 .message = "verification reaches level " + std::to_string(kMaxFarLevel) + "; level " +
                            std::to_string(level) + " was asked for",
                 .predicted = level,
                 .allowed = kMaxFarLevel};
  if (mesh.face_count() == 0 || mesh.point_count() == 0)
    return Error{ErrorCode::unsupported, "OpenSubdiv takes no mesh without faces", {"faceVertexIndices"}};
  // Far sums face corners over all levels: a third more than the last level has.
  const Count corners = (mesh.face_count() * 3 * triangles_per_face(level)) * 4 / 3 + mesh.point_count();
  if (auto fits = check_far_corners(corners); !fits) return fits;
  if (auto fits = check_far_bytes(far_mesh_bytes(mesh, level), budget); !fits) return fits;
  const auto load = far_load(mesh, budget);
  if (!load) return load.error();
  return check_far_time(*load, level);
}

struct FarMesh::State {
  const ControlMesh* mesh;
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
  Result<FarRefiner> made = make_refiner(mesh, crease_method);
  if (!made) return made.error();
  if (auto stop = budget.poll()) return *stop;
  return FarMesh(std::make_unique<State>(State{&mesh, std::move(*made), deepest, {}}));
}

namespace {

// The refiner has been refined to options.level; beyond it only where no limits are asked for.
template <class Real>
Result<FarLevel<Real>> take_level(const ControlMesh& mesh, const Far::TopologyRefiner& refiner,
                                  const RefineOptions& options, const Pace& pace) {
  FarLevel<Real> result;
  result.level = options.level;
  result.base_points = static_cast<Index>(mesh.point_count());
  take_topology(refiner, options.level, result, pace);
  auto control = convert_values<Real>(mesh.points, {"points"}, pace);
  if (!control) return control.error();
  result.points = interpolate(refiner, options.level, Carrier::vertex, 0, std::move(*control), 3, pace);
  if (options.limit || options.tangents || options.normals) take_limit_frame(refiner, result, pace);

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
    return take_level<Real>(*state_->mesh, *state_->refiner, options, pace);
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
