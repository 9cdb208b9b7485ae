#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/base/pace.h"
#include "proto/curve_task.h"
#include "proto/json/json.h"
#include "proto/json/text_writer.h"

namespace subdivd::proto {
namespace {

// Numbers of an answer straight into its text. Results are in the precision of the answer; parameters of
// curves are doubles always, for in single precision they would be other points.
class TaskWriter {
 public:
  TaskWriter(const CurveRequest& request, const Budget& budget)
      : request_(request),
        text_(budget),
        single_(answer_precision(request.curves) == Precision::single_precision) {}

  void open(const char* name, char bracket) {
    text_.key(name);
    text_.open(bracket);
  }
  void begin(char bracket) {
    text_.separate();
    text_.open(bracket);
  }
  void end(char bracket) { text_.close(bracket); }

  // Each behind a comma, where something stands before it.
  void parameter(double value) {
    text_.separate();
    plain(value);
  }
  void result(double value) {
    text_.separate();
    if (single_)
      rounded(value);
    else
      plain(value);
  }
  void result(const std::optional<double>& value) {
    if (value) return result(*value);
    null();
  }
  void null() {
    text_.separate();
    text_.raw("null");
  }
  void count(std::uint64_t value) {
    text_.separate();
    text_.number(value);
  }
  void results(std::span<const double> values) {
    begin('[');
    for (const double value : values) result(value);
    end(']');
  }

  void named_result(const char* name, double value) {
    text_.key(name);
    single_ ? rounded(value) : plain(value);
  }
  void named_parameter(const char* name, double value) {
    text_.key(name);
    plain(value);
  }
  void named_count(const char* name, std::uint64_t value) {
    text_.key(name);
    text_.number(value);
  }
  void named_results(const char* name, std::span<const double> values) {
    open(name, '[');
    for (const double value : values) result(value);
    end(']');
  }
  void named_parameters(const char* name, std::span<const double> values) {
    open(name, '[');
    for (const double value : values) parameter(value);
    end(']');
  }
  template <class Counts>
  void named_counts(const char* name, const Counts& values) {
    open(name, '[');
    for (const auto value : values) count(value);
    end(']');
  }
  bool stopped() const { return text_.stopped().has_value(); }

  // The warnings, and the end of the object.
  Result<Payload> finish() {
    if (!request_.curves.warnings.empty()) {
      open("warnings", '[');
      for (const std::string& warning : request_.curves.warnings) {
        text_.separate();
        text_.string(warning);
      }
      end(']');
    }
    end('}');
    Payload payload;
    payload.content_type = "application/json";
    payload.chunks = text_.finish();
    if (text_.stopped()) return *text_.stopped();
    if (too_large_)
      return Error{ErrorCode::not_finite,
                   "a number of the answer is too large for single precision; take precision double"};
    return payload;
  }

 private:
  void plain(double value) {
    if (std::isfinite(value))
      text_.number(value);
    else
      text_.raw("null");
  }
  void rounded(double value) {
    const auto single = static_cast<float>(value);
    if (std::isfinite(value) && !std::isfinite(single)) too_large_ = true;
    if (std::isfinite(single))
      text_.number(single);
    else
      text_.raw("null");
  }

  const CurveRequest& request_;
  json::TextWriter text_;
  const bool single_;
  bool too_large_ = false;
};

void write_measure(TaskWriter& writer, const CurveMeasure& measure, Count width) {
  writer.begin('{');
  if (measure.length) {
    writer.open("length", '{');
    writer.named_result("value", measure.length->length);
    writer.named_result("errorBound", measure.length->error_bound);
    writer.named_count("pieces", measure.length->pieces);
    writer.end('}');
  }
  if (measure.box) {
    writer.open("bounds", '{');
    writer.named_results("low", measure.box->low);
    writer.named_results("high", measure.box->high);
    writer.end('}');
  }
  if (!measure.closest.empty()) {
    writer.open("closest", '[');
    for (const ClosestPoint& point : measure.closest) {
      writer.begin('{');
      writer.named_parameter("t", point.parameter);
      writer.named_results("point", point.point);
      writer.named_result("distance", point.distance);
      writer.end('}');
    }
    writer.end(']');
  }
  if (measure.polyline) {
    const std::span<const double> points(measure.polyline->points);
    writer.open("polyline", '{');
    writer.named_parameters("ts", measure.polyline->parameters);
    writer.open("points", '[');
    for (Count i = 0; i + width <= points.size() && !writer.stopped(); i += width)
      writer.results(points.subspan(i, width));
    writer.end(']');
    writer.end('}');
  }
  if (measure.equal_parameters) {
    writer.open("equalLengths", '{');
    writer.named_parameters("ts", *measure.equal_parameters);
    writer.end('}');
  }
  if (measure.convergence) {
    writer.open("convergence", '{');
    writer.named_results("distances", measure.convergence->distances);
    writer.named_results("ratios", measure.convergence->ratios);
    // The theory's factor of every step, to compare the measured ones with.
    writer.named_result("theoreticalRatio", 0.25);
    writer.end('}');
  }
  writer.end('}');
}

// A member with something about every sample, written by one(k).
template <class One>
void write_each(TaskWriter& writer, const char* name, std::size_t samples, One one) {
  if (name != nullptr)
    writer.open(name, '[');
  else
    writer.begin('[');
  for (std::size_t k = 0; k < samples && !writer.stopped(); ++k) one(k);
  writer.end(']');
}

void write_frames(TaskWriter& writer, const CurveSamples& samples) {
  const auto direction = [&](const char* name, const std::vector<double> FrenetFrame::*member) {
    write_each(writer, name, samples.ts.size(), [&](std::size_t k) {
      const auto& frame = samples.frames[k];
      const bool exists = frame && !((*frame).*member).empty();
      exists ? writer.results((*frame).*member) : writer.null();
    });
  };
  direction("tangents", &FrenetFrame::tangent);
  direction("normals", &FrenetFrame::normal);
  direction("binormals", &FrenetFrame::binormal);
  write_each(writer, "curvatures", samples.ts.size(),
             [&](std::size_t k) { writer.result(samples.curvatures[k]); });
  write_each(writer, "torsions", samples.ts.size(),
             [&](std::size_t k) { writer.result(samples.torsions[k]); });
}

}  // namespace

Result<Payload> encode_samples(const CurveRequest& request, const CurveSamples& samples,
                               const Budget& budget) {
  TaskWriter writer(request, budget);
  const std::size_t count = samples.ts.size();
  const auto row = [&](std::size_t k, Index order) {
    const Index width = samples.widths[k];
    writer.results(std::span<const double>(samples.rows[k]).subspan(Count{order} * width, width));
  };
  writer.begin('{');
  writer.open("samples", '{');
  writer.named_counts("curves", samples.curves);
  writer.named_parameters("ts", samples.ts);
  write_each(writer, "points", count, [&](std::size_t k) { row(k, 0); });
  if (samples.order > 0)
    write_each(writer, "derivatives", samples.order, [&](std::size_t order) {
      write_each(writer, nullptr, count, [&](std::size_t k) { row(k, static_cast<Index>(order) + 1); });
    });
  if (samples.framed && count > 0) write_frames(writer, samples);
  writer.end('}');
  return writer.finish();
}

Result<Payload> encode_samples(const CurveRequest& request, const SurfaceSamples& samples,
                               const Budget& budget) {
  using Sample = PatchSample<double>;
  const CurveTask& task = request.task;
  const std::size_t count = samples.samples.size();
  TaskWriter writer(request, budget);
  const auto tuples = [&](std::initializer_list<std::vector<double> Sample::*> members) {
    write_each(writer, nullptr, count, [&](std::size_t k) {
      writer.begin('[');
      for (const auto member : members) writer.results(samples.samples[k].*member);
      writer.end(']');
    });
  };
  writer.begin('{');
  writer.open("samples", '{');
  writer.named_counts("surfaces", task.sample_surfaces);
  writer.named_parameters("us", task.sample_us);
  writer.named_parameters("vs", task.sample_vs);
  write_each(writer, "points", count, [&](std::size_t k) { writer.results(samples.samples[k].point); });
  if (task.derivatives > 0) {
    writer.open("derivatives", '[');
    tuples({&Sample::du, &Sample::dv});
    if (task.derivatives > 1) tuples({&Sample::duu, &Sample::duv, &Sample::dvv});
    writer.end(']');
  }
  if (task.frames && count > 0)
    write_each(writer, "normals", count, [&](std::size_t k) {
      const auto& normal = samples.samples[k].normal;
      normal != std::array<double, 3>{} ? writer.results(normal) : writer.null();
    });
  writer.end('}');
  return writer.finish();
}

Result<Payload> encode_measures(const CurveRequest& request, const std::vector<CurveMeasure>& measures,
                                const Budget& budget) {
  TaskWriter writer(request, budget);
  writer.begin('{');
  writer.open("measures", '[');
  std::size_t at = 0;
  for (const ControlCurves& curves : request.curves.curves)
    for (Count c = 0; c < curves.curve_count() && !writer.stopped(); ++c)
      write_measure(writer, measures[at++], curves.width);
  writer.end(']');
  return writer.finish();
}

namespace {

// Points alone: orders, knots and weights are doubles always.
Result<RefineAnswer<float>> in_single(RefineAnswer<double> answer, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) {
    RefineAnswer<float> single;
    for (RefinedCurves<double>& from : answer.curves) {
      RefinedCurves<float> to;
      to.name = std::move(from.name);
      to.level = from.level;
      to.width = from.width;
      to.vertex_counts = std::move(from.vertex_counts);
      to.wrap = from.wrap;
      to.basis = std::move(from.basis);
      to.points.reserve(from.points.size());
      for (const double value : from.points) {
        pace.spend(1);
        to.points.push_back(static_cast<float>(value));
      }
      single.curves.push_back(std::move(to));
    }
    return single;
  });
}

}  // namespace

Result<Payload> encode_edited(const CurveRequest& request, EditedCurves edited, const Budget& budget) {
  using Json = nlohmann::ordered_json;
  Json members = Json::object();
  if (request.task.kind == CurveTaskKind::remove_knot) members["removed"] = edited.removed;
  if (request.task.kind != CurveTaskKind::insert_knot) members["errorBounds"] = edited.error_bounds;
  if (!request.curves.warnings.empty()) members["warnings"] = request.curves.warnings;
  const std::string text = members.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (answer_precision(request.curves) == Precision::double_precision)
    return json::write(request.curves, AnyAnswer(std::move(edited.answer)), text, budget);
  auto single = in_single(std::move(edited.answer), budget);
  if (!single) return single.error();
  return json::write(request.curves, AnyAnswer(*std::move(single)), text, budget);
}

}  // namespace subdivd::proto
