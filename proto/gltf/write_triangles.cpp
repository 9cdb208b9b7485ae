#include "proto/gltf/write_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/buffer.h"
#include "core/mesh/scan.h"
#include "proto/gltf/ngons.h"
#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

Error not_single(const std::string& attribute) {
  return Error{ErrorCode::not_finite, (attribute == "POSITION" ? attribute : in_quotes(attribute)) +
                                          " holds values too large for the single precision of glTF"};
}

constexpr Count kPiece = 16384;  // elements between two looks at the clock

using Vector = std::array<double, 3>;

template <class Real>
class TrianglesWriter {
 public:
  TrianglesWriter(const TrianglesSlot& slot, RefinedMesh<Real>& mesh, Output& output, Warnings& warnings,
                  Work& work)
      : slot_(slot), mesh_(mesh), output_(output), warnings_(warnings), work_(work) {}

  Result<void> write();

 private:
  Result<void> find_vertices();
  Result<Buffer<float>> taken(Buffer<Real>& values, Index width, Index components,
                              std::span<const Index> sources) const;
  Result<Buffer<float>> positions();
  Result<Buffer<float>> normals(std::span<const float> positions);
  Result<Buffer<float>> attribute(const AttributeSlot& attribute);
  std::span<const Index> sources_of(const AttributeSlot& attribute) const;
  Result<Vector> stand_in_normal(std::span<const float> positions, Index vertex, Count ordinal);
  Result<void> add(const std::string& name, Buffer<float> values, Index components);
  Result<Index> add_indices();

  const TrianglesSlot& slot_;
  RefinedMesh<Real>& mesh_;
  Output& output_;
  Warnings& warnings_;
  Work& work_;
  Index vertex_count_ = 0;
  Buffer<Index> indices_;                // once they are written
  TriangleStream triangles_;             // until then
  bool has_ngons_ = false;               // the triangles tell larger faces apart
  RefinedRenderMesh* render_ = nullptr;  // null: vertices are the refined mesh's own
  Json attributes_;
};

// Vertices that no triangle uses copy some vertex of their primitive, so that bounds stay tight.
// False: there is none that any uses.
Result<bool> stand_in(Buffer<Index>& sources, Work& work) {
  const auto used = std::ranges::find_if(sources, [](Index source) { return source != kNoIndex; });
  if (used == sources.end()) return false;
  const Index source = *used;
  for (std::span<Index> rest(sources); !rest.empty(); rest = rest.subspan(std::min(rest.size(), kPiece))) {
    if (auto stop = work.spend(kPiece / 4)) return *std::move(stop);
    std::ranges::replace(rest.first(std::min(rest.size(), kPiece)), kNoIndex, source);
  }
  return true;
}

template <class Real>
Result<void> TrianglesWriter<Real>::find_vertices() {
  if (slot_.render_mesh == kNoIndex) {
    vertex_count_ = static_cast<Index>(mesh_.points.size() / 3);
    indices_ = std::move(mesh_.faces);
    return {};
  }
  render_ = &mesh_.render_meshes[slot_.render_mesh];
  triangles_ = std::move(render_->triangles);
  if (slot_.ngons) has_ngons_ = triangles_.tell_faces_apart();
  vertex_count_ = render_->vertex_count;
  if (!render_->source_vertices.empty()) {
    const auto used = stand_in(render_->source_vertices, work_);
    if (!used) return used.error();
    if (!*used) vertex_count_ = 0;
  }
  for (Buffer<Index>& sources : render_->source_values)
    if (auto done = stand_in(sources, work_); !done) return done.error();
  return {};
}

