#include <string>

#include "core/curves/subdivision.h"
#include "core/refine/refine.h"
#include "core/splines/spline.h"
#include "proto/json/json.h"
#include "proto/json/number_text.h"

namespace subdivd::proto::json {
namespace {

constexpr Count kMemberText = 512;  // names and brackets of the members of one mesh or primvar

// What escaping makes of a name at worst: \u0001.
Count name_text(const std::string& name) { return 6 * Count{name.size()} + 2; }

// Two brackets per tuple whatever the form.
Count tuples_text(Count tuples, Count width, Count number) { return tuples * (width * number + 2) + 2; }
Count indices_text(Count count, Count values) { return count * (digits_of(values) + 1) + 2; }

// Quoted, escaped and with commas.
Count names_text(const NameList& names) { return 6 * names.text_size() + 3 * names.size(); }

Count mesh_text(const ControlMesh& mesh, const RefinedSize& size, Count number, bool normals) {
  const Count vertices = size.counts.vertices, faces = size.counts.faces, corners = size.corners;
  Count bytes = kMemberText + name_text(mesh.name) + tuples_text(vertices, 3, number) + 2 * faces +
                indices_text(corners, vertices);
  if (size.counts.face_size != 3) bytes += indices_text(faces, corners);
  if (normals) bytes += tuples_text(vertices, 3, number);
  std::size_t channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    Count values = 1;
    switch (primvar.interpolation) {
      case Interpolation::constant:
        values = 1;
        break;
      case Interpolation::uniform:
        values = faces;
        break;
      case Interpolation::varying:
      case Interpolation::vertex:
        values = vertices;
        break;
      case Interpolation::face_varying:
        values = size.channel_values[channel++];
        break;
    }
    bytes += kMemberText + name_text(primvar.name) + tuples_text(values, primvar.element_size, number);
    if (primvar.interpolation == Interpolation::face_varying) bytes += indices_text(corners, values);
  }
  return bytes;
}

// Orders, knots and weights, which are doubles always; refining adds as many knots as points.
Count on_knots_text(const ControlCurves& curves, Count points) {
  const Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  if (nurbs == nullptr) return 0;
  const Count knots = points + (Count{kMaxDegree} + 1) * curves.curve_count();
  return indices_text(curves.curve_count(), kMaxDegree + 1) +
         (knots + (nurbs->weights.empty() ? 0 : points)) * kRealText<double>;
}

Count curves_text(const ControlCurves& curves, Index level, Count number, bool tangents) {
  const Count points = total_point_count(curves, level);
  const Count arrays = tangents ? 2 : 1;
  const Count curve_count = curves.vertex_counts.empty() ? 1 : curves.vertex_counts.size();
  return kMemberText + name_text(curves.name) + arrays * tuples_text(points, curves.width, number) +
         indices_text(curve_count, points) + on_knots_text(curves, points);
}

// The grid of the patch and its faces, quads at least as long as triangles: 4 corners and a count each.
Count surface_text(const ControlPatch& patch, Index level, Count number, bool normals) {
  const Count points = refined_grid_count(patch.u_wrap, patch.u_degree, patch.u_count, level) *
                       refined_grid_count(patch.v_wrap, patch.v_degree, patch.v_count, level);
  Count bytes = kMemberText + name_text(patch.name) + tuples_text(points, patch.width, number) +
                indices_text(6 * points, points);
  if (normals) bytes += tuples_text(points, 3, number);
  return bytes;
}

// One level of a verification: positions, limits, normals, two quantities per primvar, each a Deviation.
Count verification_text(const ControlMesh* mesh, Index level) {
  constexpr Count deviation = 1024;
  Count quantities = 3;
  if (mesh != nullptr)
    for (const Primvar& primvar : mesh->primvars)
      quantities += 2 + 2 * name_text(primvar.name) / deviation + 1;
  return 2048 + (Count{level} + 1) * (256 + quantities * deviation);
}

}  // namespace

Count predicted_envelope_bytes(const RefineRequest& request) {
  const Index level = request.options.level;
  const Count levels = 256 + 128 * (Count{level} + 1);
  Count bytes = 2048;
  for (const std::string& warning : request.warnings) bytes += name_text(warning) + 1;
  for (const ControlMesh& mesh : request.meshes) {
    bytes += name_text(mesh.name) + levels;
    if (request.options.verify) bytes += name_text(mesh.name) + verification_text(&mesh, level);
  }
  for (const ControlCurves& curves : request.curves) {
    bytes += name_text(curves.name) + levels;
    if (request.options.verify) bytes += name_text(curves.name) + verification_text(nullptr, level);
  }
  for (const ControlPatch& surface : request.surfaces) {
    bytes += name_text(surface.name) + levels;
    if (request.options.verify) bytes += name_text(surface.name) + verification_text(nullptr, level);
  }
  return bytes;
}

Count predicted_bytes(const RefineRequest& request, const std::vector<RefinedSize>& meshes) {
  const Count number =
      answer_precision(request) == Precision::single_precision ? kRealText<float> : kRealText<double>;
  const bool normals = request.options.normals;
  Count bytes = predicted_envelope_bytes(request) + 64;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    bytes += mesh_text(request.meshes[i], meshes[i], number, normals);
    if (i < request.primvar_names.size())
      for (const NameList& names : request.primvar_names[i]) bytes += names_text(names);
  }
  for (const ControlCurves& curves : request.curves)
    bytes += curves_text(curves, request.options.level, number, normals);
  for (const ControlPatch& surface : request.surfaces)
    bytes += surface_text(surface, request.options.level, number, normals);
  return bytes;
}

}  // namespace subdivd::proto::json
