#include "tests/bench/floor.h"

#include <algorithm>
#include <cstring>

#include "core/lattice/split.h"

namespace subdivd::bench {
namespace {

using Four [[gnu::vector_size(16)]] = float;

Four load(const float* at) {
  Four four;
  std::memcpy(&four, at, sizeof four);
  return four;
}

// Has been read, whatever becomes of it.
void use(const float* at) {
  const Four four = load(at);
#ifdef __x86_64__
  asm volatile("" ::"x"(four));
#else
  asm volatile("" ::"w"(four));
#endif
}

void use_run(const float* at, Count points) {
  for (Count k = 0; k < points; ++k) use(at + 3 * k);
}

// Writes one point after the other; a little of the next one with each.
class Stream {
 public:
  explicit Stream(float* to) : to_(to) {}
  void put(Four value, Count points) {
    for (Count k = 0; k < points; ++k, to_ += 3) std::memcpy(to_, &value, sizeof value);
  }

 private:
  float* to_;
};

}  // namespace

Floor::Floor(const Topology<Triangles>& topology, Index level) : topology_(topology), level_(level) {
  for (const auto& sides : topology.edge_sides()) {
    const Index any = sides[0] != kNoIndex ? sides[0] : sides[1];
    faces_.push_back({any / 3, sides[1] != kNoIndex ? sides[1] / 3 : any / 3});
  }
  for (Index k = 0; k <= level; ++k) around_.push_back(around(topology, k));
  for (Index k = 1; k < level; ++k) {
    const LevelCounts counts =
        refined_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), k);
    scratch_[k % 2].resize(3 * counts.vertices + kSpare);
  }
}

Floor::Around Floor::around(const Topology<Triangles>& topology, Index level) {
  const Count n = segments(level);
  const auto beside = [&](Index e, Index v) {
    const auto& ends = topology.edge_vertices(e);
    if (n == 1) return ends[0] == v ? ends[1] : ends[0];
    return static_cast<Index>(topology.vertex_count() + e * (n - 1) + (ends[0] == v ? 0 : n - 2));
  };
  Around around;
  for (Index v = 0; v < topology.vertex_count(); ++v)
    for (const Index e : topology.vertex_edges(v)) around.vertices.push_back(beside(e, v));
  for (Index e = 0; e < topology.edge_count(); ++e) {
    auto& points = around.edges.emplace_back();
    const auto along = topology.edge_half_edges(e);
    for (std::size_t k = 0; k < 2; ++k) {
      const Index h = along[k % along.size()], after = topology.next(h), before = topology.prev(h);
      if (n == 1) {
        points[k] = topology.corner_vertex(before);
      } else {
        points[2 * k] = beside(topology.half_edge_edge(before), topology.corner_vertex(h));
        points[2 * k + 1] = beside(topology.half_edge_edge(after), topology.corner_vertex(after));
      }
    }
  }
  return around;
}

// Calls put(a value, points) whenever as many points are to be written: for every base vertex, edge and face
// `written`.
template <class Put>
void Floor::gather(Index level, const float* from, const std::array<Count, 3>& written, Put&& put) const {
  const Count n = segments(level), inside_edge = n - 1, inside_face = (n - 1) * (n - 2) / 2;
  const Around& around = around_[level];
  const Count vertices = topology_.vertex_count(), edges = topology_.edge_count();
  const float* const on_edges = from + 3 * vertices;
  const float* const in_faces = on_edges + 3 * edges * inside_edge;
  // In two loops, for where one vertex's ring ends and the next begins is no matter of reading.
  for (const Index point : around.vertices) use(from + Count{3} * point);
  for (Count v = 0; v < vertices; ++v) put(load(from + 3 * v), written[0]);
  for (Index e = 0; e < edges; ++e) {
    const auto& ends = topology_.edge_vertices(e);
    use(from + Count{3} * ends[0]);
    use_run(on_edges + 3 * e * inside_edge, inside_edge);
    for (Count k = 0; k < (n == 1 ? 2 : 4); ++k) use(from + Count{3} * around.edges[e][k]);
    if (n > 2)
      for (const Index face : faces_[e]) use_run(in_faces + 3 * face * inside_face, n - 2);
    put(load(from + Count{3} * ends[1]), written[1]);
  }
  if (written[2] == 0) return;
  for (Index f = 0; f < topology_.face_count(); ++f) {
    const Index* v = topology_.corner_vertices().data() + Count{3} * f;
    const Index* e = topology_.half_edge_edges().data() + Count{3} * f;
    for (int k = 0; k < 3; ++k) use_run(on_edges + 3 * e[k] * inside_edge, inside_edge);
    use_run(in_faces + 3 * f * inside_face, inside_face);
    use(from + Count{3} * v[1]);
    use(from + Count{3} * v[2]);
    put(load(from + Count{3} * v[0]), written[2]);
  }
}

void Floor::refine(const std::vector<float>& control, float* points) {
  scratch_[0].resize(std::max<std::size_t>(scratch_[0].size(), control.size() + kSpare));
  std::memcpy(scratch_[0].data(), control.data(), control.size() * sizeof(float));
  for (Index level = 0; level < level_; ++level) {
    const Count n = segments(level);
    Stream stream(level + 1 == level_ ? points : scratch_[(level + 1) % 2].data());
    gather(level, scratch_[level % 2].data(), {1, 2 * n - 1, (2 * n - 1) * (n - 1)},
           [&](Four value, Count count) { stream.put(value, count); });
  }
}

void Floor::limit(const Buffer<float>& points, float* limits, float* normals) {
  const Count n = segments(level_);
  Stream first(limits), second(normals);
  gather(level_, points.data(), {1, n - 1, (n - 1) * (n - 2) / 2}, [&](Four value, Count count) {
    first.put(value, count);
    second.put(value, count);
  });
}

}  // namespace subdivd::bench
