#include "core/oracle/far_polygons.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <utility>

#include "core/base/pace.h"
#include "core/oracle/far_refiner.h"
#include "core/oracle/far_rows.h"

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;

// A face of Far's, and which of its corners is the first of ours.
struct TurnedFace {
  int face = 0, first = 0;
};

// Far's vertex at corner k of the face.
int vertex_at(const Far::TopologyLevel& level, TurnedFace turned, int k) {
  const Far::ConstIndexArray vertices = level.GetFaceVertices(turned.face);
  return vertices[(turned.first + k) % vertices.size()];
}

// The child at every corner of every face, turned to begin with the child of the corner's vertex.
std::vector<TurnedFace> children(const Far::TopologyLevel& parent, const Far::TopologyLevel& child,
                                 const std::vector<TurnedFace>& faces, const Pace& pace) {
  std::vector<TurnedFace> result;
  for (const TurnedFace& turned : faces) {
    const Far::ConstIndexArray below = parent.GetFaceChildFaces(turned.face);
    for (int k = 0; k < below.size(); ++k) {
      pace.spend(8);
      TurnedFace at{below[(turned.first + k) % below.size()], 0};
      const int first = parent.GetVertexChildVertex(vertex_at(parent, turned, k));
      const int size = child.GetFaceVertices(at.face).size();
      while (at.first < size && vertex_at(child, {at.face, at.first}, 0) != first) ++at.first;
      result.push_back(at);
    }
  }
  return result;
}

std::vector<Index> corners_of(const Far::TopologyLevel& level, const std::vector<TurnedFace>& faces,
                              const Pace& pace) {
  std::vector<Index> corners;
  for (const TurnedFace& turned : faces)
    for (int k = 0; k < level.GetFaceVertices(turned.face).size(); ++k) {
      pace.spend(1);
      corners.push_back(static_cast<Index>(vertex_at(level, turned, k)));
    }
  return corners;
}

Result<std::vector<FarPolygons>> refine_all(const ControlMesh& mesh, const FarPolygonRules& rules,
                                            Index level, const Pace& pace) {
  ControlMesh ruled = mesh;
  ruled.triangle_subdivision_rule = rules.triangles;
  auto made = make_refiner(ruled, rules.crease_method,
                           rules.bilinear ? FarScheme::bilinear : FarScheme::catmull_clark);
  if (!made) return made.error();
  Far::TopologyRefiner& refiner = **made;
  Far::TopologyRefiner::UniformOptions uniform(static_cast<int>(level));
  uniform.fullTopologyInLastLevel = true;
  refiner.RefineUniform(uniform);

  std::vector<TurnedFace> faces;
  for (int f = 0; f < refiner.GetLevel(0).GetNumFaces(); ++f) faces.push_back({f, 0});
  Buffer<double> points(mesh.points.begin(), mesh.points.end());
  std::vector<FarPolygons> levels;
  for (int depth = 0;; ++depth) {
    const Far::TopologyLevel& here = refiner.GetLevel(depth);
    levels.push_back({{points.begin(), points.end()}, corners_of(here, faces, pace)});
    if (depth == static_cast<int>(level)) break;
    const Far::TopologyLevel& below = refiner.GetLevel(depth + 1);
    faces = children(here, below, faces, pace);
    Buffer<double> next(Count{3} * static_cast<Count>(below.GetNumVertices()));
    Rows<double> target(next, 3, pace);
    Far::PrimvarRefinerReal<double>(refiner).Interpolate(depth + 1, Rows<double>(points, 3, pace), target);
    points = std::move(next);
  }
  if (far_has_complained()) return far_refusal();
  return levels;
}

}  // namespace

Result<std::vector<FarPolygons>> far_refine_polygons(const ControlMesh& mesh, const FarPolygonRules& rules,
                                                     Index level, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return refine_all(mesh, rules, level, pace); });
}

}  // namespace subdivd::oracle
