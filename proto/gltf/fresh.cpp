#include "proto/gltf/fresh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/pace.h"
#include "core/refine/plan.h"
#include "core/schemes/all.h"
#include "proto/gltf/caps.h"
#include "proto/gltf/gltf.h"
#include "proto/gltf/weld.h"
#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

constexpr Index kMaxComponents = 4;

bool is_texture_coordinate(const Primvar& primvar) {
  if (primvar.element_size != 2) return false;
  std::string name = primvar.name;
  while (!name.empty() && (name.back() == '_' || (name.back() >= '0' && name.back() <= '9'))) name.pop_back();
  return name == "st" || name == "uv" || name == "map" || name == "UVMap";
}

std::string custom_name(const std::string& name) {
  std::string custom = "_";
  for (const char c : name) {
    const bool lower = c >= 'a' && c <= 'z';
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    custom += lower ? static_cast<char>(c - 'a' + 'A') : plain ? c : '_';
  }
  return custom.size() > 1 ? custom : custom + "PRIMVAR";
}

// Names no attribute twice: a second "a-b" beside "a_b" becomes _A_B_2. `taken`: names, and for those that
// were asked for again the last number tried: or n equal names would be compared n * n times.
std::string unique_name(std::string name, std::map<std::string, int>& taken) {
  if (taken.emplace(name, 1).second) return name;
  for (;;) {
    std::string numbered = name + "_" + std::to_string(++taken[name]);
    if (taken.emplace(numbered, 1).second) return numbered;
  }
}

bool is_expressible(const Primvar& primvar) {
  return primvar.interpolation != Interpolation::constant &&
         primvar.interpolation != Interpolation::uniform && primvar.element_size >= 1 &&
         primvar.element_size <= kMaxComponents;
}

std::vector<AttributeSlot> attributes_of(const ControlMesh& mesh, std::vector<std::string>* warnings) {
  std::vector<AttributeSlot> slots;
  std::map<std::string, int> taken;
  Count texture_coordinates = 0;
  for (Index i = 0; i < mesh.primvars.size(); ++i) {
    const Primvar& primvar = mesh.primvars[i];
    if (!is_expressible(primvar)) {
      if (warnings != nullptr)
        warnings->push_back(
            "primvar " + in_quotes(primvar.name) + " of mesh " + in_quotes(mesh.name) +
            " is left out: glTF holds vertex, varying and faceVarying values of 1 to 4 numbers");
      continue;
    }
    std::string name;
    if (is_texture_coordinate(primvar)) {
      name = "TEXCOORD_" + std::to_string(texture_coordinates++);
    } else if (primvar.name == "displayColor" && primvar.element_size >= 3) {
      name = "COLOR_0";
    } else {
      name = unique_name(custom_name(primvar.name), taken);
    }
    slots.push_back({std::move(name), i, 0, primvar.element_size});
  }
  return slots;
}

Json make_primitive(Count mode) {
  Json primitive;
  primitive.set("attributes", Json::Object());
  primitive.set("mode", Json::number(mode));
  return primitive;
}

// One mesh and its node; returns the mesh's number.
Index add_mesh(Json& document, const std::string& name, Json::Array primitives) {
  Json::Array& meshes = document.array_member("meshes");
  const auto number = static_cast<Index>(meshes.size());
  Json& mesh = meshes.emplace_back();
  if (!name.empty()) mesh.set("name", name);
  mesh.set("primitives", std::move(primitives));
  Json& node = document.array_member("nodes").emplace_back();
  if (!name.empty()) node.set("name", name);
  node.set("mesh", Json::number(Count{number}));
  return number;
}

void warn_of_width(const char* kind, const std::string& name, Index width,
                   std::vector<std::string>& warnings) {
  if (width > 3)
    warnings.push_back(std::string(kind) + " " + in_quotes(name) + ": only the first 3 of " +
                       std::to_string(width) + " numbers per point are written, as its position");
}

void add_curves(const RefineRequest& request, Index index, Source& source,
                std::vector<std::string>& warnings) {
  const ControlCurves& curves = request.curves[index];
  // Curves by pieces come back open, ending where they begin.
  const bool loop = curves.wrap == CurveWrap::periodic && is_subdivided(curves.basis);
  const Count mode = loop ? kLineLoop : kLineStrip;
  const Count count = curves.vertex_counts.empty() ? 1 : curves.vertex_counts.size();
  Json::Array primitives(count, make_primitive(mode));
  const Index mesh = add_mesh(source.document, curves.name, std::move(primitives));
  for (Index ordinal = 0; ordinal < count; ++ordinal)
    source.curves.push_back({mesh, ordinal, mode, {index}, ordinal, {}});
  warn_of_width("curve", curves.name, curves.width, warnings);
}

void add_surface(const RefineRequest& request, Index index, Source& source,
                 std::vector<std::string>& warnings) {
  const ControlPatch& surface = request.surfaces[index];
  TrianglesSlot slot;
  slot.mesh = add_mesh(source.document, surface.name, {make_primitive(kTriangles)});
  slot.control_mesh = index;
  slot.normals = patch_options(request, surface).normals;
  source.surfaces.push_back(std::move(slot));
  warn_of_width("surface", surface.name, surface.width, warnings);
}

Count primitives_of(const RefineRequest& request) {
  Count count = request.meshes.size() + request.surfaces.size();
  for (const ControlCurves& curves : request.curves) count += std::max<Count>(1, curves.vertex_counts.size());
  return count;
}

Result<void> check_primitives(const RefineRequest& request) {
  const Count count = primitives_of(request);
  if (request.source || count <= kMaxPrimitives) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "the answer would have " + std::to_string(count) +
                          " primitives, one for each mesh, curve and "
                          "surface; a glTF answer may have " +
                          std::to_string(kMaxPrimitives) + ": ask for JSON",
               .predicted = count,
               .allowed = kMaxPrimitives};
}

