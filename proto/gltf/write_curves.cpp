#include "proto/gltf/write_curves.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

// A run of points of one RefinedCurves.
template <class Real>
struct Run {
  const Real* first = nullptr;
  Index count = 0, width = 3;
  bool closed = false;
};

template <class Real>
void add_runs(const RefinedCurves<Real>& curves, Index first, Index end, Count begin,
              std::vector<Run<Real>>& runs) {
  const Buffer<Real>& points = curves.limit_points.empty() ? curves.points : curves.limit_points;
  for (Index ordinal = first; ordinal < end; ++ordinal) {
    const Index count = curves.vertex_counts[ordinal];
    runs.push_back(
        {points.data() + begin * curves.width, count, curves.width, curves.wrap == CurveWrap::periodic});
    begin += count;
  }
}

template <class Real>
std::vector<Run<Real>> runs_of(const CurvesSlot& slot, const std::vector<RefinedCurves<Real>>& all,
                               Count first_point) {
  std::vector<Run<Real>> runs;
  for (const Index index : slot.curves) {
    const auto count = static_cast<Index>(all[index].vertex_counts.size());
    if (slot.mode == kLines) {
      add_runs(all[index], 0, count, 0, runs);
    } else if (slot.ordinal < count) {
      add_runs(all[index], slot.ordinal, slot.ordinal + 1, first_point, runs);
    }
  }
  return runs;
}

// `components` scalars of every point from `offset` on; zeros beyond the width of its curve.
template <class Real>
Result<Buffer<float>> gather(const std::vector<Run<Real>>& runs, Index offset, Index components, bool color,
                             Work& work) {
  Count points = 0;
  for (const Run<Real>& run : runs) points += run.count;
  Buffer<float> out;
  out.reserve(points * components);
  for (const Run<Real>& run : runs)
    for (Count point = 0; point < run.count; ++point) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      for (Index k = 0; k < components; ++k) {
        const Real value = offset + k < run.width ? run.first[point * run.width + offset + k] : Real(0);
        out.push_back(static_cast<float>(color ? std::clamp(value, Real(0), Real(1)) : value));
      }
    }
  return out;
}

template <class Real>
Result<Buffer<Index>> segments_of(const std::vector<Run<Real>>& runs, Work& work) {
  Buffer<Index> ends;
  Count count = 0;
  for (const Run<Real>& run : runs) count += 2 * Count{run.count};
  ends.reserve(count);
  Index begin = 0;
  for (const Run<Real>& run : runs) {
    for (Index i = 0; i + 1 < run.count; ++i) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      ends.insert(ends.end(), {begin + i, begin + i + 1});
    }
    if (run.closed) ends.insert(ends.end(), {begin + run.count - 1, begin});
    begin += run.count;
  }
  return ends;
}

}  // namespace

template <class Real>
Result<void> write_curves(const CurvesSlot& slot, const std::vector<RefinedCurves<Real>>& curves,
                          Count first_point, Output& output, Work& work) {
  if (auto stop = work.spend(256)) return *std::move(stop);
  const std::vector<Run<Real>> runs = runs_of(slot, curves, first_point);
  Json& primitive = output.primitive(slot.mesh, slot.primitive);
  Json attributes = std::move(*primitive.find("attributes"));
  const auto add = [&](const AttributeSlot& attribute, bool bounds) -> Result<void> {
    const bool color = semantic_of(attribute.name) == Semantic::color;
    auto values = gather(runs, attribute.offset, attribute.components, color, work);
    if (!values) return values.error();
    const auto scanned = scan_floats(*values, attribute.components, bounds, Clamp::none, work);
    if (!scanned) return scanned.error();
    if (!scanned->finite)
      return Error{
          ErrorCode::not_finite,
          in_quotes(attribute.name) + " of a curve holds values too large for the single precision of glTF"};
    const Index accessor = output.add_floats(*std::move(values), attribute.components, *scanned);
    attributes.set(attribute.name, Json::number(Count{accessor}));
    return {};
  };
  if (auto added = add({"POSITION", 0, 0, 3}, true); !added) return added;
  for (const AttributeSlot& attribute : slot.attributes)
    if (auto added = add(attribute, false); !added) return added;
  primitive.set("attributes", std::move(attributes));
  if (slot.mode != kLines) return {};
  const Index points = std::accumulate(runs.begin(), runs.end(), Index{0},
                                       [](Index sum, const Run<Real>& run) { return sum + run.count; });
  auto segments = segments_of(runs, work);
  if (!segments) return segments.error();
  const auto accessor = output.add_indices(*std::move(segments), points);
  if (!accessor) return accessor.error();
  primitive.set("indices", Json::number(Count{*accessor}));
  return {};
}

template Result<void> write_curves(const CurvesSlot&, const std::vector<RefinedCurves<float>>&, Count,
                                   Output&, Work&);
template Result<void> write_curves(const CurvesSlot&, const std::vector<RefinedCurves<double>>&, Count,
                                   Output&, Work&);

}  // namespace subdivd::proto::gltf
