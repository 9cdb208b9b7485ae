#include "proto/gltf/write_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "proto/gltf/fresh.h"

namespace subdivd::proto::gltf {
namespace {

Error not_single(const std::string& attribute) {
  return Error{ErrorCode::not_finite,
               attribute + " holds values too large for the single precision of glTF",
               {},
               0,
               0};
}

bool all_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

template <class Real>
class TrianglesWriter {
 public:
  TrianglesWriter(const TrianglesSlot& slot, RefinedMesh<Real>& mesh, Output& output, Warnings& warnings)
      : slot_(slot), mesh_(mesh), output_(output), warnings_(warnings) {}

  Result<void> write();

 private:
  void find_vertices();
  std::vector<float> positions() const;
  std::vector<float> normals(const std::vector<float>& positions);
  std::vector<float> attribute(const AttributeSlot& attribute) const;
  Result<void> add(const std::string& name, std::vector<float> values, Index components, bool bounds);
  Index vertex_of(Index v) const { return source_corner_.empty() ? v : mesh_.triangles[source_corner_[v]]; }

  const TrianglesSlot& slot_;
  RefinedMesh<Real>& mesh_;
  Output& output_;
  Warnings& warnings_;
  Index vertex_count_ = 0;
  std::vector<Index> indices_;
  std::vector<Index> source_corner_;  // per vertex; empty: vertices are the refined mesh's own
  Json attributes_;
};

template <class Real>
void TrianglesWriter<Real>::find_vertices() {
  if (slot_.render_mesh != kNoIndex) {
    RefinedRenderMesh& render = mesh_.render_meshes[slot_.render_mesh];
    vertex_count_ = render.vertex_count;
    indices_ = std::move(render.indices);
    source_corner_ = std::move(render.source_corner);
    // Vertices that no triangle uses copy some vertex of their primitive, so that bounds stay tight.
    const auto used = std::find_if(source_corner_.begin(), source_corner_.end(),
                                   [](Index corner) { return corner != kNoIndex; });
    if (used != source_corner_.end()) {
      const Index stand_in = *used;
      std::replace(source_corner_.begin(), source_corner_.end(), kNoIndex, stand_in);
    } else {
      vertex_count_ = 0;
    }
    return;
  }
  std::vector<const std::vector<Index>*> channels;
  for (const AttributeSlot& attribute : slot_.attributes)
    if (mesh_.primvars[attribute.primvar].interpolation == Interpolation::face_varying)
      channels.push_back(&mesh_.primvars[attribute.primvar].indices);
  if (channels.empty() || mesh_.triangles.empty()) {
    vertex_count_ = static_cast<Index>(mesh_.points.size() / 3);
    indices_ = mesh_.triangles;
    return;
  }
  SplitVertices split = split_vertices(mesh_.triangles, channels);
  vertex_count_ = split.vertex_count;
  indices_ = std::move(split.indices);
  source_corner_ = std::move(split.source_corner);
}

template <class Real>
std::vector<float> TrianglesWriter<Real>::positions() const {
  const std::vector<Real>& points = mesh_.limit_points.empty() ? mesh_.points : mesh_.limit_points;
  std::vector<float> out(Count{vertex_count_} * 3);
  for (Index v = 0; v < vertex_count_; ++v)
    for (Count k = 0; k < 3; ++k)
      out[Count{v} * 3 + k] = static_cast<float>(points[Count{vertex_of(v)} * 3 + k]);
  return out;
}

using Vector = std::array<double, 3>;

// Of the first triangle that uses the vertex and has an area; upright where there is none.
Vector flat_normal(const std::vector<float>& positions, const std::vector<Index>& indices, Index vertex) {
  const auto at = [&](Count corner, Count k) { return double{positions[Count{indices[corner]} * 3 + k]}; };
  for (Count t = 0; t + 2 < indices.size(); t += 3) {
    if (std::find(indices.begin() + t, indices.begin() + t + 3, vertex) == indices.begin() + t + 3) continue;
    Vector a{}, b{};
    for (Count k = 0; k < 3; ++k) a[k] = at(t + 1, k) - at(t, k), b[k] = at(t + 2, k) - at(t, k);
    const Vector n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    if (const double length = std::hypot(n[0], n[1], n[2]); length > 0 && std::isfinite(length))
      return {n[0] / length, n[1] / length, n[2] / length};
  }
  return {0, 0, 1};
}

template <class Real>
std::vector<float> TrianglesWriter<Real>::normals(const std::vector<float>& positions) {
  std::vector<float> out(Count{vertex_count_} * 3);
  Count stand_ins = 0;
  for (Index v = 0; v < vertex_count_; ++v) {
    Vector normal{};
    for (Count k = 0; k < 3; ++k) normal[k] = double(mesh_.normals[Count{vertex_of(v)} * 3 + k]);
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (length > 0.5 && length < 2) {
      for (double& component : normal) component /= length;
    } else {
      // Looking for a triangle is linear in the mesh; bounded, or a mesh of such vertices takes its square.
      normal = ++stand_ins <= 64 ? flat_normal(positions, indices_, v) : Vector{0, 0, 1};
    }
    for (Count k = 0; k < 3; ++k) out[Count{v} * 3 + k] = static_cast<float>(normal[k]);
  }
  if (stand_ins > 0)
    warnings_.add("NORMAL where the surface has none is a unit vector of no meaning: " +
                      std::to_string(stand_ins) + (stand_ins == 1 ? " vertex" : " vertices"),
                  "/meshes/" + std::to_string(slot_.mesh) + "/primitives/" + std::to_string(slot_.primitive));
  return out;
}

template <class Real>
std::vector<float> TrianglesWriter<Real>::attribute(const AttributeSlot& attribute) const {
  const RefinedPrimvar<Real>& primvar = mesh_.primvars[attribute.primvar];
  const std::vector<Real>& values = primvar.limit_values.empty() ? primvar.values : primvar.limit_values;
  const bool face_varying = primvar.interpolation == Interpolation::face_varying;
  const bool color = semantic_of(attribute.name) == Semantic::color;
  std::vector<float> out(Count{vertex_count_} * attribute.components);
  for (Index v = 0; v < vertex_count_; ++v) {
    // Without triangles there are no corners; the one vertex that stands for them copies the first value.
    const Index value = !face_varying            ? vertex_of(v)
                        : source_corner_.empty() ? 0
                                                 : primvar.indices[source_corner_[v]];
    for (Index k = 0; k < attribute.components; ++k) {
      const Real scalar = values[Count{value} * primvar.element_size + k];
      out[Count{v} * attribute.components + k] =
          static_cast<float>(color ? std::clamp(scalar, Real(0), Real(1)) : scalar);
    }
  }
  return out;
}

template <class Real>
Result<void> TrianglesWriter<Real>::add(const std::string& name, std::vector<float> values, Index components,
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
  std::vector<float> points = empty ? std::vector<float>(3) : positions();
  if (!all_finite(points)) return not_single("POSITION");
  if (indices_.empty()) indices_ = {0, 0, 0};
  std::vector<float> unit;
  if (slot_.normals) unit = empty ? std::vector<float>{0, 0, 1} : normals(points);
  if (auto added = add("POSITION", std::move(points), 3, true); !added) return added;
  if (slot_.normals)
    if (auto added = add("NORMAL", std::move(unit), 3, false); !added) return added;
  for (const AttributeSlot& slot : slot_.attributes) {
    std::vector<float> values = empty ? std::vector<float>(slot.components) : attribute(slot);
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
