#include "proto/gltf/buffers.h"

#include <algorithm>

#include "proto/gltf/base64.h"
#include "proto/gltf/fields.h"

namespace subdivd::proto::gltf {
namespace {

// The reader library keeps offsets of sparse data in int; nothing larger can have been sent anyway.
constexpr Count kMaxBufferBytes = (Count{1} << 31) - 1;

bool equal_without_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

// data:[media type][;name=value ...][;base64],DATA   [RFC 2397; the scheme's case does not matter: RFC
// 3986, 3.1]
Result<std::vector<std::byte>> decode_data_uri(std::string_view uri, const Place& place, Work& work) {
  constexpr std::string_view kScheme = "data:", kMark = ";base64";
  if (!equal_without_case(uri.substr(0, kScheme.size()), kScheme))
    return error_at(place, ErrorCode::unsupported,
                    "buffers in other files are not read: embed the data (GLB, or a Base64 data URI)");
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos)
    return error_at(
        place, ErrorCode::malformed,
        "the data URI is not of the form data:application/octet-stream;base64,…: it has no comma");
  const std::string_view head = uri.substr(0, comma);
  if (head.size() < kMark.size() || !equal_without_case(head.substr(head.size() - kMark.size()), kMark))
    return error_at(place, ErrorCode::malformed,
                    "the data URI is not marked as Base64 (;base64 before the comma): percent-encoded bytes "
                    "are not read");
  auto bytes = decode_base64(uri.substr(comma + 1), work);
  if (!bytes) return std::move(bytes).error();
  if (!*bytes)
    return error_at(place, ErrorCode::malformed,
                    "the data URI is no strict Base64 (padding needed, white space not allowed)");
  return std::move(**bytes);
}

}  // namespace

Result<Buffers> load_buffers(Json& document, std::optional<Bytes> bin, bool keep_text, Work& work) {
  const Place root;
  auto array = optional_array(document, "buffers", root);
  if (!array) return array.error();
  Buffers buffers;
  if (*array == nullptr) return buffers;
  const Place all = root.at("buffers");
  Json::Array& list = *document.find("buffers")->array();
  if (auto kept = work.keep(list.size() * (sizeof(Bytes) + sizeof(std::vector<std::byte>)) + 2 * kBlockBytes);
      !kept)
    return kept.error();
  buffers.bytes.reserve(list.size());
  buffers.decoded.reserve(list.size());
  for (Count i = 0; i < list.size(); ++i) {
    if (auto stop = work.spend(16)) return *std::move(stop);
    Json& buffer = list[i];
    const Place place = all.at(i);
    if (auto is = expect_object(buffer, place); !is) return is.error();
    const auto length = required_integer(buffer, "byteLength", place, {1, kMaxBufferBytes});
    if (!length) return length.error();
    const auto uri = optional_string(buffer, "uri", place);
    if (!uri) return uri.error();
    Bytes bytes;
    if (*uri != nullptr) {
      auto decoded = decode_data_uri(**uri, place.at("uri"), work);
      if (!decoded) return decoded.error();
      buffers.decoded.push_back(*std::move(decoded));
      bytes = buffers.decoded.back();
      if (!keep_text || i == 0) {
        work.drop((*uri)->size());
        buffer.set("uri", Json());
      }
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
