#include "core/refine/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/limit/limit.h"
#include "core/refine/control.h"
#include "core/refine/numbering.h"
#include "core/refine/plain.h"
#include "core/refine/render_mesh.h"
#include "core/schemes/all.h"

namespace subdivd {
namespace {

// Values beyond this could overflow in a mask's sums before the weights bring them back.
template <class Real>
constexpr double kLargestValue = std::numeric_limits<Real>::max() / 1e6;

template <class Real>
Result<void> check_magnitudes(const std::vector<double>& values, Path where) {
  const auto bad =
      std::ranges::find_if(values, [](double x) { return !(std::abs(x) <= kLargestValue<Real>); });
  if (bad == values.end()) return {};
  where.emplace_back(static_cast<std::uint64_t>(bad - values.begin()));
  return Error{
      ErrorCode::out_of_range,
      std::string("the value is too large to be refined in ") +
          (sizeof(Real) == 4 ? "single precision (at most 3e32)" : "double precision (at most 1e302)"),
      std::move(where), 0, 0};
}

template <class Real>
Result<void> check_magnitudes(const ControlMesh& mesh) {
  if (auto fits = check_magnitudes<Real>(mesh.points, {"points"}); !fits) return fits;
  for (const Primvar& primvar : mesh.primvars)
    if (auto fits = check_magnitudes<Real>(primvar.values, {"primvars", primvar.name, "values"}); !fits)
      return fits;
  return {};
}

// Rows of `from`, `width` scalars each, in the order of `rows`.
template <class Real, class Scalar>
std::vector<Real> gathered(const std::vector<Scalar>& from, Index width, const std::vector<Index>& rows) {
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

// One mesh or channel through all levels, together with the values on it.
template <class Scheme, class Real>
class Refinement {
 public:
  Refinement(const Scheme& scheme, const RefineOptions& options, plain::Level level, const Budget& budget)
      : scheme_(scheme),
        options_(options),
        budget_(budget),
        base_(level.topology),
        level_(std::move(level)) {}

  Result<void> run(std::vector<Values<Real>>& sets) {
    for (Index step = 0; step < options_.level; ++step) {
      for (Values<Real>& set : sets) {
        auto values = plain::refine_values<Scheme, Real>(scheme_, options_.crease_method, level_, set.values,
                                                         set.width, set.linear, budget_);
        if (!values) return std::move(values).error();
        set.values = std::move(*values);
      }
      auto next = plain::next_level(level_, options_.crease_method, budget_);
      if (!next) return std::move(next).error();
      level_ = std::move(*next);
    }
    numbers_ = plain::closed_form_numbers(base_, options_.level, level_);
    return {};
  }

  // The refined values in the order of the closed form.
  std::vector<Real> take(const Values<Real>& set) const {
    std::vector<Real> out(set.values.size());
    for (std::size_t v = 0; v < numbers_.size(); ++v)
      std::copy_n(set.values.data() + v * set.width, set.width,
                  out.data() + std::size_t{numbers_[v]} * set.width);
    return out;
  }

  Result<std::vector<Real>> limits(const Values<Real>& set) const {
    if (level_.linear || set.linear) return take(set);
    std::vector<Real> out(set.values.size());
    auto limit = [&](Index v, const LimitRing<Scheme, Real>& ring) {
      std::ranges::copy(ring.position(), out.data() + std::size_t{numbers_[v]} * set.width);
    };
    if (auto done = for_each_ring(set, limit); !done) return std::move(done).error();
    return out;
  }

  // Tangents and normals of the points, into `out`.
  Result<void> frames(const Values<Real>& points, RefinedMesh<Real>& out) const {
    if (options_.tangents) {
      out.tangents_u.resize(points.values.size());
      out.tangents_v.resize(points.values.size());
    }
    if (options_.normals) out.normals.resize(points.values.size());
    return for_each_ring(points, [&](Index v, const LimitRing<Scheme, Real>& ring) {
      const std::vector<Frame<Real>> frames = ring.frames();
      const std::size_t at = std::size_t{3} * numbers_[v];
      if (options_.tangents && !frames.empty()) {
        std::copy_n(frames[0].u, 3, out.tangents_u.data() + at);
        std::copy_n(frames[0].v, 3, out.tangents_v.data() + at);
      }
      if (options_.normals) mean_normal<Real>(frames, out.normals.data() + at);
    });
  }

 private:
  template <class F>
  Result<void> for_each_ring(const Values<Real>& set, F&& f) const {
    for (Index v = 0; v < level_.topology.vertex_count(); ++v) {
      if (v % 4096 == 0)
        if (auto stop = budget_.poll()) return *stop;
      f(v, LimitRing<Scheme, Real>(scheme_, options_.crease_method, level_.topology, level_.sharpness, v,
                                   set.values, set.width));
    }
    return {};
  }

  Scheme scheme_;
  const RefineOptions& options_;
  const Budget& budget_;
  Topology base_;
  plain::Level level_;
  std::vector<Index> numbers_;  // of the last level's vertices, by the closed form
};

std::vector<Index> triangles_of(const Numbering& numbering, std::span<const unsigned char> holes) {
  std::vector<Index> indices;
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

std::vector<Provenance> provenance_of(const Numbering& numbering, Index face_count) {
  std::vector<Provenance> provenance(numbering.vertex_count());
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
    auto size = size_of<Real>(mesh_, options_, control_);
    if (!size) return std::move(size).error();
    if (auto fits = budget_.check_bytes(size->bytes); !fits) return std::move(fits).error();
    for (auto part :
         {&Job::refine_connectivity, &Job::refine_points, &Job::refine_face_values, &Job::refine_channels}) {
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
    out_.triangles = triangles_of(numbering, control_.holes);
    out_.provenance = provenance_of(numbering, control_.topology.face_count());
    out_.triangle_faces.reserve(out_.triangles.size() / 3);
    for (Index f = 0; f < control_.holes.size(); ++f)
      if (control_.holes[f] == 0)
        out_.triangle_faces.insert(out_.triangle_faces.end(), Count{1} << (2 * options_.level), f);
    for (const RenderMesh& render : mesh_.render_meshes) {
      if (auto stop = budget_.poll()) return *stop;
      out_.render_meshes.push_back(refine_render_mesh(render, options_.level, control_.holes));
    }
    for (const Primvar& primvar : mesh_.primvars)
      out_.primvars.push_back({primvar.name, primvar.interpolation, primvar.element_size, {}, {}, {}});
    return {};
  }

  // Positions and the primvars that live on the points go through the levels together.
  Result<void> refine_points() {
    std::vector<Values<Real>> sets{{3, false, {mesh_.points.begin(), mesh_.points.end()}}};
    std::vector<RefinedPrimvar<Real>*> owners{nullptr};
    for (std::size_t k = 0; k < mesh_.primvars.size(); ++k) {
      const Primvar& primvar = mesh_.primvars[k];
      const bool varying = primvar.interpolation == Interpolation::varying;
      if (!varying && primvar.interpolation != Interpolation::vertex) continue;
      sets.push_back({primvar.element_size, varying, resolved_values<Real>(primvar)});
      owners.push_back(&out_.primvars[k]);
    }
    Refinement<Scheme, Real> refinement(scheme_, options_,
                                        plain::first_level(control_.topology, control_.sharpness), budget_);
    if (auto done = refinement.run(sets); !done) return done;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      (k == 0 ? out_.points : owners[k]->values) = refinement.take(sets[k]);
      if (!options_.limit || sets[k].linear) continue;
      auto limits = refinement.limits(sets[k]);
      if (!limits) return std::move(limits).error();
      (k == 0 ? out_.limit_points : owners[k]->limit_values) = std::move(*limits);
    }
    if (!options_.tangents && !options_.normals) return {};
    return refinement.frames(sets[0], out_);
  }

  Result<void> refine_face_values() {
    for (std::size_t k = 0; k < mesh_.primvars.size(); ++k) {
      const Primvar& primvar = mesh_.primvars[k];
      if (primvar.interpolation == Interpolation::constant)
        out_.primvars[k].values = resolved_values<Real>(primvar);
      if (primvar.interpolation == Interpolation::uniform)
        out_.primvars[k].values =
            gathered<Real>(resolved_values<Real>(primvar), primvar.element_size, out_.triangle_faces);
    }
    return {};
  }

  Result<void> refine_channels() {
    std::size_t channel = 0;
    for (std::size_t k = 0; k < mesh_.primvars.size(); ++k) {
      const Primvar& primvar = mesh_.primvars[k];
      if (primvar.interpolation != Interpolation::face_varying) continue;
      const Channel& own = control_.channels[channel++];
      std::vector<Values<Real>> sets{
          {primvar.element_size, false, gathered<Real>(primvar.values, primvar.element_size, own.values)}};
      Refinement<Scheme, Real> refinement(scheme_, options_, plain::first_level(own), budget_);
      if (auto done = refinement.run(sets); !done) return done;
      out_.primvars[k].values = refinement.take(sets[0]);
      out_.primvars[k].indices = triangles_of(Numbering(own.topology, options_.level), control_.holes);
      if (!options_.limit) continue;
      auto limits = refinement.limits(sets[0]);
      if (!limits) return std::move(limits).error();
      out_.primvars[k].limit_values = std::move(*limits);
    }
    return {};
  }

  Scheme scheme_;
  const ControlMesh& mesh_;
  const RefineOptions& options_;
  const Budget& budget_;
  Control control_;
  RefinedMesh<Real> out_;
};

}  // namespace

template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto fits = check_magnitudes<Real>(mesh); !fits) return std::move(fits).error();
  std::optional<Result<RefinedMesh<Real>>> result;
  visit_scheme(mesh.subdivision_scheme, [&]<class S>(std::type_identity<S>) {
    result = Job<S, Real>(S{options.loop_weights}, mesh, options, budget).run();
  });
  if (!result)
    return Error{ErrorCode::bad_enum,
                 "\"" + mesh.subdivision_scheme + "\" is no scheme of this version; valid: \"loop\"",
                 {"subdivisionScheme"},
                 0,
                 0};
  return std::move(*result);
}

template Result<RefinedMesh<float>> refine<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<RefinedMesh<double>> refine<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd
