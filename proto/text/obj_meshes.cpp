#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "proto/text/obj_file.h"
#include "proto/text/obj_labels.h"
#include "proto/text/request.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

// Those of all points or texture coordinates that one object uses, numbered anew.
class Selection {
 public:
  explicit Selection(Count total, const Pace& pace) : pace_(pace) {
    pace.fill(numbers_, total, 0);
    pace.fill(owners_, total, kNoIndex);
  }

  // Selects for object number `owner`, in place of the last one's. Takes n log n for n indices, for a million
  // objects must not go through all points each.
  void select(std::span<const Index> used, Index owner) {
    owner_ = owner;
    chosen_.clear();
    pace_.for_each(used.size(), [&](Count k) {
      if (std::exchange(owners_[used[k]], owner) != owner) chosen_.push_back(used[k]);
    });
    pace_.sort(chosen_.begin(), chosen_.end(), std::less<>());
    pace_.for_each(chosen_.size(), [&](Count k) { numbers_[chosen_[k]] = static_cast<Index>(k); });
  }

  const std::vector<Index>& chosen() const { return chosen_; }
  bool has(Index old) const { return owners_[old] == owner_; }
  Index number(Index old) const { return numbers_[old]; }

  std::vector<Index> numbered(std::span<const Index> used) const {
    std::vector<Index> result;
    result.reserve(used.size());
    pace_.for_each(used.size(), [&](Count k) { result.push_back(numbers_[used[k]]); });
    return result;
  }
  std::vector<double> rows(const std::vector<double>& values, std::size_t width) const {
    std::vector<double> result;
    result.reserve(width * chosen_.size());
    pace_.for_each(chosen_.size(), [&](Count k) {
      const double* row = values.data() + width * chosen_[k];
      result.insert(result.end(), row, row + width);
    });
    return result;
  }

 private:
  const Pace& pace_;
  std::vector<Index> numbers_, owners_, chosen_;
  Index owner_ = kNoIndex;
};

Error fault(Count line, const std::string& message) {
  return Error{ErrorCode::out_of_range, "line " + std::to_string(line) + ": " + message};
}

class MeshMaker {
 public:
  MeshMaker(ObjFile file, const Pace& pace) : pace_(pace), file_(std::move(file)) {}

  Result<RefineRequest> make() {
    Count with_faces = 0, with_lines = 0;
    for (std::size_t i = 0; i < file_.objects.size(); ++i) {
      pace_.spend(4);
      with_faces += face_end(i) > file_.objects[i].first_face ? 1 : 0;
      with_lines += line_end(i) > file_.objects[i].first_line ? 1 : 0;
    }
    meshes_.reserve(with_faces);
    curves_.reserve(with_lines);
    for (std::size_t i = 0; i < file_.objects.size(); ++i) {
      pace_.spend(64);
      if (line_end(i) > file_.objects[i].first_line) add_curves(i);
    }
    if (auto begun = begin_labels(); !begun) return std::move(begun).error();
    if (with_faces == 1 && with_lines == 0)
      add_only_mesh();
    else if (auto made = add_meshes(); !made)
      return std::move(made).error();
    add_warnings();
    RefineRequest request = make_request(std::move(meshes_), std::move(curves_), std::move(warnings_));
    request.primvar_names = std::move(names_);
    request.material_libraries = std::move(file_.material_libraries);
    flatten_labels(request);
    if (file_.crease_method) request.options.crease_method = *file_.crease_method;
    return request;
  }

 private:
  // Where the next object begins.
  Count next(std::size_t i, Count ObjObject::*member, Count all) const {
    return i + 1 < file_.objects.size() ? file_.objects[i + 1].*member : all;
  }
  Count face_end(std::size_t i) const { return next(i, &ObjObject::first_face, file_.face_counts.size()); }
  Count corner_end(std::size_t i) const {
    return next(i, &ObjObject::first_corner, file_.corner_points.size());
  }
  Count line_end(std::size_t i) const { return next(i, &ObjObject::first_line, file_.line_counts.size()); }
  Count line_point_end(std::size_t i) const {
    return next(i, &ObjObject::first_line_point, file_.line_points.size());
  }

  // Names take no memory yet but the body's own.
  Result<void> begin_labels() {
    if (file_.labels[kGroup].empty() && file_.labels[kMaterial].empty()) return {};
    auto labels = ObjLabels::make(file_, pace_);
    if (!labels) return std::move(labels).error();
    labels_ = *std::move(labels);
    std::vector<ObjLabels::Range> faces;
    for (std::size_t i = 0; i < file_.objects.size(); ++i) {
      pace_.spend(4);
      if (face_end(i) > file_.objects[i].first_face)
        faces.push_back({file_.objects[i].first_face, face_end(i)});
    }
    constexpr Count kGrowing = 3;  // while an array that grows is moved
    if (auto stopped = take(pace_.budget(), kGrowing * labels_->name_bytes(faces, pace_)))
      return *std::move(stopped);
    names_.reserve(faces.size());
    return {};
  }

