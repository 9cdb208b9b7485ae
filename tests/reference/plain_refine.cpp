#include "tests/reference/plain_refine.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/base/pace.h"
#include "core/lattice/numbering.h"
#include "core/limit/limit.h"
#include "tests/reference/plain.h"
#include "tests/reference/ring.h"

namespace subdivd::plain {
namespace {

struct Control {
  Topology<Triangles> topology;
  Sharpness sharpness;
  std::vector<unsigned char> holes;
  std::vector<Channel<Triangles>> channels;
};

Control make_control(const ControlMesh& mesh, CreaseMethod method) {
  Control control;
  const auto topology = std::make_shared<const Topology<Triangles>>(static_cast<Index>(mesh.point_count()),
                                                                    Triangles(mesh.face_vertex_indices));
  control.topology = *topology;
  control.sharpness = control_sharpness(mesh, control.topology);
  control.holes = hole_flags(mesh, control.topology);
  for (const Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation != Interpolation::face_varying) continue;
    std::vector<Index> corners = primvar.indices;
    if (corners.empty()) {
      corners.resize(mesh.face_vertex_indices.size());
      std::iota(corners.begin(), corners.end(), Index{0});
    }
    control.channels.push_back(
        make_channel(mesh, method, topology, control.sharpness, vertices_with_faces(control.topology),
                     corners, static_cast<Index>(primvar.values.size() / primvar.element_size)));
  }
  return control;
}

// Rows of `from`, `width` scalars each, in the order of `rows`.
template <class Real, class Scalar>
std::vector<Real> gathered(const std::vector<Scalar>& from, Index width, std::span<const Index> rows) {
  std::vector<Real> to;
  to.reserve(rows.size() * width);
  for (Index row : rows) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(Count{row} * width);
    to.insert(to.end(), first, first + width);
  }
  return to;
}

// The values that a primvar gives to each element in turn, indices resolved.
template <class Real>
std::vector<Real> resolved_values(const Primvar& primvar) {
  if (primvar.indices.empty()) return {primvar.values.begin(), primvar.values.end()};
  return gathered<Real>(primvar.values, primvar.element_size, primvar.indices);
}

// A set of values on the vertices of a mesh or channel.
template <class Real>
struct Values {
  Index width;
  bool linear;
  std::vector<Real> values;
};

// A mesh, or a channel of it, through all levels, together with the values on it.
template <class Scheme, class Real>
class Refinement {
 public:
  Refinement(const Scheme& scheme, const RefineOptions& options, Level level, const Budget& budget)
      : scheme_(scheme),
        options_(options),
        budget_(budget),
        base_(topology_of(level.faces)),
        level_(std::move(level)) {}

  // One level on. `next_mesh`: for a channel, the mesh one level on; for the mesh itself null.
  Result<void> step(std::vector<Values<Real>>& sets, const Level* next_mesh) {
    return stoppable(budget_, [&](const Pace& pace) {
      for (Values<Real>& set : sets)
        set.values = apply<Real>(rows_of(scheme_, options_.crease_method, level_, set.linear, pace),
                                 set.values, set.width, pace);
      level_ = next_mesh != nullptr ? next_level(level_, Split::triangles, *next_mesh, pace)
                                    : next_level(level_, Split::triangles, options_.crease_method, pace);
    });
  }

  void number() { numbers_ = closed_form_numbers(base_, options_.level, level_.faces); }
  const Level& level() const { return level_; }

  // The refined values in the order of the closed form.
  Buffer<Real> take(const Values<Real>& set) const {
    Buffer<Real> out(set.values.size());
    for (std::size_t v = 0; v < numbers_.size(); ++v)
      std::copy_n(set.values.data() + v * set.width, set.width,
                  out.data() + std::size_t{numbers_[v]} * set.width);
    return out;
  }

  // `mesh`: the last level of the mesh; for the mesh itself its own.
  Result<Buffer<Real>> limits(const Values<Real>& set, const Level& mesh) const {
    if (level_.linear || set.linear) return take(set);
    Buffer<Real> out(set.values.size());
    auto limit = [&](Index v, const LimitRing<Scheme, Real>& ring) {
      std::ranges::copy(ring.position(), out.data() + std::size_t{numbers_[v]} * set.width);
    };
    if (auto done = for_each_ring(set, mesh, limit); !done) return std::move(done).error();
    return out;
  }

