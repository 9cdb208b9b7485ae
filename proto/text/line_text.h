#pragma once
// What a caller wrote, as it may stand in a line of OBJ or OFF.

#include <string>
#include <string_view>

namespace subdivd::proto::text {

// No name begins a line of its own: '_' stands in the place of every control character (C0, DEL, C1), of what
// ends lines elsewhere (U+2028, U+2029), of bytes that are not UTF-8 and of a backslash at the end, which would join
// the next line. Blanks at both ends are left out, and what lies beyond kMaxWordBytes, which no reader takes.
std::string line_text(std::string_view text);

}  // namespace subdivd::proto::text
