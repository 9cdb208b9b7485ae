#include "core/schemes/doo_sabin.h"

#include <array>

namespace subdivd {

std::span<const SchemeOption<DooSabin>> DooSabin::options() {
  static constexpr std::array<std::string_view, 2> kWords = {"dooSabin", "midpoint"};
  static constexpr std::array kOptions = {SchemeOption<DooSabin>{
      .name = "dooSabinWeights",
      .short_name = "weights",
      .words = kWords,
      .help =
          "Weights within a face: Doo and Sabin's of 1978, or the mean of the centroid, the middles of both "
          "edges and the vertex. They agree at faces of four corners only.",
      .set = [](DooSabin& scheme, std::size_t word) { scheme.weights = static_cast<DooSabinWeights>(word); },
      .get = [](const DooSabin& scheme) { return static_cast<std::size_t>(scheme.weights); }}};
  return kOptions;
}

CornerMask DooSabin::corner_mask(Index) const {
  if (weights == DooSabinWeights::midpoint) return {.self = 1.0 / 2, .beside = 1.0 / 8, .mean = 1.0 / 4};
  return {.self = 1.0 / 4, .mean = 3.0 / 4, .wave = 1.0 / 2};
}

}  // namespace subdivd
