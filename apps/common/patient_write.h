// Writing to whoever takes it: a pipe or a terminal may keep a program waiting, but not from its end.
#pragma once

#include <filesystem>
#include <string_view>

namespace vex {

/// Writes all of `text` to an open descriptor. Gives up where an interrupt arrives meanwhile (interrupt.h), at the end
/// of a line where lines are shorter than 4 KiB: false then. Throws std::system_error where writing fails.
bool write_until_interrupted(int descriptor, std::string_view text);

/// The same where `path` leads: into a device, a pipe, or a file that has lost its name. Also a pipe's reader is waited
/// for until an interrupt, or not at all where one has arrived before.
bool write_in_place(const std::filesystem::path& path, std::string_view text);

}  // namespace vex