// The first `components` of every value, in the vertices' order. Without sources and with nothing to leave
// out the refined array itself travels on: no copy between the core and the socket. With sources this gather
// is that copy: split vertices exist nowhere else.
template <class Real>
Result<Buffer<float>> TrianglesWriter<Real>::taken(Buffer<Real>& values, Index width, Index components,
                                                   std::span<const Index> sources) const {
  if constexpr (std::is_same_v<Real, float>)
    if (sources.empty() && width == components && values.size() == Count{vertex_count_} * width)
      return std::move(values);
  Buffer<float> out(Count{vertex_count_} * components);
  const auto gather = [&](auto count) {
    return in_shared_blocks(vertex_count_, work_, [&](Count begin, Count end) {
      float* to = out.data() + begin * count;
      for (Count v = begin; v < end; ++v, to += count) {
        const Real* from = values.data() + (sources.empty() ? v : Count{sources[v]}) * width;
        for (Index k = 0; k < count; ++k) to[k] = static_cast<float>(from[k]);
      }
    });
  };
  const auto gathered = components == 3   ? gather(std::integral_constant<Index, 3>{})
                        : components == 2 ? gather(std::integral_constant<Index, 2>{})
                                          : gather(components);
  if (!gathered) return gathered.error();
  return out;
}

template <class Real>
Result<Buffer<float>> TrianglesWriter<Real>::positions() {
  Buffer<Real>& points = mesh_.limit_points.empty() ? mesh_.points : mesh_.limit_points;
  return taken(
      points, 3, 3,
      render_ != nullptr ? std::span<const Index>(render_->source_vertices) : std::span<const Index>());
}

// Looking for a vertex's triangle is linear in the mesh. Not for more vertices than this, or a mesh of
// nothing else takes its square; and not in longer meshes: one look takes 20 ms there.
constexpr Count kMostLookedFor = 64, kLongestLookedThrough = 12'000'000;

// Of the first triangle that uses the vertex and has an area; upright where there is none.
Vector flat_normal(std::span<const float> positions, std::span<const Index> indices, Index vertex) {
  const auto at = [&](Count corner, Count k) { return double{positions[Count{indices[corner]} * 3 + k]}; };
  for (Count t = 0; t + 2 < indices.size(); t += 3) {
    if (std::ranges::count(indices.subspan(t, 3), vertex) == 0) continue;
    Vector a{}, b{};
    for (Count k = 0; k < 3; ++k) a[k] = at(t + 1, k) - at(t, k), b[k] = at(t + 2, k) - at(t, k);
    const Vector n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    if (const double length = std::hypot(n[0], n[1], n[2]); length > 0 && std::isfinite(length))
      return {n[0] / length, n[1] / length, n[2] / length};
  }
  return {0, 0, 1};
}

// Of the vertex that is the `ordinal`-th that needs one. It is looked for among the indices, which are
// written for that, earlier than needed: they are part of what was granted for the answer.
template <class Real>
Result<Vector> TrianglesWriter<Real>::stand_in_normal(std::span<const float> positions, Index vertex,
                                                      Count ordinal) {
  constexpr Vector kUpright{0, 0, 1};
  if (ordinal >= kMostLookedFor) return kUpright;
  if (indices_.empty() && triangles_.index_count() <= kLongestLookedThrough) {
    auto written = triangles_.all(work_.budget().threads(), work_.budget());
    if (!written) return written.error();
    indices_ = *std::move(written);
  }
  if (indices_.empty() || indices_.size() > kLongestLookedThrough) return kUpright;
  if (auto stop = work_.spend(indices_.size())) return *std::move(stop);
  return flat_normal(positions, indices_, vertex);
}

template <class Real>
Result<Buffer<float>> TrianglesWriter<Real>::normals(std::span<const float> positions) {
  Result<Buffer<float>> out =
      taken(mesh_.normals, 3, 3,
            render_ != nullptr ? std::span<const Index>(render_->source_vertices) : std::span<const Index>());
  if (!out) return out;
  Count stand_ins = 0;
  for (Index v = 0; v < vertex_count_; ++v) {
    if (v % 4096 == 0)
      if (auto stop = work_.spend(1024)) return *std::move(stop);
    float* normal = out->data() + Count{v} * 3;
    if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0) continue;
    const Result<Vector> flat = stand_in_normal(positions, v, stand_ins++);
    if (!flat) return flat.error();
    std::ranges::transform(*flat, normal, [](double x) { return static_cast<float>(x); });
  }
  if (stand_ins > 0)
    warnings_.add("NORMAL where the surface has none is a unit vector of no meaning; such vertices",
                  Place().at("meshes").at(slot_.mesh).at("primitives").at(slot_.primitive), stand_ins);
  return out;
}

