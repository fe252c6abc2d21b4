#include "apps/common/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "engine/numeric/errors.h"

namespace vex {

LockedFile::LockedFile(const OutputFile& file, const std::string& option) : path_(file.path()), target_(file.target()) {
  try {
    open_and_lock(option);
  } catch (const std::system_error& error) {
    throw UsageError("the file of " + option + " cannot be written (" + path_ + ": " + error.code().message() +
                     ") - name another one");
  }
}

void LockedFile::open_and_lock(const std::string& option) {
  while (true) {
    // For writing, which file systems of a network ask of who locks.
    constexpr int kHow = O_RDWR | O_NOFOLLOW | O_CLOEXEC;
    file_.take(open(target_.c_str(), kHow | O_CREAT | O_EXCL, 0666));
    was_made_ = file_.number() >= 0;
    if (!was_made_ && errno == EEXIST) file_.take(open(target_.c_str(), kHow));
    if (file_.number() < 0) {
      if (errno == ENOENT &&
          std::filesystem::is_directory(target_.parent_path().empty() ? "." : target_.parent_path())) {
        continue;  // it was removed in between
      }
      fail_with(errno);
    }
    int refused = 0;
    while ((refused = flock(file_.number(), LOCK_EX | LOCK_NB) == 0 ? 0 : errno) == EINTR) {
    }
    if (refused == EWOULDBLOCK) {
      throw UsageError("another run that lives saves itself in this file (" + path_ + " for " + option +
                       ") - wait for its end, or name another file");
    }
    has_lock_ = refused == 0;
    // The name leads to another file where the process that held this one replaced or removed it a moment ago.
    struct stat named = {};
    if (stat(target_.c_str(), &named) == 0 && FileNumber{named.st_dev, named.st_ino} == number()) {
      was_empty_ = named.st_size == 0;
      break;
    }
  }
  if (has_lock_) remove_leftovers(target_);
}

LockedFile::~LockedFile() {
  if (!was_made_ || was_written_) return;
  struct stat named = {};
  if (stat(target_.c_str(), &named) == 0 && FileNumber{named.st_dev, named.st_ino} == number()) {
    unlink(target_.c_str());
  }
}

FileNumber LockedFile::number() const {
  struct stat found = {};
  if (fstat(file_.number(), &found) != 0) fail_with(errno);
  return {found.st_dev, found.st_ino};
}

void LockedFile::replace(std::string_view text) {
  file_.take(replace_locked_file(target_, text, number()));
  was_written_ = true;
}

}  // namespace vex
