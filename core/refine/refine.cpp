#include "core/refine/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/limit/limit.h"
#include "core/mesh/channel.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"
#include "core/refine/numbering.h"
#include "core/refine/plain.h"
#include "core/refine/render_mesh.h"
#include "core/schemes/all.h"

namespace subdivd {
namespace {

// Coordinates beyond this could overflow in a mask's sums before the weights bring them back.
template <class Real>
constexpr double largest_value() {
  return std::numeric_limits<Real>::max() / 1e6;
}

Index value_count(const Primvar& primvar) {
  return static_cast<Index>(primvar.values.size() / primvar.element_size);
}

std::vector<Index> corner_values(const ControlMesh& mesh, const Primvar& primvar) {
  if (!primvar.indices.empty()) return primvar.indices;
  std::vector<Index> corners(mesh.face_vertex_indices.size());
  for (Index h = 0; h < corners.size(); ++h) corners[h] = h;
  return corners;
}

// The values that a primvar gives to each element in turn, indices resolved, in the engine's type.
template <class Real>
std::vector<Real> resolved_values(const Primvar& primvar) {
  if (primvar.indices.empty()) return {primvar.values.begin(), primvar.values.end()};
  std::vector<Real> values;
  values.reserve(primvar.indices.size() * primvar.element_size);
  for (Index index : primvar.indices) {
    const auto first =
        primvar.values.begin() + static_cast<std::ptrdiff_t>(Count{index} * primvar.element_size);
    values.insert(values.end(), first, first + primvar.element_size);
  }
  return values;
}

template <class Real>
Result<void> check_magnitudes(const ControlMesh& mesh) {
  auto check = [](const std::vector<double>& values, Path where) -> Result<void> {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!(std::abs(values[k]) <= largest_value<Real>())) {
        where.emplace_back(std::uint64_t{k});
        return Error{
            ErrorCode::out_of_range,
            std::string("the value is too large to be refined in ") +
                (sizeof(Real) == 4 ? "single precision (at most 3e32)" : "double precision (at most 1e302)"),
            std::move(where), 0, 0};
      }
    return {};
  };
  if (auto fault = check(mesh.points, {"points"}); !fault) return fault;
  for (const Primvar& primvar : mesh.primvars)
    if (auto fault = check(primvar.values, {"primvars", primvar.name, "values"}); !fault) return fault;
  return {};
}

// Everything about a mesh that does not depend on values, as far as sizes need it.
struct Base {
  Topology topology;
  Sharpness sharpness;
  std::vector<unsigned char> holes;
};

Base make_base(const ControlMesh& mesh) {
  Base base;
  base.topology = Topology(static_cast<Index>(mesh.point_count()), mesh.face_vertex_indices);
  base.sharpness = control_sharpness(mesh, base.topology);
  base.holes = hole_flags(mesh, base.topology);
  return base;
}

Count output_triangles(const Base& base, Index level) {
  return static_cast<Count>(std::ranges::count(base.holes, 0)) << (2 * level);
}

Error too_many(std::string_view what, Count predicted) {
  return {ErrorCode::too_large,
          "level would make " + std::to_string(predicted) + " " + std::string(what) +
              "; 32-bit indices number " + std::to_string(kMaxIndexCount) +
              ": choose a lower level or split the mesh",
          {},
          predicted,
          kMaxIndexCount};
}

Count refined_values(const Primvar& primvar, const RefinedSize& size, Count channel_values) {
  switch (primvar.interpolation) {
    case Interpolation::constant:
      return 1;
    case Interpolation::uniform:
      return size.counts.triangles;
    case Interpolation::varying:
    case Interpolation::vertex:
      return size.counts.vertices;
    case Interpolation::face_varying:
      return channel_values;
  }
  return 0;
}

template <class Real>
Result<RefinedSize> size_of(const ControlMesh& mesh, const RefineOptions& options, const Base& base) {
  if (options.level > kMaxLevel)
    return Error{ErrorCode::out_of_range,
                 "level must be 0 to " + std::to_string(kMaxLevel),
                 {},
                 options.level,
                 kMaxLevel};
  const Topology& topology = base.topology;
  RefinedSize size;
  size.counts =
      refined_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), options.level);
  if (size.counts.vertices > kMaxIndexCount) return too_many("vertices", size.counts.vertices);
  if (3 * size.counts.triangles > kMaxIndexCount)
    return too_many("triangle corners", 3 * size.counts.triangles);
  size.counts.triangles = output_triangles(base, options.level);
  for (const RenderMesh& render : mesh.render_meshes) {
    size.render_vertices.push_back(count_render_vertices(render, options.level));
    if (size.render_vertices.back() > kMaxIndexCount)
      return too_many("render vertices", size.render_vertices.back());
  }
  const Count vectors = 1 + Count{options.limit} + 2 * Count{options.tangents} + Count{options.normals};
  size.bytes = size.counts.vertices * (3 * vectors * sizeof(Real) + sizeof(Provenance)) +
               size.counts.triangles * 4 * sizeof(Index);
  for (std::size_t k = 0; k < mesh.render_meshes.size(); ++k)
    size.bytes += size.render_vertices[k] * sizeof(Index) + 3 * sizeof(Index) * size.counts.triangles;
  for (const Primvar& primvar : mesh.primvars) {
    Count channel_values = 0;
    if (primvar.interpolation == Interpolation::face_varying) {
      const Channel channel = make_channel(mesh, options.crease_method, topology, base.sharpness,
                                           corner_values(mesh, primvar), value_count(primvar));
      channel_values = refined_counts(channel.topology.vertex_count(), channel.topology.edge_count(),
                                      channel.topology.face_count(), options.level)
                           .vertices;
      if (channel_values > kMaxIndexCount)
        return too_many("values of a face-varying primvar", channel_values);
      size.channel_values.push_back(channel_values);
      size.bytes += 3 * sizeof(Index) * size.counts.triangles;
    }
    const bool has_limit = options.limit && (primvar.interpolation == Interpolation::vertex ||
                                             primvar.interpolation == Interpolation::face_varying);
    size.bytes += refined_values(primvar, size, channel_values) * primvar.element_size * sizeof(Real) *
                  (has_limit ? 2 : 1);
  }
  return size;
}

