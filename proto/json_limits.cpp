#include "proto/json_limits.h"

#include <string>
#include <utility>

namespace subdivd::proto {

Error number_too_long(Path where, Count byte, Count size) {
  return {.code = ErrorCode::too_large,
          .message = "the number at byte " + std::to_string(byte) + " has " + std::to_string(size) +
                     " characters; " + std::to_string(kMaxNumberBytes) + " are allowed",
          .where = std::move(where),
          .predicted = size,
          .allowed = kMaxNumberBytes};
}

Error nested_too_deeply(Path where, Count allowed) {
  return {.code = ErrorCode::too_large,
          .message = "JSON is nested deeper than the " + std::to_string(allowed) + " levels allowed",
          .where = std::move(where),
          .predicted = allowed + 1,
          .allowed = allowed};
}

}  // namespace subdivd::proto
