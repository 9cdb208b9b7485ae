#pragma once
// What a scheme takes of a control mesh's tags.

#include <string_view>

#include "core/base/result.h"
#include "core/mesh/cage.h"

namespace subdivd {

// Whether sharpness may run out with the levels. Schemes that say nothing of it take it.
template <class S>
constexpr bool takes_semi_sharp() {
  if constexpr (requires { S::takes_semi_sharp; })
    return S::takes_semi_sharp;
  else
    return true;
}

// unsupported, at the first crease or corner whose sharpness is neither 0 nor infinite: for schemes that do not take
// such. `scheme`: its name.
Result<void> refuse_semi_sharp(std::string_view scheme, const Cage& cage);

}  // namespace subdivd
