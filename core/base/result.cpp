#include "core/base/result.h"

namespace subdivd {

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::malformed:
      return "malformed";
    case ErrorCode::missing_field:
      return "missing_field";
    case ErrorCode::unknown_field:
      return "unknown_field";
    case ErrorCode::duplicate_field:
      return "duplicate_field";
    case ErrorCode::wrong_type:
      return "wrong_type";
    case ErrorCode::out_of_range:
      return "out_of_range";
    case ErrorCode::bad_enum:
      return "bad_enum";
    case ErrorCode::wrong_length:
      return "wrong_length";
    case ErrorCode::not_finite:
      return "not_finite";
    case ErrorCode::not_a_triangle:
      return "not_a_triangle";
    case ErrorCode::not_an_edge:
      return "not_an_edge";
    case ErrorCode::duplicate_tag:
      return "duplicate_tag";
    case ErrorCode::too_few_points:
      return "too_few_points";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::too_large:
      return "too_large";
    case ErrorCode::deadline_exceeded:
      return "deadline_exceeded";
    case ErrorCode::cancelled:
      return "cancelled";
    case ErrorCode::overloaded:
      return "overloaded";
    case ErrorCode::internal:
      return "internal";
  }
  return "internal";
}

}  // namespace subdivd
