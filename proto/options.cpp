#include "proto/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/pace.h"
#include "core/lattice/split.h"
#include "core/refine/plan.h"
#include "core/schemes/all.h"
#include "proto/client_text.h"
#include "proto/suggest.h"

namespace subdivd::proto {
namespace {

// Words in the order of the enumerators they stand for: the index of a word is the enumerator's value.
constexpr std::array<std::string_view, 3> kBoundary = {"none", "edgeOnly", "edgeAndCorner"};
constexpr std::array<std::string_view, 6> kFaceVarying = {"none",         "cornersOnly", "cornersPlus1",
                                                          "cornersPlus2", "boundaries",  "all"};
constexpr std::array<std::string_view, 2> kCreaseMethod = {"uniform", "chaikin"};
constexpr std::array<std::string_view, 2> kFaces = {"triangles", "quads"};
constexpr std::array<std::string_view, 2> kPrecision = {"single", "double"};
constexpr std::array<std::string_view, 2> kWeld = {"exact", "none"};
constexpr std::array<std::string_view, 5> kFormat = {"json", "glb", "gltf", "obj", "off"};

static_assert(kBoundary.size() == static_cast<std::size_t>(BoundaryInterpolation::edge_and_corner) + 1);
static_assert(kFaceVarying.size() == static_cast<std::size_t>(FaceVaryingInterpolation::all) + 1);
static_assert(kCreaseMethod.size() == static_cast<std::size_t>(CreaseMethod::chaikin) + 1);
static_assert(kFaces.size() == static_cast<std::size_t>(Faces::quads) + 1);
static_assert(kPrecision.size() == static_cast<std::size_t>(Precision::double_precision) + 1);
static_assert(kWeld.size() == static_cast<std::size_t>(Weld::none) + 1);
static_assert(kFormat.size() == static_cast<std::size_t>(Format::off) + 1);

template <class T>
struct Plain {
  using type = T;
};
template <class T>
struct Plain<std::optional<T>> {
  using type = T;
};

template <auto member>
void set(Options& options, std::uint64_t value) {
  using Value = typename Plain<std::remove_reference_t<decltype(options.*member)>>::type;
  options.*member = static_cast<Value>(value);
}

template <auto member>
std::optional<std::uint64_t> get(const Options& options) {
  const auto& value = options.*member;
  if constexpr (requires { value.has_value(); }) {
    if (!value) return std::nullopt;
    return static_cast<std::uint64_t>(*value);
  } else {
    return static_cast<std::uint64_t>(value);
  }
}

template <auto member>
OptionSpec option(OptionKind kind, std::string_view name, std::span<const std::string_view> words,
                  std::string_view default_value, std::string_view applies_to, std::string_view help) {
  return {.name = name,
          .kind = kind,
          .words = words,
          .maximum = kind == OptionKind::integer ? kMaxLevel : 1,
          .default_value = default_value,
          .applies_to = applies_to,
          .help = help,
          .set = set<member>,
          .get = get<member>};
}

constexpr auto kBoolean = OptionKind::boolean;
constexpr auto kInteger = OptionKind::integer;
constexpr auto kWord = OptionKind::word;

// clang-format off
std::vector<OptionSpec> options_of_all() { return {
  option<&Options::level>(kInteger, "level", {}, "2", "meshes, curves, surfaces, glTF",
    "How often to refine. Every level makes four triangles or quads of one (of a face of another number of vertices as many quads) and doubles a curve's segments. The server may allow less than the maximum."),
  option<&Options::limit>(kBoolean, "limit", {}, "false", "meshes, curves, surfaces, glTF",
    "Move every refined point, and every vertex and faceVarying value, to where refining for ever would lead."),
  option<&Options::normals>(kBoolean, "normals", {}, "false", "meshes, curves, surfaces, glTF",
    "Add unit normals of the limit surface, one per refined point; curves get tangents instead."),
  option<&Options::verify>(kBoolean, "verify", {}, "false", "meshes, curves, glTF",
    "Attach the report of the comparison with OpenSubdiv."),
  option<&Options::triangulate>(kBoolean, "triangulate", {}, "false", "meshes",
    "Split faces of more than three vertices before anything else, which loop asks for: into fans from their first "
    "vertex, by clipping ears where a fan would fold a concave face over."),
}; }

std::vector<OptionSpec> options_of_kinds() { return {
  option<&Options::subdivision_scheme>(kWord, "subdivisionScheme", kSchemeNames, "", "meshes, glTF",
    "The scheme; set here it overrides every mesh of the body. Default: the mesh's own, and where it has none loop if all its faces are triangles, otherwise catmullClark."),
  option<&Options::interpolate_boundary>(kWord, "interpolateBoundary", kBoundary, "", "meshes, glTF",
    "What happens where the surface ends; set here it overrides every mesh of the body. Default: the mesh's own, edgeAndCorner where it has none."),
  option<&Options::face_varying_linear_interpolation>(kWord, "faceVaryingLinearInterpolation", kFaceVarying, "", "meshes, glTF",
    "Which parts of the borders of faceVarying primvars stay linear; set here it overrides every mesh of the body. Default: the mesh's own, cornersPlus1 where it has none."),
  option<&Options::crease_method>(kWord, "creaseMethod", kCreaseMethod, "uniform", "meshes",
    "How the sharpness of semi-sharp creases decays from level to level."),
  option<&Options::faces>(kWord, "faces", kFaces, "", "meshes, surfaces",
    "triangles: cut quads and larger faces into triangles from their first corner; quads: the faces that the scheme makes, which must not be triangles, and quads between the refined points of B-spline surfaces. Default: quads where there are any, triangles in glTF answers, which know nothing else."),
  option<&Options::ngons>(kBoolean, "ngons", {}, "false", "meshes, glTF",
    "glTF answers only: mark which triangles make a quad or a larger face, by the extension FB_ngon_encoding."),
  option<&Options::precision>(kWord, "precision", kPrecision, "", "meshes, curves, surfaces, glTF",
    "Floating-point type of the computation and of the numbers in answers that are text. Default: single for glTF answers, double for all others."),
  option<&Options::weld>(kWord, "weld", kWeld, "exact", "glTF",
    "exact: vertices of one glTF mesh with bit-identical positions are one point, so seams cannot crack; none: the indices alone decide."),
  option<&Options::format>(kWord, "format", kFormat, "", "meshes, curves, surfaces, glTF",
    "Format of the answer. Default: what the Accept header prefers, otherwise the kind of the body, and json for OBJ and OFF."),
}; }
// clang-format on

// Of scheme S, as a request sets them.
template <class S>
void add_scheme_options(std::vector<OptionSpec>& table) {
  for (const SchemeOption<S>& option : S::options())
    table.push_back(
        {.name = option.name,
         .kind = kWord,
         .words = option.words,
         .maximum = 1,
         .default_value = option.words[0],
         .applies_to = "meshes, glTF",
         .help = option.help,
         .set = [&option](Options& options,
                          std::uint64_t value) { option.set(std::get<S>(options.schemes), value); },
         .get = [&option](const Options& options) -> std::optional<std::uint64_t> {
           return option.get(std::get<S>(options.schemes));
         }});
}

const std::vector<OptionSpec>& table() {
  static const std::vector<OptionSpec> whole = [] {
    std::vector<OptionSpec> made = options_of_all();
    for_each_scheme(AllSchemes(), [&]<class S>(const S&) { add_scheme_options<S>(made); });
    for (OptionSpec& spec : options_of_kinds()) made.push_back(std::move(spec));
    return made;
  }();
  return whole;
}

const std::vector<std::string_view>& names() {
  static const std::vector<std::string_view> all = [] {
    std::vector<std::string_view> made;
    for (const OptionSpec& spec : table()) made.push_back(spec.name);
    return made;
  }();
  return all;
}

Error refusal(ErrorCode code, const OptionSpec& spec, std::string_view got, const Path& where) {
  std::string message =
      std::string(spec.name) + " is " + std::string(got) + "; it must be " + valid_values(spec);
  return {.code = code, .message = std::move(message), .where = where};
}

Result<void> set_number(Options& options, const OptionSpec& spec, double number, std::string_view got,
                        const Path& where) {
  if (number != std::floor(number)) return refusal(ErrorCode::wrong_type, spec, got, where);
  if (number < 0) return refusal(ErrorCode::out_of_range, spec, got, where);
  if (number > spec.maximum) {
    Error error = refusal(ErrorCode::too_large, spec, got, where);
    error.predicted = number < 1e18 ? static_cast<Count>(number) : std::numeric_limits<Count>::max();
    error.allowed = spec.maximum;
    return error;
  }
  spec.set(options, static_cast<std::uint64_t>(number));
  return {};
}

Result<void> set_word(Options& options, const OptionSpec& spec, std::string_view word, const Path& where) {
  const auto found = std::find(spec.words.begin(), spec.words.end(), word);
  if (found == spec.words.end())
    return Error{ErrorCode::bad_enum,
                 std::string(spec.name) + " is " + in_quotes(word) + hint(word, spec.words), where};
  spec.set(options, static_cast<std::uint64_t>(found - spec.words.begin()));
  return {};
}

Error unknown(std::string_view name, std::span<const std::string_view> taken, const Path& where) {
  return {ErrorCode::unknown_field, std::string("there is no option ") + in_quotes(name) + hint(name, taken),
          where};
}

Path parameter(std::string_view name) { return {"?" + client_text(name)}; }

// The query's parameter if the query sets the option, otherwise the body's member.
Path blame(std::string_view name, const QueryParameters& query) {
  for (const auto& [parameter_name, value] : query)
    if (parameter_name == name) return parameter(name);
  return {"options", std::string(name)};
}

// Whoever asks for quads and gets triangles was misunderstood. Not where surfaces make quads: the same word is theirs.
Result<void> check_faces(const RefineRequest& request, const QueryParameters& query, const Budget& budget) {
  if (request.options.faces != Faces::quads || !request.surfaces.empty()) return {};
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (std::size_t i = 0; i < request.meshes.size(); ++i) {
      const auto scheme = scheme_of(request.meshes[i], request.options.schemes, pace);
      if (!scheme || !splits_into_triangles(*scheme)) continue;
      const std::string_view name = std::visit([]<class S>(const S&) { return S::name; }, *scheme);
      return Error{ErrorCode::unsupported,
                   "faces is quads, and mesh " + std::to_string(i) + " is refined by " + std::string(name) +
                       ", which makes triangles: leave faces out or take another subdivisionScheme",
                   blame("faces", query)};
    }
    return {};
  });
}