// A set of values on one topology, refined together level by level.
template <class Real>
struct Values {
  Index width;
  bool linear;
  std::vector<Real> values;
};

// Rows of `from` moved to the rows given by `numbers`.
template <class Real>
std::vector<Real> renumbered(const std::vector<Real>& from, Index width, const std::vector<Index>& numbers) {
  std::vector<Real> to(from.size());
  for (std::size_t v = 0; v < numbers.size(); ++v)
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(v * width), width,
                to.begin() + static_cast<std::ptrdiff_t>(std::size_t{numbers[v]} * width));
  return to;
}

template <class Scheme, class Real>
class PlainRefinement {
 public:
  PlainRefinement(const Scheme& scheme, CreaseMethod method, Index depth, plain::Level level,
                  const Budget& budget)
      : scheme_(scheme),
        method_(method),
        depth_(depth),
        budget_(budget),
        level_(std::move(level)),
        base_(level_.topology) {}

  // Refines all value sets to the last level; they stay in the level's own order until taken.
  Result<void> run(std::vector<Values<Real>>& sets) {
    for (Index step = 0; step < depth_; ++step) {
      for (Values<Real>& set : sets) {
        if (auto stop = budget_.poll()) return *stop;
        const bool linear = level_.linear;
        level_.linear |= set.linear;
        set.values = plain::refine_values<Scheme, Real>(scheme_, method_, level_, set.values, set.width);
        level_.linear = linear;
      }
      if (auto stop = budget_.poll()) return *stop;
      level_ = plain::next_level(level_, method_);
    }
    numbers_ = plain::closed_form_numbers(base_, depth_, level_);
    return {};
  }

  const plain::Level& level() const { return level_; }
  const Topology& base() const { return base_; }
  std::vector<Real> take(const Values<Real>& set) const {
    return renumbered(set.values, set.width, numbers_);
  }

