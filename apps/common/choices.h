// Words that must be one of a list.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vex {

/// Throws UsageError, which lists the choices, unless the word is one of them.
void require_one_of(const std::string& word, const char* option, const std::vector<std::string_view>& choices);

}  // namespace vex
