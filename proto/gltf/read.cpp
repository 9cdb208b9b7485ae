#include <memory>
#include <utility>

#include "proto/gltf/buffers.h"
#include "proto/gltf/container.h"
#include "proto/gltf/gltf.h"
#include "proto/gltf/patch.h"
#include "proto/gltf/read_lines.h"
#include "proto/gltf/read_triangles.h"
#include "proto/gltf/source.h"
#include "proto/gltf/structure.h"
#include "proto/gltf/validate.h"

namespace subdivd::proto::gltf {
namespace {

void read_foreign_chunks(const Container& container, Format answer, Source& source, Warnings& warnings) {
  for (const ForeignChunk& chunk : container.foreign) {
    if (answer == Format::glb) {
      source.foreign.push_back({chunk.type, {chunk.bytes.begin(), chunk.bytes.end()}});
    } else {
      warnings.add("A GLB chunk of unknown type has no place in this format and is dropped", "GLB");
    }
  }
}

Result<void> read_meshes(const Asset& asset, const Options& options, const Limits& limits,
                         RefineRequest& request, Source& source) {
  const Place root, all = root.at("meshes");
  bool normals = options.normals;
  for (Index i = 0; i < asset.model.meshes.size(); ++i) {
    const Place place = all.at(i), primitives = place.at("primitives");
    auto read = read_triangles(asset, i, options, limits, place);
    if (!read) return read.error();
    if (!read->slots.empty()) {
      normals |= read->has_normals;
      for (TrianglesSlot& slot : read->slots) {
        slot.control_mesh = static_cast<Index>(request.meshes.size());
        source.triangles.push_back(std::move(slot));
      }
      request.meshes.push_back(std::move(read->mesh));
    }
    const auto& structure = asset.model.meshes[i].primitives;
    for (Index p = 0; p < structure.size(); ++p) {
      const auto mode = static_cast<Count>(structure[p].mode);
      if (mode == kPoints || mode >= kTriangles) continue;
      auto lines = read_lines(asset, i, p, options, primitives.at(p));
      if (!lines) return lines.error();
      if (lines->curves.empty()) continue;
      for (ControlCurves& curves : lines->curves) {
        lines->slot.curves.push_back(static_cast<Index>(request.curves.size()));
        request.curves.push_back(std::move(curves));
      }
      source.curves.push_back(std::move(lines->slot));
    }
  }
  request.options.normals = normals;
  if (request.meshes.empty() && request.curves.empty())
    return error_at(all, ErrorCode::unsupported,
                    "no mesh has triangles or lines that can be refined: there is nothing to do");
  return {};
}

}  // namespace

Result<RefineRequest> read(std::string_view body, Format format, const Options& options, const Limits& limits,
                           [[maybe_unused]] const Budget& budget) {
  Container container;
  if (format == Format::glb) {
    auto parsed = parse_glb(body);
    if (!parsed) return parsed.error();
    container = *std::move(parsed);
  } else {
    container.json = body;
  }
  JsonLimits json_limits;
  json_limits.max_depth = limits.max_json_depth;
  auto document = parse_json(container.json, json_limits);
  if (!document) return document.error();
  if (auto good = check_asset(*document); !good) return good.error();
  const auto buffers = load_buffers(*document, container.bin);
  if (!buffers) return buffers.error();
  const auto layout = check_layout(*document, *buffers);
  if (!layout) return layout.error();
  if (auto good = check_structure(*document, *layout, limits); !good) return good.error();
  const auto model = load_structure(*document);
  if (!model) return model.error();

  RefineRequest request;
  request.input = format;
  request.options = options;
  auto source = std::make_shared<Source>();
  Warnings warnings;
  read_foreign_chunks(container, options.format.value_or(format), *source, warnings);
  if (auto good = read_meshes({*model, *buffers, warnings}, options, limits, request, *source); !good)
    return good.error();
  source->document = *std::move(document);
  patch(*source, *buffers, warnings);
  request.source = std::move(source);
  request.warnings = warnings.sentences();
  return request;
}

}  // namespace subdivd::proto::gltf
