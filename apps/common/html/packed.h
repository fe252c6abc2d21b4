// Text packed for a page.
#pragma once

#include <string>
#include <string_view>

namespace vex {

/// By gzip, then in base64; the same characters from the same text and version of zlib.
std::string packed_text(std::string_view text);

}  // namespace vex
