#include "proto/json/words.h"

#include <array>
#include <variant>

#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

constexpr std::array<std::string_view, 5> kInterpolations = {"constant", "uniform", "varying", "vertex",
                                                             "faceVarying"};
static_assert(kInterpolations.size() == static_cast<std::size_t>(Interpolation::face_varying) + 1);

constexpr std::array<std::string_view, 3> kWraps = {"nonperiodic", "periodic", "pinned"};
static_assert(kWraps.size() == static_cast<std::size_t>(CurveWrap::pinned) + 1);

template <class... Kinds>
constexpr auto words_of(const std::variant<Kinds...>*) {
  return std::array<std::string_view, sizeof...(Kinds)>{Kinds::kWord...};
}
constexpr auto kKinds = words_of(static_cast<const CurveBasis*>(nullptr));
// Curves on knots have a type of their own, and come last.
static_assert(kKinds.back() == Nurbs::kWord);

constexpr std::array<std::string_view, 3> kSpacings = {"uniform", "centripetal", "chordal"};
static_assert(kSpacings.size() == static_cast<std::size_t>(Spacing::chordal) + 1);

constexpr std::array<std::string_view, 2> kTriangleRules = {"catmullClark", "smooth"};
static_assert(kTriangleRules.size() == static_cast<std::size_t>(TriangleRule::smooth) + 1);

constexpr std::array<std::string_view, 2> kOrientations = {"rightHanded", "leftHanded"};
static_assert(kOrientations.size() == static_cast<std::size_t>(Orientation::left_handed) + 1);

}  // namespace

std::span<const std::string_view> interpolation_words() { return kInterpolations; }
std::span<const std::string_view> wrap_words() { return kWraps; }
std::span<const std::string_view> basis_words() { return std::span(kKinds).first(kKinds.size() - 1); }
std::span<const std::string_view> spacing_words() { return kSpacings; }
std::span<const std::string_view> triangle_rule_words() { return kTriangleRules; }
std::span<const std::string_view> orientation_words() { return kOrientations; }

std::string_view word_of(Interpolation interpolation) {
  return interpolation_words()[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(BoundaryInterpolation interpolation) {
  return find_option("interpolateBoundary")->words[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(FaceVaryingInterpolation interpolation) {
  return find_option("faceVaryingLinearInterpolation")->words[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(Orientation orientation) {
  return orientation_words()[static_cast<std::size_t>(orientation)];
}

std::string_view word_of(TriangleRule rule) { return triangle_rule_words()[static_cast<std::size_t>(rule)]; }

std::string_view word_of(CurveWrap wrap) { return wrap_words()[static_cast<std::size_t>(wrap)]; }

}  // namespace subdivd::proto::json
