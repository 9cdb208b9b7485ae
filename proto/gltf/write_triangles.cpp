#include "proto/gltf/write_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/buffer.h"

namespace subdivd::proto::gltf {
namespace {

Error not_single(const std::string& attribute) {
  return Error{ErrorCode::not_finite,
               attribute + " holds values too large for the single precision of glTF",
               {},
               0,
               0};
}

// A test of bits, and no way out before the end: the loop fills the lanes.
bool all_finite(std::span<const float> values) {
  constexpr std::uint32_t kExponent = 0x7f800000;
  std::uint32_t bad = 0;
  for (const float value : values)
    bad |= static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  return bad == 0;
}

template <class Real>
class TrianglesWriter {
 public:
  TrianglesWriter(const TrianglesSlot& slot, RefinedMesh<Real>& mesh, Output& output, Warnings& warnings)
      : slot_(slot), mesh_(mesh), output_(output), warnings_(warnings) {}

  Result<void> write();

 private:
  void find_vertices();
  Buffer<float> taken(Buffer<Real>& values, Index width, Index components,
                      std::span<const Index> sources) const;
  Buffer<float> positions();
  Buffer<float> normals(std::span<const float> positions);
  Buffer<float> attribute(const AttributeSlot& attribute);
  std::span<const Index> sources_of(const AttributeSlot& attribute) const;
  Result<void> add(const std::string& name, Buffer<float> values, Index components, bool bounds);

