#include "proto/text/text.h"

namespace subdivd::proto::text {

Result<RefineRequest> read_obj(std::string_view, const Budget&) {
  return Error{ErrorCode::unsupported, "OBJ is not read yet"};
}

}  // namespace subdivd::proto::text
