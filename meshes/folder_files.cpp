#include "meshes/folder_files.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace vex {
namespace {

constexpr int kForReading = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;

OpenFile open_folder(int at, const char* name, int further_flags) {
  return OpenFile(::openat(at, name, O_PATH | O_DIRECTORY | O_CLOEXEC | further_flags));
}

/// Without a link on the way, a name without ".." is where it says.
OpenFile open_step_by_step(OpenFile folder, const std::filesystem::path& name) {
  for (auto part = name.begin(); part != name.end(); ++part) {
    if (*part == "..") break;
    if (std::next(part) == name.end()) {
      return OpenFile(::openat(folder.number(), part->c_str(), kForReading | O_NOFOLLOW));
    }
    if (*part != ".") folder = open_folder(folder.number(), part->c_str(), O_NOFOLLOW);
  }
  return OpenFile(-1);
}

}  // namespace

OpenFile open_beneath(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path relative(name);
  if (name.empty() || name.find('\0') != std::string::npos || relative.is_absolute()) return OpenFile(-1);
  OpenFile start = open_folder(AT_FDCWD, folder.empty() ? "." : folder.c_str(), 0);
  if (start.number() < 0) return start;
  struct open_how how {};
  how.flags = kForReading;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const long opened = ::syscall(SYS_openat2, start.number(), name.c_str(), &how, sizeof how);
  if (opened < 0 && (errno == ENOSYS || errno == EPERM)) {  // an old kernel, or a container that knows no such call
    return open_step_by_step(std::move(start), relative);
  }
  return OpenFile(static_cast<int>(opened));
}

}  // namespace vex