  // After all other primvars.
  void add_labels(ControlMesh& mesh, ObjLabels::Range faces) {
    if (labels_) labels_->add(faces, mesh, names_.emplace_back(), pace_);
  }

  // One number for each face, in a JSON answer.
  void flatten_labels(RefineRequest& request) const {
    for (std::size_t i = 0; i < request.primvar_names.size(); ++i)
      for (std::size_t p = 0; p < request.primvar_names[i].size(); ++p) {
        pace_.spend(1);
        if (!request.primvar_names[i][p].empty()) request.mesh_forms[i].primvars[p] = ArrayForm::flat;
      }
  }

  void add_curves(std::size_t i) {
    const ObjObject& object = file_.objects[i];
    ControlCurves& curves = curves_.emplace_back();
    curves.name = joined_line(object.name);
    const std::span all_points(file_.line_points);
    const auto used =
        all_points.subspan(object.first_line_point, line_point_end(i) - object.first_line_point);
    curves.points.reserve(3 * used.size());
    pace_.for_each(used.size(), [&](Count k) {
      const double* point = file_.points.data() + 3 * Count{used[k]};
      curves.points.insert(curves.points.end(), point, point + 3);
    });
    if (line_end(i) - object.first_line == 1) return;
    const std::span all_counts(file_.line_counts);
    pace_.copy(all_counts.subspan(object.first_line, line_end(i) - object.first_line), curves.vertex_counts);
  }

  ControlMesh& begin_mesh(std::string_view name, std::vector<Index> counts) {
    ControlMesh& mesh = meshes_.emplace_back();
    mesh.name = joined_line(name);
    bool triangles = true;
    pace_.for_each(counts.size(), [&](Count k) { triangles &= counts[k] == 3; });
    if (!triangles) mesh.face_vertex_counts = std::move(counts);
    if (file_.boundary) mesh.interpolate_boundary = *file_.boundary;
    if (file_.face_varying) mesh.face_varying_linear_interpolation = *file_.face_varying;
    if (file_.triangle_rule) mesh.triangle_subdivision_rule = *file_.triangle_rule;
    return mesh;
  }

  // Whether all points have colours.
  bool is_colored(const std::vector<double>& colors) {
    Count with = 0;
    pace_.for_each(colors.size(), [&](Count k) { with += std::isnan(colors[k]) ? 0 : 1; });
    half_colored_ |= with != 0 && with != colors.size();
    return with != 0 && with == colors.size();
  }

  // Whether all corners have texture coordinates.
  bool is_textured(std::span<const Index> texcoords) {
    Count with = 0;
    pace_.for_each(texcoords.size(), [&](Count k) { with += texcoords[k] != kNoIndex ? 1 : 0; });
    half_textured_ |= with != 0 && with != texcoords.size();
    return with != 0 && with == texcoords.size();
  }

  void add_only_mesh() {
    std::size_t i = 0;
    while (face_end(i) == file_.objects[i].first_face) ++i;
    const Count faces = file_.face_counts.size();
    ControlMesh& mesh = begin_mesh(file_.objects[i].name, std::move(file_.face_counts));
    mesh.points = std::move(file_.points);
    mesh.face_vertex_indices = std::move(file_.corner_points);
    if (is_colored(file_.colors))
      add_primvar(mesh, "displayColor", Interpolation::vertex, 3, std::move(file_.colors));
    if (is_textured(file_.corner_texcoords))
      add_primvar(mesh, "st", Interpolation::face_varying, 2, std::move(file_.texcoords),
                  std::move(file_.corner_texcoords));
    add_labels(mesh, {0, faces});
    pace_.for_each(file_.creases.size(), [&](Count k) {
      const ObjCrease& crease = file_.creases[k];
      add_crease(mesh, crease.a, crease.b, crease.sharpness);
    });
    pace_.for_each(file_.corners.size(), [&](Count k) {
      mesh.corner_indices.push_back(file_.corners[k].point);
      mesh.corner_sharpnesses.push_back(file_.corners[k].sharpness);
    });
    pace_.for_each(file_.holes.size(), [&](Count k) { mesh.hole_indices.push_back(file_.holes[k].face); });
  }

  static void add_crease(ControlMesh& mesh, Index a, Index b, float sharpness) {
    mesh.crease_indices.push_back(a);
    mesh.crease_indices.push_back(b);
    mesh.crease_lengths.push_back(2);
    mesh.crease_sharpnesses.push_back(sharpness);
  }

