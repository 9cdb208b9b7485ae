#include "core/refine/steps.h"

#include <array>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/engine/plain/line_rows.h"
#include "core/engine/plain/ring_rows.h"
#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"

namespace subdivd {
namespace {

// Where the levels' corners lie on the base faces, and which of the lattice's vertices each vertex is for that.
// See core/engine/plain/split.h for the children of a face.
class PlacesOfLevels {
 public:
  PlacesOfLevels(const Lattice& lattice, const Pace& pace) : lattice_(lattice), pace_(pace) {
    pace_.fill(order_, lattice.base_vertex_count(), Index{0});
    std::iota(order_.begin(), order_.end(), Index{0});
    const Index size = corners_of_a_face();
    places_.reserve(lattice.base_corners().size());
    pace_.for_each(lattice.base_face_count(), [&](Index) {
      for (Index k = 0; k < size; ++k) places_.push_back(corner_place(k));
    });
  }

  // The lattice's number of each vertex of the level.
  std::span<const Index> order() const { return order_; }

  // On to the next level, from the faces of this one.
  void refine(const plain::Adjacency& faces) {
    ++level_;
    if (lattice_.has_triangles()) {
      number(Numbering(lattice_.triangles(), level_), faces);
      refine_triangles();
    } else {
      number(Numbering(lattice_.quads(), level_), faces);
      refine_quads();
    }
  }