  // Tangents and normals of the points, into `out`.
  Result<void> frames(const Values<Real>& points, RefinedMesh<Real>& out) const {
    if (options_.tangents) {
      out.tangents_u.resize(points.values.size());
      out.tangents_v.resize(points.values.size());
    }
    if (options_.normals) out.normals.resize(points.values.size());
    return for_each_ring(points, level_, [&](Index v, const LimitRing<Scheme, Real>& ring) {
      const std::vector<Frame<Real>> frames = ring.frames();
      const std::size_t at = std::size_t{3} * numbers_[v];
      if (options_.tangents && !frames.empty()) {
        std::copy_n(frames[0].u, 3, out.tangents_u.data() + at);
        std::copy_n(frames[0].v, 3, out.tangents_v.data() + at);
      }
      FrameMean<Real> mean;
      for (const Frame<Real>& frame : frames) mean.add(frame);
      if (options_.normals) mean.normal(out.normals.data() + at);
    });
  }

 private:
  template <class F>
  Result<void> for_each_ring(const Values<Real>& set, const Level& mesh, F&& f) const {
    const Topology<Triangles> faces = topology_of(level_.faces), mesh_faces = topology_of(mesh.faces);
    const SharpTopology own{faces, level_.sharpness}, above{mesh_faces, mesh.sharpness};
    for (Index v = 0; v < faces.vertex_count(); ++v) {
      if (v % 4096 == 0)
        if (auto stop = budget_.poll()) return *stop;
      f(v,
        LimitRing<Scheme, Real>(scheme_, options_.crease_method,
                                ring_of<Real>(options_.crease_method, own, above, v, set.values, set.width)));
    }
    return {};
  }

  Scheme scheme_;
  const RefineOptions& options_;
  Budget budget_;
  Topology<Triangles> base_;
  Level level_;
  std::vector<Index> numbers_;  // of the last level's vertices, by the closed form
};

Buffer<Index> triangles_of(const Numbering<Triangles>& numbering, std::span<const unsigned char> holes) {
  Buffer<Index> indices;
  const Count n = numbering.segment_count();
  indices.reserve(3 * n * n * static_cast<Count>(std::ranges::count(holes, 0)));
  for (Index f = 0; f < holes.size(); ++f)
    if (holes[f] == 0)
      for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
        indices.push_back(numbering.vertex(f, i0, j0));
        indices.push_back(numbering.vertex(f, i1, j1));
        indices.push_back(numbering.vertex(f, i2, j2));
      });
  return indices;
}

Buffer<Provenance> provenance_of(const Numbering<Triangles>& numbering, Index face_count) {
  Buffer<Provenance> provenance(numbering.vertex_count());
  const Count n = numbering.segment_count();
  for (Index f = face_count; f-- > 0;)  // backwards: the lowest-numbered face wins
    for (Count j = 0; j <= n; ++j)
      for (Count i = 0; i + j <= n; ++i)
        provenance[numbering.vertex(f, i, j)] = {f, static_cast<Index>(i), static_cast<Index>(j)};
  return provenance;
}

// refine() for one scheme, part by part.
template <class Scheme, class Real>
class Job {
 public:
  Job(const Scheme& scheme, const ControlMesh& mesh, const RefineOptions& options, const Budget& budget)
      : scheme_(scheme),
        mesh_(mesh),
        options_(options),
        budget_(budget),
        control_(make_control(mesh, options.crease_method)) {}

  Result<RefinedMesh<Real>> run() {
    for (auto part : {&Job::refine_connectivity, &Job::gather, &Job::refine_levels, &Job::write_points,
                      &Job::write_channels, &Job::write_face_values}) {
      if (auto stop = budget_.poll()) return *stop;
      if (auto done = (this->*part)(); !done) return std::move(done).error();
    }
    return std::move(out_);
  }

 private:
  Result<void> refine_connectivity() {
    const Numbering numbering(control_.topology, options_.level);
    out_.name = mesh_.name;
    out_.level = options_.level;
    out_.face_count = static_cast<Count>(std::ranges::count(control_.holes, 0)) << (2 * options_.level);
    out_.faces = triangles_of(numbering, control_.holes);
    out_.provenance = provenance_of(numbering, control_.topology.face_count());
    out_.base_faces.reserve(out_.faces.size() / 3);
    for (Index f = 0; f < control_.holes.size(); ++f)
      if (control_.holes[f] == 0)
        out_.base_faces.insert(out_.base_faces.end(), Count{1} << (2 * options_.level), f);
    for (const Primvar& primvar : mesh_.primvars)
      out_.primvars.push_back({primvar.name, primvar.interpolation, primvar.element_size, {}, {}, {}});
    return {};
  }

