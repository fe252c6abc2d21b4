#include "meshes/file_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "engine/numeric/errors.h"
#include "meshes/machine_memory.h"

namespace vex {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

FileStamp stamp_of(const struct stat& status) {
  return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Opens for reading without waiting for anything, which opening a pipe would do.
int open_at_once(const std::filesystem::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

struct stat checked_status(const Descriptor& file, const std::filesystem::path& path) {
  const auto refuse = [&path](const std::string& reason) {
    throw InputError("cannot read the mesh file " + path.string() + " (" + reason + ") - name a file that can be read");
  };
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) refuse("it is a folder");
  if (!S_ISREG(status.st_mode)) refuse("it is a pipe, a device or a socket, not a file");
  if (status.st_size == 0) {
    throw InputError("the mesh file " + path.string() + " is empty (0 bytes) - name a file that holds a mesh");
  }
  return status;
}

[[noreturn]] void refuse_too_large(const std::string& name, std::uint64_t size) {
  throw InputError(name + " is too large for this machine (" + std::to_string(size / kMiB) + " MiB or more, with " +
                   std::to_string(machine_memory() / kMiB) + " MiB of memory) - simplify the mesh");
}

/// Fills `bytes` from its byte `at` on; returns how many came before the end. Throws InputError.
std::size_t read_until_full(int descriptor, std::size_t at, FileBytes* bytes, const std::string& name) {
  const std::size_t first = at;
  while (at < bytes->size()) {
    const ssize_t n = ::read(descriptor, bytes->data() + at, std::min(bytes->size() - at, 1024 * kMiB));
    if (n == 0) break;
    if (n < 0 && errno != EINTR) {
      throw InputError("cannot read " + name + " (" + std::strerror(errno) + ") - name something that can be read");
    }
    at += n > 0 ? static_cast<std::size_t>(n) : 0;
  }
  return at - first;
}

}  // namespace

void FileBytes::resize(std::size_t size) {
  char* const data = static_cast<char*>(std::realloc(data_.get(), std::max<std::size_t>(size, 1)));
  if (data == nullptr) throw std::bad_alloc();
  static_cast<void>(data_.release());  // realloc has dealt with it
  data_.reset(data);
  size_ = size;
}

std::optional<FileStamp> file_stamp(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return stamp_of(status);
}

std::uint64_t most_file_bytes() { return machine_memory() / 2; }

std::uintmax_t checked_file_size(const std::filesystem::path& path) {
  const Descriptor file(open_at_once(path));
  return static_cast<std::uintmax_t>(checked_status(file, path).st_size);
}

FileBytes read_file_bytes(const std::filesystem::path& path) {
  const std::string name = "the mesh file " + path.string();
  const Descriptor file(open_at_once(path));
  const struct stat before = checked_status(file, path);
  const auto size = static_cast<std::size_t>(before.st_size);
  if (size > most_file_bytes()) refuse_too_large(name, size);
  FileBytes bytes;
  bytes.resize(size + 1);  // the last byte only meets the end
  const std::size_t n_read = read_until_full(file.number(), 0, &bytes, name);
  struct stat after {};
  if (n_read != size || ::fstat(file.number(), &after) != 0 || stamp_of(after) != stamp_of(before)) {
    throw InputError(name + " changed while it was read (it had " + std::to_string(size) + " bytes, then " +
                     std::to_string(std::max(n_read, static_cast<std::size_t>(after.st_size))) +
                     ") - start again when it is written");
  }
  bytes.resize(size);
  return bytes;
}

FileBytes read_standard_input() {
  const std::string name = "standard input";
  // It does not say how long it is, so that what is taken doubles; and an endless one should not take long to refuse.
  const std::uint64_t most = machine_memory() / 16;
  FileBytes bytes;
  std::size_t size = 0;
  do {
    if (size > most) refuse_too_large(name, size);
    bytes.resize(std::max(kMiB, 2 * size));
    size += read_until_full(STDIN_FILENO, size, &bytes, name);
  } while (size == bytes.size());
  bytes.resize(size);
  if (size == 0) throw InputError("standard input is empty (0 bytes) - give it a mesh, or name a file");
  return bytes;
}

}  // namespace vex