template <class Real>
std::span<const Index> TrianglesWriter<Real>::sources_of(const AttributeSlot& attribute) const {
  if (render_ == nullptr) return {};
  const auto is_channel = [](const RefinedPrimvar<Real>& p) {
    return p.interpolation == Interpolation::face_varying;
  };
  if (!is_channel(mesh_.primvars[attribute.primvar])) return render_->source_vertices;
  const auto first = mesh_.primvars.begin();
  const auto channel =
      std::count_if(first, first + static_cast<std::ptrdiff_t>(attribute.primvar), is_channel);
  return render_->source_values[static_cast<std::size_t>(channel)];
}

template <class Real>
Result<Buffer<float>> TrianglesWriter<Real>::attribute(const AttributeSlot& attribute) {
  RefinedPrimvar<Real>& primvar = mesh_.primvars[attribute.primvar];
  Buffer<Real>& values = primvar.limit_values.empty() ? primvar.values : primvar.limit_values;
  return taken(values, primvar.element_size, attribute.components, sources_of(attribute));
}

template <class Real>
Result<void> TrianglesWriter<Real>::add(const std::string& name, Buffer<float> values, Index components) {
  const bool is_position = name == "POSITION";
  const Clamp clamp = semantic_of(name) == Semantic::color ? Clamp::unit : Clamp::none;
  const auto scanned = scan_floats(values, components, is_position, clamp, work_);
  if (!scanned) return scanned.error();
  if (!scanned->finite) return not_single(name);
  const Index accessor = output_.add_floats(std::move(values), components, *scanned);
  attributes_.set(name, Json::number(Count{accessor}));
  return {};
}

template <class Real>
Result<Index> TrianglesWriter<Real>::add_indices() {
  const Index vertices = std::max<Index>(vertex_count_, 1);
  if (indices_.empty() && triangles_.index_count() == 0) indices_ = {0, 0, 0};
  return indices_.empty() ? output_.add_indices(std::move(triangles_), vertices)
                          : output_.add_indices(std::move(indices_), vertices);
}

template <class Real>
Result<void> TrianglesWriter<Real>::write() {
  if (auto stop = work_.spend(256)) return *std::move(stop);
  if (auto found = find_vertices(); !found) return found;
  Json& primitive = output_.primitive(slot_.mesh, slot_.primitive);
  attributes_ = std::move(*primitive.find("attributes"));
  const bool empty = vertex_count_ == 0;
  auto points = empty ? Result<Buffer<float>>(Buffer<float>(3, 0.0f)) : positions();
  if (!points) return points.error();
  Result<Buffer<float>> unit = Buffer<float>{0, 0, 1};
  if (slot_.normals && !empty) unit = normals(*points);
  if (!unit) return unit.error();
  if (auto added = add("POSITION", *std::move(points), 3); !added) return added;
  if (slot_.normals)
    if (auto added = add("NORMAL", *std::move(unit), 3); !added) return added;
  for (const AttributeSlot& slot : slot_.attributes) {
    const bool split = mesh_.primvars[slot.primvar].interpolation == Interpolation::face_varying;
    if (split && render_ == nullptr && !empty) continue;  // add_render_meshes was not called
    auto values = empty ? Result<Buffer<float>>(Buffer<float>(slot.components, 0.0f)) : attribute(slot);
    if (!values) return values.error();
    if (auto added = add(slot.name, *std::move(values), slot.components); !added) return added;
  }
  const auto accessor = add_indices();
  if (!accessor) return accessor.error();
  primitive.set("attributes", std::move(attributes_));
  primitive.set("indices", Json::number(Count{*accessor}));
  if (has_ngons_) {
    set_ngon_encoding(primitive);
    output_.use_extension(kNgonEncoding);
  }
  return {};
}

}  // namespace

template <class Real>
Result<void> write_triangles(const TrianglesSlot& slot, RefinedMesh<Real>& mesh, Output& output,
                             Warnings& warnings, Work& work) {
  return TrianglesWriter<Real>(slot, mesh, output, warnings, work).write();
}

template Result<void> write_triangles(const TrianglesSlot&, RefinedMesh<float>&, Output&, Warnings&, Work&);
template Result<void> write_triangles(const TrianglesSlot&, RefinedMesh<double>&, Output&, Warnings&, Work&);

}  // namespace subdivd::proto::gltf