nlohmann::ordered_json json_value(const OptionSpec& spec, std::uint64_t value) {
  switch (spec.kind) {
    case OptionKind::boolean:
      return value != 0;
    case OptionKind::integer:
      return value;
    case OptionKind::word:
      return std::string(spec.words[static_cast<std::size_t>(value)]);
  }
  return nullptr;
}

nlohmann::ordered_json value_schema(const OptionSpec& spec) {
  nlohmann::ordered_json schema;
  switch (spec.kind) {
    case OptionKind::boolean:
      schema["type"] = "boolean";
      schema["default"] = spec.default_value == "true";
      break;
    case OptionKind::integer:
      schema["type"] = "integer";
      schema["minimum"] = 0;
      schema["maximum"] = spec.maximum;
      schema["default"] = std::stoi(std::string(spec.default_value));
      break;
    case OptionKind::word:
      schema["type"] = "string";
      schema["enum"] = std::vector<std::string>(spec.words.begin(), spec.words.end());
      if (!spec.default_value.empty()) schema["default"] = spec.default_value;
      break;
  }
  return schema;
}

std::string description(const OptionSpec& spec) {
  return std::string(spec.help) + " Applies to " + std::string(spec.applies_to) + '.';
}

}  // namespace

std::span<const OptionSpec> option_table() { return table(); }
std::span<const std::string_view> option_names() { return names(); }

