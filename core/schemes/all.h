#pragma once
// THE list of schemes, and the only dispatch by name.

#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "core/schemes/loop.h"

namespace subdivd {

using AllSchemes = std::tuple<Loop>;

// One scheme of the list, with its options.
template <class List>
struct VariantOf;
template <class... S>
struct VariantOf<std::tuple<S...>> {
  using type = std::variant<S...>;
};
using AnyScheme = VariantOf<AllSchemes>::type;

// Calls f(std::type_identity<S>{}) for the scheme of that name; false when there is none.
template <class F>
bool visit_scheme(std::string_view name, F&& f) {
  return [&]<class... S>(std::type_identity<std::tuple<S...>>) {
    return ((S::name == name ? (f(std::type_identity<S>{}), true) : false) || ...);
  }(std::type_identity<AllSchemes>{});
}

}  // namespace subdivd
