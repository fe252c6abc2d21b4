// A file's content exchanged as a whole: whoever looks finds the old one or the new one, and nothing is left beside it.
#pragma once

#include <filesystem>
#include <string_view>

namespace vex {

/// Puts `text` into `target`, a regular file or one that does not exist yet, by way of a new file in the same folder
/// that takes its name. That file's own name cannot be foreseen, and it is made anew, so that no link that waits in a
/// shared folder leads it elsewhere. A file that was there keeps its permissions, and its owner and group as far as
/// this user may give files away; a new one has those that the user's mask leaves.
///
/// Whatever signals wait until it is done (EndHeldBack, interrupt.h; those that this program does not handle, as
/// SIGQUIT, only where no other thread is there to take them). Throws std::system_error where the disk or the folder
/// refuses; then the target is as it was, and the other file is gone.
void replace_file(const std::filesystem::path& target, std::string_view text);

}  // namespace vex
