#include "core/engine/plain/level.h"

#include <algorithm>
#include <utility>

#include "core/engine/plain/mask_rows.h"
#include "core/engine/plain/split.h"

namespace subdivd::plain {
namespace {

std::vector<std::array<float, 2>> decayed_halves(const Level& level, CreaseMethod method, const Pace& pace) {
  std::vector<std::array<float, 2>> halves(level.faces.edge_count());
  std::vector<float> parent, child;
  pace.for_each(level.faces.vertex_count(), [&](Index v) {
    const auto edges = level.faces.vertex_edges(v);
    pace.spend(edges.size());
    parent.clear();
    for (const Index e : edges) parent.push_back(level.sharpness.edges[e]);
    child.resize(parent.size());
    decay_around_vertex(method, parent, child, pace);
    for (std::size_t k = 0; k < edges.size(); ++k)
      halves[edges[k]][half_at(level.faces, edges[k], v)] = child[k];
  });
  return halves;
}

// Of a channel from the mesh over the same faces; borders and what else is infinite stay so.
std::vector<std::array<float, 2>> inherited_halves(const Level& channel, const Level& mesh,
                                                   const Pace& pace) {
  std::vector<std::array<float, 2>> halves(channel.faces.edge_count());
  const auto lower_half = [](const Adjacency& faces, Index h) {
    return half_at(faces, faces.half_edge_edge(h), faces.corner_vertex(h));
  };
  pace.for_each(channel.faces.half_edge_count(), [&](Index h) {
    const Index e = channel.faces.half_edge_edge(h);
    const auto& from = mesh.halves[mesh.faces.half_edge_edge(h)];
    const Index own = lower_half(channel.faces, h), theirs = lower_half(mesh.faces, h);
    halves[e][own] = from[theirs];
    halves[e][1 - own] = from[1 - theirs];
    if (is_infinite(channel.sharpness.edges[e])) halves[e] = {kInfiniteSharpness, kInfiniteSharpness};
  });
  return halves;
}

// The next level but for its halves.
Level without_halves(const Level& level, Split split, const Pace& pace) {
  Level next{split_faces(split, level.faces, pace), {}, {}, level.linear, level.linear_borders};
  next.sharpness = next_sharpness(level, next.faces.vertex_count(), next.faces.edge_count(), pace);
  return next;
}

}  // namespace

Level first_level(Adjacency faces, Sharpness sharpness, CreaseMethod method, const Pace& pace) {
  Level level{std::move(faces), std::move(sharpness), {}, false, false};
  level.halves = decayed_halves(level, method, pace);
  return level;
}

Level first_level(Adjacency faces, Sharpness sharpness, bool linear, bool linear_borders, const Level& mesh,
                  const Pace& pace) {
  Level level{std::move(faces), std::move(sharpness), {}, linear, linear_borders};
  level.halves = inherited_halves(level, mesh, pace);
  return level;
}

Sharpness next_sharpness(const Level& level, Index vertices, Index edges, const Pace& pace) {
  const Adjacency& parent = level.faces;
  Sharpness next;
  pace.fill(next.edges, edges, 0.0f);
  pace.fill(next.vertices, vertices, 0.0f);
  pace.for_each(parent.edge_count(), [&](Index e) {
    for (const Index half : {0u, 1u}) next.edges[2 * e + half] = level.halves[e][half];
    if (level.linear_borders && parent.edge_half_edges(e).size() == 1)
      next.vertices[parent.vertex_count() + e] = kInfiniteSharpness;
  });
  pace.for_each(parent.vertex_count(),
                [&](Index v) { next.vertices[v] = decay(level.sharpness.vertices[v]); });
  return next;
}

Level next_level(const Level& level, Split split, CreaseMethod method, const Pace& pace) {
  Level next = without_halves(level, split, pace);
  next.halves = decayed_halves(next, method, pace);
  return next;
}

Level next_level(const Level& channel, Split split, const Level& next_mesh, const Pace& pace) {
  Level next = without_halves(channel, split, pace);
  next.halves = inherited_halves(next, next_mesh, pace);
  return next;
}

StepRows rows_of(const AnyGridScheme& scheme, CreaseMethod method, const Level& level, bool linear,
                 const Pace& pace) {
  return std::visit([&](const auto& one) { return rows_of(one, method, level, linear, pace); }, scheme);
}

}  // namespace subdivd::plain