  Result<std::vector<Real>> limits(const Values<Real>& set) const {
    std::vector<Real> limits(set.values.size());
    for (Index v = 0; v < level_.topology.vertex_count(); ++v) {
      if (v % 4096 == 0)
        if (auto stop = budget_.poll()) return *stop;
      const auto out = limits.begin() + static_cast<std::ptrdiff_t>(std::size_t{numbers_[v]} * set.width);
      if (level_.linear || set.linear) {
        std::copy_n(set.values.begin() + static_cast<std::ptrdiff_t>(std::size_t{v} * set.width), set.width,
                    out);
        continue;
      }
      const LimitRing<Scheme, Real> ring(scheme_, method_, level_.topology, level_.sharpness, v, set.values,
                                         set.width);
      std::ranges::copy(ring.position(), out);
    }
    return limits;
  }

  Result<void> frames(const Values<Real>& points, const RefineOptions& options,
                      RefinedMesh<Real>& out) const {
    const std::size_t size = points.values.size();
    if (options.tangents) out.tangents_u.resize(size), out.tangents_v.resize(size);
    if (options.normals) out.normals.resize(size);
    for (Index v = 0; v < level_.topology.vertex_count(); ++v) {
      if (v % 4096 == 0)
        if (auto stop = budget_.poll()) return *stop;
      const LimitRing<Scheme, Real> ring(scheme_, method_, level_.topology, level_.sharpness, v,
                                         points.values, 3);
      const std::vector<Frame<Real>> frames = ring.frames();
      const std::size_t at = std::size_t{3} * numbers_[v];
      if (options.tangents && !frames.empty())
        for (std::size_t c = 0; c < 3; ++c) {
          out.tangents_u[at + c] = frames[0].u[c];
          out.tangents_v[at + c] = frames[0].v[c];
        }
      if (options.normals) mean_normal<Real>(frames, out.normals.data() + at);
    }
    return {};
  }

 private:
  Scheme scheme_;
  CreaseMethod method_;
  Index depth_;
  const Budget& budget_;
  plain::Level level_;
  Topology base_;
  std::vector<Index> numbers_;
};

void write_triangles(const Numbering& numbering, std::span<const unsigned char> holes,
                     std::vector<Index>& indices) {
  for (Index f = 0; f < holes.size(); ++f) {
    if (holes[f] != 0) continue;
    for_each_triangle(numbering.segment_count(),
                      [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
                        indices.push_back(numbering.vertex(f, i0, j0));
                        indices.push_back(numbering.vertex(f, i1, j1));
                        indices.push_back(numbering.vertex(f, i2, j2));
                      });
  }
}

std::vector<Provenance> provenance_of(const Base& base, const Numbering& numbering) {
  std::vector<Provenance> provenance(numbering.vertex_count());
  const Count n = numbering.segment_count();
  for (Index f = base.topology.face_count(); f-- > 0;)  // backwards: the lowest-numbered face wins
    for (Count j = 0; j <= n; ++j)
      for (Count i = 0; i + j <= n; ++i)
        provenance[numbering.vertex(f, i, j)] = {f, static_cast<Index>(i), static_cast<Index>(j)};
  return provenance;
}

