#include "proto/json/locate.h"

#include <algorithm>
#include <utility>

namespace subdivd::proto::json {
namespace {

struct Entry {
  std::uint64_t list = 0, position = 0;
};

// Which list of `lengths` (empty: lists of three) holds the flat index k.
Entry entry_of(std::uint64_t k, const std::vector<Index>& lengths) {
  if (lengths.empty()) return {k / 3, k % 3};
  std::uint64_t list = 0;
  while (list < lengths.size() && k >= lengths[list]) k -= lengths[list++];
  return {list, k};
}

// The corner as read of a present corner.
std::uint64_t original_corner(std::uint64_t corner, const FaceHistory& history) {
  if (!history.kept.empty()) corner = std::uint64_t{3} * history.kept[corner / 3] + corner % 3;
  return history.triangulated.empty() ? corner : history.corners[corner];
}

void split(Path& where, std::uint64_t width) {
  const std::uint64_t k = std::get<std::uint64_t>(where.back());
  where.back() = k / width;
  where.emplace_back(k % width);
}

void split(Path& where, const std::vector<Index>& lengths) {
  const Entry entry = entry_of(std::get<std::uint64_t>(where.back()), lengths);
  where.back() = entry.list;
  where.emplace_back(entry.position);
}

// Where an edge of the creases as they are now, each of two points, stood in the body.
struct CreaseEdge {
  std::uint64_t point = 0, edge = 0, crease = 0;
};

// The edges that were left are those that were there, in their order.
CreaseEdge original_edge(std::uint64_t edge, const ControlMesh& mesh, const FaceHistory& history) {
  CreaseEdge at;
  std::uint64_t found = 0;
  for (at.crease = 0; at.crease < history.crease_lengths.size(); ++at.crease, ++at.point)
    for (Index k = 0; k + 1 < history.crease_lengths[at.crease]; ++k, ++at.edge, ++at.point) {
      const bool left = mesh.crease_indices[2 * found] == history.crease_indices[at.point] &&
                        mesh.crease_indices[2 * found + 1] == history.crease_indices[at.point + 1];
      if (left && found++ == edge) return at;
    }
  return at;  // not reached
}

// Leaving out faces may have cut creases.
bool were_cut(const ControlMesh& mesh, const FaceHistory& history) {
  return !history.kept.empty() && mesh.crease_indices != history.crease_indices;
}

void locate_crease(Path& where, const ControlMesh& mesh, const JsonMeshForm& form,
                   const FaceHistory& history) {
  const std::string field = std::get<std::string>(where[0]);
  const bool cut = were_cut(mesh, history);
  std::uint64_t& k = std::get<std::uint64_t>(where[1]);
  if (field == "creaseSharpnesses" && cut) {
    const CreaseEdge edge = original_edge(k, mesh, history);
    k = history.sharp_edges ? edge.edge : edge.crease;
  }
  if (field == "creaseIndices") {
    if (cut) k = original_edge(k / 2, mesh, history).point + k % 2;
    if (form.creases == ArrayForm::nested) split(where, cut ? history.crease_lengths : mesh.crease_lengths);
  }
  if (field == "creaseLengths" && form.creases == ArrayForm::nested) where[0] = "creaseIndices";
}

void locate_primvar(Path& where, const ControlMesh& mesh, const JsonMeshForm& form,
                    const FaceHistory& history) {
  const std::string& name = std::get<std::string>(where[1]);
  const auto primvar = std::ranges::find(mesh.primvars, name, &Primvar::name);
  if (primvar == mesh.primvars.end()) return;
  const auto number = static_cast<std::size_t>(primvar - mesh.primvars.begin());
  if (where[2] == PathStep("values") && form.primvars[number] == ArrayForm::nested)
    split(where, primvar->element_size);
  if (where[2] != PathStep("indices") || !history.changed()) return;
  std::uint64_t& k = std::get<std::uint64_t>(where.back());
  if (primvar->interpolation == Interpolation::face_varying) k = original_corner(k, history);
  if (primvar->interpolation == Interpolation::uniform) k = history.original_face(static_cast<Index>(k));
}

}  // namespace

Index FaceHistory::original_face(Index face) const {
  const Index triangle = kept.empty() ? face : kept[face];
  return triangulated.empty() ? triangle : triangulated[triangle];
}

std::vector<Index> FaceHistory::original_faces() const {
  if (kept.empty()) return triangulated;
  std::vector<Index> faces(kept.size());
  for (Index f = 0; f < faces.size(); ++f) faces[f] = original_face(f);
  return faces;
}

Path locate(Path where, const ControlMesh& mesh, const JsonMeshForm& form, const FaceHistory& history) {
  if (where.size() < 2 || !std::holds_alternative<std::string>(where.front())) return where;
  const std::string field = std::get<std::string>(where.front());
  if (field == "primvars") {
    if (where.size() == 4) locate_primvar(where, mesh, form, history);
    return where;
  }
  if (!std::holds_alternative<std::uint64_t>(where[1])) return where;
  if (field == "points" && form.points == ArrayForm::nested) split(where, 3);
  if (field == "faceVertexIndices") {
    std::uint64_t& corner = std::get<std::uint64_t>(where[1]);
    if (history.changed()) corner = original_corner(corner, history);
    if (form.faces == ArrayForm::nested)
      split(where, history.changed() ? history.counts : mesh.face_vertex_counts);
  }
  if (field == "faceVertexCounts" && form.faces == ArrayForm::nested) where[0] = "faceVertexIndices";
  if (field.starts_with("crease")) locate_crease(where, mesh, form, history);
  return where;
}

Path locate(Path where, const ControlCurves& curves, const JsonCurvesForm& form) {
  if (where.size() != 2 || !std::holds_alternative<std::uint64_t>(where[1])) {
    if (where == Path{"order"} && form.order_list) where.emplace_back(std::uint64_t{0});
    return where;
  }
  if (where[0] == PathStep("points") && form.points == ArrayForm::nested) split(where, curves.width);
  if (where[0] == PathStep("ranges") && form.ranges == ArrayForm::flat)
    std::get<std::uint64_t>(where[1]) *= 2;
  return where;
}

Path locate(Path where, const ControlPatch& surface, const JsonSurfaceForm& form) {
  if (where.empty()) return where;
  const bool point = where.size() == 2 && where[0] == PathStep("points");
  if (point && form.points == ArrayForm::nested) split(where, surface.width);
  if (where.size() > 1) return where;
  // Of what the body does not say itself, the member that it followed from is to blame.
  const auto is = [&](const char* name) { return where[0] == PathStep(name); };
  if ((is("uDegree") && !form.u_degree) || (is("vDegree") && !form.v_degree)) where[0] = "degree";
  if (is("width") || (is("uVertexCount") && !form.u_count) || (is("vVertexCount") && !form.v_count))
    where[0] = "points";
  return where;
}

}  // namespace subdivd::proto::json
