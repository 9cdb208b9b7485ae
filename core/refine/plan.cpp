#include "core/refine/plan.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/pace.h"
#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"
#include "core/mesh/channel.h"
#include "core/mesh/sharpness.h"
#include "core/refine/first_step.h"

namespace subdivd {
namespace {

std::string in_quotes(std::string_view name) { return '"' + std::string(name) + '"'; }

Error no_such_scheme(std::string_view name) {
  std::string known;
  for (const std::string_view one : kSchemeNames) known += (known.empty() ? "" : ", ") + in_quotes(one);
  return Error{ErrorCode::bad_enum,
               in_quotes(name) + " is no scheme of this version; valid: " + known,
               {"subdivisionScheme"}};
}

// `given`: the sizes that all faces of the mesh have.
Error other_faces(std::string_view name, FaceSizes sizes, FaceSizes given, std::size_t face, Index corners,
                  const AllSchemes& schemes) {
  std::string others;
  for_each_scheme(schemes, [&]<class S>(const S&) {
    if (S::face_sizes.least <= given.least && given.most <= S::face_sizes.most)
      others += (others.empty() ? "" : " or ") + in_quotes(S::name);
  });
  const std::string takes = sizes.least == sizes.most
                                ? std::to_string(sizes.least)
                                : std::to_string(sizes.least) + " to " + std::to_string(sizes.most);
  return Error{ErrorCode::unsupported,
               in_quotes(name) + " takes faces of " + takes + " vertices, and face " + std::to_string(face) +
                   " has " + std::to_string(corners) + ": take " + others +
                   (sizes.least == 3 ? ", or set triangulate to true to split larger faces" : ""),
               {"subdivisionScheme"}};
}

// The least and the most corners of a face.
FaceSizes sizes_of(const Cage& cage, const Pace& pace) {
  if (cage.face_vertex_counts.empty()) return {3, 3};
  FaceSizes sizes{kNoIndex, 0};
  pace.for_each(cage.face_vertex_counts.size(), [&](std::size_t f) {
    sizes.least = std::min(sizes.least, cage.face_vertex_counts[f]);
    sizes.most = std::max(sizes.most, cage.face_vertex_counts[f]);
  });
  return sizes;
}

// Of every corner in turn.
std::vector<Index> corner_values(const Cage& cage, const Cage::Seams& seams, const Pace& pace) {
  std::vector<Index> corners;
  if (seams.corner_values.empty())
    pace.for_each(static_cast<Index>(cage.face_vertex_indices.size()),
                  [&](Index k) { corners.push_back(k); });
  else
    pace.copy(seams.corner_values, corners);
  return corners;
}

bool are_alike(const Cage::Seams& a, const Cage::Seams& b, const Pace& pace) {
  return a.value_count == b.value_count && pace.equal(a.corner_values, b.corner_values);
}

bool connects_alike(const Lattice& lattice, const RenderMesh& render, const Pace& pace) {
  if (lattice.base_vertex_count() != render.vertex_count ||
      !pace.equal(lattice.base_corners(), render.indices))
    return false;
  std::vector<unsigned char> used;
  pace.fill(used, render.vertex_count, 0);
  pace.for_each(render.indices.size(), [&](std::size_t k) { used[render.indices[k]] = 1; });
  return pace.all_blocks(used.size(), [&](Count begin, Count end) {
    return std::find(used.begin() + static_cast<std::ptrdiff_t>(begin),
                     used.begin() + static_cast<std::ptrdiff_t>(end),
                     0) == used.begin() + static_cast<std::ptrdiff_t>(end);
  });
}

// Corners of some faces in a row, over whatever vertices.
template <class Faces>
Faces faces_of(const Cage& cage, Index begin, Index end, std::span<const Index> corners, const Pace& pace) {
  std::vector<Index> indices;
  pace.copy(corners, indices);
  if constexpr (std::is_same_v<Faces, Polygons>) {
    std::vector<Index> begins;
    begins.reserve(Count{end} - begin + 1);
    begins.push_back(0);
    pace.for_each(end - begin, [&](Index f) { begins.push_back(begins.back() + cage.face_size(begin + f)); });
    return Polygons(std::move(begins), std::move(indices), pace);
  } else {
    return Faces(std::move(indices));
  }
}

std::shared_ptr<const Lattice> lattice_of(std::shared_ptr<const Connectivity<Polygons>> polygons,
                                          const Pace& pace) {
  auto quads = quads_of(*polygons, pace);
  return std::make_shared<const Lattice>(std::move(polygons), std::move(quads));
}
template <class Faces>
std::shared_ptr<const Lattice> lattice_of(std::shared_ptr<const Connectivity<Faces>> grids, const Pace&) {
  return std::make_shared<const Lattice>(std::move(grids));
}

}  // namespace

Result<void> check_level(Index level) {
  if (level <= kMaxLevel) return {};
  return Error{.code = ErrorCode::out_of_range,
               .message = "level must be 0 to " + std::to_string(kMaxLevel),
               .predicted = level,
               .allowed = kMaxLevel};
}

Result<AnyScheme> scheme_of(const Cage& cage, const AllSchemes& schemes, const Pace& pace) {
  const FaceSizes given = sizes_of(cage, pace);
  std::optional<AnyScheme> scheme = scheme_of_mesh(cage.subdivision_scheme, given, schemes);
  if (!scheme) return no_such_scheme(cage.subdivision_scheme);
  const FaceSizes taken = face_sizes_of(*scheme);
  if (given.least < taken.least || given.most > taken.most) {
    std::size_t face = 0;
    while (cage.face_size(face) >= taken.least && cage.face_size(face) <= taken.most) {
      pace.spend(1);
      ++face;
    }
    return other_faces(cage.subdivision_scheme, taken, given, face, cage.face_size(face), schemes);
  }
  if (!takes_semi_sharp(*scheme))
    if (auto fine = refuse_semi_sharp(name_of(*scheme), cage); !fine) return std::move(fine).error();
  if (auto* catmull_clark = std::get_if<CatmullClark>(&*scheme))
    catmull_clark->triangles = cage.triangle_subdivision_rule;
  return *scheme;
}

// Whether the first step must make quads of the faces.
bool has_first_step(const AnyScheme& scheme, FaceSizes sizes) {
  return !splits_into_triangles(scheme) && sizes != FaceSizes{4, 4};
}

// Measured on closed meshes, separate faces, hubs and many channels. What the first step makes is held beside the
// quads, and while it is made much else.
constexpr Count kBytesPerCorner = 112, kBytesPerCornerOfFirstStep = 440, kBytesPerPoint = 64;

Count plan_bytes(const Cage& cage, const PlanOptions& options, const Pace& pace) {
  const FaceSizes sizes = sizes_of(cage, pace);
  const auto scheme = scheme_of_mesh(cage.subdivision_scheme, sizes, options.schemes);
  const Count nets = 1 + cage.channels.size(), corners = cage.face_vertex_indices.size();
  const bool by_steps = scheme && as_one_of<AnyInterpolatingScheme>(*scheme).has_value();
  const Count per_corner =
      scheme && !by_steps && has_first_step(*scheme, sizes) ? kBytesPerCornerOfFirstStep : kBytesPerCorner;
  Count bytes = by_steps ? steps_bytes(corners, options.max_level, options.frames) +
                               (nets - 1) * steps_bytes(corners, options.max_level, false)
                         : 0;
  bytes += (per_corner * corners + kBytesPerPoint * cage.point_count) *
           (nets + (cage.render_meshes.empty() ? 0 : 1));
  if (options.crease_method == CreaseMethod::chaikin) {
    const Count edges = std::min<Count>(cage.crease_indices.size(), corners);
    bytes += nets * chaikin_bytes(edges, options.max_level);
  }
  return bytes;
}

// plan(), for faces of one kind.
struct Plan::Builder {
  const Cage& cage;
  const PlanOptions& options;
  const Budget& budget;
  const Pace& pace;
  Plan& plan;

