#include "proto/text/write.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/pace.h"
#include "proto/text/carried.h"
#include "proto/text/line_text.h"
#include "proto/text/sections.h"

namespace subdivd::proto::text {
namespace {

template <class Array>
Count bytes_of(const Array& array) {
  return array.capacity() * sizeof(typename Array::value_type);
}

// With the option limit, the limits in the place of the refined values.
template <class Array>
void keep_chosen(Array& values, Array& limits) {
  if (!limits.empty()) values = std::move(limits);
  Array().swap(limits);
}

template <class Real>
class DocumentMaker {
 public:
  DocumentMaker(const RefineRequest& request, RefineAnswer<Real> answer, const Pace& pace)
      : request_(request), pace_(pace), document_(std::make_unique<Document<Real>>()) {
    document_->format = answer_format(request);
    document_->answer = std::move(answer);
  }

  std::unique_ptr<const Document<Real>> make(std::vector<std::string> warnings) {
    carried_ = what_is_carried(request_, document_->format, pace_);
    std::ranges::move(carried_.warnings, std::back_inserter(warnings));
    drop_what_is_not_written();
    document_->names.resize(request_.meshes.size());
    document_->sections.reserve(sections());
    if (document_->format == Format::obj)
      make_obj(warnings);
    else
      make_off(warnings);
    count_bytes();
    return std::move(document_);
  }

 private:
  RefineAnswer<Real>& answer() { return document_->answer; }
  Count sections() const {
    constexpr Count kMostOfPart = 5;  // o, v, vt, vn, f
    return 1 + kMostOfPart * (request_.meshes.size() + request_.curves.size() + request_.surfaces.size());
  }

  template <class Section>
  void add(Section section) {
    document_->sections.emplace_back(std::move(section));
  }

  void drop_what_is_not_written() {
    for (std::size_t i = 0; i < answer().meshes.size(); ++i) {
      RefinedMesh<Real>& mesh = answer().meshes[i];
      const CarriedMesh& carried = carried_.meshes[i];
      pace_.spend(16);
      keep_chosen(mesh.points, mesh.limit_points);
      for (std::size_t p = 0; p < mesh.primvars.size(); ++p) {
        pace_.spend(4);
        RefinedPrimvar<Real>& primvar = mesh.primvars[p];
        const auto place = static_cast<Index>(p);
        keep_chosen(primvar.values, primvar.limit_values);
        if (place == carried.color || place == carried.texcoords ||
            std::ranges::find(carried.labels, place) != carried.labels.end())
          continue;
        Buffer<Real>().swap(primvar.values);
        Buffer<Index>().swap(primvar.indices);
      }
    }
    for (RefinedCurves<Real>& curves : answer().curves) {
      keep_chosen(curves.points, curves.limit_points);
      Buffer<Real>().swap(curves.tangents);
    }
    for (RefinedPatch<Real>& surface : answer().surfaces) keep_chosen(surface.points, surface.limit_points);
  }

  static std::string comments(const std::vector<std::string>& warnings) {
    std::string text;
    for (const std::string& warning : warnings) text.append("# ").append(line_text(warning)).append("\n");
    return text;
  }

  std::string libraries() const {
    std::string text;
    for (Count k = 0; k < request_.material_libraries.size(); ++k) {
      pace_.spend(4 + request_.material_libraries[k].size());
      text.append("mtllib ").append(line_text(request_.material_libraries[k])).append("\n");
    }
    return text;
  }

  static Column<Real> positions(const Buffer<Real>& points, Index width) {
    return {points.data(), width, std::min<Index>(width, 3), 3 - std::min<Index>(width, 3)};
  }
  static Column<Real> primvar(const RefinedMesh<Real>& mesh, Index place, Index count) {
    if (place == kNoIndex) return {};
    return {mesh.primvars[place].values.data(), mesh.primvars[place].element_size, count};
  }
  static Column<Real> vectors(const Buffer<Real>& values, bool wanted) {
    return wanted && !values.empty() ? Column<Real>{values.data(), 3, 3} : Column<Real>{};
  }

  static Faces<Real> faces_of(const RefinedMesh<Real>& mesh) {
    return {.count = mesh.face_count,
            .face_size = mesh.face_size,
            .counts = mesh.face_vertex_counts.data(),
            .points = mesh.faces.data()};
  }
  static Faces<Real> faces_of(const RefinedPatch<Real>& surface) {
    const Index size = std::max<Index>(surface.corners_per_face, 1);
    return {.count = surface.faces.size() / size, .face_size = size, .points = surface.faces.data()};
  }

