#include "proto/gltf/read_lines.h"

#include <algorithm>
#include <utility>

#include "proto/gltf/caps.h"
#include "proto/gltf/weld.h"

namespace subdivd::proto::gltf {
namespace {

constexpr Index kPeriodicMinimum = 3;  // points of a closed curve

// Position and attributes of every vertex, one after the other.
struct Tuples {
  Index width = 3;
  std::vector<double> values;
  Held memory;
};

Result<Tuples> interleave(const Asset& asset, const PrimitiveData& data, const Place& place) {
  Tuples tuples;
  Index widest = 3;
  for (const PrimitiveChannel& channel : data.channels) {
    tuples.width += channel.components;
    widest = std::max(widest, channel.components);
  }
  const Count scalars = Count{data.vertex_count} * tuples.width;
  auto memory = asset.work.hold(scalars * sizeof(double) + kBlockBytes);
  if (!memory) return memory.error();
  tuples.memory = *std::move(memory);
  const auto held = asset.work.hold(Count{data.vertex_count} * widest * sizeof(double) + kBlockBytes);
  if (!held) return held.error();
  if (auto grown = grow(tuples.values, scalars, asset.work); !grown) return grown.error();
  std::vector<double> values;
  values.reserve(Count{data.vertex_count} * widest);
  Index offset = 0;
  const Place attributes = place.at("attributes");
  const auto add = [&](std::string_view name, Index accessor, Index components) -> Result<void> {
    values.clear();
    if (auto read = append_values(asset, data, accessor, attributes.at(name), values); !read) return read;
    for (Count vertex = 0; vertex < data.vertex_count; ++vertex) {
      if (auto stop = asset.work.spend(1)) return *std::move(stop);
      for (Index k = 0; k < components; ++k)
        tuples.values[vertex * tuples.width + offset + k] = values[vertex * components + k];
    }
    offset += components;
    return {};
  };
  if (auto added = add("POSITION", data.position_accessor, 3); !added) return added.error();
  for (const PrimitiveChannel& channel : data.channels)
    if (auto added = add(channel.name, channel.accessor, channel.components); !added) return added.error();
  return tuples;
}

Result<ControlCurves> make_curves(const ChainList& chains, CurveWrap wrap, const Tuples& tuples, Work& work) {
  ControlCurves curves;
  curves.width = tuples.width;
  curves.wrap = wrap;
  if (auto kept = work.keep(chains.vertices.size() * tuples.width * sizeof(double) +
                            chains.lengths.size() * sizeof(Index) + 2 * kBlockBytes);
      !kept)
    return kept.error();
  curves.points.reserve(chains.vertices.size() * tuples.width);
  for (const Count vertex : chains.vertices) {
    if (auto stop = work.spend(2)) return *std::move(stop);
    const auto first = tuples.values.begin() + static_cast<std::ptrdiff_t>(vertex * tuples.width);
    curves.points.insert(curves.points.end(), first, first + tuples.width);
  }
  curves.vertex_counts = chains.lengths;
  return curves;
}

// Segments with welded ends; those of no length are left out.
Result<Chains> chain_lines(const PrimitiveData& data, const Tuples& tuples, Weld option, Work& work) {
  const auto held = work.hold(data.corners.size() * sizeof(Index) + kBlockBytes);
  if (!held) return held.error();
  Welded weld;
  if (option == Weld::exact) {
    auto welded = weld_tuples(tuples.values, tuples.width, {}, work);
    if (!welded) return welded.error();
    weld = *std::move(welded);
  }
  std::vector<Index> proper;
  proper.reserve(data.corners.size());
  const auto end_at = [&](std::size_t i) {
    const Index vertex = data.corners[i];
    return option == Weld::exact ? weld.first[weld.id[vertex]] : vertex;
  };
  for (std::size_t i = 0; i + 1 < data.corners.size(); i += 2) {
    if (auto stop = work.spend(2)) return *std::move(stop);
    const Index a = end_at(i), b = end_at(i + 1);
    if (a != b) proper.insert(proper.end(), {a, b});
  }
  return chain_segments(proper, data.vertex_count, work);
}

class ChainBuilder {
 public:
  ChainBuilder(const std::vector<Index>& ends, Index vertex_count, Work& work)
      : ends_(ends), vertex_count_(vertex_count), work_(work) {}
  Result<Chains> build();

 private:
  Result<void> index_segments();
  bool is_inner(Index vertex) const { return first_[vertex + 1] - first_[vertex] == 2; }
  Result<void> walk(Index vertex, Index segment);
  Result<void> start(Index end);

  const std::vector<Index>& ends_;
  Index vertex_count_;
  Work& work_;
  std::vector<Index> first_, segments_;  // segments at vertex v: segments_[first_[v] .. first_[v + 1])
  std::vector<bool> used_;
  std::vector<Index> chain_;
  Chains chains_;
};

Result<void> ChainBuilder::index_segments() {
  first_.resize(std::size_t{vertex_count_} + 1);
  segments_.resize(ends_.size());
  used_.resize(ends_.size() / 2);
  for (const Index end : ends_) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    ++first_[end + 1];
  }
  for (Index v = 0; v < vertex_count_; ++v) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    first_[v + 1] += first_[v];
  }
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index i = 0; i < ends_.size(); ++i) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    segments_[next[ends_[i]]++] = i / 2;
  }
  return {};
}

// From `vertex` along `segment` until a vertex that ends a chain, or back to the start (which is repeated).
Result<void> ChainBuilder::walk(Index vertex, Index segment) {
  chain_.assign(1, vertex);
  for (;;) {
    if (auto stop = work_.spend(2)) return *std::move(stop);
    used_[segment] = true;
    vertex = ends_[2 * std::size_t{segment}] == vertex ? ends_[2 * std::size_t{segment} + 1]
                                                       : ends_[2 * std::size_t{segment}];
    chain_.push_back(vertex);
    if (!is_inner(vertex)) return {};
    const Index a = segments_[first_[vertex]], b = segments_[first_[vertex] + 1];
    segment = a == segment ? b : a;
    if (used_[segment]) return {};
  }
}

Result<void> ChainBuilder::start(Index end) {
  if (auto walked = walk(ends_[end], end / 2); !walked) return walked;
  const bool closed =
      chain_.front() == chain_.back() && is_inner(chain_.front()) && chain_.size() > kPeriodicMinimum;
  if (closed) chain_.pop_back();
  ChainList& list = closed ? chains_.closed : chains_.open;
  list.vertices.insert(list.vertices.end(), chain_.begin(), chain_.end());
  list.lengths.push_back(static_cast<Index>(chain_.size()));
  return {};
}

Result<Chains> ChainBuilder::build() {
  // A chain has one vertex more than segments. Lists grow by doubling, and open ones can leave closed ones
  // room.
  auto memory = work_.hold(ends_.size() * 6 * sizeof(Index) + 4 * kBlockBytes);
  if (!memory) return memory.error();
  chains_.memory = *std::move(memory);
  const auto held = work_.hold((2 * std::size_t{vertex_count_} + 4 * ends_.size()) * sizeof(Index));
  if (!held) return held.error();
  if (auto indexed = index_segments(); !indexed) return indexed.error();
  for (Index i = 0; i < ends_.size(); ++i) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    if (!used_[i / 2] && !is_inner(ends_[i]))
      if (auto started = start(i); !started) return started.error();
  }
  for (Index i = 0; i < ends_.size(); i += 2) {
    if (auto stop = work_.spend(1)) return *std::move(stop);
    if (!used_[i / 2])
      if (auto started = start(i); !started) return started.error();
  }
  return std::move(chains_);
}

}  // namespace

Result<Chains> chain_segments(const std::vector<Index>& ends, Index vertex_count, Work& work) {
  return ChainBuilder(ends, vertex_count, work).build();
}

Result<ReadLines> read_lines(const Asset& asset, Index mesh, Index primitive, const Options& options,
                             const Place& place) {
  const Json& json = (*asset.meshes[mesh].find("primitives")->array())[primitive];
  const Count mode = mode_of(json);
  auto data = read_primitive(asset, json, place);
  if (!data) return data.error();
  if (data->has_normals) asset.warnings.add("NORMAL of a line primitive is dropped", place);
  ReadLines result;
  result.slot = {mesh, primitive, mode, {}, 0, {}};
  Index offset = 3;
  Count beside = sizeof(CurvesSlot) + 2 * sizeof(ControlCurves) + kMaxRepeatedName + 4 * kBlockBytes;
  for (const PrimitiveChannel& channel : data->channels) {
    result.slot.attributes.push_back({std::string(channel.name), 0, offset, channel.components});
    offset += channel.components;
    beside += 3 * (sizeof(PrimitiveChannel) + sizeof(AttributeSlot)) + channel.name.size() + kBlockBytes;
  }
  if (auto kept = asset.work.keep(beside); !kept) return kept.error();
  if (offset > kMaxCurveWidth) {
    asset.warnings.add("A line primitive with attributes of too many numbers is left as it is", place);
    return result;
  }
  if (mode == kLineLoop && data->corners.size() < kPeriodicMinimum) {
    asset.warnings.add("A line primitive too short to be refined is left as it is", place);
    return result;
  }
  if (auto left_out = leave_out_unused(*data, asset.work); !left_out) return left_out.error();
  const Count corners = data->corners.size();
  const auto tuples = interleave(asset, *data, place);
  if (!tuples) return tuples.error();
  const auto add = [&](const ChainList& chains, CurveWrap wrap) -> Result<void> {
    if (chains.lengths.empty()) return {};
    auto curves = make_curves(chains, wrap, *tuples, asset.work);
    if (!curves) return curves.error();
    curves->name = short_name(asset.meshes[mesh]);
    result.curves.push_back(*std::move(curves));
    return {};
  };
  result.curves.reserve(2);
  if (mode == kLines) {
    const auto chains = chain_lines(*data, *tuples, options.weld, asset.work);
    if (!chains) return chains.error();
    if (auto added = add(chains->open, CurveWrap::pinned); !added) return added.error();
    if (auto added = add(chains->closed, CurveWrap::periodic); !added) return added.error();
  } else {
    const auto length = static_cast<Index>(data->corners.size());
    const ChainList chain{std::move(data->corners), {length}};
    if (auto added = add(chain, mode == kLineStrip ? CurveWrap::pinned : CurveWrap::periodic); !added)
      return added.error();
  }
  if (result.curves.empty())
    asset.warnings.add("A line primitive too short to be refined is left as it is", place);
  // Corners and numbers of vertices end here.
  asset.work.drop((data->original.size() + corners) * sizeof(Index));
  return result;
}

}  // namespace subdivd::proto::gltf
