#include "core/refine/refinable.h"

#include <algorithm>
#include <utility>

#include "core/engine/grid/evaluate.h"
#include "core/limit/face_frames.h"
#include "core/refine/linear.h"

namespace subdivd {
namespace {

// While the ring of a hub is looked at, which is as large as the mesh.
constexpr Count kHub = 4096, kBytesPerRingCorner = 176;
// Per semi-sharp edge while nets are built.
constexpr Count kSemiSharpBytes = 64;

template <class Faces>
Count ring_bytes(const Topology<Faces>& topology, const Pace& pace) {
  Count corners = 0;
  pace.for_each(topology.vertex_count(), [&](Index v) {
    if (const Count here = topology.vertex_corners(v).size(); here > kHub) corners += here;
  });
  return corners * kBytesPerRingCorner;
}

template <class Faces>
Count resident_bytes_of(const Net<Faces>& net) {
  Count bytes = net.resident_bytes();
  if (net.crease_method() == CreaseMethod::chaikin)
    bytes += chaikin_bytes(net.semi_sharp(0).edges.size(), net.max_level());
  return bytes;
}

// The two levels below the last, the control values, and the rules of edges where all are linear.
template <class Faces>
Count evaluation_bytes_of(const Net<Faces>& net, Index level, Index width, Count scalar_bytes, bool limits,
                          const Pace& pace) {
  Count values = net.value_count(0);
  for (Index below = 1; below <= 2 && below < level; ++below) values += net.value_count(level - below);
  return values * width * scalar_bytes + net.topology().edge_count() +
         (limits ? ring_bytes(net.topology(), pace) : 0);
}

template <class Faces>
class OfGrids final : public Refinable {
 public:
  explicit OfGrids(std::shared_ptr<const Net<Faces>> net)
      : Refinable(std::make_shared<const Lattice>(
            std::shared_ptr<const Connectivity<Faces>>(net->shared_topology()))),
        net_(std::move(net)) {}

  std::span<const Index> value_indices() const override { return net_->value_indices(); }
  Result<void> evaluate(Index level, Buffer<float>&& control, Index width, Smoothing smoothing,
                        const Evaluated<float>& out, Index threads, const Budget& budget) const override {
    return subdivd::evaluate<float>(*net_, level, std::move(control), width, smoothing, out, threads, budget);
  }
  Result<void> evaluate(Index level, Buffer<double>&& control, Index width, Smoothing smoothing,
                        const Evaluated<double>& out, Index threads, const Budget& budget) const override {
    return subdivd::evaluate<double>(*net_, level, std::move(control), width, smoothing, out, threads,
                                     budget);
  }

  Count resident_bytes() const override { return resident_bytes_of(*net_); }
  Count building_bytes() const override {
    return net_->building_bytes() + kSemiSharpBytes * net_->semi_sharp(0).edges.size();
  }
  Count evaluation_bytes(Index level, Index width, Count scalar_bytes, bool limits,
                         const Pace& pace) const override {
    return evaluation_bytes_of(*net_, level, width, scalar_bytes, limits, pace);
  }

 private:
  std::shared_ptr<const Net<Faces>> net_;
};

class OfPolygons final : public Refinable {
 public:
  OfPolygons(FirstStep step, std::shared_ptr<const Net<Quads>> net)
      : Refinable(std::make_shared<const Lattice>(step.polygons, step.quads)),
        step_(std::move(step)),
        net_(std::move(net)) {}

  std::span<const Index> value_indices() const override { return step_.values; }
  Result<void> evaluate(Index level, Buffer<float>&& control, Index width, Smoothing smoothing,
                        const Evaluated<float>& out, Index threads, const Budget& budget) const override {
    return evaluate_all(level, std::move(control), width, smoothing, out, threads, budget);
  }
  Result<void> evaluate(Index level, Buffer<double>&& control, Index width, Smoothing smoothing,
                        const Evaluated<double>& out, Index threads, const Budget& budget) const override {
    return evaluate_all(level, std::move(control), width, smoothing, out, threads, budget);
  }

