#include "proto/cut_faces.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/buffer.h"
#include "core/base/pace.h"

namespace subdivd::proto {
namespace {

// The faces of a refined mesh, before they are cut.
class Cutter {
 public:
  template <class Real>
  Cutter(const RefinedMesh<Real>& mesh, const Pace& pace)
      : face_count_(mesh.face_count), size_(mesh.face_size), sizes_(mesh.face_vertex_counts), pace_(pace) {
    if (size_ != 0)
      triangle_count_ = (size_ - 2) * face_count_;
    else
      pace.for_each(sizes_.size(), [&](Count f) { triangle_count_ += sizes_[f] - 2; });
  }

  Count triangle_count() const { return triangle_count_; }

  // What the corners of all faces have in turn becomes what those of the triangles have.
  Buffer<Index> of_corners(const Buffer<Index>& values) const {
    Buffer<Index> cut(3 * triangle_count_);
    const Index* face = values.data();
    Index* at = cut.data();
    for_each_face([&](Index size) {
      pace_.in_blocks(size - 2, [&](Count begin, Count end) {
        for (Count k = begin; k < end; ++k, at += 3)
          at[0] = face[0], at[1] = face[k + 1], at[2] = face[k + 2];
      });
      face += size;
    });
    return cut;
  }

  // What faces have, `width` each.
  template <class T>
  Buffer<T> of_faces(const Buffer<T>& values, Count width) const {
    Buffer<T> cut(triangle_count_ * width);
    const T* face = values.data();
    T* at = cut.data();
    for_each_face([&](Index size) {
      pace_.in_blocks(
          size - 2,
          [&](Count begin, Count end) {
            for (Count k = begin; k < end; ++k) at = std::copy_n(face, width, at);
          },
          width);
      face += width;
    });
    return cut;
  }

 private:
  template <class F>
  void for_each_face(F&& f) const {
    for (Count k = 0; k < face_count_; ++k) f(size_ != 0 ? size_ : sizes_[k]);
  }

  Count face_count_, triangle_count_ = 0;
  Index size_;  // of every face; 0: `sizes_` tells
  std::span<const Index> sizes_;
  const Pace& pace_;
};

}  // namespace

bool cuts_faces(const RefineRequest& request) {
  return request.options.faces == Faces::triangles && !is_gltf(answer_format(request));
}

RefinedSize cut_size(RefinedSize size) {
  size.counts.faces = size.corners - 2 * size.counts.faces;
  size.counts.face_size = 3;
  size.corners = 3 * size.counts.faces;
  return size;
}

Count cutting_bytes(const ControlMesh& mesh, const RefinedSize& cut, Count scalar) {
  Count bytes = cut.corners * sizeof(Index);
  for (const Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation == Interpolation::face_varying) bytes += cut.corners * sizeof(Index);
    if (primvar.interpolation == Interpolation::uniform)
      bytes += cut.counts.faces * primvar.element_size * scalar;
  }
  return bytes;
}

template <class Real>
Result<void> cut_faces(RefinedMesh<Real>& mesh, const Budget& budget) {
  if (mesh.face_size == 3) return {};
  return stoppable(budget, [&](const Pace& pace) {
    const Cutter cutter(mesh, pace);
    if (!mesh.faces.empty()) mesh.faces = cutter.of_corners(mesh.faces);
    if (!mesh.base_faces.empty()) mesh.base_faces = cutter.of_faces(mesh.base_faces, 1);
    for (RefinedPrimvar<Real>& primvar : mesh.primvars) {
      if (!primvar.indices.empty()) primvar.indices = cutter.of_corners(primvar.indices);
      if (primvar.interpolation == Interpolation::uniform)
        primvar.values = cutter.of_faces(primvar.values, primvar.element_size);
    }
    mesh.face_count = cutter.triangle_count();
    mesh.face_size = 3;
    mesh.face_vertex_counts = {};
  });
}

template Result<void> cut_faces(RefinedMesh<float>&, const Budget&);
template Result<void> cut_faces(RefinedMesh<double>&, const Budget&);

}  // namespace subdivd::proto