  // ----- OBJ: one object for each part, numbers from 1 over the whole file -----

  void make_obj(const std::vector<std::string>& warnings) {
    add(comments(warnings) + libraries());
    const Count parts = answer().meshes.size() + answer().curves.size() + answer().surfaces.size();
    alone_ = parts == 1;
    for (std::size_t i = 0; i < answer().meshes.size(); ++i) add_obj_mesh(i);
    for (const RefinedCurves<Real>& curves : answer().curves) add_obj_curves(curves);
    for (const RefinedPatch<Real>& surface : answer().surfaces) add_obj_surface(surface);
  }

  // An object without a name still begins here, lest its faces belong to the last one.
  void begin_object(const std::string& name) {
    pace_.spend(64 + name.size());
    const std::string text = line_text(name);
    if (!text.empty())
      add("o " + text + "\n");
    else if (!alone_)
      add(std::string("o\n"));
  }

  void add_points(const Buffer<Real>& points, Index width, Column<Real> colors) {
    const Count count = points.size() / std::max<Index>(width, 1);
    add(Rows<Real>{"v ", count, {positions(points, width), colors}});
    next_point_ += count;
  }
  void add_normals(const Buffer<Real>& normals) {
    if (normals.empty()) return;
    add(Rows<Real>{"vn ", normals.size() / 3, {vectors(normals, true)}});
    next_normal_ += normals.size() / 3;
  }

  void add_obj_mesh(std::size_t i) {
    const RefinedMesh<Real>& mesh = answer().meshes[i];
    const CarriedMesh& carried = carried_.meshes[i];
    begin_object(mesh.name);
    Faces<Real> faces = faces_of(mesh);
    faces.first_point = next_point_;
    faces.first_texcoord = next_texcoord_;
    faces.first_normal = next_normal_;
    add_points(mesh.points, 3, primvar(mesh, carried.color, carried.color_size));
    if (carried.texcoords != kNoIndex) {
      const RefinedPrimvar<Real>& texcoords = mesh.primvars[carried.texcoords];
      const Count count = texcoords.values.size() / 2;
      faces.texcoords = texcoords.indices.empty() ? mesh.faces.data() : texcoords.indices.data();
      add(Rows<Real>{"vt ", count, {primvar(mesh, carried.texcoords, 2)}});
      next_texcoord_ += count;
    }
    faces.has_normals = !mesh.normals.empty();
    add_normals(mesh.normals);
    for (std::size_t kind = 0; kind < kLabelKinds; ++kind) {
      if (carried.labels[kind] == kNoIndex) continue;
      NameList& lines = document_->names[i][kind];
      const NameList& names = names_of(request_, i, carried.labels[kind]);
      lines.reserve(names.size(), names.text_size());
      for (Count k = 0; k < names.size(); ++k) {
        pace_.spend(4 + names[k].size());
        lines.add(line_text(names[k]));
      }
      faces.labels[kind] = {mesh.primvars[carried.labels[kind]].values.data(), &lines};
    }
    add(faces);
  }

  void add_obj_curves(const RefinedCurves<Real>& curves) {
    begin_object(curves.name);
    // Curves by pieces come back open, ending where they begin.
    const Lines lines{&curves.vertex_counts, next_point_, curves.wrap == CurveWrap::periodic};
    add_points(curves.points, curves.width, {});
    add(lines);
  }

  void add_obj_surface(const RefinedPatch<Real>& surface) {
    begin_object(surface.name);
    Faces<Real> faces = faces_of(surface);
    faces.first_point = next_point_;
    faces.first_normal = next_normal_;
    add_points(surface.points, surface.width, {});
    faces.has_normals = !surface.normals.empty();
    add_normals(surface.normals);
    add(faces);
  }

  // ----- OFF: all parts are one mesh, numbers from 0 -----

  void make_off(const std::vector<std::string>& warnings) {
    const bool any = !carried_.meshes.empty();
    const bool texcoords = any && carried_.meshes[0].texcoords != kNoIndex;
    const bool colors = any && carried_.meshes[0].color != kNoIndex && !carried_.face_colors;
    Count points = 0, faces = 0;
    for (const RefinedMesh<Real>& mesh : answer().meshes) {
      points += mesh.points.size() / 3;
      faces += mesh.face_count;
    }
    for (const RefinedPatch<Real>& surface : answer().surfaces) {
      points += surface.points.size() / surface.width;
      faces += faces_of(surface).count;
    }
    std::string head = texcoords ? "ST" : "";
    head.append(colors ? "C" : "").append(carried_.normals ? "N" : "").append("OFF\n");
    head += comments(warnings);
    head += std::to_string(points) + ' ' + std::to_string(faces) + " 0\n";
    add(head);
    add_off_points(colors);
    add_off_faces();
  }