// What the document and the slots take, for each primitive and for each attribute beside its name.
constexpr Count kPrimitiveBytes = 2048, kAttributeBytes = 256;

}  // namespace

Result<Source> make_source(const RefineRequest& request, std::vector<std::string>& warnings, Work& work) {
  if (auto few = check_primitives(request); !few) return few.error();
  Count bytes = primitives_of(request) * kPrimitiveBytes;
  for (const ControlMesh& mesh : request.meshes) {
    bytes += 4 * mesh.name.size();
    for (const Primvar& primvar : mesh.primvars) bytes += kAttributeBytes + 4 * primvar.name.size();
  }
  for (const ControlCurves& curves : request.curves) bytes += 4 * curves.name.size();
  for (const ControlPatch& surface : request.surfaces) bytes += 4 * surface.name.size();
  if (auto kept = work.keep(bytes); !kept) return kept.error();
  Source source;
  Json& asset = source.document.set("asset", Json());
  asset.set("version", "2.0");
  asset.set("generator", "subdivd " SUBDIVD_VERSION);
  source.document.set("scene", Json::number(Count{0}));
  Json::Array nodes;
  const Count count = request.meshes.size() + request.curves.size() + request.surfaces.size();
  for (Count i = 0; i < count; ++i) nodes.push_back(Json::number(i));
  Json scene;
  scene.set("nodes", std::move(nodes));
  source.document.array_member("scenes").push_back(std::move(scene));
  for (Index i = 0; i < request.meshes.size(); ++i) {
    if (auto stop = work.spend(512)) return *std::move(stop);
    const ControlMesh& mesh = request.meshes[i];
    TrianglesSlot slot;
    slot.mesh = add_mesh(source.document, mesh.name, {make_primitive(kTriangles)});
    slot.control_mesh = i;
    slot.render_mesh = mesh.render_meshes.empty() ? kNoIndex : 0;
    slot.normals = request.options.normals;
    slot.ngons = request.options.ngons;
    slot.attributes = attributes_of(mesh, &warnings);
    source.triangles.push_back(std::move(slot));
  }
  for (Index i = 0; i < request.curves.size(); ++i) {
    if (auto stop = work.spend(512)) return *std::move(stop);
    add_curves(request, i, source, warnings);
  }
  for (Index i = 0; i < request.surfaces.size(); ++i) {
    if (auto stop = work.spend(512)) return *std::move(stop);
    add_surface(request, i, source, warnings);
  }
  return source;
}

Result<SplitVertices> split_vertices(const std::vector<Index>& corners,
                                     const std::vector<const std::vector<Index>*>& indices, Work& work) {
  const Count width = indices.size() + 1;
  const auto held = work.hold(corners.size() * width * sizeof(Index) + kBlockBytes);
  if (!held) return held.error();
  if (auto kept = work.keep(corners.size() * sizeof(Index) + kBlockBytes); !kept) return kept.error();
  std::vector<Index> keys(corners.size() * width);
  for (Count corner = 0; corner < corners.size(); ++corner) {
    if (auto stop = work.spend(width)) return *std::move(stop);
    keys[corner * width] = corners[corner];
    for (Count k = 1; k < width; ++k) {
      const std::vector<Index>& channel = *indices[k - 1];
      keys[corner * width + k] = channel.empty() ? static_cast<Index>(corner) : channel[corner];
    }
  }
  auto weld = weld_tuples(keys, width, work);
  if (!weld) return weld.error();
  return SplitVertices{static_cast<Index>(weld->first.size()), std::move(weld->id)};
}

namespace {

// Faces that refine to others than triangles are cut for the answer, as those of render meshes are.
Result<void> add_whole(ControlMesh& mesh, const AllSchemes& schemes, Work& work) {
  const auto scheme =
      stoppable(work.budget(), [&](const Pace& pace) { return scheme_of(mesh, schemes, pace); });
  if (!scheme && is_stop(scheme.error())) return scheme.error();
  if (!scheme || splits_into_triangles(*scheme)) return {};  // what cannot be refined is refused by the plan
  const Count corners = mesh.face_vertex_indices.size();
  if (auto stop = work.spend(corners / 4)) return *std::move(stop);
  if (auto kept = work.keep(corners * sizeof(Index) + kBlockBytes); !kept) return kept.error();
  mesh.render_meshes.push_back({0, static_cast<Index>(mesh.face_count()),
                                static_cast<Index>(mesh.point_count()), mesh.face_vertex_indices});
  return {};
}

}  // namespace

Result<void> add_render_meshes(RefineRequest& request, const Budget& budget) {
  // Before anything is refined for an answer that cannot be written.
  if (auto few = check_primitives(request); !few) return few;
  Work work(budget);
  for (ControlMesh& mesh : request.meshes) {
    if (!mesh.render_meshes.empty()) continue;
    std::vector<const std::vector<Index>*> indices;
    for (const Primvar& primvar : mesh.primvars)
      if (primvar.interpolation == Interpolation::face_varying && is_expressible(primvar))
        indices.push_back(&primvar.indices);
    if (indices.empty()) {
      if (auto added = add_whole(mesh, request.options.schemes, work); !added) return added;
      continue;
    }
    auto split = split_vertices(mesh.face_vertex_indices, indices, work);
    if (!split) return split.error();
    mesh.render_meshes.push_back(
        {0, static_cast<Index>(mesh.face_count()), split->vertex_count, std::move(split->indices)});
  }
  return {};
}

}  // namespace subdivd::proto::gltf