 private:
  Index corners_of_a_face() const { return lattice_.has_triangles() ? 3 : 4; }
  GridPoint corner_place(Index k) const {
    constexpr std::array<GridPoint, 3> kTriangle{{{0, 0}, {1, 0}, {0, 1}}};
    constexpr std::array<GridPoint, 4> kQuad{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    return lattice_.has_triangles() ? kTriangle[k] : kQuad[k];
  }
  // Of the next level's grid.
  static GridPoint middle(GridPoint a, GridPoint b) { return {a.i + b.i, a.j + b.j}; }

  void refine_triangles() {
    std::vector<GridPoint> next;
    next.reserve(4 * places_.size());
    pace_.for_each(places_.size() / 3, [&](Count f) {
      pace_.spend(4);
      const GridPoint* const p = &places_[3 * f];
      const GridPoint v0 = middle(p[0], p[0]), v1 = middle(p[1], p[1]), v2 = middle(p[2], p[2]),
                      e0 = middle(p[0], p[1]), e1 = middle(p[1], p[2]), e2 = middle(p[2], p[0]);
      next.insert(next.end(), {v0, e0, e2, e0, v1, e1, e2, e1, v2, e0, e1, e2});
    });
    places_ = std::move(next);
  }

  void refine_quads() {
    std::vector<GridPoint> next;
    next.reserve(4 * places_.size());
    pace_.for_each(places_.size() / 4, [&](Count f) {
      pace_.spend(4);
      const GridPoint* const p = &places_[4 * f];
      const GridPoint inside = middle(p[0], p[2]);
      for (Index k = 0; k < 4; ++k)
        next.insert(next.end(),
                    {middle(p[k], p[k]), middle(p[k], p[(k + 1) % 4]), inside, middle(p[k], p[(k + 3) % 4])});
    });
    places_ = std::move(next);
  }

  // The next level's vertices: of old ones, of edges, and of quads.
  template <class Faces>
  void number(const Numbering<Faces>& numbering, const plain::Adjacency& faces) {
    const Index old_count = faces.vertex_count(), edges = faces.edge_count();
    const bool quads = std::is_same_v<Faces, Quads>;
    pace_.fill(order_, Count{old_count} + edges + (quads ? faces.face_count() : 0), Index{0});
    // Those of no face keep their numbers, as all of the control mesh do.
    pace_.for_each(lattice_.base_vertex_count(), [&](Index v) { order_[v] = v; });
    const Index per_base_face = Faces::size << (2 * (level_ - 1));
    pace_.for_each(faces.half_edge_count(), [&](Index h) {
      const Index base = h / per_base_face;
      const auto set = [&](Index vertex, GridPoint place) {
        order_[vertex] = numbering.vertex(base, place.i, place.j);
      };
      set(faces.corner_vertex(h), middle(places_[h], places_[h]));
      set(old_count + faces.half_edge_edge(h), middle(places_[h], places_[faces.next(h)]));
      if (quads && h % 4 == 0) set(old_count + edges + h / 4, middle(places_[h], places_[h + 2]));
    });
  }

  const Lattice& lattice_;
  const Pace& pace_;
  Index level_ = 0;
  std::vector<Index> order_;
  std::vector<GridPoint> places_;  // of every corner of the level's faces
};

// The same rows in other numberings: `per` rows for each new value, `rows_at` and `columns_at` telling where those of
// each number go.
plain::StepRows renumbered(const plain::StepRows& from, std::span<const Index> columns_at,
                           std::span<const Index> rows_at, Count per, const Pace& pace) {
  plain::StepRows to;
  to.old_count = from.old_count;
  to.sums = from.sums;
  const auto renumber = [&](std::vector<Index>& columns) {
    pace.for_each(columns.size(), [&](Count k) {
      if (columns[k] < from.old_count) columns[k] = columns_at[columns[k]];
    });
  };
  renumber(to.sums.columns);
  std::vector<Index> came_from;
  pace.fill(came_from, rows_at.size(), Index{0});
  pace.for_each(static_cast<Index>(rows_at.size()), [&](Index v) { came_from[rows_at[v]] = v; });
  to.rows.offsets.reserve(from.rows.offsets.size());
  to.rows.columns.reserve(from.rows.columns.size());
  to.rows.weights.reserve(from.rows.weights.size());
  pace.for_each(came_from.size() * per, [&](Count row) {
    const Count old = Count{came_from[row / per]} * per + row % per;
    const Count begin = from.rows.offsets[old], end = from.rows.offsets[old + 1];
    pace.spend(end - begin);
    for (Count k = begin; k < end; ++k) to.rows.add(from.rows.columns[k], from.rows.weights[k]);
    to.rows.end_row();
  });
  renumber(to.rows.columns);
  return to;
}

template <Interpolates Scheme>
void add_steps(const Scheme& scheme, plain::Level level, Index max_level, bool frames, Steps& steps,
               const Pace& pace) {
  PlacesOfLevels places(*steps.lattice, pace);
  for (Index k = 0;; ++k) {
    std::vector<Index> here;
    pace.copy(places.order(), here);
    if (frames)
      steps.tangents.push_back(
          renumbered(plain::tangent_rows(scheme, level, false, pace), here, here, 2, pace));
    if (k == max_level) return;
    places.refine(level.faces);
    steps.rows.push_back(
        renumbered(plain::step_rows(scheme, level, false, pace), here, places.order(), 1, pace));
    if (k + 1 == max_level && !frames) return;
    level = plain::next_level(level, Scheme::split, CreaseMethod::uniform, pace);
  }
}

}  // namespace

Steps interpolating_steps(const AnyInterpolatingScheme& scheme, plain::Level base,
                          std::shared_ptr<const Lattice> lattice, Index max_level, bool frames,
                          const Pace& pace) {
  Steps steps;
  steps.lattice = std::move(lattice);
  steps.linear = base.linear;
  if (!steps.linear)
    std::visit([&](const auto& one) { add_steps(one, std::move(base), max_level, frames, steps, pace); },
               scheme);
  return steps;
}

Count steps_bytes(Count corners, Index max_level, bool frames) {
  // Measured per corner of a level: of its adjacency and what its rows are made from, of the step that follows, and of
  // tangents. Rows around extraordinary vertices are longer, and those are the control mesh's at every level.
  constexpr Count kOfLevel = 320, kOfStep = 200, kOfTangents = 120, kOfRing = 800, kOfRingTangents = 300;
  Count bytes = 0;
  for (Index level = 0; level <= max_level; ++level) {
    const Count here = corners << (2 * level);
    if (level < max_level) bytes += kOfStep * here + kOfRing * corners;
    if (frames) bytes += kOfTangents * here + kOfRingTangents * corners;
  }
  const Index last = max_level == 0 || frames ? max_level : max_level - 1;
  return bytes + (kOfLevel * corners << (2 * last));
}

}  // namespace subdivd
