#pragma once
// What a caller wrote, as we may repeat it. Every name, word and key of a caller that goes into a message, a
// warning, a pointer or a parameter of a problem document goes through client_text(), so that a megabyte of
// it never comes back. Answers that carry names (of meshes, curves and primvars) have them whole.

#include <cstddef>
#include <string>
#include <string_view>

namespace subdivd::proto {

// The longest text, in bytes, that is repeated whole; a longer one is cut to this, the mark included.
inline constexpr std::size_t kLongestClientText = 96;

// `text` itself, or its beginning up to a boundary of UTF-8 with "…" behind it. What has been cut once is not
// cut again. Control characters and bytes that are not UTF-8 are escaped by whoever writes JSON.
std::string client_text(std::string_view text);

}  // namespace subdivd::proto
