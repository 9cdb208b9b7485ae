#pragma once
// THE table of options; those that a scheme has come from the list of schemes. Query parameters, the body's
// `options`, the echo of effective options, the messages that list valid values and the parameters of the
// OpenAPI document all come from it.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "proto/decode.h"
#include "proto/wire.h"

namespace subdivd::proto {

enum class OptionKind { boolean, integer, word };

struct OptionSpec {
  std::string_view name;
  OptionKind kind = OptionKind::boolean;
  std::span<const std::string_view> words;  // of kind word: the valid ones, in the order of the enumeration
  Index maximum = 0;                        // of kind integer: 0..maximum; Limits may allow less
  std::string_view default_value;           // as written; empty: depends on the request, `help` says how
  std::string_view applies_to;              // "meshes", "curves", "glTF", joined by ", "
  std::string_view help;

  // Values travel as numbers between here and Options: 0/1, the integer, the index of the word.
  std::function<void(Options& options, std::uint64_t value)> set;
  std::function<std::optional<std::uint64_t>(const Options& options)> get;  // empty: not set
};

std::span<const OptionSpec> option_table();
std::span<const std::string_view> option_names();
const OptionSpec* find_option(std::string_view name);  // null: no such option

// "one of a, b or c", "true or false", "a whole number from 0 to 15".
std::string valid_values(const OptionSpec& spec);

// An option's value as it stands in the body: exactly one of these is set.
struct OptionValue {
  std::optional<bool> boolean;
  std::optional<double> number;
  std::optional<std::string_view> text;
  std::string_view other;  // what no option can be: "null", "an array", "an object"
};

// Whether there is such an option, and whether it is among those that are taken here; the refusal lists them.
// `where` goes into the error.
Result<void> check_option(std::string_view name, std::span<const std::string_view> taken, const Path& where);

// Sets one option; `where` goes into the error. `set_option` takes the body's typed values, `set_parameter`
// a query parameter's text (booleans: true, false, 1 or 0). Refusals list the valid names or values.
Result<void> set_option(Options& options, std::string_view name, const OptionValue& value, const Path& where);
Result<void> set_parameter(Options& options, std::string_view name, std::string_view text);

// All of a query over `options`. A repeated parameter is refused: which of the two was meant? `taken`: names
// of the options that are taken here.
Result<void> set_parameters(Options& options, const QueryParameters& query,
                            std::span<const std::string_view> taken = option_names());

// What single values cannot tell: the level against the server's limit, options that exclude each other with
// the schemes of the meshes.
// `query` tells whether the body or the query is to blame.
Result<void> check_options(const RefineRequest& request, const Limits& limits, const QueryParameters& query,
                           const Budget& budget);

// The options in effect for `request`, as a JSON object. What is not set and left to the meshes is left out;
// the text is a valid `options` member of a request.
std::string effective_options(const RefineRequest& request);

// The parameters of the OpenAPI document's components: an object of Parameter Objects by name.
// `options_schema` is the schema of the body's `options`.
std::string openapi_parameters();
std::string options_schema();

}  // namespace subdivd::proto
