#include "proto/gltf/read_lines.h"

#include <array>
#include <numeric>
#include <utility>

#include "proto/gltf/weld.h"

namespace subdivd::proto::gltf {
namespace {

constexpr Index kPeriodicMinimum = 3;  // points of a closed curve

// Position and attributes of every vertex, one after the other.
struct Tuples {
  Index width = 3;
  std::vector<double> values;
};

Tuples interleave(const PrimitiveData& data) {
  Tuples tuples;
  for (const PrimitiveChannel& channel : data.channels) tuples.width += channel.components;
  tuples.values.reserve(Count{data.vertex_count} * tuples.width);
  for (Count vertex = 0; vertex < data.vertex_count; ++vertex) {
    const auto append = [&](const std::vector<double>& values, Count width) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(vertex * width);
      tuples.values.insert(tuples.values.end(), first, first + static_cast<std::ptrdiff_t>(width));
    };
    append(data.positions, 3);
    for (const PrimitiveChannel& channel : data.channels) append(channel.values, channel.components);
  }
  return tuples;
}

void append_curve(ControlCurves& curves, const std::vector<Index>& vertices, const Tuples& tuples) {
  for (const Count vertex : vertices) {
    const auto first = tuples.values.begin() + static_cast<std::ptrdiff_t>(vertex * tuples.width);
    curves.points.insert(curves.points.end(), first, first + tuples.width);
  }
  curves.vertex_counts.push_back(static_cast<Index>(vertices.size()));
}

// Segments with welded ends; those of no length are left out.
Chains chain_lines(const PrimitiveData& data, const Tuples& tuples, Weld option) {
  std::vector<Index> ends = data.corners;
  if (option == Weld::exact) {
    const Welded weld = weld_tuples(tuples.values, tuples.width);
    for (Index& end : ends) end = weld.first[weld.id[end]];
  }
  std::vector<Index> proper;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
    if (ends[i] != ends[i + 1]) proper.insert(proper.end(), {ends[i], ends[i + 1]});
  return chain_segments(proper, data.vertex_count);
}

class ChainBuilder {
 public:
  ChainBuilder(const std::vector<Index>& ends, Index vertex_count);
  Chains build();

 private:
  bool is_inner(Index vertex) const { return first_[vertex + 1] - first_[vertex] == 2; }
  std::vector<Index> walk(Index vertex, Index segment);

  const std::vector<Index>& ends_;
  std::vector<Index> first_, segments_;  // segments at vertex v: segments_[first_[v] .. first_[v + 1])
  std::vector<bool> used_;
};

ChainBuilder::ChainBuilder(const std::vector<Index>& ends, Index vertex_count)
    : ends_(ends), first_(std::size_t{vertex_count} + 1), segments_(ends.size()), used_(ends.size() / 2) {
  for (const Index end : ends) ++first_[end + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index i = 0; i < ends.size(); ++i) segments_[next[ends[i]]++] = i / 2;
}

// From `vertex` along `segment` until a vertex that ends a chain, or back to the start (which is repeated).
std::vector<Index> ChainBuilder::walk(Index vertex, Index segment) {
  std::vector<Index> chain{vertex};
  for (;;) {
    used_[segment] = true;
    vertex = ends_[2 * std::size_t{segment}] == vertex ? ends_[2 * std::size_t{segment} + 1]
                                                       : ends_[2 * std::size_t{segment}];
    chain.push_back(vertex);
    if (!is_inner(vertex)) return chain;
    const Index a = segments_[first_[vertex]], b = segments_[first_[vertex] + 1];
    segment = a == segment ? b : a;
    if (used_[segment]) return chain;
  }
}

Chains ChainBuilder::build() {
  Chains chains;
  const auto start = [&](Index i) {
    const Index segment = i / 2;
    std::vector<Index> chain = walk(ends_[i], segment);
    const bool closed =
        chain.front() == chain.back() && is_inner(chain.front()) && chain.size() > kPeriodicMinimum;
    if (closed) chain.pop_back();
    (closed ? chains.closed : chains.open).push_back(std::move(chain));
  };
  for (Index i = 0; i < ends_.size(); ++i)
    if (!used_[i / 2] && !is_inner(ends_[i])) start(i);
  for (Index i = 0; i < ends_.size(); i += 2)
    if (!used_[i / 2]) start(i);
  return chains;
}

}  // namespace

Chains chain_segments(const std::vector<Index>& ends, Index vertex_count) {
  return ChainBuilder(ends, vertex_count).build();
}

Result<ReadLines> read_lines(const Asset& asset, Index mesh, Index primitive, const Options& options,
                             const Place& place) {
  const tinygltf::Primitive& structure = asset.model.meshes[mesh].primitives[primitive];
  auto data = read_primitive(asset, structure, place);
  if (!data) return data.error();
  if (data->has_normals) asset.warnings.add("NORMAL of a line primitive is dropped", place.pointer());
  const Tuples tuples = interleave(*data);
  ReadLines result;
  result.slot = {mesh, primitive, static_cast<Count>(structure.mode), {}, 0, {}};
  Index offset = 3;
  for (const PrimitiveChannel& channel : data->channels) {
    result.slot.attributes.push_back({channel.name, 0, offset, channel.components});
    offset += channel.components;
  }
  const auto add = [&](const std::vector<std::vector<Index>>& chains, CurveWrap wrap) {
    if (chains.empty()) return;
    ControlCurves curves;
    curves.name = asset.model.meshes[mesh].name;
    curves.width = tuples.width;
    curves.wrap = wrap;
    for (const auto& chain : chains) append_curve(curves, chain, tuples);
    result.curves.push_back(std::move(curves));
  };
  if (structure.mode == static_cast<int>(kLines)) {
    const Chains chains = chain_lines(*data, tuples, options.weld);
    add(chains.open, CurveWrap::pinned);
    add(chains.closed, CurveWrap::periodic);
  } else if (structure.mode == static_cast<int>(kLineStrip)) {
    add({data->corners}, CurveWrap::pinned);
  } else if (data->corners.size() >= kPeriodicMinimum) {
    add({data->corners}, CurveWrap::periodic);
  }
  if (tuples.width > kMaxCurveWidth) result.curves.clear();
  if (result.curves.empty())
    asset.warnings.add("A line primitive too short to be refined is left as it is", place.pointer());
  return result;
}

}  // namespace subdivd::proto::gltf
