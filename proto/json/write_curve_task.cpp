#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "proto/curve_task.h"
#include "proto/json/json.h"

namespace subdivd::proto {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(std::span<const double> values) {
  return Json(std::vector<double>(values.begin(), values.end()));
}

Json tuples(std::span<const double> values, Count width) {
  Json all = Json::array();
  for (Count i = 0; i + width <= values.size(); i += width) all.push_back(numbers(values.subspan(i, width)));
  return all;
}

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Payload payload_of(const CurveRequest& request, Json json) {
  if (!request.curves.warnings.empty()) json["warnings"] = request.curves.warnings;
  Payload payload;
  payload.content_type = "application/json";
  payload.chunks.push_back(Chunk::own(dumped(json)));
  return payload;
}

Json length_of(const ArcLength& length) {
  return {{"value", length.length}, {"errorBound", length.error_bound}, {"pieces", length.pieces}};
}

Json convergence_of(const Convergence& convergence) {
  // The theory's factor of every step, to compare the measured ones with.
  return {{"distances", numbers(convergence.distances)},
          {"ratios", numbers(convergence.ratios)},
          {"theoreticalRatio", 0.25}};
}

Json measure_of(const CurveMeasure& measure, Count width) {
  Json json;
  if (measure.length) json["length"] = length_of(*measure.length);
  if (measure.box)
    json["bounds"] = {{"low", numbers(measure.box->low)}, {"high", numbers(measure.box->high)}};
  for (const ClosestPoint& point : measure.closest)
    json["closest"].push_back(
        {{"t", point.parameter}, {"point", numbers(point.point)}, {"distance", point.distance}});
  if (measure.polyline)
    json["polyline"] = {{"ts", numbers(measure.polyline->parameters)},
                        {"points", tuples(measure.polyline->points, width)}};
  if (measure.equal_parameters) json["equalLengths"] = {{"ts", numbers(*measure.equal_parameters)}};
  if (measure.convergence) json["convergence"] = convergence_of(*measure.convergence);
  return json;
}

}  // namespace

Result<Payload> encode_samples(const CurveRequest& request, const CurveSamples& samples,
                               [[maybe_unused]] const Budget& budget) {
  Json json = {{"curves", samples.curves}, {"ts", numbers(samples.ts)}, {"points", Json::array()}};
  for (Index order = 1; order <= samples.order; ++order) json["derivatives"].push_back(Json::array());
  for (std::size_t k = 0; k < samples.ts.size(); ++k) {
    const std::span<const double> rows(samples.rows[k]);
    const Index width = samples.widths[k];
    json["points"].push_back(numbers(rows.first(width)));
    for (Index order = 1; order <= samples.order; ++order)
      json["derivatives"][order - 1].push_back(numbers(rows.subspan(Count{order} * width, width)));
    if (!samples.framed) continue;
    const auto& frame = samples.frames[k];
    const auto direction = [&](const char* name, const std::vector<double> FrenetFrame::*member) {
      const bool exists = frame && !((*frame).*member).empty();
      json[name].push_back(exists ? numbers((*frame).*member) : Json(nullptr));
    };
    direction("tangents", &FrenetFrame::tangent);
    direction("normals", &FrenetFrame::normal);
    direction("binormals", &FrenetFrame::binormal);
    json["curvatures"].push_back(optional_number(samples.curvatures[k]));
    json["torsions"].push_back(optional_number(samples.torsions[k]));
  }
  return payload_of(request, {{"samples", std::move(json)}});
}

Result<Payload> encode_samples(const CurveRequest& request, const SurfaceSamples& samples,
                               [[maybe_unused]] const Budget& budget) {
  const CurveTask& task = request.task;
  Json json = {{"surfaces", task.sample_surfaces},
               {"us", numbers(task.sample_us)},
               {"vs", numbers(task.sample_vs)},
               {"points", Json::array()}};
  for (Index order = 1; order <= task.derivatives; ++order) json["derivatives"].push_back(Json::array());
  for (const PatchSample<double>& sample : samples.samples) {
    json["points"].push_back(numbers(sample.point));
    if (task.derivatives >= 1) json["derivatives"][0].push_back({numbers(sample.du), numbers(sample.dv)});
    if (task.derivatives >= 2)
      json["derivatives"][1].push_back({numbers(sample.duu), numbers(sample.duv), numbers(sample.dvv)});
    if (!task.frames) continue;
    const bool exists = sample.normal != std::array<double, 3>{};
    json["normals"].push_back(exists ? numbers(sample.normal) : Json(nullptr));
  }
  return payload_of(request, {{"samples", std::move(json)}});
}

Result<Payload> encode_measures(const CurveRequest& request, const std::vector<CurveMeasure>& measures,
                                [[maybe_unused]] const Budget& budget) {
  Json all = Json::array();
  std::size_t at = 0;
  for (const ControlCurves& curves : request.curves.curves)
    for (Count c = 0; c < curves.curve_count(); ++c) all.push_back(measure_of(measures[at++], curves.width));
  return payload_of(request, {{"measures", std::move(all)}});
}

Result<Payload> encode_edited(const CurveRequest& request, EditedCurves edited, const Budget& budget) {
  Json members = Json::object();
  if (request.task.kind == CurveTaskKind::remove_knot) members["removed"] = edited.removed;
  if (request.task.kind != CurveTaskKind::insert_knot) members["errorBounds"] = numbers(edited.error_bounds);
  if (!request.curves.warnings.empty()) members["warnings"] = request.curves.warnings;
  return json::write(request.curves, AnyAnswer(std::move(edited.answer)), dumped(members), budget);
}

}  // namespace subdivd::proto
