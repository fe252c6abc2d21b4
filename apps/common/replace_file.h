// A file's content exchanged as a whole: whoever looks finds the old one or the new one, and nothing is left beside it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace vex {

/// Puts `text` into `target`, a regular file or one that does not exist yet, by way of a new file in the same folder
/// that takes its name. That file's own name cannot be foreseen, and it is made anew, so that no link that waits in a
/// shared folder leads it elsewhere. What processes that were killed in between left there goes (remove_leftovers). A
/// file that was there keeps its permissions, and its owner and group as far as this user may give files away; a new
/// one has those that the user's mask leaves.
///
/// Whatever signals wait until it is done (EndHeldBack, interrupt.h; those that this program does not handle, as
/// SIGQUIT, only where no other thread is there to take them). Throws std::system_error where the disk or the folder
/// refuses; then the target is as it was, and the other file is gone.
void replace_file(const std::filesystem::path& target, std::string_view text);

/// Which file it is, whatever its name.
struct FileNumber {
  dev_t device = 0;
  ino_t inode = 0;
  bool operator==(const FileNumber&) const = default;
};

/// The same, of a file that this process holds locked (locked_file.h): the new file is locked before it takes the name,
/// so that at no moment the name leads to one that is not. Returns its descriptor. Where neither nothing nor
/// `expected` has the name any more it fails with EBUSY.
int replace_locked_file(const std::filesystem::path& target, std::string_view text, const FileNumber& expected);

/// Removes what processes that were killed while they replaced this file left beside it. Nothing else: not the new file
/// of a process that lives, which is locked. Throws std::system_error where the folder is gone.
void remove_leftovers(const std::filesystem::path& target);

}  // namespace vex