  Result<void> add_meshes() {
    Selection points(file_.points.size() / 3, pace_), texcoords(file_.texcoords.size() / 2, pace_);
    for (std::size_t i = 0; i < file_.objects.size(); ++i) {
      pace_.spend(64);
      const ObjObject& object = file_.objects[i];
      const Count first = object.first_corner, size = corner_end(i) - first;
      const auto used = std::span(file_.corner_points).subspan(first, size);
      points.select(used, static_cast<Index>(i));
      if (size > 0)
        add_mesh(i, used, std::span(file_.corner_texcoords).subspan(first, size), points, texcoords);
      if (auto done = add_tags(i, size > 0 ? &meshes_.back() : nullptr, points); !done) return done;
    }
    return {};
  }

  void add_mesh(std::size_t i, std::span<const Index> used, std::span<const Index> used_texcoords,
                const Selection& points, Selection& texcoords) {
    const ObjObject& object = file_.objects[i];
    std::vector<Index> counts;
    pace_.copy(std::span(file_.face_counts).subspan(object.first_face, face_end(i) - object.first_face),
               counts);
    ControlMesh& mesh = begin_mesh(object.name, std::move(counts));
    mesh.points = points.rows(file_.points, 3);
    mesh.face_vertex_indices = points.numbered(used);
    if (!file_.colors.empty())
      if (auto colors = points.rows(file_.colors, 3); is_colored(colors))
        add_primvar(mesh, "displayColor", Interpolation::vertex, 3, std::move(colors));
    if (is_textured(used_texcoords)) {
      texcoords.select(used_texcoords, static_cast<Index>(i));
      add_primvar(mesh, "st", Interpolation::face_varying, 2, texcoords.rows(file_.texcoords, 2),
                  texcoords.numbered(used_texcoords));
    }
    add_labels(mesh, {object.first_face, face_end(i)});
  }

  // Those that stand behind this object's `o`.
  Result<void> add_tags(std::size_t i, ControlMesh* mesh, const Selection& points) {
    const auto is_here = [&](Index point) { return mesh != nullptr && points.has(point); };
    const auto stranger = [](Count line, const char* what, Index index) {
      return fault(line, std::string(what) + ' ' + std::to_string(index) +
                             " does not belong to the object in which the tag stands");
    };
    for (; crease_ < file_.creases.size() && file_.creases[crease_].object == i; ++crease_) {
      pace_.spend(1);
      const ObjCrease& crease = file_.creases[crease_];
      for (const Index point : {crease.a, crease.b})
        if (!is_here(point)) return stranger(crease.line, "point", point);
      add_crease(*mesh, points.number(crease.a), points.number(crease.b), crease.sharpness);
    }
    for (; corner_ < file_.corners.size() && file_.corners[corner_].object == i; ++corner_) {
      pace_.spend(1);
      const ObjCorner& corner = file_.corners[corner_];
      if (!is_here(corner.point)) return stranger(corner.line, "point", corner.point);
      mesh->corner_indices.push_back(points.number(corner.point));
      mesh->corner_sharpnesses.push_back(corner.sharpness);
    }
    for (; hole_ < file_.holes.size() && file_.holes[hole_].object == i; ++hole_) {
      pace_.spend(1);
      const ObjHole& hole = file_.holes[hole_];
      const Count first = file_.objects[i].first_face;
      if (hole.face < first || hole.face >= face_end(i)) return stranger(hole.line, "face", hole.face);
      mesh->hole_indices.push_back(static_cast<Index>(hole.face - first));
    }
    return {};
  }

  void add_warnings() {
    if (file_.has_groups)
      warnings_.emplace_back("smoothing groups of the OBJ, and maps and shadows, are not kept.");
    if (file_.has_others)
      warnings_.emplace_back(
          "points, free-form curves and surfaces and what tells how to render are left out.");
    if (file_.has_other_tags) warnings_.emplace_back("tags of hierarchical edits are left out.");
    if (half_colored_)
      warnings_.emplace_back("colours of points are left out: not all points of the mesh have one.");
    if (half_textured_)
      warnings_.emplace_back(
          "texture coordinates of meshes that have them at some corners only are left out.");
  }

  const Pace& pace_;
  ObjFile file_;
  bool half_colored_ = false, half_textured_ = false;
  std::size_t crease_ = 0, corner_ = 0, hole_ = 0;
  std::optional<ObjLabels> labels_;  // where the file has any
  std::vector<std::vector<NameList>> names_;
  std::vector<ControlMesh> meshes_;
  std::vector<ControlCurves> curves_;
  std::vector<std::string> warnings_;
};

}  // namespace

Result<RefineRequest> make_meshes(ObjFile file, const Pace& pace) {
  return MeshMaker(std::move(file), pace).make();
}

}  // namespace subdivd::proto::text
