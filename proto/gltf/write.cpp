#include <algorithm>
#include <string>
#include <utility>

#include "core/lattice/split.h"
#include "proto/gltf/fresh.h"
#include "proto/gltf/gltf.h"
#include "proto/gltf/output.h"
#include "proto/gltf/source.h"
#include "proto/gltf/write_curves.h"
#include "proto/gltf/write_triangles.h"

namespace subdivd::proto::gltf {
namespace {

// What an array of the answer takes in the tree (its bufferView and accessor, lists that double) and beside
// it (its chunk), and what a primitive takes.
constexpr Count kArrayBytes = 2048, kSlotBytes = 512;

// Of the mark on a primitive of faces larger than triangles: its text at most, and what it takes in the tree.
constexpr Count kNgonsTextBytes = 64, kNgonsBytes = 512;

// The envelope under asset.extras.subdivd, with the warnings that came up while writing. Extras that are no
// object move to a member of their own.
Result<void> attach(Json& asset, std::string_view envelope, const std::vector<std::string>& warnings,
                    Work& work) {
  Json ours = Json::raw(std::string(envelope));
  if (!warnings.empty()) {
    auto parsed = parse_json(envelope, {64, kMaxIndexCount}, work);
    if (!parsed && parsed.error().code != ErrorCode::malformed) return parsed.error();
    if (!parsed || parsed->object() == nullptr)
      return Error{ErrorCode::internal, "the envelope of the answer is no JSON object"};
    ours = *std::move(parsed);
    for (const std::string& warning : warnings) ours.array_member("warnings").push_back(warning);
  }
  Json* extras = asset.find("extras");
  if (extras == nullptr) {
    extras = &asset.set("extras", Json::Object());
  } else if (extras->object() == nullptr) {
    Json wrapped;
    wrapped.set("original", std::move(*extras));
    *extras = std::move(wrapped);
  }
  extras->set("subdivd", std::move(ours));
  return {};
}

// Points of space whatever the width: zeros stand for what a narrow point lacks.
template <class Real>
Buffer<Real> in_space(Buffer<Real> points, Index width) {
  if (width == 3) return points;
  Buffer<Real> out(points.size() / width * 3, Real(0));
  for (Count i = 0; i < out.size() / 3; ++i)
    std::copy_n(&points[i * width], std::min<Index>(width, 3), &out[i * 3]);
  return out;
}

template <class Real>
RefinedMesh<Real> mesh_of(RefinedPatch<Real> surface) {
  RefinedMesh<Real> mesh;
  Buffer<Real>& points = surface.limit_points.empty() ? surface.points : surface.limit_points;
  mesh.points = in_space(std::move(points), surface.width);
  mesh.faces = std::move(surface.faces);
  mesh.normals = std::move(surface.normals);
  return mesh;
}

template <class Real>
Result<void> fill(const Source& source, RefineAnswer<Real>& answer, Output& output, Warnings& warnings,
                  Work& work) {
  for (const TrianglesSlot& slot : source.triangles)
    if (auto written = write_triangles(slot, answer.meshes[slot.control_mesh], output, warnings, work);
        !written)
      return written;
  Count first_point = 0;  // of the curve that the slot shows; curves of one element follow each other
  for (const CurvesSlot& slot : source.curves) {
    if (slot.ordinal == 0) first_point = 0;
    if (auto written = write_curves(slot, answer.curves, first_point, output, work); !written) return written;
    const std::vector<Index>& counts = answer.curves[slot.curves.front()].vertex_counts;
    if (slot.ordinal < counts.size()) first_point += counts[slot.ordinal];
  }
  for (const TrianglesSlot& slot : source.surfaces) {
    RefinedMesh<Real> mesh = mesh_of(std::move(answer.surfaces[slot.control_mesh]));
    if (auto written = write_triangles(slot, mesh, output, warnings, work); !written) return written;
  }
  return {};
}

// Upper bound of the envelope: options and statistics are short; warnings and the report are not.
Count envelope_bytes(const RefineRequest& request) {
  constexpr Count kDeviation = 1024, kLevel = 512, kMesh = 4096, kOptions = 8192;
  Count bytes = kOptions;
  for (const std::string& warning : request.warnings) bytes += 6 * warning.size() + 8;
  const Count levels = request.options.verify ? request.options.level + 1 : 1;
  for (const ControlMesh& mesh : request.meshes) {
    bytes += kMesh + 6 * mesh.name.size() + levels * (kLevel + 3 * kDeviation);
    for (const Primvar& primvar : mesh.primvars)
      bytes += 6 * primvar.name.size() + levels * (2 * kDeviation + 12 * primvar.name.size());
    // What fresh.cpp says of primvars that it leaves out.
    bytes += mesh.primvars.size() * (256 + 6 * mesh.name.size());
  }
  for (const ControlCurves& curves : request.curves)
    bytes += kMesh + 12 * curves.name.size() + levels * (kLevel + 2 * kDeviation);
  for (const ControlPatch& surface : request.surfaces)
    bytes += kMesh + 12 * surface.name.size() + (request.options.level + 1) * kLevel;
  return bytes;
}

Count triangles_bytes(const TrianglesSlot& slot, const ControlMesh& mesh, const RefinedSize& size) {
  Count vertices = size.counts.vertices, corners = size.corners;
  if (slot.render_mesh != kNoIndex) {
    vertices = size.render_vertices[slot.render_mesh];
    corners = 3 * size.render_triangles[slot.render_mesh];
  }
  Count floats = slot.normals ? 6 : 3;
  for (const AttributeSlot& attribute : slot.attributes) {
    floats += attribute.components;
    // Split while writing: at most every corner becomes a vertex.
    if (slot.render_mesh == kNoIndex &&
        mesh.primvars[attribute.primvar].interpolation == Interpolation::face_varying)
      vertices = std::max(vertices, corners);
  }
  vertices = std::max<Count>(vertices, 1);
  return vertices * floats * sizeof(float) + index_bytes(std::max<Count>(corners, 3), vertices);
}

Count surface_bytes(const TrianglesSlot& slot, const ControlPatch& surface, Index level) {
  const Count u = refined_grid_count(surface.u_wrap, surface.u_degree, surface.u_count, level);
  const Count v = refined_grid_count(surface.v_wrap, surface.v_degree, surface.v_count, level);
  const Count quads = (u - (surface.u_wrap == CurveWrap::periodic ? 0 : 1)) *
                      (v - (surface.v_wrap == CurveWrap::periodic ? 0 : 1));
  return u * v * (slot.normals ? 6 : 3) * sizeof(float) + index_bytes(6 * quads, u * v);
}

Result<Count> curves_bytes(const CurvesSlot& slot, const std::vector<ControlCurves>& all, Index level,
                           Work& work) {
  Count points = 0, segments = 0;
  for (const Index index : slot.curves) {
    const ControlCurves& curves = all[index];
    // Curves by pieces or on knots are counted together, with the first of them.
    if (!is_subdivided(curves.basis)) {
      if (slot.ordinal == 0) points += total_point_count(curves, level);
      continue;
    }
    const Count count = curves.vertex_counts.empty() ? 1 : curves.vertex_counts.size();
    const bool whole = slot.mode == kLines;
    for (Count ordinal = whole ? 0 : slot.ordinal; ordinal < (whole ? count : slot.ordinal + Count{1});
         ++ordinal) {
      if (auto stop = work.spend(4)) return *std::move(stop);
      const Count controls =
          curves.vertex_counts.empty() ? curves.point_count() : curves.vertex_counts[ordinal];
      const Count refined = refined_point_count(curves, controls, level);
      points += refined;
      segments += curves.wrap == CurveWrap::periodic ? refined : refined - 1;
    }
  }
  Count floats = 3;
  for (const AttributeSlot& attribute : slot.attributes) floats += attribute.components;
  return points * floats * sizeof(float) + (slot.mode == kLines ? index_bytes(2 * segments, points) : 0);
}

}  // namespace

Result<Count> predicted_bytes(const RefineRequest& request, const std::vector<RefinedSize>& meshes,
                              const Budget& budget) {
  Work work(budget);
  std::vector<std::string> warnings;
  auto made = request.source ? Result<Source>(Source()) : make_source(request, warnings, work);
  if (!made) return made.error();
  const Source& source = request.source ? *request.source : *made;
  const auto text = source.document.text_size(work);
  if (!text) return text.error();
  Count bin = source.data.size();
  Count json = *text + envelope_bytes(request) + 1024;
  // Arrays begin at multiples of 4; those of curves and vertices do so by themselves.
  const auto add_attributes = [&](const std::vector<AttributeSlot>& attributes, Count others) {
    json += (attributes.size() + others) * kAccessorTextBytes;
    for (const AttributeSlot& attribute : attributes) json += 6 * attribute.name.size();
  };
  for (const TrianglesSlot& slot : source.triangles) {
    if (auto stop = work.spend(32)) return *std::move(stop);
    bin += triangles_bytes(slot, request.meshes[slot.control_mesh], meshes[slot.control_mesh]);
    add_attributes(slot.attributes, 3);
    if (slot.ngons) json += kNgonsTextBytes;
  }
  for (const CurvesSlot& slot : source.curves) {
    const auto bytes = curves_bytes(slot, request.curves, request.options.level, work);
    if (!bytes) return bytes;
    bin += *bytes;
    add_attributes(slot.attributes, 2);
  }
  for (const TrianglesSlot& slot : source.surfaces) {
    if (auto stop = work.spend(32)) return *std::move(stop);
    bin += surface_bytes(slot, request.surfaces[slot.control_mesh], request.options.level);
    add_attributes(slot.attributes, 3);
  }
  if (answer_format(request) == Format::gltf) return json + (bin + 2) / 3 * 4;
  for (const Source::Foreign& chunk : source.foreign) json += chunk.bytes.size() + 8;
  return json + bin;
}

Result<Payload> write(const RefineRequest& request, AnyAnswer answer, Format format,
                      std::string_view envelope, const Budget& budget) {
  Work work(budget);
  std::vector<std::string> sentences;
  std::shared_ptr<const Source> source = request.source;
  if (!source) {
    auto made = make_source(request, sentences, work);
    if (!made) return made.error();
    source = std::make_shared<const Source>(*std::move(made));
  }
  // The answer's document: a copy, and what each slot adds to it.
  const auto bytes = source->document.heap_bytes(work);
  if (!bytes) return bytes.error();
  Count slots = source->triangles.size() + source->curves.size() + source->surfaces.size();
  Count arrays = 2 * slots;
  Count marks = 0;
  for (const TrianglesSlot& slot : source->triangles) {
    arrays += slot.attributes.size() + 1;
    marks += slot.ngons;
  }
  for (const CurvesSlot& slot : source->curves) arrays += slot.attributes.size();
  if (auto kept = work.keep(*bytes + arrays * kArrayBytes + slots * kSlotBytes + marks * kNgonsBytes); !kept)
    return kept.error();
  auto document = source->document.copy(work);
  if (!document) return document.error();
  Output output(*std::move(document), Chunk{source, source->data}, format, work);
  Warnings warnings;
  const auto filled =
      std::visit([&](auto& real) { return fill(*source, real, output, warnings, work); }, answer);
  if (!filled) return filled.error();
  for (const std::string& sentence : warnings.sentences()) sentences.push_back(sentence);
  if (auto attached = attach(output.asset(), envelope, sentences, work); !attached) return attached.error();
  return std::move(output).finish(source, source->foreign);
}

}  // namespace subdivd::proto::gltf