  Count resident_bytes() const override {
    const Connectivity<Polygons>& polygons = *step_.polygons;
    constexpr Count kOfCorner = 20, kOfEdge = 34, kOfVertex = 24, kOfWeight = 12;
    return resident_bytes_of(*net_) + kOfCorner * polygons.corner_vertices().size() +
           kOfEdge * polygons.edge_count() + kOfVertex * polygons.vertex_count() +
           kOfWeight * weight_count() +
           sizeof(Count) * (step_.rows.rows.offsets.size() + step_.rows.sums.offsets.size());
  }
  // The plain engine's adjacency, and its rows while they grow.
  Count building_bytes() const override {
    const Connectivity<Polygons>& polygons = *step_.polygons;
    return net_->building_bytes() + kSemiSharpBytes * net_->semi_sharp(0).edges.size() +
           64 * polygons.corner_vertices().size() + 24 * weight_count();
  }
  Count evaluation_bytes(Index level, Index width, Count scalar_bytes, bool limits,
                         const Pace& pace) const override {
    Count bytes =
        evaluation_bytes_of(*net_, std::max<Index>(level, 1) - 1, width, scalar_bytes, limits, pace) +
        step_.polygons->vertex_count() * width * scalar_bytes;
    const Count sums = step_.rows.sums.row_count();  // made, then held behind the control values
    if (sums != 0) bytes += (step_.polygons->vertex_count() + 2 * sums) * width * scalar_bytes;
    if (level == 0 && limits) bytes += 4 * net_->value_count(0) * width * scalar_bytes;
    return bytes;
  }

 private:
  Count weight_count() const { return step_.rows.rows.columns.size() + step_.rows.sums.columns.size(); }

  template <class Real>
  Result<void> evaluate_all(Index level, Buffer<Real>&& control, Index width, Smoothing smoothing,
                            const Evaluated<Real>& out, Index threads, const Budget& budget) const {
    return stoppable(budget, [&](const Pace& pace) -> Result<void> {
      if (level == 0 && out.values != nullptr) std::copy(control.begin(), control.end(), out.values);
      if (level == 0 && !out.wants_limits()) return {};
      Buffer<Real> values = apply<Real>(step_, control, width, smoothing == Smoothing::linear, pace);
      if (level == 0) return limits_of_vertices(std::move(values), width, smoothing, out, threads, budget);
      control = {};
      return subdivd::evaluate<Real>(*net_, level - 1, std::move(values), width, smoothing, out, threads,
                                     budget);
    });
  }

  // Of the polygons' own vertices, which are the first of the quads': their limits outlive the step.
  template <class Real>
  Result<void> limits_of_vertices(Buffer<Real> values, Index width, Smoothing smoothing,
                                  const Evaluated<Real>& out, Index threads, const Budget& budget) const {
    Evaluated<Real> all;
    std::vector<std::pair<Buffer<Real>, Real*>> arrays;
    arrays.reserve(4);
    const auto with_room = [&](Real* to) -> Real* {
      if (to == nullptr) return nullptr;
      arrays.emplace_back(Buffer<Real>(net_->value_count(0) * width), to);
      return arrays.back().first.data();
    };
    all.limits = with_room(out.limits);
    all.tangents_u = with_room(out.tangents_u);
    all.tangents_v = with_room(out.tangents_v);
    all.normals = with_room(out.normals);
    if (auto done =
            subdivd::evaluate<Real>(*net_, 0, std::move(values), width, smoothing, all, threads, budget);
        !done)
      return done;
    for (const auto& [from, to] : arrays)
      std::copy_n(from.begin(), Count{step_.polygons->vertex_count()} * width, to);
    return {};
  }

  FirstStep step_;
  std::shared_ptr<const Net<Quads>> net_;
};

Count bytes_of(const plain::StepRows& step) {
  Count bytes = 0;
  for (const plain::SparseRows* rows : {&step.rows, &step.sums})
    bytes += rows->columns.size() * (sizeof(Index) + sizeof(double)) + rows->offsets.size() * sizeof(Count);
  return bytes;
}

class OfSteps final : public Refinable {
 public:
  explicit OfSteps(Steps steps) : Refinable(steps.lattice), steps_(std::move(steps)) {}

  std::span<const Index> value_indices() const override { return steps_.values; }
  Result<void> evaluate(Index level, Buffer<float>&& control, Index width, Smoothing smoothing,
                        const Evaluated<float>& out, Index, const Budget& budget) const override {
    return evaluate_all<float>(level, std::move(control), width, smoothing, out, budget);
  }
  Result<void> evaluate(Index level, Buffer<double>&& control, Index width, Smoothing smoothing,
                        const Evaluated<double>& out, Index, const Budget& budget) const override {
    return evaluate_all<double>(level, std::move(control), width, smoothing, out, budget);
  }