  template <class Faces>
  std::shared_ptr<const Topology<Faces>> whole_topology() const {
    return std::make_shared<const Topology<Faces>>(
        cage.point_count,
        faces_of<Faces>(cage, 0, static_cast<Index>(cage.face_count()), cage.face_vertex_indices, pace),
        pace);
  }

  // At an open border a face has no surface where that needs faces which are not there.
  template <class Faces>
  std::vector<unsigned char> holes_of(const Topology<Faces>& topology) const {
    Cage as_closed = cage;
    if (!needs_neighbors(plan.scheme_))
      as_closed.interpolate_boundary = BoundaryInterpolation::edge_and_corner;
    return hole_flags(as_closed, topology, pace);
  }

  // By `plain`, level after level.
  template <class Faces>
  Result<void> build(const AnyInterpolatingScheme& scheme) {
    const auto topology = whole_topology<Faces>();
    Sharpness sharpness = control_sharpness(cage, *topology, pace);
    plan.holes_ = holes_of(*topology);
    if (auto fits = check_points(refined_vertex_count(*topology, options.max_level)); !fits) return fits;
    const auto steps_of = [&](const Topology<Faces>& of, std::shared_ptr<const Lattice> lattice,
                              Sharpness of_it, bool linear, bool linear_borders, bool frames) {
      plain::Level level =
          plain::first_level(plain::adjacency_of(of, pace), std::move(of_it), options.crease_method, pace);
      level.linear = linear;
      level.linear_borders = linear_borders;
      return interpolating_steps(scheme, std::move(level), std::move(lattice), options.max_level, frames,
                                 pace);
    };
    plan.parts_.push_back(make_refinable(
        steps_of(*topology, lattice_of<Faces>(topology, pace), sharpness, false, false, options.frames)));
    add_channels<Faces>(topology, sharpness, [&](Channel<Faces> channel) {
      Steps steps = steps_of(*channel.topology, lattice_of<Faces>(channel.topology, pace),
                             std::move(channel.sharpness), channel.linear, channel.linear_borders, false);
      steps.values = std::move(channel.values);
      return make_refinable(std::move(steps));
    });
    add_render_meshes<Faces>();
    return {};
  }

