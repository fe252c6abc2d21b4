// What somebody who mistyped a word may have meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vex {

/// The one of `words` that the fewest edits (Levenshtein; capitals count as small letters) make of `typed`, if they are
/// few for its length; else empty. The first of several.
std::string closest_word(std::string_view typed, std::span<const std::string> words);

}  // namespace vex
