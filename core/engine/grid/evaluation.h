#pragma once
// How values are refined on grids, whatever the faces are: levels one after the other, limits behind the last, work
// shared out to threads in blocks. An engine says by its Grid how steps look and which loops do them.

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/pace.h"
#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/engine/grid/base_edges.h"
#include "core/engine/grid/base_vertices.h"
#include "core/engine/grid/evaluate.h"
#include "core/engine/grid/evaluated.h"
#include "core/engine/grid/kernels/step.h"
#include "core/engine/grid/regular_ring.h"
#include "core/engine/net.h"
#include "core/lattice/split.h"
#include "core/schemes/all.h"

namespace subdivd {

// What a Grid is: types and static functions.
//   Faces                       of the nets
//   Step<Real>, Limit<Real>     what the loops take
//   kernels<Real>()             the loops
//   row_scratch(n)              scalars that a step needs
//   masks<Real>(scheme, method) of a step: the masks of what is regular and settled; linear_masks<Real>(): of midpoints
//   set_limit_masks(limit, scheme), set_linear_limit_masks(limit)
//   face_row(piece, n, whole)   cuts 0..face_count * n^2 pieces into rows of faces, or whole ones
//   has_inside(n)               whether faces of n segments get points inside
template <class Grid, class Scheme, class Real>
class GridEvaluation {
 public:
  using Faces = typename Grid::Faces;
  using Step = typename Grid::template Step<Real>;
  using Limit = typename Grid::template Limit<Real>;
  using FaceRow = kernels::FaceRow;

  GridEvaluation(const Net<Faces>& net, const Scheme& scheme, Index level, Buffer<Real> control, Index width,
                 Smoothing smoothing, const Evaluated<Real>& out, const Pace& pace)
      : net_(net),
        scheme_(scheme),
        level_(level),
        control_(std::move(control)),
        width_(width),
        linear_(smoothing == Smoothing::linear),
        out_(out),
        kernels_(Grid::template kernels<Real>()),
        vertices_(net, scheme, width, linear_ ? Smoothing::linear : net.smoothing()),
        edges_(net, scheme, width) {
    linear_ |= net.smoothing() == Smoothing::linear;
    if (linear_)
      pace.fill(linear_rules_, net.topology().edge_count(), static_cast<unsigned char>(EdgeRule::linear));
    else if (out.wants_limits())
      vertices_.prepare_limits(level, pace);
    vertex_masks_ = vertices_.smooth_masks();
    set_topology(topology_step_, net.topology());
    topology_step_.masks = linear_ ? Grid::template linear_masks<Real>()
                                   : Grid::template masks<Real>(scheme_, net.crease_method());
    if (out.wants_limits()) limit_masks_ = vertices_.limit_masks();
    if (out.wants_frames()) tangent_masks_ = vertices_.tangent_masks();
    // Two levels below the last take turns; the last goes straight to the caller.
    for (Index k = 0; k < 2; ++k)
      if (level > k + 1) set_size(scratch_[k], net.value_count(level - 1 - k) * width);
    set_size(control_, control_.size());
    if (out.values == nullptr && level > 0) own_values_.resize(net.value_count(level) * width);
  }

  Result<void> run(Index threads, const Budget& budget) {
    threads = is_small(level_) ? 1 : std::max<Index>(threads, 1);
    deferred_.resize(threads);
    return Team::run(threads, budget, [&](Worker& worker) { work(worker); });
  }

 private:
  static constexpr Count kBlock = 1 << 14;         // points between two polls of the budget, about
  static constexpr Count kWorthSharing = 1 << 16;  // scalars of a level: some 50 microseconds
  static constexpr Count kLargeFace = 1 << 18;     // points inside a face that is taken in several pieces

  static_assert(static_cast<int>(EdgeRule::smooth) == 0 && static_cast<int>(EdgeRule::linear) == 2,
                "the kernels know the rules by number");
  static_assert(static_cast<int>(VertexRule::smooth) == 0 && static_cast<int>(VertexRule::dart) == 1);
  static_assert(kernels::kListedValence == kListedValence);

  // Steps read a little past the end of what they refine.
  static constexpr auto kSpare = static_cast<std::ptrdiff_t>(kSpareControl);
  static void set_size(Buffer<Real>& buffer, Count size) {
    buffer.resize(size + kSpare);
    std::fill(buffer.end() - kSpare, buffer.end(), Real(0));
  }

