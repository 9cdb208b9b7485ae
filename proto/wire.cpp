#include "proto/wire.h"

#include <algorithm>

namespace subdivd::proto {

std::string_view media_type(Format format) {
  switch (format) {
    case Format::json:
      return "application/json";
    case Format::glb:
      return "model/gltf-binary";
    case Format::gltf:
      return "model/gltf+json";
    case Format::obj:
      return "model/obj";
    case Format::off:
      return "text/plain; charset=utf-8";
  }
  return {};
}

Format answer_format(const RefineRequest& request) { return request.options.format.value_or(request.input); }

Precision answer_precision(const RefineRequest& request) {
  const bool gltf = is_gltf(answer_format(request));
  return request.options.precision.value_or(gltf ? Precision::single_precision : Precision::double_precision);
}

Faces answer_faces(const RefineRequest& request) {
  if (is_gltf(answer_format(request))) return Faces::triangles;
  return request.options.faces.value_or(Faces::quads);
}

const NameList& names_of(const RefineRequest& request, std::size_t mesh, std::size_t primvar) {
  static const NameList none;
  if (mesh >= request.primvar_names.size() || primvar >= request.primvar_names[mesh].size()) return none;
  return request.primvar_names[mesh][primvar];
}

namespace {

// A glTF answer indexes render meshes alone.
bool needs_connectivity(const RefineRequest& request) {
  return !is_gltf(answer_format(request)) || std::ranges::any_of(request.meshes, [](const ControlMesh& mesh) {
    return mesh.render_meshes.empty();
  });
}

}  // namespace

RefineOptions mesh_options(const RefineRequest& request) {
  const Options& options = request.options;
  return {.level = options.level,
          .schemes = options.schemes,
          .crease_method = options.crease_method,
          .limit = options.limit,
          .normals = options.normals,
          .connectivity = needs_connectivity(request),
          .provenance = false};
}

CurveOptions curve_options(const RefineRequest& request, const ControlCurves& curves) {
  const Options& options = request.options;
  // A line of glTF or OBJ has no basis: it can only be the curve itself, where refining does not lead there.
  const bool limit =
      options.limit || (answer_format(request) != Format::json && !is_subdivided(curves.basis));
  return {.level = options.level, .limit = limit, .tangents = options.normals};
}

PatchOptions patch_options(const RefineRequest& request, const ControlPatch& patch) {
  const Options& options = request.options;
  return {.level = options.level,
          .limit = options.limit,
          .tangents = false,
          .normals = options.normals && patch.width == 3,
          .faces = answer_faces(request) == Faces::quads ? PatchFaces::quads : PatchFaces::triangles};
}

Chunk Chunk::own(std::string text) {
  auto kept = std::make_shared<const std::string>(std::move(text));
  return {kept, std::as_bytes(std::span(*kept))};
}

}  // namespace subdivd::proto