const OptionSpec* find_option(std::string_view name) {
  for (const OptionSpec& spec : table())
    if (spec.name == name) return &spec;
  return nullptr;
}

std::string valid_values(const OptionSpec& spec) {
  switch (spec.kind) {
    case OptionKind::boolean:
      return "true or false";
    case OptionKind::integer:
      return std::string("a whole number from 0 to ") + std::to_string(spec.maximum);
    case OptionKind::word:
      return std::string("one of ") + either_of(spec.words);
  }
  return {};
}

Result<void> check_option(std::string_view name, std::span<const std::string_view> taken, const Path& where) {
  if (find_option(name) == nullptr) return unknown(name, taken, where);
  if (std::ranges::find(taken, name) != taken.end()) return {};
  return Error{ErrorCode::unknown_field,
               "this request does not take the option " + in_quotes(name) + "; valid: " + either_of(taken),
               where};
}

Result<void> set_option(Options& options, std::string_view name, const OptionValue& value,
                        const Path& where) {
  const OptionSpec* spec = find_option(name);
  if (spec == nullptr) return unknown(name, names(), where);
  if (spec->kind == OptionKind::boolean && value.boolean) {
    spec->set(options, *value.boolean ? 1 : 0);
    return {};
  }
  if (spec->kind == OptionKind::integer && value.number) {
    const nlohmann::json number = *value.number;
    return set_number(options, *spec, *value.number, number.dump(), where);
  }
  if (spec->kind == OptionKind::word && value.text) return set_word(options, *spec, *value.text, where);
  const std::string_view got = value.boolean  ? "a boolean"
                               : value.number ? "a number"
                               : value.text   ? "a string"
                                              : value.other;
  return refusal(ErrorCode::wrong_type, *spec, got, where);
}

