#include "core/refine/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/refine/evaluate.h"
#include "core/refine/numbering.h"
#include "core/refine/plan.h"
#include "core/refine/render_mesh.h"
#include "core/refine/size.h"
#include "core/refine/triangles.h"

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
template <class Real>
Buffer<Real> gathered(const std::vector<double>& from, Index width, std::span<const Index> rows) {
  Buffer<Real> to(rows.size() * width);
  auto at = to.begin();
  for (const Index row : rows)
    at = std::transform(from.begin() + static_cast<std::ptrdiff_t>(Count{row} * width),
                        from.begin() + static_cast<std::ptrdiff_t>(Count{row} * width + width), at,
                        [](double x) { return static_cast<Real>(x); });
  return to;
}

template <class Real>
Buffer<Real> converted(const std::vector<double>& from) {
  Buffer<Real> to(from.size());
  std::ranges::transform(from, to.begin(), [](double x) { return static_cast<Real>(x); });
  return to;
}

// The values that a primvar gives to each element in turn, indices resolved.
template <class Real>
Buffer<Real> resolved_values(const Primvar& primvar) {
  if (primvar.indices.empty()) return converted<Real>(primvar.values);
  return gathered<Real>(primvar.values, primvar.element_size, primvar.indices);
}

// refine(), part by part.
template <class Real>
class Job {
 public:
  Job(const ControlMesh& mesh, const RefineOptions& options, const Budget& budget, const Plan& plan)
      : mesh_(mesh), options_(options), budget_(budget), plan_(plan) {}

  Result<RefinedMesh<Real>> run() {
    out_.name = mesh_.name;
    out_.level = options_.level;
    out_.triangle_count = plan_.counts(options_.level).triangles;
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
    const Buffer<Real> control = converted<Real>(mesh_.points);
    return evaluate<Real>(plan_.mesh(), options_.level, control, 3, Smoothing::smooth, to, options_.threads,
                          budget_);
  }

  Result<void> write_indices(const Net& net, Buffer<Index>& out) {
    if (!options_.connectivity) return {};
    out.resize(3 * plan_.counts(options_.level).triangles);
    return write_triangles(net.topology(), options_.level, plan_.holes(), out.data(), options_.threads,
                           budget_);
  }

  Result<void> refine_connectivity() {
    if (auto done = write_indices(plan_.mesh(), out_.triangles); !done) return done;
    if (!options_.provenance) return {};
    out_.triangle_faces = triangle_faces();
    return write_provenance();
  }

  Result<void> write_provenance() {
    const Topology& topology = plan_.mesh().topology();
    const Numbering numbering(topology, options_.level);
    const Count n = numbering.segment_count();
    const Count faces_per_poll = std::max<Count>(1, (Count{1} << 18) / (n * n));
    out_.provenance.resize(numbering.vertex_count());
    std::fill_n(out_.provenance.begin(), topology.vertex_count(), Provenance{});
    for (Index f = topology.face_count(); f-- > 0;) {  // backwards: the lowest-numbered face wins
      if (f % faces_per_poll == 0)
        if (auto stop = budget_.poll()) return *stop;
      for (Count j = 0; j <= n; ++j)
        for (Count i = 0; i + j <= n; ++i)
          out_.provenance[numbering.vertex(f, i, j)] = {f, static_cast<Index>(i), static_cast<Index>(j)};
    }
    return {};
  }

  Buffer<Index> triangle_faces() const {
    Buffer<Index> faces(plan_.counts(options_.level).triangles);
    auto at = faces.begin();
    for (Index f = 0; f < plan_.holes().size(); ++f)
      if (plan_.holes()[f] == 0) at = std::fill_n(at, std::ptrdiff_t{1} << (2 * options_.level), f);
    return faces;
  }

  Result<void> refine_values(const Net& net, const Buffer<Real>& control, Smoothing smoothing, bool limit,
                             RefinedPrimvar<Real>& out) {
    const Count size = net.value_count(options_.level) * out.element_size;
    Evaluated<Real> to;
    out.values.resize(size);
    to.values = out.values.data();
    if (limit) {
      out.limit_values.resize(size);
      to.limits = out.limit_values.data();
    }
    return evaluate<Real>(net, options_.level, control, out.element_size, smoothing, to, options_.threads,
                          budget_);
  }

  Result<void> refine_primvars() {
    std::size_t channel = 0;
    for (const Primvar& primvar : mesh_.primvars) {
      RefinedPrimvar<Real>& out = out_.primvars.emplace_back(
          RefinedPrimvar<Real>{primvar.name, primvar.interpolation, primvar.element_size, {}, {}, {}});
      Result<void> done;
      switch (primvar.interpolation) {
        case Interpolation::constant:
          out.values = resolved_values<Real>(primvar);
          break;
        case Interpolation::uniform:
          out.values = gathered<Real>(primvar.values, primvar.element_size, uniform_rows(primvar));
          break;
        case Interpolation::varying:
          done = refine_values(plan_.mesh(), resolved_values<Real>(primvar), Smoothing::linear, false, out);
          break;
        case Interpolation::vertex:
          done = refine_values(plan_.mesh(), resolved_values<Real>(primvar), Smoothing::smooth,
                               options_.limit, out);
          break;
        case Interpolation::face_varying: {
          const Net& net = plan_.channel(channel++);
          done = refine_values(net, gathered<Real>(primvar.values, primvar.element_size, net.value_indices()),
                               Smoothing::smooth, options_.limit, out);
          if (done) done = write_indices(net, out.indices);
          break;
        }
      }
      if (!done) return done;
    }
    return {};
  }

  // Row of the primvar's values for every output triangle.
  Buffer<Index> uniform_rows(const Primvar& primvar) const {
    Buffer<Index> rows = triangle_faces();
    if (!primvar.indices.empty())
      for (Index& row : rows) row = primvar.indices[row];
    return rows;
  }

  Result<void> refine_render_meshes() {
    for (const RenderMesh& render : mesh_.render_meshes) {
      auto refined = refine_render_mesh(render, plan_, options_.level, options_.threads, budget_);
      if (!refined) return std::move(refined).error();
      out_.render_meshes.push_back(std::move(*refined));
    }
    return {};
  }

  const ControlMesh& mesh_;
  const RefineOptions& options_;
  const Budget& budget_;
  const Plan& plan_;
  RefinedMesh<Real> out_;
};

}  // namespace

template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto fits = check_magnitudes<Real>(mesh); !fits) return std::move(fits).error();
  if (auto allowed = check_level(options.level); !allowed) return std::move(allowed).error();
  const auto plan = Plan::build(mesh, {options.loop_weights, options.crease_method, options.level}, budget);
  if (!plan) return plan.error();
  const auto size = size_of<Real>(mesh, options, *plan, budget);
  if (!size) return size.error();
  if (auto fits = budget.check_bytes(size->bytes); !fits) return std::move(fits).error();
  return Job<Real>(mesh, options, budget, *plan).run();
}

template Result<RefinedMesh<float>> refine<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<RefinedMesh<double>> refine<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd
