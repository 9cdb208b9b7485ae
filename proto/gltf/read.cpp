#include <memory>
#include <utility>

#include "proto/gltf/buffers.h"
#include "proto/gltf/container.h"
#include "proto/gltf/extensions.h"
#include "proto/gltf/gltf.h"
#include "proto/gltf/patch.h"
#include "proto/gltf/prune.h"
#include "proto/gltf/read_lines.h"
#include "proto/gltf/read_triangles.h"
#include "proto/gltf/source.h"
#include "proto/gltf/structure.h"
#include "proto/gltf/validate.h"

namespace subdivd::proto::gltf {
namespace {

Result<void> read_foreign_chunks(const Container& container, Format answer, Source& source,
                                 Warnings& warnings, Work& work) {
  for (const ForeignChunk& chunk : container.foreign) {
    if (answer != Format::glb) {
      warnings.add("A GLB chunk of unknown type has no place in this format and is dropped", Place());
      continue;
    }
    if (auto kept = work.keep(chunk.bytes.size() + 3 * sizeof(Source::Foreign) + kBlockBytes); !kept)
      return kept;
    Source::Foreign& copy = source.foreign.emplace_back(Source::Foreign{chunk.type, {}});
    copy.bytes.reserve(chunk.bytes.size());
    if (auto copied = append_bytes(copy.bytes, chunk.bytes, work); !copied) return copied;
  }
  return {};
}

Result<void> read_lines_of(const Asset& asset, Index mesh, const Options& options, const Place& place,
                           RefineRequest& request, Source& source) {
  const Place primitives = place.at("primitives");
  const Json::Array& structure = *asset.meshes[mesh].find("primitives")->array();
  for (Index p = 0; p < structure.size(); ++p) {
    const Count mode = mode_of(structure[p]);
    if (mode == kPoints || mode >= kTriangles) continue;
    auto lines = read_lines(asset, mesh, p, options, primitives.at(p));
    if (!lines) return lines.error();
    if (lines->curves.empty()) continue;
    for (ControlCurves& curves : lines->curves) {
      lines->slot.curves.push_back(static_cast<Index>(request.curves.size()));
      request.curves.push_back(std::move(curves));
    }
    source.curves.push_back(std::move(lines->slot));
  }
  return {};
}

Result<void> read_meshes(const Asset& asset, const Options& options, const Limits& limits,
                         RefineRequest& request, Source& source) {
  const Place root, all = root.at("meshes");
  bool normals = options.normals;
  // Lists grow by doubling, and the old one lives until the new one is filled.
  if (auto kept = asset.work.keep(3 * asset.meshes.size() * sizeof(ControlMesh)); !kept) return kept;
  for (Index i = 0; i < asset.meshes.size(); ++i) {
    const Place place = all.at(i);
    auto read = read_triangles(asset, i, options, limits, place);
    if (!read) return read.error();
    if (!read->slots.empty()) {
      normals |= read->has_normals;
      if (auto kept = asset.work.keep(2 * read->slots.size() * sizeof(TrianglesSlot)); !kept) return kept;
      for (TrianglesSlot& slot : read->slots) {
        slot.control_mesh = static_cast<Index>(request.meshes.size());
        source.triangles.push_back(std::move(slot));
      }
      request.meshes.push_back(std::move(read->mesh));
    }
    if (auto lines = read_lines_of(asset, i, options, place, request, source); !lines) return lines;
  }
  request.options.normals = normals;
  if (request.meshes.empty() && request.curves.empty())
    return error_at(all, ErrorCode::unsupported,
                    "no mesh has triangles or lines that can be refined: there is nothing to do");
  return {};
}

Result<Json> read_document(std::string_view text, const Limits& limits, Work& work) {
  JsonLimits json_limits;
  json_limits.max_depth = limits.max_json_depth;
  auto document = parse_json(text, json_limits, work);
  if (!document) return document;
  if (auto good = check_asset(*document, work); !good) return good.error();
  return document;
}

}  // namespace

Result<RefineRequest> read(std::string_view body, Format format, const Options& options, const Limits& limits,
                           const Budget& budget) {
  Work work(budget);
  Container container;
  if (format == Format::glb) {
    auto parsed = parse_glb(body);
    if (!parsed) return parsed.error();
    container = *std::move(parsed);
  } else {
    container.json = body;
  }
  auto document = read_document(container.json, limits, work);
  if (!document) return document.error();
  const auto only_append = has_unknown_extension(*document, work);
  if (!only_append) return only_append.error();
  const auto buffers = load_buffers(*document, container.bin, *only_append, work);
  if (!buffers) return buffers.error();
  const auto layout = check_layout(*document, *buffers, work);
  if (!layout) return layout.error();
  if (auto good = check_structure(*document, *layout, limits, work); !good) return good.error();
  const auto structure = load_structure(*document, *layout, work);
  if (!structure) return structure.error();

  RefineRequest request;
  request.input = format;
  request.options = options;
  auto source = std::make_shared<Source>();
  Warnings warnings;
  const Format answer = options.format.value_or(format);
  if (auto good = read_foreign_chunks(container, answer, *source, warnings, work); !good) return good.error();
  const Asset asset{*document->find("meshes")->array(), {*structure, *buffers}, warnings, work};
  if (auto good = read_meshes(asset, options, limits, request, *source); !good) return good.error();
  source->document = *std::move(document);
  if (auto patched = patch(*source, *buffers, *only_append, warnings, work); !patched) return patched.error();
  request.source = std::move(source);
  request.warnings = warnings.sentences();
  return request;
}

}  // namespace subdivd::proto::gltf
