#include "core/schemes/tags.h"

#include <algorithm>
#include <span>
#include <string>

#include "core/mesh/sharpness.h"

namespace subdivd {

Result<void> refuse_semi_sharp(std::string_view scheme, const Cage& cage) {
  const struct {
    std::string_view field;
    std::span<const float> values;
  } tags[] = {{"creaseSharpnesses", cage.crease_sharpnesses}, {"cornerSharpnesses", cage.corner_sharpnesses}};
  for (const auto& [field, values] : tags) {
    const auto at = std::ranges::find_if(values, is_semi_sharp);
    if (at == values.end()) continue;
    return Error{.code = ErrorCode::unsupported,
                 .message = "semi-sharpness means nothing to the scheme " + std::string(scheme) +
                            ": a sharpness is 0 or infinite (10 or more)",
                 .where = {std::string(field), static_cast<std::uint64_t>(at - values.begin())}};
  }
  return {};
}

}  // namespace subdivd