  Count resident_bytes() const override {
    Count bytes = kBytesPerCorner * lattice()->base_corners().size();
    for (const auto* list : {&steps_.rows, &steps_.tangents})
      for (const plain::StepRows& step : *list) bytes += bytes_of(step);
    return bytes;
  }
  // The last step's rows once more, and the faces that they are made from.
  Count building_bytes() const override {
    constexpr Count kOfCorner = 160;
    const Index levels = static_cast<Index>(std::max(steps_.rows.size(), steps_.tangents.size()));
    const Index last = levels - std::min<Index>(levels, 1);
    return resident_bytes() + (kOfCorner * lattice()->base_corners().size() << (2 * last));
  }
  Count evaluation_bytes(Index level, Index width, Count scalar_bytes, bool limits,
                         const Pace&) const override {
    const Count last = value_count(level), before = value_count(level - std::min<Index>(level, 1));
    Count bytes = 3 * (last + before) * width * scalar_bytes;
    if (limits)
      bytes += 12 * last * scalar_bytes +
               lattice()->face_count(level) * lattice()->face_size(level) * sizeof(Index);
    return bytes;
  }

 private:
  static constexpr Count kBytesPerCorner = 96;

  template <class Real>
  Result<void> evaluate_all(Index level, Buffer<Real> control, Index width, Smoothing smoothing,
                            const Evaluated<Real>& out, const Budget& budget) const {
    return stoppable(budget, [&](const Pace& pace) -> Result<void> {
      const Buffer<Real> values = steps_.linear || smoothing == Smoothing::linear
                                      ? linear_values<Real>(level, control, width, pace)
                                      : refined_values<Real>(level, std::move(control), width, pace);
      for (Real* const to : {out.values, out.limits})  // vertices stay
        if (to != nullptr)
          pace.in_blocks(values.size(), [&](Count begin, Count end) {
            std::copy_n(&values[begin], end - begin, to + begin);
          });
      return out.wants_frames() ? write_all_frames<Real>(level, values, out, pace, budget) : Result<void>();
    });
  }

  template <class Real>
  Buffer<Real> linear_values(Index level, std::span<const Real> control, Index width,
                             const Pace& pace) const {
    Buffer<Real> values(value_count(level) * width);
    interpolate_linearly<Real>(*lattice(), level, control, width, values.data(), pace);
    return values;
  }

  template <class Real>
  Buffer<Real> refined_values(Index level, Buffer<Real> values, Index width, const Pace& pace) const {
    for (Index k = 0; k < level; ++k) {
      Buffer<Real> next(value_count(k + 1) * width);
      plain::apply<Real>(steps_.rows[k], values, width, next.data(), pace);
      values = std::move(next);
    }
    return values;
  }

  // Of positions.
  template <class Real>
  Result<void> write_all_frames(Index level, std::span<const Real> points, const Evaluated<Real>& out,
                                const Pace& pace, const Budget& budget) const {
    const std::vector<unsigned char> no_holes(lattice()->base_face_count(), 0);
    Buffer<Index> corners(lattice()->face_count(level) * lattice()->face_size(level));
    if (auto done = lattice()->write_faces(level, no_holes, corners.data(), 1, budget); !done) return done;
    const FaceFrames<Real> of_faces(points, lattice()->face_size(level), corners, pace);
    corners = {};
    const plain::StepRows none, &rows = level < steps_.tangents.size() ? steps_.tangents[level] : none;
    const std::vector<Real> tangents = plain::apply<Real>(rows, points, 3, pace);
    const auto is_known = [&](Index v) {
      const auto& offsets = rows.rows.offsets;
      return offsets.size() > 2 * Count{v} + 1 && offsets[2 * Count{v} + 1] != offsets[2 * Count{v}];
    };
    pace.for_each(static_cast<Index>(value_count(level)), [&](Index v) {
      Frame<Real> frame;
      if (is_known(v)) {
        std::copy_n(&tangents[6 * Count{v}], 3, frame.u);
        std::copy_n(&tangents[6 * Count{v} + 3], 3, frame.v);
      }
      if (!is_known(v) || !set_normal(frame)) frame = of_faces.at(v);
      FrameMean<Real> mean;
      mean.add(frame);
      write_frames(mean, out, v);
    });
    return {};
  }

  Steps steps_;
};

}  // namespace

std::shared_ptr<const Refinable> make_refinable(std::shared_ptr<const Net<Triangles>> net) {
  return std::make_shared<const OfGrids<Triangles>>(std::move(net));
}
std::shared_ptr<const Refinable> make_refinable(std::shared_ptr<const Net<Quads>> net) {
  return std::make_shared<const OfGrids<Quads>>(std::move(net));
}
std::shared_ptr<const Refinable> make_refinable(FirstStep step, std::shared_ptr<const Net<Quads>> net) {
  return std::make_shared<const OfPolygons>(std::move(step), std::move(net));
}

std::shared_ptr<const Refinable> make_refinable(Steps steps) {
  return std::make_shared<const OfSteps>(std::move(steps));
}

}  // namespace subdivd
