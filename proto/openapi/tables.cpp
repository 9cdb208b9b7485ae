#include "proto/openapi/tables.h"

#include <span>
#include <string>
#include <string_view>

#include "core/analysis/spectrum.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"
#include "core/curves/subdivision.h"
#include "core/mesh/control_mesh.h"
#include "core/schemes/all.h"
#include "core/splines/spline.h"
#include "core/surfaces/patch.h"
#include "proto/curve_task.h"
#include "proto/json/words.h"
#include "proto/options.h"

namespace subdivd::proto::openapi {
namespace {

Json list(std::span<const std::string_view> words) {
  Json made = Json::array();
  for (const std::string_view word : words) made.push_back(word);
  return made;
}

void add_words(Json& named) {
  named["words.interpolation"] = list(json::interpolation_words());
  named["words.wrap"] = list(json::wrap_words());
  named["words.basis"] = list(json::basis_words());
  named["words.spacing"] = list(json::spacing_words());
  named["words.orientation"] = list(json::orientation_words());
  named["words.schemes"] = list(kSchemeNames);
  named["words.triangleRule"] = list(json::triangle_rule_words());
  for (const OptionSpec& spec : option_table())
    if (spec.kind == OptionKind::word) named["words." + std::string(spec.name)] = list(spec.words);
}

void add_limits(Json& named) {
  named["limits.index"] = kMaxIndexCount - 1;
  named["limits.elementSize"] = kMaxElementSize;
  named["limits.curveWidth"] = kMaxCurveWidth;
  named["limits.curveDegree"] = kMaxCurveDegree;
  named["limits.curveLevel"] = kMaxCurveLevel;
  named["limits.surfaceWidth"] = kMaxPatchWidth;
  named["limits.degree"] = kMaxDegree;
  named["limits.order"] = kMaxDegree + 1;
  named["limits.derivatives"] = kMostDerivatives;
  named["limits.equalLengths"] = kMostEqualLengths;
  named["limits.valence"] = kMaxSpectrumValence;
}

void add_options(Json& named) {
  named["options"] = Json::parse(options_schema());
  named["parameters"] = Json::parse(openapi_parameters());
  named["allOptions"] = Json::array();
  for (const std::string_view name : option_names())
    named["allOptions"].push_back({{"$ref", "#/components/parameters/" + std::string(name)}});
}

Json schema_of(const SchemeParameter& parameter) {
  if (parameter.type == "word")
    return {{"type", "string"}, {"enum", parameter.words}, {"default", parameter.words.front()}};
  if (parameter.type == "boolean") return {{"type", "boolean"}, {"default", parameter.standard != 0}};
  const auto number = [&](double value) {
    return parameter.type == "integer" ? Json(static_cast<Index>(value)) : Json(value);
  };
  return {{"type", parameter.type},
          {"minimum", number(parameter.least)},
          {"maximum", number(parameter.most)},
          {"default", number(parameter.standard)}};
}

void add_spectra(Json& named) {
  named["words.spectra"] = Json::array();
  for (const SchemeInfo& scheme : list_of_schemes()) {
    named["words.spectra"].push_back(scheme.name);
    for (const SchemeParameter& parameter : scheme.parameters)
      named["spectrum." + parameter.name] = schema_of(parameter);
  }
}

// Every ErrorCode up to the last of the list.
void add_codes(Json& named) {
  named["codes.errors"] = Json::array();
  for (int code = 0; code <= static_cast<int>(ErrorCode::internal); ++code)
    named["codes.errors"].push_back(name_of(static_cast<ErrorCode>(code)));
}

}  // namespace

Json tables() {
  Json named = Json::object();
  add_words(named);
  add_limits(named);
  add_options(named);
  add_spectra(named);
  add_codes(named);
  return named;
}

}  // namespace subdivd::proto::openapi
