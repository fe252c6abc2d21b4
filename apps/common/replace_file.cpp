#include "apps/common/replace_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "apps/common/descriptor.h"
#include "apps/common/interrupt.h"
#include "apps/common/text.h"

namespace vex {
namespace fs = std::filesystem;
namespace {

// A descriptor, or what the system says of it.
int opened(int number) {
  if (number < 0) fail_with(errno);
  return number;
}

// A signal that ended the program now would leave the other file behind; so would a limit on the size of files, whose
// signal is ignored, so that writing fails instead.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t held;
    sigfillset(&held);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigdelset(&held, fault);
    pthread_sigmask(SIG_BLOCK, &held, &mask_);
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGXFSZ, &ignore, &at_limit_);
  }
  ~SignalsHeldBack() {
    sigaction(SIGXFSZ, &at_limit_, nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

 private:
  EndHeldBack end_held_back_;
  sigset_t mask_ = {};
  struct sigaction at_limit_ = {};
};

// Hidden, named after the file that it will be, and with an end that nobody can foresee.
std::string unforeseeable_name(int folder, const std::string& name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  constexpr std::size_t kUsual = 255,
                        kAround = 12;  // bytes of a name: the system's most, and what stands around it here
  std::random_device random;
  std::uniform_int_distribution<std::size_t> letter(0, kLetters.size() - 1);
  std::string end;
  for (int k = 0; k < 10; ++k) end += kLetters[letter(random)];
  const long most = fpathconf(folder, _PC_NAME_MAX);
  const std::size_t longest = most > 0 ? static_cast<std::size_t>(most) : kUsual;
  return "." + std::string(first_bytes(name, longest - std::min(longest, kAround))) + "." + end;
}

// A new file in the folder, gone again unless it was put in place.
class NewFile {
 public:
  /// `old`: what is there already; null where nothing is.
  NewFile(int folder, const std::string& name, const struct stat* old)
      : folder_(folder),
        name_(unforeseeable_name(folder, name)),
        file_(opened(make(old != nullptr ? S_IRUSR | S_IWUSR : kForAll))) {
    if (old != nullptr) keep_owner_and_permissions(*old);
  }
  ~NewFile() {
    if (!is_in_place_) unlinkat(folder_, name_.c_str(), 0);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t n = ::write(file_.number(), text.data(), text.size());
      if (n < 0 && errno != EINTR) fail_with(errno);
      if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
    }
    // Before the new name: a machine that loses its power must not find the name of a file whose bytes never came.
    if (fsync(file_.number()) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail_with(errno);
    file_.close();
  }

  void put_in_place(const std::string& name) {
    if (renameat(folder_, name_.c_str(), folder_, name.c_str()) != 0) fail_with(errno);
    is_in_place_ = true;
  }

 private:
  static constexpr mode_t kForAll = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;  // less the mask

  int make(mode_t mode) const {
    return openat(folder_, name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
  }

  void keep_owner_and_permissions(const struct stat& old) const {
    mode_t mode = old.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
    const bool keeps_group = fchown(file_.number(), old.st_uid, old.st_gid) == 0 ||
                             fchown(file_.number(), static_cast<uid_t>(-1), old.st_gid) == 0;
    // Another group than before may do no more than everybody.
    if (!keeps_group) mode &= ~static_cast<mode_t>(S_IRWXG) | ((mode & S_IRWXO) << 3);
    // Where permissions cannot be set they stay the user's alone.
    static_cast<void>(fchmod(file_.number(), mode));
  }

  int folder_;
  std::string name_;
  Descriptor file_;
  bool is_in_place_ = false;
};

}  // namespace

void replace_file(const fs::path& target, std::string_view text) {
  const fs::path folder_path = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string name = target.filename().string();
  const SignalsHeldBack held;
  const Descriptor folder(opened(open(folder_path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)));
  struct stat old = {};
  const bool exists = fstatat(folder.number(), name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(old.st_mode);
  NewFile file(folder.number(), name, exists ? &old : nullptr);
  file.write(text);
  file.put_in_place(name);
}

}  // namespace vex