  static void set_topology(Step& step, const Topology<Faces>& topology) {
    const auto pairs = [](std::span<const std::array<Index, 2>> all) {
      return all.empty() ? nullptr : all[0].data();
    };
    step.corners = topology.corner_vertices().data();
    step.half_edge_edges = topology.half_edge_edges().data();
    step.edge_vertices = pairs(topology.edge_vertices());
    step.edge_sides = pairs(topology.edge_sides());
    step.vertex_edges = topology.all_vertex_edges().data();
    step.vertex_edge_offsets = topology.vertex_edge_offsets().data();
    step.vertex_corners = topology.all_vertex_corners().data();
    step.vertex_corner_offsets = topology.vertex_corner_offsets().data();
    step.vertex_count = topology.vertex_count();
    step.edge_count = topology.edge_count();
    step.face_count = topology.face_count();
  }

  // The array of a level.
  const Real* values_at(Index level) const {
    return level == 0 ? control_.data() : const_cast<GridEvaluation*>(this)->target_at(level);
  }
  Real* target_at(Index level) {
    if (level == level_) return out_.values != nullptr ? out_.values : own_values_.data();
    return scratch_[(level_ - 1 - level) % 2].data();
  }

  Step step_from(Index level, const Real* from, Real* to, Real* rows) const {
    Step step = topology_step_;
    step.edge_rules =
        linear_ ? linear_rules_.data() : reinterpret_cast<const unsigned char*>(net_.edge_rules().data());
    step.vertex_rules = reinterpret_cast<const unsigned char*>(net_.vertex_rules().data());
    step.vertex_masks = vertex_masks_.data();
    step.n = segments(level);
    step.width = width_;
    step.from = from;
    step.to = to;
    step.rows = rows;
    return step;
  }

  // Calls f(kernel index, first component) for the pieces of at most four components.
  template <class F>
  void for_components(F&& f) const {
    for (Index c = 0; c < width_; c += 4) f(std::min<Index>(width_ - c, 4) - 1, c);
  }

  void work(Worker& worker) {
    std::vector<Real> rows(Grid::row_scratch(segments(level_)), Real(0));
    // The first worker goes through the small levels alone: sharing them would take longer.
    Index level = 0;
    Worker alone = worker.alone();
    for (; worker.count() > 1 && is_small(level + 1); ++level)
      if (worker.index() == 0) refine_level(alone, level, rows);
    if (level > 0 && !worker.meet()) return;
    for (; level < level_; ++level) {
      if (!refine_level(worker, level, rows) || !worker.meet()) return;
    }
    if (level_ == 0 && out_.values != nullptr && !copy_control(worker)) return;
    if (!out_.wants_limits()) return;
    for (const auto& [begin, end] : deferred_[worker.index()]) {
      if (!worker.go_on(8 * kBlock)) return;
      limit_faces(worker, begin, end, rows);
    }
    limit_vertices(worker, rows);
    limit_edges(worker, rows);
  }

  // Level 0 is what was given. False when the team is to stop.
  bool copy_control(Worker& worker) const {
    const Range share = worker.share(control_.size() - kSpareControl);
    for (Count begin = share.begin; begin < share.end; begin += kBlock) {
      const Count count = std::min(kBlock, share.end - begin);
      if (!worker.go_on(count)) return false;
      std::copy_n(control_.begin() + static_cast<std::ptrdiff_t>(begin), count, out_.values + begin);
    }
    return true;
  }

  // False when the team is to stop.
  bool refine_level(Worker& worker, Index level, std::vector<Real>& rows) {
    const Step step = step_from(level, values_at(level), target_at(level + 1), rows.data());
    refine_vertices(worker, level, step);
    refine_edges(worker, level, step);
    const bool last = level + 1 == level_ && out_.wants_limits();
    // Limits inside a face need its border at the last level.
    if (last && !worker.meet()) return false;
    refine_faces(worker, step, last ? &rows : nullptr);
    return true;
  }

  bool is_small(Index level) const { return net_.value_count(level) * width_ < kWorthSharing; }

  // Steps of a point: as many as its value has quarters of a vector.
  Count steps_per_point() const { return (width_ + 3) / 4; }

