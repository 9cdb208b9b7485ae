#include "proto/gltf/write_curves.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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
std::vector<Run<Real>> runs_of(const CurvesSlot& slot, const std::vector<RefinedCurves<Real>>& all) {
  std::vector<Run<Real>> runs;
  for (const Index index : slot.curves) {
    const RefinedCurves<Real>& curves = all[index];
    const Buffer<Real>& points = curves.limit_points.empty() ? curves.points : curves.limit_points;
    Count begin = 0;
    for (Index ordinal = 0; ordinal < curves.vertex_counts.size(); ++ordinal) {
      const Index count = curves.vertex_counts[ordinal];
      if (slot.mode == kLines || ordinal == slot.ordinal)
        runs.push_back(
            {points.data() + begin * curves.width, count, curves.width, curves.wrap == CurveWrap::periodic});
      begin += count;
    }
  }
  return runs;
}

// `components` scalars of every point from `offset` on; zeros beyond the width of its curve.
template <class Real>
Buffer<float> gather(const std::vector<Run<Real>>& runs, Index offset, Index components, bool color) {
  Buffer<float> out;
  for (const Run<Real>& run : runs)
    for (Count point = 0; point < run.count; ++point)
      for (Index k = 0; k < components; ++k) {
        const Real value = offset + k < run.width ? run.first[point * run.width + offset + k] : Real(0);
        out.push_back(static_cast<float>(color ? std::clamp(value, Real(0), Real(1)) : value));
      }
  return out;
}

template <class Real>
Buffer<Index> segments_of(const std::vector<Run<Real>>& runs) {
  Buffer<Index> ends;
  Index begin = 0;
  for (const Run<Real>& run : runs) {
    for (Index i = 0; i + 1 < run.count; ++i) ends.insert(ends.end(), {begin + i, begin + i + 1});
    if (run.closed) ends.insert(ends.end(), {begin + run.count - 1, begin});
    begin += run.count;
  }
  return ends;
}

}  // namespace

template <class Real>
Result<void> write_curves(const CurvesSlot& slot, const std::vector<RefinedCurves<Real>>& curves,
                          Output& output) {
  const std::vector<Run<Real>> runs = runs_of(slot, curves);
  Json& primitive = output.primitive(slot.mesh, slot.primitive);
  Json attributes = std::move(*primitive.find("attributes"));
  const auto add = [&](const AttributeSlot& attribute, bool bounds) -> Result<void> {
    const bool color = semantic_of(attribute.name) == Semantic::color;
    Buffer<float> values = gather(runs, attribute.offset, attribute.components, color);
    if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
      return Error{ErrorCode::not_finite,
                   attribute.name + " of a curve holds values too large for the single precision of glTF",
                   {},
                   0,
                   0};
    const Index accessor = output.add_floats(std::move(values), attribute.components, bounds);
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
  primitive.set("indices", Json::number(Count{output.add_indices(segments_of(runs), points)}));
  return {};
}

template Result<void> write_curves(const CurvesSlot&, const std::vector<RefinedCurves<float>>&, Output&);
template Result<void> write_curves(const CurvesSlot&, const std::vector<RefinedCurves<double>>&, Output&);

}  // namespace subdivd::proto::gltf
