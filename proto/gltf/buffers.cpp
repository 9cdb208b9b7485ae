#include "proto/gltf/buffers.h"

#include "proto/gltf/base64.h"
#include "proto/gltf/fields.h"

namespace subdivd::proto::gltf {
namespace {

// The reader library keeps offsets of sparse data in int; nothing larger can have been sent anyway.
constexpr Count kMaxBufferBytes = (Count{1} << 31) - 1;

Result<std::vector<std::byte>> decode_data_uri(const std::string& uri, const Place& place) {
  if (!uri.starts_with("data:"))
    return error_at(place, ErrorCode::unsupported,
                    "buffers in other files are not read: embed the data (GLB, or a Base64 data URI)");
  const std::size_t comma = uri.find(',');
  constexpr std::string_view kMark = ";base64";
  if (comma == std::string::npos || comma < kMark.size() ||
      std::string_view(uri).substr(comma - kMark.size(), kMark.size()) != kMark)
    return error_at(place, ErrorCode::malformed,
                    "the data URI is not of the form data:application/octet-stream;base64,…");
  auto bytes = decode_base64(std::string_view(uri).substr(comma + 1));
  if (!bytes)
    return error_at(place, ErrorCode::malformed,
                    "the data URI is no strict Base64 (padding needed, white space not allowed)");
  return std::move(*bytes);
}

}  // namespace

Result<Buffers> load_buffers(const Json& document, std::optional<Bytes> bin) {
  const Place root;
  auto array = optional_array(document, "buffers", root);
  if (!array) return array.error();
  Buffers buffers;
  if (*array == nullptr) return buffers;
  const Place all = root.at("buffers");
  for (Count i = 0; i < (*array)->array()->size(); ++i) {
    const Json& buffer = (*(*array)->array())[i];
    const Place place = all.at(i);
    if (auto is = expect_object(buffer, place); !is) return is.error();
    const auto length = required_integer(buffer, "byteLength", place, {1, kMaxBufferBytes});
    if (!length) return length.error();
    const auto uri = optional_string(buffer, "uri", place);
    if (!uri) return uri.error();
    Bytes bytes;
    if (*uri != nullptr) {
      auto decoded = decode_data_uri(**uri, place.at("uri"));
      if (!decoded) return decoded.error();
      buffers.decoded.push_back(*std::move(decoded));
      bytes = buffers.decoded.back();
    } else if (i == 0 && bin) {
      bytes = *bin;
    } else {
      return error_at(place, ErrorCode::missing_field,
                      "the buffer has no \"uri\", and no BIN chunk holds its data");
    }
    if (*length > bytes.size())
      return error_at(place.at("byteLength"), ErrorCode::out_of_range,
                      "\"byteLength\" is " + std::to_string(*length) + " but there are only " +
                          std::to_string(bytes.size()) + " bytes");
    buffers.bytes.push_back(bytes.first(*length));
  }
  return buffers;
}

}  // namespace subdivd::proto::gltf
