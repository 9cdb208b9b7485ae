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
  std::uint64_t face = corner / 3, k = corner % 3;
  if (!history.kept.empty()) face = history.kept[face];
  if (history.triangulated.empty()) return 3 * face + k;
  // Triangle j of a fan has the corners 0, j + 1, j + 2 of its face.
  const Index original = history.triangulated[face];
  const auto first = std::ranges::lower_bound(history.triangulated, original) - history.triangulated.begin();
  const std::uint64_t j = face - static_cast<std::uint64_t>(first);
  std::uint64_t offset = 0;
  for (Index f = 0; f < original; ++f) offset += history.counts[f];
  return offset + (k == 0 ? 0 : j + k);
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
  // Leaving out faces may have cut creases and thinned out holes: their numbers are no longer the caller's.
  if (history.changed() && (field == "holeIndices" || field.starts_with("crease"))) {
    where.resize(1);
    return where;
  }
  if (form.creases == ArrayForm::nested) {
    if (field == "creaseIndices") split(where, mesh.crease_lengths);
    if (field == "creaseLengths") where[0] = "creaseIndices";
  }
  return where;
}

Path locate(Path where, const ControlCurves& curves, ArrayForm form) {
  const bool point = where.size() == 2 && where[0] == PathStep("points");
  if (point && form == ArrayForm::flat) std::get<std::uint64_t>(where[1]) *= curves.width;
  return where;
}

}  // namespace subdivd::proto::json
