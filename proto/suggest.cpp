#include "proto/suggest.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "proto/client_text.h"

namespace subdivd::proto {
namespace {

constexpr std::size_t kLongestCompared = 48;  // no valid word is longer; keeps the table below small
constexpr std::size_t kMostSlips = 2;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Letters to insert, delete, replace or swap with their neighbour until `a` is `b` (Damerau, restricted).
std::size_t slips(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, kLongestCompared + 1>;
  Row before{}, last{}, now{};
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

}  // namespace

std::string in_quotes(std::string_view word) { return '"' + client_text(word) + '"'; }

std::string either_of(std::span<const std::string_view> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> valid) {
  if (word.size() > kLongestCompared) return {};
  std::string_view best;
  std::size_t fewest = kMostSlips + 1;
  for (const std::string_view candidate : valid) {
    if (candidate.size() > kLongestCompared) continue;
    const std::size_t count = slips(word, candidate);
    // A short word is "near" every other short word: at most half of the letters may differ.
    if (count < fewest && 2 * count <= candidate.size()) {
      fewest = count;
      best = candidate;
    }
  }
  return best;
}

std::string hint(std::string_view word, std::span<const std::string_view> valid) {
  std::string text = ";";
  if (const std::string_view near = nearest(word, valid); !near.empty())
    text.append(" did you mean ").append(in_quotes(near)).append("?");
  return text.append(" valid: ").append(either_of(valid));
}

}  // namespace subdivd::proto
