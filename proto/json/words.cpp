#include "proto/json/words.h"

#include <array>

#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

constexpr std::array<std::string_view, 5> kInterpolations = {"constant", "uniform", "varying", "vertex",
                                                             "faceVarying"};
static_assert(kInterpolations.size() == static_cast<std::size_t>(Interpolation::face_varying) + 1);

constexpr std::array<std::string_view, 3> kWraps = {"nonperiodic", "periodic", "pinned"};
static_assert(kWraps.size() == static_cast<std::size_t>(CurveWrap::pinned) + 1);

constexpr std::array<std::string_view, 7> kBases = {"bspline",    "fourPoint", "cornerCutting", "bezier",
                                                    "catmullRom", "hermite",   "nurbs"};
static_assert(kBases.size() == static_cast<std::size_t>(CurveBasis::nurbs) + 1);

constexpr std::array<std::string_view, 3> kSpacings = {"uniform", "centripetal", "chordal"};
static_assert(kSpacings.size() == static_cast<std::size_t>(Spacing::chordal) + 1);

}  // namespace

std::span<const std::string_view> interpolation_words() { return kInterpolations; }
std::span<const std::string_view> wrap_words() { return kWraps; }
std::span<const std::string_view> basis_words() { return std::span(kBases).first(kBases.size() - 1); }
std::span<const std::string_view> spacing_words() { return kSpacings; }

std::string_view word_of(Interpolation interpolation) {
  return interpolation_words()[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(BoundaryInterpolation interpolation) {
  return find_option("interpolateBoundary")->words[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(FaceVaryingInterpolation interpolation) {
  return find_option("faceVaryingLinearInterpolation")->words[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(CurveWrap wrap) { return wrap_words()[static_cast<std::size_t>(wrap)]; }
std::string_view word_of(CurveBasis basis) { return kBases[static_cast<std::size_t>(basis)]; }

}  // namespace subdivd::proto::json
