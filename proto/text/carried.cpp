#include "proto/text/carried.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "proto/suggest.h"

namespace subdivd::proto::text {
namespace {

// Of equal faults one sentence, with the first that has it.
class LeftOut {
 public:
  explicit LeftOut(std::string reason) : reason_(std::move(reason)) {}
  void add(const std::string& what) {
    if (count_++ == 0) first_ = what;
  }
  void report(std::vector<std::string>& warnings) const {
    if (count_ == 0) return;
    const std::string more = count_ > 1 ? " (and " + std::to_string(count_ - 1) + " more)" : "";
    warnings.push_back(first_ + more + reason_);
  }

 private:
  std::string reason_, first_;
  Count count_ = 0;
};

bool is_per_point(const Primvar& primvar) {
  return primvar.interpolation == Interpolation::vertex || primvar.interpolation == Interpolation::varying;
}

// OpenUSD's names and those that a glTF's attributes have here.
bool is_color(const Primvar& primvar) {
  return (primvar.name == "displayColor" || primvar.name == "COLOR_0") &&
         (primvar.element_size == 3 || primvar.element_size == 4);
}
bool is_texcoord(const Primvar& primvar) {
  return (primvar.name == "st" || primvar.name == "TEXCOORD_0") && primvar.element_size == 2;
}

class Decision {
 public:
  Decision(const RefineRequest& request, Format format) : request_(request), obj_(format == Format::obj) {}

  Carried decide(const Pace& pace) {
    carried_.meshes.resize(request_.meshes.size());
    for (std::size_t i = 0; i < request_.meshes.size(); ++i) {
      pace.spend(8 + 8 * request_.meshes[i].primvars.size());
      find(i);
    }
    if (!obj_) agree(pace);
    for (std::size_t i = 0; i < request_.meshes.size(); ++i) {
      pace.spend(8 + 8 * request_.meshes[i].primvars.size());
      warn_of_primvars(i);
    }
    warn();
    return std::move(carried_);
  }

 private:
  void find(std::size_t i) {
    const ControlMesh& mesh = request_.meshes[i];
    CarriedMesh& found = carried_.meshes[i];
    const auto take = [&](Index& place, std::size_t p) {
      if (place == kNoIndex) place = static_cast<Index>(p);
    };
    for (std::size_t p = 0; p < mesh.primvars.size(); ++p) {
      const Primvar& primvar = mesh.primvars[p];
      const bool of_points = is_per_point(primvar),
                 of_faces = primvar.interpolation == Interpolation::uniform;
      if (is_color(primvar) && (of_points || (of_faces && !obj_))) take(found.color, p);
      if (is_texcoord(primvar) &&
          (of_points || (obj_ && primvar.interpolation == Interpolation::face_varying)))
        take(found.texcoords, p);
      for (std::size_t kind = 0; obj_ && kind < kLabelKinds; ++kind)
        if (primvar.name == kLabelPrimvars[kind] && !names_of(request_, i, p).empty())
          take(found.labels[kind], p);
    }
    if (found.color != kNoIndex) found.color_size = obj_ ? 3 : mesh.primvars[found.color].element_size;
  }

  const Primvar* color_of(std::size_t i) const {
    const Index place = carried_.meshes[i].color;
    return place == kNoIndex ? nullptr : &request_.meshes[i].primvars[place];
  }

  // One header holds for all lines of an OFF.
  void agree(const Pace& pace) {
    const std::size_t count = carried_.meshes.size();
    bool colors = count > 0 && request_.surfaces.empty(), texcoords = colors;
    for (std::size_t i = 0; i < count; ++i) {
      pace.spend(4);
      const Primvar* const color = color_of(i);
      const Primvar* const first = color_of(0);
      colors = colors && color != nullptr && color->element_size == first->element_size &&
               is_per_point(*color) == is_per_point(*first);
      texcoords = texcoords && carried_.meshes[i].texcoords != kNoIndex;
    }
    carried_.face_colors = colors && !is_per_point(*color_of(0));
    for (CarriedMesh& mesh : carried_.meshes) {
      pace.spend(1);
      if (!colors) mesh.color = kNoIndex, mesh.color_size = 0;
      if (!texcoords) mesh.texcoords = kNoIndex;
    }
    carried_.normals =
        request_.options.normals && std::ranges::all_of(request_.surfaces, [&](const ControlPatch& surface) {
          return patch_options(request_, surface).normals;
        });
    if (request_.options.normals && !carried_.normals)
      carried_.warnings.emplace_back(
          "normals are left out: not all surfaces have them, and an OFF has one for every point or none");
  }

  void warn_of_primvars(std::size_t i) {
    const ControlMesh& mesh = request_.meshes[i];
    const CarriedMesh& carried = carried_.meshes[i];
    for (std::size_t p = 0; p < mesh.primvars.size(); ++p) {
      const auto place = static_cast<Index>(p);
      const std::string what = "primvar " + in_quotes(mesh.primvars[p].name) +
                               (mesh.name.empty() ? std::string() : " of mesh " + in_quotes(mesh.name));
      if (place == carried.color) {
        if (carried.color_size < mesh.primvars[p].element_size) opacities_.add(what);
      } else if (place != carried.texcoords &&
                 std::ranges::find(carried.labels, place) == carried.labels.end()) {
        primvars_.add(what);
      }
    }
  }

  void warn() {
    std::vector<std::string>& warnings = carried_.warnings;
    primvars_.report(warnings);
    opacities_.report(warnings);
    const Count parts = request_.meshes.size() + request_.surfaces.size();
    if (!obj_ && parts > 1)
      warnings.push_back("an OFF is one mesh: all " + std::to_string(parts) +
                         " are joined, without their names");
    const auto is_wide = [](const auto& part) { return part.width > 3; };
    if (std::ranges::any_of(request_.curves, is_wide) || std::ranges::any_of(request_.surfaces, is_wide))
      warnings.emplace_back("of points of more than 3 numbers the first 3 are written");
    if (std::ranges::any_of(request_.curves,
                            [](const ControlCurves& curves) { return curves.wrap == CurveWrap::periodic; }))
      warnings.emplace_back("a line knows no wrap: closed curves end with the point they begin with");
    if (request_.options.normals && !request_.curves.empty())
      warnings.emplace_back("tangents of curves are left out");
  }

  const RefineRequest& request_;
  const bool obj_;
  Carried carried_;
  LeftOut primvars_{
      obj_ ? " is left out: an OBJ holds displayColor of points, st, and group and material with names"
           : " is left out: an OFF holds displayColor and, of points, st, where all its meshes have them"};
  LeftOut opacities_{" is written without its fourth number"};
};

}  // namespace

Carried what_is_carried(const RefineRequest& request, Format format, const Pace& pace) {
  return Decision(request, format).decide(pace);
}

}  // namespace subdivd::proto::text
