#include "core/refine/refine.h"

#include <algorithm>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/pace.h"
#include "core/refine/render_mesh.h"

namespace subdivd {
namespace {

// Rows of `from`, `width` scalars each, in the order of `rows`; room is left for evaluate().
template <class Real>
Buffer<Real> gather_rows(const std::vector<double>& from, Index width, std::span<const Index> rows,
                         const Pace& pace) {
  Buffer<Real> to;
  to.reserve(rows.size() * width + kSpareControl);
  to.resize(rows.size() * width);
  auto at = to.begin();
  for (const Index row : rows) {
    pace.spend(width);
    at = std::transform(from.begin() + static_cast<std::ptrdiff_t>(Count{row} * width),
                        from.begin() + static_cast<std::ptrdiff_t>(Count{row} * width + width), at,
                        [](double x) { return static_cast<Real>(x); });
  }
  return to;
}

template <class Real>
Buffer<Real> convert_values(const std::vector<double>& from, const Pace& pace) {
  Buffer<Real> to;
  to.reserve(from.size() + kSpareControl);
  to.resize(from.size());
  pace.in_blocks(from.size(), [&](Count begin, Count end) {
    for (Count k = begin; k < end; ++k) to[k] = static_cast<Real>(from[k]);
  });
  return to;
}

// The values that a primvar gives to each element in turn, indices resolved.
template <class Real>
Buffer<Real> resolve_values(const Primvar& primvar, const Pace& pace) {
  if (primvar.indices.empty()) return convert_values<Real>(primvar.values, pace);
  return gather_rows<Real>(primvar.values, primvar.element_size, primvar.indices, pace);
}

// refine(), part by part.
template <class Real>
class Job {
 public:
  Job(const ControlMesh& mesh, const RefineOptions& options, const Budget& budget, const Plan& plan,
      const Pace& pace)
      : mesh_(mesh), options_(options), budget_(budget), plan_(plan), pace_(pace) {}

  Result<RefinedMesh<Real>> run() {
    out_.name = mesh_.name;
    out_.scheme = name_of(plan_.scheme());
    out_.level = options_.level;
    for (Index level = 0; level <= options_.level; ++level)
      out_.levels.push_back(plan_.mesh().lattice()->counts(level));
    out_.face_count = plan_.counts(options_.level).faces;
    out_.face_size = plan_.mesh().lattice()->face_size(options_.level);
    for (auto part : {&Job::refine_points, &Job::refine_connectivity, &Job::refine_primvars,
                      &Job::refine_render_meshes}) {
      if (auto stop = budget_.poll()) return *stop;
      if (auto done = (this->*part)(); !done) return std::move(done).error();
    }
    return std::move(out_);
  }

 private:
  Result<void> refine_points() {
    const Count size = 3 * plan_.mesh().value_count(options_.level);
    Evaluated<Real> to;
    const auto array = [&](Buffer<Real>& buffer) {
      buffer.resize(size);
      return buffer.data();
    };
    to.values = array(out_.points);
    if (options_.limit) to.limits = array(out_.limit_points);
    if (options_.tangents) {
      to.tangents_u = array(out_.tangents_u);
      to.tangents_v = array(out_.tangents_v);
    }
    if (options_.normals) to.normals = array(out_.normals);
    return plan_.mesh().evaluate(options_.level, convert_values<Real>(mesh_.points, pace_), 3,
                                 Smoothing::smooth, to, options_.threads, budget_);
  }

  Result<void> write_indices(const Refinable& part, Buffer<Index>& out) {
    if (!options_.connectivity) return {};
    out.resize(plan_.corner_count(options_.level));
    return part.lattice()->write_faces(options_.level, plan_.holes(), out.data(), options_.threads, budget_);
  }

  Result<void> refine_connectivity() {
    if (auto done = write_indices(plan_.mesh(), out_.faces); !done) return done;
    const Lattice& lattice = *plan_.mesh().lattice();
    if (options_.connectivity && out_.face_size == 0) {
      out_.face_vertex_counts.resize(out_.face_count);
      lattice.write_face_sizes(plan_.holes(), out_.face_vertex_counts.data(), pace_);
    }
    if (!options_.provenance) return {};
    out_.base_faces = base_faces();
    out_.provenance.resize(plan_.mesh().value_count(options_.level));
    lattice.write_provenance(options_.level, out_.provenance, pace_);
    return {};
  }

  Buffer<Index> base_faces() const {
    Buffer<Index> faces(out_.face_count);
    plan_.mesh().lattice()->write_base_faces(options_.level, plan_.holes(), faces.data(), pace_);
    return faces;
  }

