#pragma once
// GET /v1/schemes and GET /v1/schemes/{name}/{valence}: the schemes there are, and what each does around a
// point in the end, as numbers.

#include <string>
#include <string_view>

#include "core/analysis/spectrum.h"
#include "core/base/result.h"
#include "proto/decode.h"

namespace subdivd::proto {

// {"schemes": [...]}: names, kinds and parameters.
std::string schemes_json();

// The scheme of the path and the query's parameters over their defaults. Parameters that the scheme does not
// have, or twice, are refused (unknown_field, duplicate_field at "?name"); so is what is no number. Curves
// have a valence of 2.
Result<SchemeChoice> decode_scheme(std::string_view name, std::string_view valence,
                                   const QueryParameters& query);

std::string spectrum_json(const Spectrum& spectrum);

}  // namespace subdivd::proto
