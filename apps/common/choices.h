// Words that must be one of a list.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace vex {

/// Throws UsageError unless the word is one of `built`; the message says whether it is planned or unknown. What follows
/// a colon in the word does not count for `planned`.
void require_one_of(const std::string& word, const char* option, std::initializer_list<std::string_view> built,
                    std::initializer_list<std::string_view> planned);

}  // namespace vex