  void add_off_points(bool colors) {
    for (std::size_t i = 0; i < answer().meshes.size(); ++i) {
      pace_.spend(64);
      const RefinedMesh<Real>& mesh = answer().meshes[i];
      const CarriedMesh& carried = carried_.meshes[i];
      Rows<Real> rows{"", mesh.points.size() / 3, {positions(mesh.points, 3)}};
      rows.columns[1] = vectors(mesh.normals, carried_.normals);
      if (colors) rows.columns[2] = primvar(mesh, carried.color, carried.color_size);
      rows.columns[2].decimal = true;
      rows.columns[3] = primvar(mesh, carried.texcoords, 2);
      add(rows);
    }
    for (const RefinedPatch<Real>& surface : answer().surfaces)
      add(Rows<Real>{"",
                     surface.points.size() / surface.width,
                     {positions(surface.points, surface.width), vectors(surface.normals, carried_.normals)}});
  }

  void add_off_faces() {
    Count first = 0;
    for (std::size_t i = 0; i < answer().meshes.size(); ++i) {
      pace_.spend(64);
      const RefinedMesh<Real>& mesh = answer().meshes[i];
      Faces<Real> faces = faces_of(mesh);
      faces.first_point = first;
      if (carried_.face_colors)
        faces.color = primvar(mesh, carried_.meshes[i].color, carried_.meshes[i].color_size);
      faces.color.decimal = true;
      add(faces);
      first += mesh.points.size() / 3;
    }
    for (const RefinedPatch<Real>& surface : answer().surfaces) {
      Faces<Real> faces = faces_of(surface);
      faces.first_point = first;
      add(faces);
      first += surface.points.size() / surface.width;
    }
  }

  void count_bytes() {
    Count bytes = bytes_of(document_->sections) + bytes_of(document_->names);
    for (const RefinedMesh<Real>& mesh : answer().meshes) {
      pace_.spend(8);
      bytes += sizeof mesh + bytes_of(mesh.points) + bytes_of(mesh.faces) +
               bytes_of(mesh.face_vertex_counts) + bytes_of(mesh.normals);
      for (const RefinedPrimvar<Real>& primvar : mesh.primvars)
        bytes += sizeof primvar + bytes_of(primvar.values) + bytes_of(primvar.indices);
    }
    for (const RefinedCurves<Real>& curves : answer().curves)
      bytes += sizeof curves + bytes_of(curves.points) + bytes_of(curves.vertex_counts);
    for (const RefinedPatch<Real>& surface : answer().surfaces)
      bytes +=
          sizeof surface + bytes_of(surface.points) + bytes_of(surface.faces) + bytes_of(surface.normals);
    for (const auto& names : document_->names)
      for (const NameList& list : names) bytes += NameList::bytes_of(list.size(), list.text_size());
    document_->held_bytes = bytes;
  }

  const RefineRequest& request_;
  const Pace& pace_;
  std::unique_ptr<Document<Real>> document_;
  Carried carried_;
  bool alone_ = false;
  Count next_point_ = 1, next_texcoord_ = 1, next_normal_ = 1;
};

template <class Real>
Result<Payload> write_text(const RefineRequest& request, RefineAnswer<Real> answer,
                           std::vector<std::string> warnings, const Budget& budget) {
  auto document = stoppable(budget, [&](const Pace& pace) {
    return DocumentMaker<Real>(request, std::move(answer), pace).make(std::move(warnings));
  });
  if (!document) return std::move(document).error();
  auto chunk = make_chunk(*std::move(document), budget);
  if (!chunk) return std::move(chunk).error();
  Payload payload;
  payload.content_type = media_type(answer_format(request));
  payload.chunks.push_back(*std::move(chunk));
  return payload;
}

}  // namespace

Result<Payload> write(const RefineRequest& request, AnyAnswer answer, std::vector<std::string> warnings,
                      const Budget& budget) {
  return std::visit(
      [&](auto& typed) { return write_text(request, std::move(typed), std::move(warnings), budget); },
      answer);
}

}  // namespace subdivd::proto::text
