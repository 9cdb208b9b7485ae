// Catmull and Clark's scheme the half-edge way: every half-edge of a level makes four of the next by formulas of its own
// number and its neighbours', so that nothing is searched for after the control mesh. Written for this bench from the
// rule, in the plainest way that is fast; creases, borders and corners as OpenSubdiv has them.
//   [DupuyVanhoey21]  J. Dupuy, K. Vanhoey, A Halfedge Refinement Rule for Parallel Catmull-Clark Subdivision, HPG 2021
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "tests/bench/peers.h"
#include "tests/bench/stopwatch.h"

namespace subdivd::bench {
namespace {

// Faces are quads: half-edge h belongs to face h / 4.
struct Level {
  int vertices = 0, edges = 0;
  std::vector<int> vertex, twin, edge;  // of every half-edge: where it begins; -1: none; its edge
  std::vector<float> sharpness;         // of every edge; borders 10
  std::vector<float> points;            // x y z

  int half_edges() const { return static_cast<int>(vertex.size()); }
  static int next(int h) { return h % 4 == 3 ? h - 3 : h + 1; }
  static int prev(int h) { return h % 4 == 0 ? h + 3 : h - 1; }
  float sharpness_of(int h) const {
    return sharpness[static_cast<std::size_t>(edge[static_cast<std::size_t>(h)])];
  }
};

constexpr float kInfinite = 10;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// False where an edge has more than two faces.
bool build(const PeerJob& job, Level& level) {
  level.vertices = static_cast<int>(job.points.size() / 3);
  level.points.assign(job.points.begin(), job.points.end());
  level.vertex.assign(job.corners.begin(), job.corners.end());
  const int half_edges = level.half_edges();
  level.twin.assign(at(half_edges), -1);
  level.edge.assign(at(half_edges), -1);
  // Half-edges by the vertex that they leave.
  std::vector<int> begins(at(level.vertices + 1), 0), leaving(at(half_edges));
  for (int h = 0; h < half_edges; ++h) ++begins[at(level.vertex[at(h)] + 1)];
  for (int v = 0; v < level.vertices; ++v) begins[at(v + 1)] += begins[at(v)];
  std::vector<int> place = begins;
  for (int h = 0; h < half_edges; ++h) leaving[at(place[at(level.vertex[at(h)])]++)] = h;
  for (int h = 0; h < half_edges; ++h) {
    if (level.edge[at(h)] >= 0) continue;
    const int from = level.vertex[at(h)], to = level.vertex[at(Level::next(h))];
    for (int k = begins[at(to)]; k < begins[at(to + 1)]; ++k) {
      const int other = leaving[at(k)];
      if (level.vertex[at(Level::next(other))] != from) continue;
      if (level.twin[at(h)] >= 0) return false;
      level.twin[at(h)] = other;
      level.twin[at(other)] = h;
      level.edge[at(other)] = level.edges;
    }
    level.edge[at(h)] = level.edges++;
  }
  level.sharpness.assign(at(level.edges), 0);
  for (int h = 0; h < half_edges; ++h)
    if (level.twin[at(h)] < 0) level.sharpness[at(level.edge[at(h)])] = kInfinite;
  std::map<std::pair<int, int>, float> creases;
  for (std::size_t k = 0; k < job.crease_sharpnesses.size(); ++k) {
    const int a = job.creases[2 * k], b = job.creases[2 * k + 1];
    creases[{std::min(a, b), std::max(a, b)}] = job.crease_sharpnesses[k];
  }
  if (creases.empty()) return true;
  for (int h = 0; h < half_edges; ++h) {
    const int a = level.vertex[at(h)], b = level.vertex[at(Level::next(h))];
    const auto found = creases.find({std::min(a, b), std::max(a, b)});
    float& sharpness = level.sharpness[at(level.edge[at(h)])];
    if (found != creases.end()) sharpness = std::max(sharpness, found->second);
  }
  return true;
}

// The next level's half-edges: those of corner h are 4 h to 4 h + 3. The points of faces follow those of vertices, those
// of edges follow these.
void refine_topology(const Level& old, bool last, std::uint32_t* corners, Level& next) {
  const int half_edges = old.half_edges(), faces = half_edges / 4;
  const int first_edge_point = old.vertices + faces;
  next.vertices = first_edge_point + old.edges;
  for (int h = 0; h < half_edges; ++h) {
    std::uint32_t* const to = corners + 4 * at(h);
    to[0] = static_cast<std::uint32_t>(old.vertex[at(h)]);
    to[1] = static_cast<std::uint32_t>(first_edge_point + old.edge[at(h)]);
    to[2] = static_cast<std::uint32_t>(old.vertices + h / 4);
    to[3] = static_cast<std::uint32_t>(first_edge_point + old.edge[at(Level::prev(h))]);
  }
  if (last) return;
  next.edges = 2 * old.edges + half_edges;
  next.vertex.resize(4 * at(half_edges));
  next.twin.resize(4 * at(half_edges));
  next.edge.resize(4 * at(half_edges));
  for (int h = 0; h < half_edges; ++h) {
    const int before = Level::prev(h), twin = old.twin[at(h)], twin_before = old.twin[at(before)];
    for (int k = 0; k < 4; ++k) next.vertex[at(4 * h + k)] = static_cast<int>(corners[at(4 * h + k)]);
    int* const twins = &next.twin[at(4 * h)];
    twins[0] = twin < 0 ? -1 : 4 * Level::next(twin) + 3;
    twins[1] = 4 * Level::next(h) + 2;
    twins[2] = 4 * before + 1;
    twins[3] = twin_before < 0 ? -1 : 4 * twin_before;
    int* const edges = &next.edge[at(4 * h)];
    edges[0] = 2 * old.edge[at(h)] + (h > twin ? 0 : 1);
    edges[1] = 2 * old.edges + h;
    edges[2] = 2 * old.edges + before;
    edges[3] = 2 * old.edge[at(before)] + (before > twin_before ? 1 : 0);
  }
  next.sharpness.assign(at(next.edges), 0);
  for (int e = 0; e < old.edges; ++e) {
    const float s = old.sharpness[at(e)];
    next.sharpness[at(2 * e)] = next.sharpness[at(2 * e + 1)] = s >= kInfinite ? s : std::max(s - 1, 0.f);
  }
}

void put_face_points(const Level& old, float* out) {
  for (int h = 0; h < old.half_edges(); h += 4, out += 3)
    for (std::size_t c = 0; c < 3; ++c) {
      float sum = 0;
      for (int k = 0; k < 4; ++k) sum += old.points[3 * at(old.vertex[at(h + k)]) + c];
      out[c] = sum / 4;
    }
}

void put_edge_points(const Level& old, const float* face_points, float* out) {
  for (int h = 0; h < old.half_edges(); ++h) {
    const int twin = old.twin[at(h)];
    if (twin > h) continue;
    const float *const a = &old.points[3 * at(old.vertex[at(h)])],
                       *const b = &old.points[3 * at(old.vertex[at(Level::next(h))])];
    float* const to = out + 3 * at(old.edge[at(h)]);
    const float sharp = std::min(old.sharpness_of(h), 1.f);
    if (sharp == 1) {
      for (int c = 0; c < 3; ++c) to[c] = (a[c] + b[c]) / 2;
      continue;
    }
    const float *const f = face_points + 3 * at(h / 4), *const g = face_points + 3 * at(twin / 4);
    for (int c = 0; c < 3; ++c)
      to[c] = (1 - sharp) * (a[c] + b[c] + f[c] + g[c]) / 4 + sharp * (a[c] + b[c]) / 2;
  }
}

// What the half-edges at a vertex bring together.
struct Around {
  float sum[3] = {0, 0, 0};    // of other ends and face points
  float sharp[3] = {0, 0, 0};  // of the ends of sharp edges
  float sharpness = 0;         // of these, together
  int edges = 0, faces = 0, sharp_edges = 0;
};

void put_vertex_points(const Level& old, const float* face_points, std::vector<Around>& around, float* out) {
  around.assign(at(old.vertices), {});
  const auto add_edge = [&](Around& to, int other, float sharpness) {
    const float* const end = &old.points[3 * at(other)];
    ++to.edges;
    for (int c = 0; c < 3; ++c) to.sum[c] += end[c];
    if (sharpness == 0) return;
    ++to.sharp_edges;
    to.sharpness += sharpness;
    for (int c = 0; c < 3; ++c) to.sharp[c] += end[c];
  };
  for (int h = 0; h < old.half_edges(); ++h) {
    Around& to = around[at(old.vertex[at(h)])];
    const float* const face = face_points + 3 * at(h / 4);
    ++to.faces;
    for (int c = 0; c < 3; ++c) to.sum[c] += face[c];
    add_edge(to, old.vertex[at(Level::next(h))], old.sharpness_of(h));
    // An edge on the border has no half-edge that leaves from its other end.
    if (const int before = Level::prev(h); old.twin[at(before)] < 0)
      add_edge(to, old.vertex[at(before)], kInfinite);
  }
  for (int v = 0; v < old.vertices; ++v, out += 3) {
    const Around& here = around[at(v)];
    const float* const p = &old.points[3 * at(v)];
    const auto n = static_cast<float>(here.edges);
    const bool corner = here.sharp_edges > 2 || here.faces == 1;
    const float mean =
        here.sharp_edges < 2 ? 0 : std::min(here.sharpness / static_cast<float>(here.sharp_edges), 1.f);
    const float sharp = corner && here.faces == 1 ? 1 : mean;
    for (int c = 0; c < 3; ++c) {
      const float smooth = p[c] * (n - 2) / n + here.sum[c] / (n * n);
      const float creased = corner ? p[c] : 3 * p[c] / 4 + here.sharp[c] / 8;
      out[c] = sharp == 0 ? smooth : sharp == 1 ? creased : (1 - sharp) * smooth + sharp * creased;
    }
  }
}

}  // namespace

PeerTimes run_half_edges(const PeerJob& job) {
  PeerTimes times;
  Stopwatch stopwatch;
  Level level, next;
  if (!build(job, level)) return times;
  times.build = stopwatch.lap();
  std::vector<Around> around;
  std::vector<std::uint32_t> corners;
  for (int depth = 1; depth <= job.level; ++depth) {
    const bool last = depth == job.level;
    if (!last) corners.resize(4 * at(level.half_edges()));
    if (last && job.out_corners.size() != 4 * at(level.half_edges())) return times;
    refine_topology(level, last, last ? job.out_corners.data() : corners.data(), next);
    if (last && job.out_points.size() != 3 * at(next.vertices)) return times;
    if (!last) next.points.resize(3 * at(next.vertices));
    float* const points = last ? job.out_points.data() : next.points.data();
    float* const faces = points + 3 * at(level.vertices);
    put_face_points(level, faces);
    put_edge_points(level, faces, faces + 3 * at(level.half_edges() / 4));
    put_vertex_points(level, faces, around, points);
    std::swap(level, next);
  }
  times.refine = stopwatch.lap();
  times.ok = true;
  return times;
}

}  // namespace subdivd::bench
