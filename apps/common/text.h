// Texts of others, such as file names, on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace vex {

/// Control characters written as \x1b, so that a text stays on its line and commands no terminal. UTF-8 passes.
std::string printable(std::string_view text);

}  // namespace vex
