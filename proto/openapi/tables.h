#pragma once
// What the OpenAPI document takes from the code: values under the names that "$use" knows.

#include "proto/openapi/compose.h"

namespace subdivd::proto::openapi {

//   words.NAME          the words of an enumeration, in its order; NAME is a member of the body or an option
//   words.schemes       names of the schemes of meshes; words.spectra: of all that have a spectrum
//   limits.NAME         the largest number that the reader takes
//   options             the schema of the body's `options`
//   parameters          the options as Parameter Objects by name; allOptions: references to all of them
//   spectrum.NAME       the schema of a scheme's query parameter
//   codes.errors        every ErrorCode
Json tables();

}  // namespace subdivd::proto::openapi