  // Calls f(begin, end) for blocks of the worker's share of `total` items of `points` points each.
  template <class F>
  void in_blocks(Worker& worker, Count total, Count points, F&& f) const {
    points *= steps_per_point();
    const Range share = worker.share(total);
    const Count block = std::max<Count>(1, kBlock / std::max<Count>(points, 1));
    for (Count begin = share.begin; begin < share.end; begin += block) {
      const Count end = std::min(begin + block, share.end);
      if (!worker.go_on((end - begin) * points)) return;
      f(static_cast<Index>(begin), static_cast<Index>(end));
    }
  }

  void refine_vertices(Worker& worker, Index level, const Step& step) const {
    in_blocks(worker, net_.topology().vertex_count(), 4, [&](Index begin, Index end) {
      if (linear_) {
        std::copy(step.from + Count{begin} * width_, step.from + Count{end} * width_,
                  step.to + Count{begin} * width_);
        return;
      }
      for_components([&](Index kernel, Index component) {
        Step part = step;
        part.from += component;
        part.to += component;
        kernels_.refine_vertices[kernel](part, begin, end);
      });
      vertices_.refine(level, step.from, step.to, begin, end, Pace(worker));
    });
  }

  void refine_edges(Worker& worker, Index level, const Step& step) const {
    in_blocks(worker, net_.topology().edge_count(), 4 * step.n, [&](Index begin, Index end) {
      for_components([&](Index kernel, Index component) {
        Step part = step;
        part.from += component;
        part.to += component;
        kernels_.refine_edges[kernel](part, begin, end);
      });
      if (!linear_) edges_.refine_semi_sharp(level, step.from, step.to, begin, end);
    });
  }

  // `limit_rows`: scratch for limits, which are written as soon as a face is complete; null: none.
  void refine_faces(Worker& worker, const Step& step, std::vector<Real>* limit_rows) {
    if (!Grid::has_inside(2 * step.n)) return;
    const Count n = step.n, faces = net_.topology().face_count(), points = 2 * n * n;
    const bool whole =
        points * steps_per_point() <= kLargeFace && (n < 64 || faces >= Count{8} * worker.count());
    const Range share = worker.share(faces * n * n);
    const FaceRow last = Grid::face_row(share.end, n, whole);
    const Count block = std::max<Count>(whole ? n * n : 1, kBlock / steps_per_point());
    FaceRow begin = Grid::face_row(share.begin, n, whole);
    for (Count at = share.begin; at < share.end; at += block) {
      const FaceRow end = at + block >= share.end ? last : Grid::face_row(at + block, n, whole);
      if (!worker.go_on(4 * block * steps_per_point())) return;
      for_components([&](Index kernel, Index component) {
        Step part = step;
        part.from += component;
        part.to += component;
        kernels_.refine_faces[kernel](part, begin, end);
      });
      if (limit_rows != nullptr) {
        if (whole)
          limit_faces(worker, begin, end, *limit_rows);
        else
          deferred_[worker.index()].push_back({begin, end});
      }
      begin = end;
    }
  }

  struct Context {
    const GridEvaluation& evaluation;
    Worker& worker;
  };

  Limit limit_of(const Context& context, std::vector<Real>& rows) const {
    Limit limit{};
    limit.level = step_from(level_, values_at(level_), out_.limits, rows.data());
    limit.vertex_masks = limit_masks_.data();
    limit.vertex_tangents = tangent_masks_.data();
    limit.frames = {.tangents_u = out_.tangents_u,
                    .tangents_v = out_.tangents_v,
                    .normals = out_.normals,
                    .robust_frame = &GridEvaluation::robust_frame,
                    .context = &context};
    if (linear_)
      Grid::set_linear_limit_masks(limit);
    else
      Grid::set_limit_masks(limit, scheme_);
    return limit;
  }