template <class Scheme, class Real>
Result<RefinedMesh<Real>> refine_with(const Scheme& scheme, const ControlMesh& mesh,
                                      const RefineOptions& options, const Budget& budget) {
  Base base = make_base(mesh);
  auto size = size_of<Real>(mesh, options, base);
  if (!size) return std::move(size).error();
  if (auto allowed = budget.check_bytes(size->bytes); !allowed) return std::move(allowed).error();

  RefinedMesh<Real> out;
  out.name = mesh.name;
  out.level = options.level;
  const Numbering numbering(base.topology, options.level);
  out.triangles.reserve(3 * size->counts.triangles);
  write_triangles(numbering, base.holes, out.triangles);
  for (Index f = 0; f < base.holes.size(); ++f)
    if (base.holes[f] == 0)
      out.triangle_faces.insert(out.triangle_faces.end(), Count{1} << (2 * options.level), f);
  out.provenance = provenance_of(base, numbering);

  // Positions and all primvars that live on the points go through the levels together.
  std::vector<Values<Real>> sets{{3, false, {mesh.points.begin(), mesh.points.end()}}};
  for (const Primvar& primvar : mesh.primvars)
    if (primvar.interpolation == Interpolation::vertex || primvar.interpolation == Interpolation::varying)
      sets.push_back({primvar.element_size, primvar.interpolation == Interpolation::varying,
                      resolved_values<Real>(primvar)});
  PlainRefinement<Scheme, Real> points(scheme, options.crease_method, options.level,
                                       plain::first_level(base.topology, base.sharpness), budget);
  if (auto run = points.run(sets); !run) return std::move(run).error();
  out.points = points.take(sets[0]);
  if (options.limit) {
    auto limits = points.limits(sets[0]);
    if (!limits) return std::move(limits).error();
    out.limit_points = std::move(*limits);
  }
  if (options.tangents || options.normals)
    if (auto frames = points.frames(sets[0], options, out); !frames) return std::move(frames).error();

  std::size_t set = 1;
  for (const Primvar& primvar : mesh.primvars) {
    RefinedPrimvar<Real> refined{primvar.name, primvar.interpolation, primvar.element_size, {}, {}, {}};
    switch (primvar.interpolation) {
      case Interpolation::constant:
        refined.values = resolved_values<Real>(primvar);
        break;
      case Interpolation::uniform: {
        const std::vector<Real> values = resolved_values<Real>(primvar);
        refined.values.reserve(out.triangle_faces.size() * primvar.element_size);
        for (Index f : out.triangle_faces) {
          const auto first = values.begin() + static_cast<std::ptrdiff_t>(Count{f} * primvar.element_size);
          refined.values.insert(refined.values.end(), first, first + primvar.element_size);
        }
        break;
      }
      case Interpolation::varying:
        refined.values = points.take(sets[set++]);
        break;
      case Interpolation::vertex:
        if (options.limit) {
          auto limits = points.limits(sets[set]);
          if (!limits) return std::move(limits).error();
          refined.limit_values = std::move(*limits);
        }
        refined.values = points.take(sets[set++]);
        break;
      case Interpolation::face_varying: {
        const Channel channel = make_channel(mesh, options.crease_method, base.topology, base.sharpness,
                                             corner_values(mesh, primvar), value_count(primvar));
        std::vector<Values<Real>> values{{primvar.element_size, false, {}}};
        for (Index value : channel.values) {
          const auto first =
              primvar.values.begin() + static_cast<std::ptrdiff_t>(Count{value} * primvar.element_size);
          values[0].values.insert(values[0].values.end(), first, first + primvar.element_size);
        }
        PlainRefinement<Scheme, Real> values_on(scheme, options.crease_method, options.level,
                                                plain::first_level(channel), budget);
        if (auto run = values_on.run(values); !run) return std::move(run).error();
        refined.values = values_on.take(values[0]);
        if (options.limit) {
          auto limits = values_on.limits(values[0]);
          if (!limits) return std::move(limits).error();
          refined.limit_values = std::move(*limits);
        }
        write_triangles(Numbering(channel.topology, options.level), base.holes, refined.indices);
        break;
      }
    }
    out.primvars.push_back(std::move(refined));
  }
  for (const RenderMesh& render : mesh.render_meshes) {
    if (auto stop = budget.poll()) return *stop;
    out.render_meshes.push_back(refine_render_mesh(render, options.level, base.holes));
  }
  return out;
}

template <class Scheme>
Scheme make_scheme(const RefineOptions& options) {
  return Scheme{options.loop_weights};
}

}  // namespace

template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const RefineOptions& options) {
  return size_of<Real>(mesh, options, make_base(mesh));
}

template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto fits = check_magnitudes<Real>(mesh); !fits) return std::move(fits).error();
  std::optional<Result<RefinedMesh<Real>>> result;
  visit_scheme(mesh.subdivision_scheme, [&]<class S>(std::type_identity<S>) {
    result = refine_with<S, Real>(make_scheme<S>(options), mesh, options, budget);
  });
  if (!result)
    return Error{ErrorCode::bad_enum,
                 "\"" + mesh.subdivision_scheme + "\" is no scheme of this version; valid: \"loop\"",
                 {"subdivisionScheme"},
                 0,
                 0};
  return std::move(*result);
}

template Result<RefinedSize> predict_size<float>(const ControlMesh&, const RefineOptions&);
template Result<RefinedSize> predict_size<double>(const ControlMesh&, const RefineOptions&);
template Result<RefinedMesh<float>> refine<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<RefinedMesh<double>> refine<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd
