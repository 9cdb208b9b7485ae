#include "proto/schemes.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <vector>

#include "proto/suggest.h"

namespace subdivd::proto {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json parameter_json(const SchemeParameter& parameter) {
  Json json = {{"name", parameter.name}};
  if (parameter.type == "word") {
    json["words"] = parameter.words;
    json["default"] = parameter.words.front();
    return json;
  }
  json["type"] = parameter.type;
  if (parameter.type == "boolean") {
    json["default"] = parameter.standard != 0;
    return json;
  }
  const bool whole = parameter.type == "integer";
  const auto number = [whole](double value) { return whole ? Json(static_cast<Index>(value)) : Json(value); };
  json["minimum"] = number(parameter.least);
  json["maximum"] = number(parameter.most);
  json["default"] = number(parameter.standard);
  return json;
}

// The whole text must be a number.
template <class Number>
bool read_number(std::string_view text, Number& out) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), out);
  return failure == std::errc{} && end == text.data() + text.size();
}

Error refusal(ErrorCode code, std::string message, std::string_view name) {
  return Error{code, std::move(message), {"?" + std::string(name)}};
}

Result<void> set(SchemeChoice& choice, const SchemeParameter& parameter, std::string_view text) {
  const std::string got = parameter.name + " is " + in_quotes(text);
  if (parameter.type == "word") {
    const auto word = std::ranges::find(parameter.words, text);
    const std::vector<std::string_view> words(parameter.words.begin(), parameter.words.end());
    if (word == parameter.words.end())
      return refusal(ErrorCode::bad_enum, got + "; it must be " + either_of(words), parameter.name);
    set_word(choice, parameter.name, static_cast<std::size_t>(word - parameter.words.begin()));
    return {};
  }
  if (parameter.type == "boolean") {
    if (text != "true" && text != "false")
      return refusal(ErrorCode::bad_enum, got + "; it must be true or false", parameter.name);
    choice.border = text == "true";
    return {};
  }
  const bool fine =
      parameter.name == "degree" ? read_number(text, choice.degree) : read_number(text, choice.tension);
  if (fine) return {};
  return refusal(ErrorCode::wrong_type, got + "; it must be a number", parameter.name);
}

}  // namespace

std::string schemes_json() {
  Json all = Json::array();
  for (const SchemeInfo& scheme : list_of_schemes()) {
    Json parameters = Json::array();
    for (const SchemeParameter& parameter : scheme.parameters)
      parameters.push_back(parameter_json(parameter));
    all.push_back({{"name", scheme.name}, {"kind", scheme.kind}, {"parameters", std::move(parameters)}});
  }
  return dumped({{"schemes", std::move(all)}});
}

Result<SchemeChoice> decode_scheme(std::string_view name, std::string_view valence,
                                   const QueryParameters& query) {
  const std::vector<SchemeInfo> schemes = list_of_schemes();
  const auto scheme = std::ranges::find(schemes, name, &SchemeInfo::name);
  if (scheme == schemes.end())
    return Error{ErrorCode::bad_enum, "there is no scheme " + in_quotes(name) + "; /v1/schemes lists them"};
  SchemeChoice choice;
  choice.name = scheme->name;
  if (!read_number(valence, choice.valence))
    return Error{ErrorCode::wrong_type,
                 "the valence is " + in_quotes(valence) + "; it must be a whole number"};
  if (scheme->kind == "curve" && choice.valence != 2)
    return Error{ErrorCode::out_of_range, "a point of a curve has valence 2"};
  std::set<std::string_view> seen;
  for (const auto& [key, text] : query) {
    const auto parameter = std::ranges::find(scheme->parameters, key, &SchemeParameter::name);
    if (parameter == scheme->parameters.end() || key == "valence")
      return refusal(ErrorCode::unknown_field,
                     "the scheme " + scheme->name + " has no parameter " + in_quotes(key), key);
    if (!seen.insert(key).second)
      return refusal(ErrorCode::duplicate_field,
                     "the parameter " + in_quotes(key) + " is given twice; give it once", key);
    if (auto done = set(choice, *parameter, text); !done) return std::move(done).error();
  }
  return choice;
}

std::string spectrum_json(const Spectrum& spectrum) {
  const std::size_t rows = spectrum.labels.size();
  Json matrix = Json::array();
  for (std::size_t i = 0; i < rows; ++i)
    matrix.push_back(
        std::vector<double>(spectrum.matrix.begin() + static_cast<std::ptrdiff_t>(i * rows),
                            spectrum.matrix.begin() + static_cast<std::ptrdiff_t>((i + 1) * rows)));
  return dumped({{"scheme", spectrum.scheme},
                 {"valence", spectrum.valence},
                 {"labels", spectrum.labels},
                 {"matrix", std::move(matrix)},
                 {"eigenvalues", spectrum.eigenvalues},
                 {"defect", spectrum.defect},
                 {"limitMask", spectrum.limit_mask},
                 {"tangentMasks", spectrum.tangent_masks},
                 {"subdominant", spectrum.subdominant},
                 {"subsubdominant", spectrum.subsubdominant},
                 {"curvatureRatio", spectrum.curvature_ratio},
                 {"stepsPerDigit", spectrum.steps_per_digit}});
}

}  // namespace subdivd::proto