Result<void> set_parameter(Options& options, std::string_view name, std::string_view text) {
  const Path where = parameter(name);
  const OptionSpec* spec = find_option(name);
  if (spec == nullptr) return unknown(name, names(), where);
  switch (spec->kind) {
    case OptionKind::boolean:
      if (text != "true" && text != "false" && text != "1" && text != "0")
        return Error{ErrorCode::bad_enum,
                     std::string(name) + " is " + in_quotes(text) + "; it must be true, false, 1 or 0",
                     where};
      spec->set(options, text == "true" || text == "1" ? 1 : 0);
      return {};
    case OptionKind::integer: {
      double number = 0;
      const auto [end, failure] =
          std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
      // Digits and a sign only: from_chars would also take "inf" and "1.".
      const bool plain = !text.empty() && text.find_first_not_of("-0123456789") == std::string_view::npos;
      if (!plain || failure == std::errc::invalid_argument || end != text.data() + text.size())
        return refusal(ErrorCode::wrong_type, *spec, in_quotes(text), where);
      if (failure == std::errc::result_out_of_range) number = text[0] == '-' ? -1.0 : 1e300;
      return set_number(options, *spec, number, in_quotes(text), where);
    }
    case OptionKind::word:
      return set_word(options, *spec, text, where);
  }
  return {};
}

Result<void> set_parameters(Options& options, const QueryParameters& query,
                            std::span<const std::string_view> taken) {
  std::set<std::string_view> seen;
  for (const auto& [name, text] : query) {
    if (Result<void> known = check_option(name, taken, parameter(name)); !known) return known;
    if (Result<void> done = set_parameter(options, name, text); !done) return done;
    if (!seen.insert(name).second)
      return Error{ErrorCode::duplicate_field,
                   std::string("the parameter ") + in_quotes(name) + " is given twice; give it once",
                   parameter(name)};
  }
  return {};
}

Result<void> check_options(const RefineRequest& request, const Limits& limits, const QueryParameters& query,
                           const Budget& budget) {
  const Options& options = request.options;
  if (options.level > limits.max_level)
    return Error{.code = ErrorCode::too_large,
                 .message = std::string("level is ") + std::to_string(options.level) +
                            "; this server allows at most " + std::to_string(limits.max_level),
                 .where = blame("level", query),
                 .predicted = options.level,
                 .allowed = limits.max_level};
  if (options.ngons && !is_gltf(answer_format(request)))
    return Error{
        ErrorCode::unsupported,
        "ngons marks larger faces in glTF answers, which hold nothing but triangles; this answer has them as "
        "they are: leave it out or take format glb or gltf",
        blame("ngons", query)};
  if (auto fine = check_faces(request, query, budget); !fine) return fine;
  if (!options.verify) return {};
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (const ControlMesh& mesh : request.meshes) {
      const auto scheme = scheme_of(mesh, options.schemes, pace);
      const std::string_view reason = scheme ? beyond_opensubdiv(*scheme) : std::string_view();
      if (!reason.empty())
        return Error{ErrorCode::unsupported, "verify compares with OpenSubdiv, which " + std::string(reason),
                     blame("verify", query)};
    }
    return {};
  });
}

std::string effective_options(const RefineRequest& request) {
  Options options = request.options;
  options.precision = answer_precision(request);
  options.format = answer_format(request);
  if (options.faces || !request.surfaces.empty()) options.faces = answer_faces(request);
  nlohmann::ordered_json echo = nlohmann::ordered_json::object();
  for (const OptionSpec& spec : table())
    if (const auto value = spec.get(options)) echo[std::string(spec.name)] = json_value(spec, *value);
  return echo.dump();
}

std::string openapi_parameters() {
  nlohmann::ordered_json parameters;
  for (const OptionSpec& spec : table())
    parameters[std::string(spec.name)] = {{"name", spec.name},
                                          {"in", "query"},
                                          {"description", description(spec)},
                                          {"schema", value_schema(spec)}};
  return parameters.dump(2);
}

std::string options_schema() {
  nlohmann::ordered_json properties;
  for (const OptionSpec& spec : table()) {
    nlohmann::ordered_json schema = value_schema(spec);
    schema["description"] = description(spec);
    properties[std::string(spec.name)] = schema;
  }
  return nlohmann::ordered_json{
      {"type", "object"}, {"additionalProperties", false}, {"properties", properties}}
      .dump(2);
}

}  // namespace subdivd::proto
