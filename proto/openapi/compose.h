#pragma once
// The text of the OpenAPI document is written once for everything that is said several times, and names what
// the code's tables know; compose() puts both in their places.

#include <nlohmann/json.hpp>

namespace subdivd::proto::openapi {

using Json = nlohmann::ordered_json;

// `text` with every "$use" replaced by the member of `shared` that it names, which may use others in turn:
//
//   {"$use": "a"} alone                the value of a, of whatever kind
//   {"$use": "a"} in an array          the elements of a, when a is an array
//   {"$use": ["a", "b"], "own": 1}     the members of a, then those of b, then its own; the last one counts
//
// Throws std::runtime_error, which says where: a name that is not there, members taken from what is no object,
// or names that use each other for ever.
Json compose(const Json& text, const Json& shared);

}  // namespace subdivd::proto::openapi
