#pragma once
// Wording for refusals that have to name what would have been right.

#include <span>
#include <string>
#include <string_view>

namespace subdivd::proto {

// "\"word\"" as a message may repeat it (client_text.h).
std::string in_quotes(std::string_view word);

// "a, b or c"; empty for an empty list.
std::string either_of(std::span<const std::string_view> words);

// The member of `valid` that `word` was probably meant to be (at most two slips, capitals apart), or empty.
std::string_view nearest(std::string_view word, std::span<const std::string_view> valid);

// "; did you mean \"level\"? Valid: a, b or c" (the question only when there is a near word).
std::string hint(std::string_view word, std::span<const std::string_view> valid);

}  // namespace subdivd::proto