  // On grids, polygons after a first step.
  template <class Faces>
  Result<void> build(const AnyGridScheme& scheme) {
    const auto topology = whole_topology<Faces>();
    Sharpness sharpness = control_sharpness(cage, *topology, pace);
    plan.holes_ = holes_of(*topology);
    if constexpr (std::is_same_v<Faces, Polygons>) {
      MeshFirstStep first = first_step(scheme, options.crease_method, topology, sharpness, pace);
      const plain::Level& level = first.level;
      const Index depth = options.max_level - std::min<Index>(options.max_level, 1);
      if (auto fits = check_points(refined_vertex_count(*first.step.quads, depth)); !fits) return fits;
      auto net = std::make_shared<const Net<Quads>>(Net<Quads>::build(
          scheme, options.crease_method, first.step.quads, std::move(first.step.sharpness), depth, pace));
      plan.parts_.push_back(make_refinable(std::move(first.step), net));
      add_channels<Polygons>(topology, sharpness, [&](Channel<Polygons> channel) {
        FirstStep of_channel = first_step(scheme, options.crease_method, std::move(channel), level, pace);
        Channel<Quads> quads{of_channel.quads, std::move(of_channel.sharpness), {}, of_channel.linear, false};
        quads.linear_borders =
            !quads.linear && cage.face_varying_linear_interpolation == FaceVaryingInterpolation::boundaries;
        auto channel_net = std::make_shared<const Net<Quads>>(Net<Quads>::build(net, std::move(quads), pace));
        return make_refinable(std::move(of_channel), std::move(channel_net));
      });
    } else {
      if (auto fits = check_points(refined_vertex_count(*topology, options.max_level)); !fits) return fits;
      auto net = std::make_shared<const Net<Faces>>(Net<Faces>::build(
          scheme, options.crease_method, topology, std::move(sharpness), options.max_level, pace));
      plan.parts_.push_back(make_refinable(net));
      add_channels<Faces>(topology, net->sharpness(), [&](Channel<Faces> channel) {
        return make_refinable(
            std::make_shared<const Net<Faces>>(Net<Faces>::build(net, std::move(channel), pace)));
      });
    }
    add_render_meshes<Faces>();
    return {};
  }

  // Sharpness that varies along edges takes memory at every level: not more than points alone would.
  Result<void> check_points(Count vertices) const { return budget.check_bytes(vertices * 3 * sizeof(float)); }

