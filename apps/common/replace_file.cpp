#include "apps/common/replace_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <memory>
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

// A signal that ended the program now would leave the other file behind. A limit on the size of files would end a
// program without a handler by its signal: there it is ignored, so that writing fails instead. A program's own handler
// passes over what a write of its own caused (interrupt.h), and must get what somebody else sends meanwhile.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t held;
    sigfillset(&held);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigdelset(&held, fault);
    pthread_sigmask(SIG_BLOCK, &held, &mask_);
    sigaction(SIGXFSZ, nullptr, &at_limit_);
    if (at_limit_.sa_handler != SIG_DFL) return;
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGXFSZ, &ignore, nullptr);
  }
  ~SignalsHeldBack() {
    if (at_limit_.sa_handler == SIG_DFL) sigaction(SIGXFSZ, &at_limit_, nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

 private:
  EndHeldBack end_held_back_;
  sigset_t mask_ = {};
  struct sigaction at_limit_ = {};
};

// A new file's own name: hidden, named after the file that it will be, and with an end that nobody can foresee.
constexpr std::string_view kEndLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
constexpr std::size_t kEndLength = 10;

std::string begin_of_new_name(int folder, const std::string& name) {
  constexpr std::size_t kUsual = 255, kAround = kEndLength + 2;  // bytes: the system's most, and what is no name here
  const long most = fpathconf(folder, _PC_NAME_MAX);
  const std::size_t longest = most > 0 ? static_cast<std::size_t>(most) : kUsual;
  return "." + std::string(first_bytes(name, longest - std::min(longest, kAround))) + ".";
}

std::string unforeseeable_name(int folder, const std::string& name) {
  std::random_device random;
  std::uniform_int_distribution<std::size_t> letter(0, kEndLetters.size() - 1);
  std::string all = begin_of_new_name(folder, name);
  for (std::size_t k = 0; k < kEndLength; ++k) all += kEndLetters[letter(random)];
  return all;
}

// A new file in the folder, gone again unless it was put in place.
class NewFile {
 public:
  /// `old`: what is there already; null where nothing is.
  NewFile(int folder, const std::string& name, const struct stat* old)
      : folder_(folder),
        name_(unforeseeable_name(folder, name)),
        file_(opened(make(old != nullptr ? S_IRUSR | S_IWUSR : kForAll))) {
    // Whoever removes what killed processes left behind knows by this that it is none of it.
    static_cast<void>(flock(file_.number(), LOCK_EX | LOCK_NB));
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
  }
  int release() { return file_.release(); }

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

// Where a target is.
struct Place {
  explicit Place(const fs::path& target)
      : folder(opened(open((target.has_parent_path() ? target.parent_path() : fs::path(".")).c_str(),
                           O_PATH | O_DIRECTORY | O_CLOEXEC))),
        name(target.filename().string()) {
    exists = fstatat(folder.number(), name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(old.st_mode);
  }
  Descriptor folder;
  std::string name;
  struct stat old = {};
  bool exists = false;
};

}  // namespace

int replace_locked_file(const fs::path& target, std::string_view text, const FileNumber& expected) {
  const SignalsHeldBack held;
  const Place place(target);
  NewFile file(place.folder.number(), place.name, place.exists ? &place.old : nullptr);
  file.write(text);
  // As late as can be: whoever removed the file that was there, and put another one in its place, meant to.
  const Place now(target);
  if (now.exists && !(expected == FileNumber{now.old.st_dev, now.old.st_ino})) fail_with(EBUSY);
  file.put_in_place(place.name);
  return file.release();
}

void remove_leftovers(const fs::path& target) {
  const Place place(target);
  const std::string begin = begin_of_new_name(place.folder.number(), place.name);
  const int folder = openat(place.folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // a folder that may be written and not read
  struct Close {
    void operator()(DIR* open_folder) const { closedir(open_folder); }
  };
  const std::unique_ptr<DIR, Close> all(fdopendir(folder));
  if (all == nullptr) {
    ::close(folder);
    return;
  }
  while (const dirent* const entry = readdir(all.get())) {
    const std::string_view name = entry->d_name;
    if (name.size() != begin.size() + kEndLength || !name.starts_with(begin) ||
        name.find_first_not_of(kEndLetters, begin.size()) != std::string_view::npos) {
      continue;
    }
    const Descriptor file(openat(folder, entry->d_name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat found = {};
    if (file.number() >= 0 && fstat(file.number(), &found) == 0 && S_ISREG(found.st_mode) &&
        flock(file.number(), LOCK_EX | LOCK_NB) == 0) {
      unlinkat(folder, entry->d_name, 0);
    }
  }
}

void replace_file(const fs::path& target, std::string_view text) {
  const SignalsHeldBack held;
  remove_leftovers(target);
  const Place place(target);
  NewFile file(place.folder.number(), place.name, place.exists ? &place.old : nullptr);
  file.write(text);
  file.put_in_place(place.name);  // locked until it is
}

}  // namespace vex