  const TrianglesSlot& slot_;
  RefinedMesh<Real>& mesh_;
  Output& output_;
  Warnings& warnings_;
  Index vertex_count_ = 0;
  Buffer<Index> indices_;
  RefinedRenderMesh* render_ = nullptr;  // null: vertices are the refined mesh's own
  Json attributes_;
};

// Vertices that no triangle uses copy some vertex of their primitive, so that bounds stay tight.
bool stand_in(Buffer<Index>& sources) {
  const auto used = std::ranges::find_if(sources, [](Index source) { return source != kNoIndex; });
  if (used == sources.end()) return false;
  std::ranges::replace(sources, kNoIndex, Index{*used});
  return true;
}

template <class Real>
void TrianglesWriter<Real>::find_vertices() {
  if (slot_.render_mesh == kNoIndex) {
    vertex_count_ = static_cast<Index>(mesh_.points.size() / 3);
    indices_ = std::move(mesh_.triangles);
    return;
  }
  render_ = &mesh_.render_meshes[slot_.render_mesh];
  indices_ = std::move(render_->indices);
  vertex_count_ = stand_in(render_->source_vertices) ? render_->vertex_count : 0;
  for (Buffer<Index>& sources : render_->source_values) stand_in(sources);
}

// The first `components` of every value, in the vertices' order. Without sources and with nothing to leave
// out the refined array itself travels on: no copy between the core and the socket. With sources this gather
// is that copy: split vertices exist nowhere else.
template <class Real>
Buffer<float> TrianglesWriter<Real>::taken(Buffer<Real>& values, Index width, Index components,
                                           std::span<const Index> sources) const {
  if constexpr (std::is_same_v<Real, float>)
    if (sources.empty() && width == components && values.size() == Count{vertex_count_} * width)
      return std::move(values);
  Buffer<float> out(Count{vertex_count_} * components);
  const auto gather = [&](auto count) {
    float* to = out.data();
    for (Index v = 0; v < vertex_count_; ++v, to += count) {
      const Real* from = values.data() + Count{sources.empty() ? v : sources[v]} * width;
      for (Index k = 0; k < count; ++k) to[k] = static_cast<float>(from[k]);
    }
  };
  if (components == 3)
    gather(std::integral_constant<Index, 3>{});
  else if (components == 2)
    gather(std::integral_constant<Index, 2>{});
  else
    gather(components);
  return out;
}

template <class Real>
Buffer<float> TrianglesWriter<Real>::positions() {
  Buffer<Real>& points = mesh_.limit_points.empty() ? mesh_.points : mesh_.limit_points;
  return taken(
      points, 3, 3,
      render_ != nullptr ? std::span<const Index>(render_->source_vertices) : std::span<const Index>());
}

using Vector = std::array<double, 3>;

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

template <class Real>
Buffer<float> TrianglesWriter<Real>::normals(std::span<const float> positions) {
  Buffer<float> out =
      taken(mesh_.normals, 3, 3,
            render_ != nullptr ? std::span<const Index>(render_->source_vertices) : std::span<const Index>());
  Count stand_ins = 0;
  for (Index v = 0; v < vertex_count_; ++v) {
    float* normal = out.data() + Count{v} * 3;
    if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0) continue;
    // Looking for a triangle is linear in the mesh; bounded, or a mesh of such vertices takes its square.
    const Vector flat = ++stand_ins <= 64 ? flat_normal(positions, indices_, v) : Vector{0, 0, 1};
    std::ranges::transform(flat, normal, [](double x) { return static_cast<float>(x); });
  }
  if (stand_ins > 0)
    warnings_.add("NORMAL where the surface has none is a unit vector of no meaning: " +
                      std::to_string(stand_ins) + (stand_ins == 1 ? " vertex" : " vertices"),
                  "/meshes/" + std::to_string(slot_.mesh) + "/primitives/" + std::to_string(slot_.primitive));
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
Buffer<float> TrianglesWriter<Real>::attribute(const AttributeSlot& attribute) {
  RefinedPrimvar<Real>& primvar = mesh_.primvars[attribute.primvar];
  Buffer<Real>& values = primvar.limit_values.empty() ? primvar.values : primvar.limit_values;
  Buffer<float> out = taken(values, primvar.element_size, attribute.components, sources_of(attribute));
  if (semantic_of(attribute.name) == Semantic::color)
    for (float& value : out) value = std::clamp(value, 0.0f, 1.0f);
  return out;
}

template <class Real>
Result<void> TrianglesWriter<Real>::add(const std::string& name, Buffer<float> values, Index components,
                                        bool bounds) {
  if (!all_finite(values)) return not_single(name);
  attributes_.set(name, Json::number(Count{output_.add_floats(std::move(values), components, bounds)}));
  return {};
}

template <class Real>
Result<void> TrianglesWriter<Real>::write() {
  find_vertices();
  Json& primitive = output_.primitive(slot_.mesh, slot_.primitive);
  attributes_ = std::move(*primitive.find("attributes"));
  const bool empty = vertex_count_ == 0;
  Buffer<float> points = empty ? Buffer<float>(3, 0.0f) : positions();
  if (!all_finite(points)) return not_single("POSITION");
  if (indices_.empty()) indices_ = {0, 0, 0};
  Buffer<float> unit;
  if (slot_.normals) unit = empty ? Buffer<float>{0, 0, 1} : normals(points);
  if (auto added = add("POSITION", std::move(points), 3, true); !added) return added;
  if (slot_.normals)
    if (auto added = add("NORMAL", std::move(unit), 3, false); !added) return added;
  for (const AttributeSlot& slot : slot_.attributes) {
    const bool split = mesh_.primvars[slot.primvar].interpolation == Interpolation::face_varying;
    if (split && render_ == nullptr && !empty) continue;  // add_render_meshes was not called
    Buffer<float> values = empty ? Buffer<float>(slot.components, 0.0f) : attribute(slot);
    if (auto added = add(slot.name, std::move(values), slot.components, false); !added) return added;
  }
  const Index accessor = output_.add_indices(std::move(indices_), std::max<Index>(vertex_count_, 1));
  primitive.set("attributes", std::move(attributes_));
  primitive.set("indices", Json::number(Count{accessor}));
  return {};
}

}  // namespace

template <class Real>
Result<void> write_triangles(const TrianglesSlot& slot, RefinedMesh<Real>& mesh, Output& output,
                             Warnings& warnings) {
  return TrianglesWriter<Real>(slot, mesh, output, warnings).write();
}

template Result<void> write_triangles(const TrianglesSlot&, RefinedMesh<float>&, Output&, Warnings&);
template Result<void> write_triangles(const TrianglesSlot&, RefinedMesh<double>&, Output&, Warnings&);

}  // namespace subdivd::proto::gltf