  // See FrameOutput.
  static void robust_frame(const void* context, Count vertex, Real* u, Real* v, Real* normal) {
    const auto& [self, worker] = *static_cast<const Context*>(context);
    // A thousand times as slow as the short way: a mesh that is all degenerate needs a poll here. What is
    // written when the team stops is nobody's.
    if (!worker.go_on(256)) return;
    const Real* values = self.values_at(self.level_);
    const auto number = static_cast<Index>(vertex);
    const Frame<Real> frame =
        number < self.net_.topology().vertex_count()
            ? self.vertices_.frame(self.level_, values, number, Pace(worker))
            : regular_frame(self.scheme_, self.net_.topology(), self.level_, values, number);
    std::copy_n(frame.u, 3, u);
    std::copy_n(frame.v, 3, v);
    std::copy_n(frame.normal, 3, normal);
  }

  template <class F>
  void limit_components(Worker& worker, std::vector<Real>& rows, F&& f) const {
    const Context context{*this, worker};
    const Limit limit = limit_of(context, rows);
    for_components([&](Index kernel, Index component) {
      Limit part = limit;
      part.level.from += component;
      if (part.level.to != nullptr) part.level.to += component;
      f(kernel, part);
    });
  }

  // `begin` and `end` count rows of the level below, of which every one makes two here.
  void limit_faces(Worker& worker, FaceRow begin, FaceRow end, std::vector<Real>& rows) const {
    begin.row *= 2;
    end.row *= 2;
    limit_components(worker, rows, [&](Index kernel, const Limit& part) {
      kernels_.limit_faces[kernel](part, begin, end);
    });
  }

  void limit_vertices(Worker& worker, std::vector<Real>& rows) const {
    const Real* values = values_at(level_);
    in_blocks(worker, net_.topology().vertex_count(), 16, [&](Index begin, Index end) {
      if (linear_) {
        if (out_.limits != nullptr)
          std::copy(values + Count{begin} * width_, values + Count{end} * width_,
                    out_.limits + Count{begin} * width_);
        return;
      }
      limit_components(worker, rows, [&](Index kernel, const Limit& part) {
        kernels_.limit_vertices[kernel](part, begin, end);
      });
      vertices_.limit(level_, values, out_, begin, end, Pace(worker));
    });
  }

  void limit_edges(Worker& worker, std::vector<Real>& rows) const {
    if (level_ == 0) return;
    in_blocks(worker, net_.topology().edge_count(), 8 * segments(level_), [&](Index begin, Index end) {
      limit_components(worker, rows, [&](Index kernel, const Limit& part) {
        kernels_.limit_edges[kernel](part, begin, end);
      });
      if (!linear_) {
        edges_.limit(level_, values_at(level_), out_, begin, end, Pace(worker));
      } else if (out_.limits != nullptr) {
        const Count points = segments(level_) - 1, first = net_.topology().vertex_count() + begin * points;
        std::copy_n(values_at(level_) + first * width_, (end - begin) * points * width_,
                    out_.limits + first * width_);
      }
    });
  }

  const Net<Faces>& net_;
  Scheme scheme_;
  Index level_;
  Buffer<Real> control_;
  Index width_;
  bool linear_;
  Evaluated<Real> out_;
  const kernels::GridKernels<Step, Limit>& kernels_;
  BaseVertices<Scheme, Real> vertices_;
  BaseEdges<Scheme, Real> edges_;
  Step topology_step_{};
  std::vector<unsigned char> linear_rules_;
  std::vector<Real> vertex_masks_, limit_masks_, tangent_masks_;
  std::array<Buffer<Real>, 2> scratch_;
  Buffer<Real> own_values_;
  std::vector<std::vector<std::pair<FaceRow, FaceRow>>> deferred_;  // per worker
};

// Values refined on a net by the Grid that serves its faces.
template <class Grid, class Real>
Result<void> evaluate_on_grid(const Net<typename Grid::Faces>& net, Index level, Buffer<Real>&& control,
                              Index width, Smoothing smoothing, const Evaluated<Real>& out, Index threads,
                              const Budget& budget) {
  return std::visit(
      [&]<class Scheme>(const Scheme& scheme) -> Result<void> {
        if constexpr (Scheme::split != Grid::kSplit) {
          return Error{ErrorCode::internal, "a net of other faces than its scheme makes"};
        } else {
          return stoppable(budget, [&](const Pace& pace) {
            return GridEvaluation<Grid, Scheme, Real>(net, scheme, level, std::move(control), width,
                                                      smoothing, out, pace)
                .run(threads, budget);
          });
        }
      },
      net.scheme());
}

}  // namespace subdivd