  Result<void> refine_values(const Refinable& part, Buffer<Real> control, Smoothing smoothing, bool limit,
                             RefinedPrimvar<Real>& out) {
    const Count size = part.value_count(options_.level) * out.element_size;
    Evaluated<Real> to;
    out.values.resize(size);
    to.values = out.values.data();
    if (limit) {
      out.limit_values.resize(size);
      to.limits = out.limit_values.data();
    }
    return part.evaluate(options_.level, std::move(control), out.element_size, smoothing, to,
                         options_.threads, budget_);
  }

  Result<void> refine_primvars() {
    std::size_t channel = 0;
    for (const Primvar& primvar : mesh_.primvars) {
      pace_.spend(256);
      RefinedPrimvar<Real>& out = out_.primvars.emplace_back(
          RefinedPrimvar<Real>{primvar.name, primvar.interpolation, primvar.element_size, {}, {}, {}});
      Result<void> done;
      switch (primvar.interpolation) {
        case Interpolation::constant:
          out.values = resolve_values<Real>(primvar, pace_);
          break;
        case Interpolation::uniform:
          out.values = gather_rows<Real>(primvar.values, primvar.element_size, uniform_rows(primvar), pace_);
          break;
        case Interpolation::varying:
          done = refine_values(plan_.mesh(), resolve_values<Real>(primvar, pace_), Smoothing::linear, false,
                               out);
          break;
        case Interpolation::vertex:
          done = refine_values(plan_.mesh(), resolve_values<Real>(primvar, pace_), Smoothing::smooth,
                               options_.limit, out);
          break;
        case Interpolation::face_varying: {
          const Refinable& part = plan_.channel(channel++);
          done = refine_values(part, channel_values(primvar, part), Smoothing::smooth, options_.limit, out);
          if (done) done = write_indices(part, out.indices);
          break;
        }
      }
      if (!done) return done;
    }
    return {};
  }

  // In the order of the channel's control values.
  Buffer<Real> channel_values(const Primvar& primvar, const Refinable& part) const {
    if (part.value_indices().empty()) return convert_values<Real>(primvar.values, pace_);
    return gather_rows<Real>(primvar.values, primvar.element_size, part.value_indices(), pace_);
  }

  // Row of the primvar's values for every output face.
  Buffer<Index> uniform_rows(const Primvar& primvar) const {
    Buffer<Index> rows = base_faces();
    if (!primvar.indices.empty())
      pace_.for_each(rows.size(), [&](Count k) { rows[k] = primvar.indices[rows[k]]; });
    return rows;
  }

  Result<void> refine_render_meshes() {
    const Lattice& lattice = *plan_.mesh().lattice();
    Count faces = 0;  // refined ones that are output, of the base faces before `face`
    Index face = 0;
    out_.render_meshes.reserve(mesh_.render_meshes.size());
    for (const RenderMesh& render : mesh_.render_meshes) {  // their ranges ascend
      pace_.spend(256);
      for (; face < render.face_begin; ++face)
        if (plan_.holes()[face] == 0) faces += lattice.faces_of(face, options_.level);
      auto refined = refine_render_mesh(render, plan_.render_lattice(out_.render_meshes.size()), plan_,
                                        options_.level, static_cast<Index>(faces), budget_);
      if (!refined) return std::move(refined).error();
      out_.render_meshes.push_back(std::move(*refined));
    }
    return {};
  }

  const ControlMesh& mesh_;
  const RefineOptions& options_;
  const Budget& budget_;
  const Plan& plan_;
  const Pace& pace_;
  RefinedMesh<Real> out_;
};

}  // namespace

PlanOptions plan_options(const RefineOptions& options) {
  return {options.schemes, options.crease_method, options.level, options.tangents || options.normals};
}

template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto fits = check_magnitudes<Real>(mesh, budget); !fits) return std::move(fits).error();
  const auto size = predict_size<Real>(mesh, plan, options, budget);
  if (!size) return size.error();
  if (auto fits = budget.check_bytes(size->bytes); !fits) return std::move(fits).error();
  return stoppable(budget,
                   [&](const Pace& pace) { return Job<Real>(mesh, options, budget, plan, pace).run(); });
}

template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget) {
  const auto plan = Plan::build(mesh, plan_options(options), budget);
  if (!plan) return plan.error();
  return refine<Real>(mesh, *plan, options, budget);
}

template Result<RefinedMesh<float>> refine<float>(const ControlMesh&, const Plan&, const RefineOptions&,
                                                  const Budget&);
template Result<RefinedMesh<double>> refine<double>(const ControlMesh&, const Plan&, const RefineOptions&,
                                                    const Budget&);
template Result<RefinedMesh<float>> refine<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<RefinedMesh<double>> refine<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd
