#pragma once
// THE list of schemes, and the only dispatch by name. A scheme is one file and one word here: look-up by
// name, its options on the wire, its spectrum, the engine that runs it and the property tests follow from the
// list.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "core/schemes/bilinear.h"
#include "core/schemes/butterfly.h"
#include "core/schemes/catmull_clark.h"
#include "core/schemes/kobbelt.h"
#include "core/schemes/loop.h"
#include "core/schemes/tags.h"

// What stands once for every scheme (explicit instantiations) is made by these: of those that the engines on grids run,
// of those that `plain` runs and that leave vertices where they are, and of all.
#define SUBDIVD_FOR_EACH_GRID_SCHEME(X) X(Loop) X(CatmullClark) X(Bilinear)
#define SUBDIVD_FOR_EACH_INTERPOLATING_SCHEME(X) X(Butterfly) X(Kobbelt)
#define SUBDIVD_FOR_EACH_SCHEME(X) SUBDIVD_FOR_EACH_GRID_SCHEME(X) SUBDIVD_FOR_EACH_INTERPOLATING_SCHEME(X)

namespace subdivd {

// What a scheme lacks is said here, in a sentence, not by the depths of what would have used it.
#define SUBDIVD_REQUIRE(S) template struct RequireScheme<S>;
SUBDIVD_FOR_EACH_SCHEME(SUBDIVD_REQUIRE)
#undef SUBDIVD_REQUIRE
#define SUBDIVD_REQUIRE(S) template struct RequireGridScheme<S>;
SUBDIVD_FOR_EACH_GRID_SCHEME(SUBDIVD_REQUIRE)
#undef SUBDIVD_REQUIRE
#define SUBDIVD_REQUIRE(S) template struct RequireInterpolatingScheme<S>;
SUBDIVD_FOR_EACH_INTERPOLATING_SCHEME(SUBDIVD_REQUIRE)
#undef SUBDIVD_REQUIRE

namespace detail {
template <class First, class... Rest>
struct Schemes {
  using Tuple = std::tuple<Rest...>;
  using Variant = std::variant<Rest...>;
};
#define SUBDIVD_AND_SCHEME(S) , S
using Listed = Schemes<void SUBDIVD_FOR_EACH_SCHEME(SUBDIVD_AND_SCHEME)>;
using OnGrids = Schemes<void SUBDIVD_FOR_EACH_GRID_SCHEME(SUBDIVD_AND_SCHEME)>;
using Interpolating = Schemes<void SUBDIVD_FOR_EACH_INTERPOLATING_SCHEME(SUBDIVD_AND_SCHEME)>;
#undef SUBDIVD_AND_SCHEME
}  // namespace detail

// One of each: what a request sets of every scheme's options, whichever of them its meshes name.
using AllSchemes = detail::Listed::Tuple;
// One scheme of the list, with its options; one of those that a family of engines runs.
using AnyScheme = detail::Listed::Variant;
using AnyGridScheme = detail::OnGrids::Variant;
using AnyInterpolatingScheme = detail::Interpolating::Variant;
// One of each of those that the engines on grids run.
using AllGridSchemes = detail::OnGrids::Tuple;

inline constexpr std::size_t kSchemeCount = std::tuple_size_v<AllSchemes>;

// Calls f(scheme) for every scheme of `schemes`, in the order of the list.
template <class Schemes, class F>
constexpr void for_each_scheme(Schemes&& schemes, F&& f) {
  std::apply([&](auto&... scheme) { (f(scheme), ...); }, schemes);
}

inline constexpr auto kSchemeNames = [] {
  std::array<std::string_view, kSchemeCount> names;
  std::size_t k = 0;
  for_each_scheme(AllSchemes(), [&]<class S>(const S&) { names[k++] = S::name; });
  return names;
}();

static_assert(
    [] {
      for (std::size_t k = 0; k < kSchemeCount; ++k)
        for (std::size_t j = 0; j < k; ++j)
          if (kSchemeNames[j] == kSchemeNames[k]) return false;
      return true;
    }(),
    "every scheme of the list needs a name of its own");

namespace detail {
// The first scheme of the list for which is_it<S>() holds.
template <class Test>
std::optional<AnyScheme> find_first(const AllSchemes& schemes, Test&& is_it) {
  AnyScheme found;
  bool any = false;
  for_each_scheme(schemes, [&]<class S>(const S& scheme) {
    if (any || !is_it.template operator()<S>()) return;
    found = scheme;
    any = true;
  });
  if (!any) return std::nullopt;
  return found;
}
}  // namespace detail

// The scheme of that name with the options that it has in `schemes`; nothing when there is none.
inline std::optional<AnyScheme> find_scheme(std::string_view name, const AllSchemes& schemes = {}) {
  return detail::find_first(schemes, [&]<class S>() { return S::name == name; });
}

// The same scheme as one of a family's; nothing when it is none of these.
template <class Family>
std::optional<Family> as_one_of(const AnyScheme& scheme) {
  return std::visit(
      []<class S>(const S& one) -> std::optional<Family> {
        if constexpr (std::is_constructible_v<Family, S>)
          return Family(one);
        else
          return std::nullopt;
      },
      scheme);
}

inline std::string_view name_of(const AnyScheme& scheme) {
  return std::visit([]<class S>(const S&) -> std::string_view { return S::name; }, scheme);
}

// The sizes of faces that a scheme takes.
inline FaceSizes face_sizes_of(const AnyScheme& scheme) {
  return std::visit([]<class S>(const S&) { return S::face_sizes; }, scheme);
}

inline bool splits_into_triangles(const AnyScheme& scheme) {
  return std::visit([]<class S>(const S&) { return S::split == Split::triangles; }, scheme);
}

// The scheme that a mesh names; when it names none the first of the list that takes faces of its sizes.
inline std::optional<AnyScheme> scheme_of_mesh(std::string_view name, FaceSizes sizes,
                                               const AllSchemes& schemes = {}) {
  if (!name.empty()) return find_scheme(name, schemes);
  return detail::find_first(schemes, [&]<class S>() {
    return S::face_sizes.least <= sizes.least && sizes.most <= S::face_sizes.most;
  });
}

// Whether the surface of a face needs the faces around it. Schemes that say nothing of it do.
inline bool needs_neighbors(const AnyScheme& scheme) {
  return std::visit(
      []<class S>(const S&) {
        if constexpr (requires { S::needs_neighbors; })
          return S::needs_neighbors;
        else
          return true;
      },
      scheme);
}

// Whether sharpness may run out with the levels (tags.h).
inline bool takes_semi_sharp(const AnyScheme& scheme) {
  return std::visit([]<class S>(const S&) { return takes_semi_sharp<S>(); }, scheme);
}

// Why OpenSubdiv cannot refine as this scheme does with its options: a clause that begins with a verb and
// ends with what would be right. Empty: it can.
inline std::string_view beyond_opensubdiv(const AnyScheme& scheme) {
  return std::visit([](const auto& one) { return one.beyond_opensubdiv(); }, scheme);
}

}  // namespace subdivd