  // The mesh, or one channel, with the values on it and where their refined form goes.
  struct Part {
    Refinement<Scheme, Real> refinement;
    std::vector<Values<Real>> sets;
    struct Target {
      Buffer<Real>*values, *limit_values;
    };
    std::vector<Target> targets;
    const Topology<Triangles>* topology;
  };

  // Positions and the primvars that live on the points make one part, every channel another.
  Result<void> gather() {
    Level mesh = first_level(control_.topology, control_.sharpness, options_.crease_method);
    std::size_t channel = 0;
    for (std::size_t k = 0; k < mesh_.primvars.size(); ++k) {
      if (mesh_.primvars[k].interpolation != Interpolation::face_varying) continue;
      const Channel<Triangles>& own = control_.channels[channel++];
      const Primvar& primvar = mesh_.primvars[k];
      RefinedPrimvar<Real>& out = out_.primvars[k];
      channels_.push_back(
          {{scheme_, options_, first_level(own, mesh), budget_},
           {{primvar.element_size, false, gathered<Real>(primvar.values, primvar.element_size, own.values)}},
           {{&out.values, &out.limit_values}},
           own.topology.get()});
      channel_primvars_.push_back(&out);
    }
    points_.emplace(Part{{scheme_, options_, std::move(mesh), budget_},
                         {{3, false, {mesh_.points.begin(), mesh_.points.end()}}},
                         {{&out_.points, &out_.limit_points}},
                         &control_.topology});
    for (std::size_t k = 0; k < mesh_.primvars.size(); ++k) {
      const Primvar& primvar = mesh_.primvars[k];
      const bool varying = primvar.interpolation == Interpolation::varying;
      if (!varying && primvar.interpolation != Interpolation::vertex) continue;
      points_->sets.push_back({primvar.element_size, varying, resolved_values<Real>(primvar)});
      points_->targets.push_back({&out_.primvars[k].values, &out_.primvars[k].limit_values});
    }
    return {};
  }

  // All parts level by level together: the channels' sharpness is the mesh's.
  Result<void> refine_levels() {
    for (Index level = 0; level < options_.level; ++level) {
      if (auto done = points_->refinement.step(points_->sets, nullptr); !done) return done;
      for (Part& part : channels_)
        if (auto done = part.refinement.step(part.sets, &points_->refinement.level()); !done) return done;
    }
    return {};
  }

  Result<void> write(Part& part) {
    part.refinement.number();
    for (std::size_t k = 0; k < part.sets.size(); ++k) {
      *part.targets[k].values = part.refinement.take(part.sets[k]);
      if (!options_.limit || part.sets[k].linear) continue;
      auto limits = part.refinement.limits(part.sets[k], points_->refinement.level());
      if (!limits) return std::move(limits).error();
      *part.targets[k].limit_values = std::move(*limits);
    }
    return {};
  }

  Result<void> write_points() {
    if (auto done = write(*points_); !done) return done;
    if (!options_.tangents && !options_.normals) return {};
    return points_->refinement.frames(points_->sets[0], out_);
  }

  Result<void> write_channels() {
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      if (auto done = write(channels_[k]); !done) return done;
      channel_primvars_[k]->indices =
          triangles_of(Numbering(*channels_[k].topology, options_.level), control_.holes);
    }
    return {};
  }

  static void assign(Buffer<Real>& to, const std::vector<Real>& from) { to.assign(from.begin(), from.end()); }

  Result<void> write_face_values() {
    for (std::size_t k = 0; k < mesh_.primvars.size(); ++k) {
      const Primvar& primvar = mesh_.primvars[k];
      if (primvar.interpolation == Interpolation::constant)
        assign(out_.primvars[k].values, resolved_values<Real>(primvar));
      if (primvar.interpolation == Interpolation::uniform)
        assign(out_.primvars[k].values,
               gathered<Real>(resolved_values<Real>(primvar), primvar.element_size, out_.base_faces));
    }
    return {};
  }

  Scheme scheme_;
  const ControlMesh& mesh_;
  const RefineOptions& options_;
  Budget budget_;
  Control control_;
  RefinedMesh<Real> out_;
  std::optional<Part> points_;
  std::vector<Part> channels_;
  std::vector<RefinedPrimvar<Real>*> channel_primvars_;
};

}  // namespace

template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options) {
  return Job<Loop, Real>(std::get<Loop>(*scheme_of_mesh(mesh.subdivision_scheme, {3, 3}, options.schemes)),
                         mesh, options, Budget{})
      .run();
}

template Result<RefinedMesh<float>> refine<float>(const ControlMesh&, const RefineOptions&);
template Result<RefinedMesh<double>> refine<double>(const ControlMesh&, const RefineOptions&);

}  // namespace subdivd::plain