  // `make`: of the channel what refines it.
  template <class Faces, class Make>
  void add_channels(const std::shared_ptr<const Topology<Faces>>& topology, const Sharpness& sharpness,
                    Make&& make) {
    std::vector<Index> vertices;
    // Compared with the one before, not with all earlier ones: there may be a hundred thousand.
    const Cage::Seams* previous = nullptr;
    for (const Cage::Seams& seams : cage.channels) {
      pace.spend(64);
      const Cage::Seams* const before = std::exchange(previous, &seams);
      if (before != nullptr && are_alike(*before, seams, pace)) {
        plan.parts_.push_back(plan.parts_.back());
        continue;
      }
      if (is_as_mesh(cage, *topology, seams.corner_values, seams.value_count, pace)) {
        plan.parts_.push_back(plan.parts_.front());
        continue;
      }
      if (vertices.empty()) vertices = vertices_with_faces(*topology, pace);
      plan.parts_.push_back(make(make_channel(cage, options.crease_method, topology, sharpness, vertices,
                                              corner_values(cage, seams, pace), seams.value_count, pace)));
    }
  }

  template <class Faces>
  std::shared_ptr<const Lattice> lattice_of_render(const RenderMesh& render) const {
    const Count faces = cage.face_count();
    const bool is_whole = render.face_end - render.face_begin == faces && plan.output_faces_ == faces;
    for (std::size_t k = 0; is_whole && k < plan.parts_.size(); ++k) {
      pace.spend(4);
      if (connects_alike(*plan.parts_[k]->lattice(), render, pace)) return plan.parts_[k]->lattice();
    }
    return lattice_of(
        std::make_shared<const Connectivity<Faces>>(
            render.vertex_count,
            faces_of<Faces>(cage, render.face_begin, render.face_end, render.indices, pace), pace),
        pace);
  }

  template <class Faces>
  void add_render_meshes() {
    const Lattice& lattice = *plan.mesh().lattice();
    pace.for_each(plan.holes_.size(), [&](std::size_t f) {
      if (plan.holes_[f] != 0) return;
      ++plan.output_faces_;
      plan.output_corners_ += lattice.base_face_size(static_cast<Index>(f));
    });
    plan.render_lattices_.reserve(cage.render_meshes.size());
    for (const RenderMesh& render : cage.render_meshes) {
      pace.spend(64);
      plan.render_lattices_.push_back(lattice_of_render<Faces>(render));
    }
  }
};

Result<Plan> Plan::build(const Cage& cage, const PlanOptions& options, const Budget& budget) {
  if (auto allowed = check_level(options.max_level); !allowed) return std::move(allowed).error();
  return stoppable(budget, [&](const Pace& pace) -> Result<Plan> {
    auto scheme = scheme_of(cage, options.schemes, pace);
    if (!scheme) return std::move(scheme).error();
    Plan plan;
    plan.scheme_ = *std::move(scheme);
    Builder builder{cage, options, budget, pace, plan};
    const FaceSizes sizes = sizes_of(cage, pace);
    const bool triangles = splits_into_triangles(plan.scheme_);
    Result<void> built;
    if (const auto on_grids = as_one_of<AnyGridScheme>(plan.scheme_))
      built = triangles                             ? builder.build<Triangles>(*on_grids)
              : has_first_step(plan.scheme_, sizes) ? builder.build<Polygons>(*on_grids)
                                                    : builder.build<Quads>(*on_grids);
    else if (const auto by_steps = as_one_of<AnyInterpolatingScheme>(plan.scheme_))
      built = triangles ? builder.build<Triangles>(*by_steps) : builder.build<Quads>(*by_steps);
    if (!built) return std::move(built).error();
    return plan;
  });
}

LevelCounts Plan::counts(Index level) const {
  const Lattice& lattice = *mesh().lattice();
  LevelCounts counts = lattice.counts(level);
  counts.faces = output_faces_;
  if (level >= 1 && lattice.first_level() == 1)
    counts.faces = output_corners_ << (2 * (level - 1));
  else
    counts.faces <<= 2 * level;
  return counts;
}

Count Plan::corner_count(Index level) const {
  const Index size = mesh().lattice()->face_size(level);
  return size == 0 ? output_corners_ : size * counts(level).faces;
}

}  // namespace subdivd
