#include "core/oracle/far.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <limits>

#include "core/oracle/far_grid.h"
#include "core/oracle/far_quirks.h"
#include "core/oracle/far_refiner.h"
#include "core/oracle/far_rows.h"

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// Values spread out by their indices; without indices as they stand.
template <class Real>
std::vector<Real> spread(std::vector<Real> values, const std::vector<Index>& indices, Index width) {
  if (indices.empty()) return values;
  std::vector<Real> result;
  result.reserve(indices.size() * width);
  for (const Index index : indices)
    result.insert(result.end(), values.begin() + std::ptrdiff_t{index} * width,
                  values.begin() + (std::ptrdiff_t{index} + 1) * width);
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

// Everything about one level but values.
template <class Real>
void take_topology(const Far::TopologyRefiner& refiner, Index depth, FarLevel<Real>& result) {
  FarGrid grid = grid_of(refiner, depth);
  const Far::TopologyLevel& level = refiner.GetLevel(static_cast<int>(depth));
  for (int v = 0; v < level.GetNumVertices(); ++v) result.vertices.push_back(describe(level, v));
  result.faces.reserve(grid.corners.size());
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    const Far::ConstIndexArray vertices = level.GetFaceVertices(face);
    const Index base = grid.base_faces[static_cast<std::size_t>(face)];
    for (int k = 0; k < 3; ++k) {
      const GridPoint corner = grid.corners[3 * static_cast<std::size_t>(face) + static_cast<std::size_t>(k)];
      Provenance& place = result.vertices[static_cast<std::size_t>(vertices[k])].place;
      if (base < place.face) place = {base, corner.i, corner.j};  // kNoIndex is the largest
      result.faces.push_back(static_cast<Index>(vertices[k]));
    }
    result.holes.push_back(level.IsFaceHole(face) ? 1 : 0);
  }
  result.corners = std::move(grid.corners);
  result.base_faces = std::move(grid.base_faces);

  for (int v = 0; v < refiner.GetLevel(0).GetNumVertices(); ++v) {  // unreferenced points
    if (refiner.GetLevel(0).GetVertexFaces(v).size() != 0) continue;
    int child = v;
    for (int l = 0; l < static_cast<int>(depth); ++l) child = refiner.GetLevel(l).GetVertexChildVertex(child);
    result.vertices[static_cast<std::size_t>(child)].place = {kNoIndex, static_cast<Index>(v), 0};
  }
}

// How a value is carried from level to level.
enum class Carrier { vertex, varying, face_varying };

template <class Real>
std::vector<Real> interpolate(const Far::TopologyRefiner& refiner, Index depth, Carrier carrier, int channel,
                              std::vector<Real> values, Index width) {
  const Far::PrimvarRefinerReal<Real> primvars(refiner);
  for (int l = 1; l <= static_cast<int>(depth); ++l) {
    const Far::TopologyLevel& level = refiner.GetLevel(l);
    const int count =
        carrier == Carrier::face_varying ? level.GetNumFVarValues(channel) : level.GetNumVertices();
    std::vector<Real> next(static_cast<std::size_t>(count) * width);
    const Rows<Real> from(values, width);
    Rows<Real> to(next, width);
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
std::vector<Real> limits(const Far::TopologyRefiner& refiner, std::vector<Real>& values, Index width) {
  std::vector<Real> result(values.size());
  Rows<Real> to(result, width);
  Far::PrimvarRefinerReal<Real>(refiner).Limit(Rows<Real>(values, width), to);
  return result;
}

template <class Real>
void take_limit_frame(const Far::TopologyRefiner& refiner, FarLevel<Real>& result) {
  const std::size_t size = result.points.size();
  result.limit_points.resize(size);
  result.tangents_u.resize(size);
  result.tangents_v.resize(size);
  Rows<Real> limit(result.limit_points, 3), u(result.tangents_u, 3), v(result.tangents_v, 3);
  Far::PrimvarRefinerReal<Real>(refiner).Limit(Rows<Real>(result.points, 3), limit, u, v);
}

template <class Real>
void take_face_varying(const Far::TopologyRefiner& refiner, const RefineOptions& options, int channel,
                       std::vector<Real> control, Index width, FarPrimvar<Real>& result) {
  const Far::TopologyLevel& level = refiner.GetLevel(static_cast<int>(options.level));
  result.values =
      interpolate(refiner, options.level, Carrier::face_varying, channel, std::move(control), width);
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    const Far::ConstIndexArray values = level.GetFaceFVarValues(face, channel);
    for (int k = 0; k < 3; ++k) result.indices.push_back(static_cast<Index>(values[k]));
  }
  result.torn_faces = faces_at_torn_values(refiner, channel);
  // At the control mesh LimitFaceVarying takes indices of values for indices of its own tags: wrong tags, and
  // a read past their end when values are left unused.
  if (!options.limit || options.level == 0) return;
  result.limit_values.resize(result.values.size());
  Rows<Real> to(result.limit_values, width);
  Far::PrimvarRefinerReal<Real>(refiner).LimitFaceVarying(Rows<Real>(result.values, width), to, channel);
}

template <class Real>
Result<FarPrimvar<Real>> take_primvar(const Far::TopologyRefiner& refiner, const RefineOptions& options,
                                      const Primvar& primvar, int channel, const FarLevel<Real>& level) {
  auto control = converted<Real>(primvar.values, {"primvars", primvar.name, "values"});
  if (!control) return control.error();
  const Index width = primvar.element_size;
  FarPrimvar<Real> result;
  if (primvar.interpolation == Interpolation::face_varying) {
    take_face_varying(refiner, options, channel, std::move(*control), width, result);
    return result;
  }
  result.values = spread(std::move(*control), primvar.indices, width);
  switch (primvar.interpolation) {
    case Interpolation::uniform:
      result.values = spread(std::move(result.values), level.base_faces, width);
      break;
    case Interpolation::vertex:
      result.values =
          interpolate(refiner, options.level, Carrier::vertex, 0, std::move(result.values), width);
      if (options.limit) result.limit_values = limits(refiner, result.values, width);
      break;
    case Interpolation::varying:
      result.values =
          interpolate(refiner, options.level, Carrier::varying, 0, std::move(result.values), width);
      break;
    default:
      break;
  }
  return result;
}

}  // namespace

