// OBJ bodies, told to be such and not.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/text_body.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  subdivd::test::try_text_body(body, subdivd::proto::BodyKind::obj);
  subdivd::test::try_text_body(body, subdivd::proto::BodyKind::unspecified);
  return 0;
}
