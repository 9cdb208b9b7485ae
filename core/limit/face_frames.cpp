#include "core/limit/face_frames.h"

#include <algorithm>

namespace subdivd {
namespace {

template <class Real>
void cross(const Real a[3], const Real b[3], Real out[3]) {
  for (int k = 0; k < 3; ++k) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

template <class Real>
bool is_zero(const Real v[3]) {
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

}  // namespace

template <class Real>
FaceFrames<Real>::FaceFrames(std::span<const Real> points, Index face_size, std::span<const Index> corners,
                             const Pace& pace) {
  normals_.resize(points.size());
  edges_.resize(points.size());
  pace.in_blocks(points.size(), [&](Count begin, Count end) {
    std::fill_n(normals_.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, Real(0));
    std::fill_n(edges_.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, Real(0));
  });
  const auto towards = [&](Index from, Index to, Real out[3]) {
    for (Index k = 0; k < 3; ++k) out[k] = points[3 * Count{to} + k] - points[3 * Count{from} + k];
    normalize(out);
  };
  for (Count face = 0; face < corners.size(); face += face_size) {
    pace.spend(4 * face_size);
    const auto vertices = corners.subspan(face, face_size);
    for (Index k = 0; k < face_size; ++k) {
      const Index v = vertices[k];
      Real next[3], before[3], normal[3];
      towards(v, vertices[(k + 1) % face_size], next);
      towards(v, vertices[(k + face_size - 1) % face_size], before);
      cross(next, before, normal);
      for (Index axis = 0; axis < 3; ++axis) normals_[3 * Count{v} + axis] += normal[axis];
      if (Real* const edge = &edges_[3 * Count{v}]; is_zero(edge)) std::copy_n(next, 3, edge);
    }
  }
}

template <class Real>
Frame<Real> FaceFrames<Real>::at(Index vertex) const {
  Frame<Real> frame;
  std::copy_n(&normals_[3 * Count{vertex}], 3, frame.normal);
  normalize(frame.normal);
  const Real* const edge = &edges_[3 * Count{vertex}];
  cross(frame.normal, edge, frame.v);
  normalize(frame.v);
  cross(frame.v, frame.normal, frame.u);
  return frame;
}

template class FaceFrames<float>;
template class FaceFrames<double>;

}  // namespace subdivd
