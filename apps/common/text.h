// Text for a terminal: that of others, such as file names, and tables.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vex {

/// Control characters written as \x1b, so that a text stays on its line and commands no terminal. UTF-8 passes; a byte
/// that is none of it becomes U+FFFD, so that the result is always UTF-8.
std::string printable(std::string_view text);

/// At most so many bytes, and no character of UTF-8 cut in two.
std::string_view first_bytes(std::string_view text, std::size_t n_most);

/// Columns as wide as their widest word, with so many blanks between them, the first one flush left and the others
/// right.
std::string table_text(const std::vector<std::vector<std::string>>& lines, std::size_t gap = 3);

/// "1 pose", "2 poses".
std::string plural(std::uint64_t n, const std::string& one, const std::string& many);

}  // namespace vex
