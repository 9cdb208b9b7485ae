#include <algorithm>
#include <string>

#include "core/base/pace.h"
#include "core/curves/subdivision.h"
#include "proto/json/number_text.h"
#include "proto/text/carried.h"
#include "proto/text/sections.h"
#include "proto/text/text_cursor.h"
#include "proto/text/write.h"

namespace subdivd::proto::text {
namespace {

using json::digits_of;

// Of one part or of all: what its faces and lines name.
struct Numbered {
  Count points = 0, texcoords = 0, normals = 0;
};

class Prediction {
 public:
  Prediction(const RefineRequest& request, const Pace& pace)
      : request_(request),
        pace_(pace),
        obj_(answer_format(request) == Format::obj),
        number_(answer_precision(request) == Precision::single_precision ? json::kRealText<float>
                                                                         : json::kRealText<double>) {}

  PredictedText predict(const std::vector<RefinedSize>& sizes) {
    const Carried carried = what_is_carried(request_, answer_format(request_), pace_);
    text_.bytes = kHeadText;
    for (const std::string& warning : request_.warnings) text_.bytes += warning.size() + 3;
    for (const std::string& warning : carried.warnings) text_.bytes += warning.size() + 3;
    const NameList& libraries = request_.material_libraries;
    if (obj_) text_.bytes += libraries.text_size() + 8 * libraries.size();
    text_.held_bytes += 4 * (libraries.text_size() + 8 * libraries.size());
    for (std::size_t i = 0; i < request_.meshes.size(); ++i) add_mesh(i, carried.meshes[i], sizes[i]);
    for (const ControlCurves& curves : request_.curves) add_curves(curves);
    for (const ControlPatch& surface : request_.surfaces) add_surface(surface);
    text_.held_bytes += chunk_bytes(text_.bytes);
    return text_;
  }

 private:
  static constexpr Count kHeadText = 1024, kPartText = 8, kPartBytes = 1536;

  // Names are not made longer for a line.
  void begin_part(const std::string& name) {
    pace_.spend(16);
    text_.bytes += kPartText + std::min<Count>(name.size(), kMaxWordBytes);
    text_.held_bytes += kPartBytes + name.size();
  }

  // With the word before it, or what an OFF has in its place.
  Count row(Count numbers) const { return 3 + numbers * number_; }

  void add_mesh(std::size_t i, const CarriedMesh& carried, const RefinedSize& size) {
    const ControlMesh& mesh = request_.meshes[i];
    begin_part(mesh.name);
    const Count vertices = size.counts.vertices, faces = size.counts.faces;
    const Count texcoords = texcoords_of(mesh, carried, size);
    const bool normals = request_.options.normals;
    // An OFF's colours have ".0" behind whole numbers.
    text_.bytes += vertices * (row(3) + carried.color_size * (number_ + 2)) + texcoords * row(2) +
                   (normals ? vertices * row(3) : 0);
    if (!obj_) text_.bytes += faces * carried.color_size * (number_ + 2);
    all_.points += vertices;
    all_.texcoords += texcoords;
    all_.normals += normals ? vertices : 0;
    const Count largest = size.counts.face_size != 0 ? size.counts.face_size : size.corners;
    add_faces(faces, size.corners, largest, texcoords > 0, normals);
    add_labels(i, carried);
  }

  static Count texcoords_of(const ControlMesh& mesh, const CarriedMesh& carried, const RefinedSize& size) {
    if (carried.texcoords == kNoIndex) return 0;
    if (mesh.primvars[carried.texcoords].interpolation != Interpolation::face_varying)
      return size.counts.vertices;
    const auto is_channel = [](const Primvar& primvar) {
      return primvar.interpolation == Interpolation::face_varying;
    };
    const auto first = mesh.primvars.begin();
    return size.channel_values[static_cast<std::size_t>(
        std::count_if(first, first + static_cast<std::ptrdiff_t>(carried.texcoords), is_channel))];
  }

  void add_faces(Count faces, Count corners, Count largest, bool texcoords, bool normals) {
    Count corner = 1 + digits_of(all_.points);
    if (obj_ && texcoords) corner += 1 + digits_of(all_.texcoords);
    if (obj_ && normals) corner += 2 + digits_of(all_.normals);
    text_.bytes += corners * corner + faces * (1 + digits_of(largest));
  }

  // Refined faces follow their base faces: names change as often as they do there, holes included.
  void add_labels(std::size_t i, const CarriedMesh& carried) {
    const ControlMesh& mesh = request_.meshes[i];
    for (std::size_t kind = 0; kind < kLabelKinds; ++kind) {
      constexpr Count kWords = 9;  // "usemtl " and the end of the line
      text_.bytes += kWords;       // where the last mesh's name ends
      if (carried.labels[kind] == kNoIndex) continue;
      const Primvar& primvar = mesh.primvars[carried.labels[kind]];
      const NameList& names = names_of(request_, i, carried.labels[kind]);
      text_.held_bytes += NameList::bytes_of(names.size(), names.text_size());
      Count last = names.size();
      pace_.for_each(mesh.face_count(), [&](Count face) {
        const Count at = primvar.indices.empty() ? face : Count{primvar.indices[face]};
        const auto name = static_cast<Count>(primvar.values[at]);
        if (std::exchange(last, name) != name)
          text_.bytes += kWords + std::min<Count>(names[name].size(), kMaxWordBytes);
      });
    }
  }

  void add_curves(const ControlCurves& curves) {
    begin_part(curves.name);
    const Count points = total_point_count(curves, request_.options.level, pace_);
    all_.points += points;
    text_.bytes +=
        points * (row(3) + 1 + digits_of(all_.points)) + curves.curve_count() * (3 + digits_of(all_.points));
  }

  void add_surface(const ControlPatch& patch) {
    begin_part(patch.name);
    const Index level = request_.options.level;
    const Count u = refined_grid_count(patch.u_wrap, patch.u_degree, patch.u_count, level),
                v = refined_grid_count(patch.v_wrap, patch.v_degree, patch.v_count, level);
    const bool normals = patch_options(request_, patch).normals;
    const bool triangles = answer_faces(request_) == proto::Faces::triangles;
    all_.points += u * v;
    all_.normals += normals ? u * v : 0;
    text_.bytes += u * v * (normals ? 2 : 1) * row(3);
    add_faces((triangles ? 2 : 1) * u * v, (triangles ? 6 : 4) * u * v, 4, false, normals);
  }

  const RefineRequest& request_;
  const Pace& pace_;
  const bool obj_;
  const Count number_;
  Numbered all_;
  PredictedText text_;
};

}  // namespace

Result<PredictedText> predict(const RefineRequest& request, const std::vector<RefinedSize>& meshes,
                              const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return Prediction(request, pace).predict(meshes); });
}

}  // namespace subdivd::proto::text