// Per refined triangle: Far's own tables, ours, and for every scalar of a primvar the values of two levels
// and the limits on at most three values (every corner its own).
Count far_bytes(const ControlMesh& mesh, Index level) {
  Count per_triangle = 400;
  for (const Primvar& primvar : mesh.primvars)
    per_triangle += Count{primvar.element_size} * sizeof(double) *
                    (primvar.interpolation == Interpolation::face_varying ? 9 : 2);
  return (mesh.face_count() << (2 * level)) * per_triangle;
}

Result<void> check_far_corners(Count corners) {
  constexpr Count kMost = std::numeric_limits<int>::max();
  if (corners <= kMost) return {};
  return Error{ErrorCode::too_large,
               "the refined mesh has more face corners than OpenSubdiv can number",
               {},
               corners,
               kMost};
}

Result<void> check_far_bytes(Count bytes, const Budget& budget) {
  if (bytes <= budget.max_bytes) return {};
  return Error{ErrorCode::too_large,
               "verification would take about " + std::to_string(bytes) + " bytes; " +
                   std::to_string(budget.max_bytes) + " are allowed: choose a lower level",
               {},
               bytes,
               budget.max_bytes};
}

Result<void> check_far_size(const ControlMesh& mesh, Index level, const Budget& budget) {
  if (level > kMaxFarLevel)
    return Error{ErrorCode::out_of_range,
                 "verification reaches level " + std::to_string(kMaxFarLevel) + "; level " +
                     std::to_string(level) + " was asked for",
                 {},
                 level,
                 kMaxFarLevel};
  if (mesh.face_count() == 0 || mesh.point_count() == 0)
    return Error{
        ErrorCode::unsupported, "OpenSubdiv takes no mesh without faces", {"faceVertexIndices"}, 0, 0};
  // Far sums face corners over all levels: a third more than the last level has.
  const Count corners = (mesh.face_count() * 3 << (2 * level)) * 4 / 3 + mesh.point_count();
  if (auto fits = check_far_corners(corners); !fits) return fits;
  return check_far_bytes(far_bytes(mesh, level), budget);
}

template <class Real>
Result<FarLevel<Real>> far_refine(const ControlMesh& mesh, const RefineOptions& options,
                                  const Budget& budget) {
  if (auto fits = check_far_size(mesh, options.level, budget); !fits) return fits.error();
  Result<FarRefiner> made = make_refiner(mesh, options.crease_method);
  if (!made) return made.error();
  Far::TopologyRefiner& refiner = **made;
  if (auto stop = budget.poll()) return *stop;

  Far::TopologyRefiner::UniformOptions uniform(static_cast<int>(options.level));
  // Without it Far leaves the last level's edges out, which limits and every question about vertices need.
  uniform.fullTopologyInLastLevel = true;
  refiner.RefineUniform(uniform);
  if (auto stop = budget.poll()) return *stop;

  FarLevel<Real> result;
  result.level = options.level;
  result.base_points = static_cast<Index>(mesh.point_count());
  take_topology(refiner, options.level, result);
  auto control = converted<Real>(mesh.points, {"points"});
  if (!control) return control.error();
  result.points = interpolate(refiner, options.level, Carrier::vertex, 0, std::move(*control), 3);
  if (options.limit || options.tangents || options.normals) take_limit_frame(refiner, result);

  int channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    if (auto stop = budget.poll()) return *stop;
    auto taken = take_primvar(refiner, options, primvar, channel, result);
    if (!taken) return taken.error();
    result.primvars.push_back(std::move(*taken));
    if (primvar.interpolation == Interpolation::face_varying) ++channel;
  }
  if (const std::string complaint = take_far_error(); !complaint.empty())
    return Error{ErrorCode::unsupported, "OpenSubdiv could not refine this mesh: " + complaint, {}, 0, 0};
  return result;
}

template Result<FarLevel<float>> far_refine(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<FarLevel<double>> far_refine(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd::oracle
