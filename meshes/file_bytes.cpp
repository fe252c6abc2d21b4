#include "meshes/file_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/machine_memory.h"
#include "meshes/open_file.h"

namespace vex {
namespace {

FileStamp stamp_of(const struct stat& status) {
  return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Opens for reading without waiting for anything, which opening a pipe would do.
int open_at_once(const std::filesystem::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

struct stat checked_status(const OpenFile& file, const std::filesystem::path& path) {
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

/// How much of a file was ever written: the rest are holes, which take no room on the disk and read as zeros.
std::uint64_t written_bytes(const OpenFile& file, const struct stat& status) {
  constexpr int kMostPieces = 100'000;  // of a file made of more, what lies behind them counts as holes
  constexpr std::int64_t kBlock = 512;  // what st_blocks counts
  if (status.st_blocks >= status.st_size / kBlock) return static_cast<std::uint64_t>(status.st_size);
  std::uint64_t written = 0;
  ::off_t at = 0;
  for (int n = 0; n < kMostPieces && at < status.st_size; ++n) {
    const ::off_t begin = ::lseek(file.number(), at, SEEK_DATA);
    if (begin < 0 && errno == ENXIO) break;  // nothing but a hole is left
    at = begin < 0 ? begin : ::lseek(file.number(), begin, SEEK_HOLE);
    if (at < 0) {  // the file system does not tell
      written = static_cast<std::uint64_t>(status.st_size);
      break;
    }
    written += static_cast<std::uint64_t>(at - begin);
  }
  ::lseek(file.number(), 0, SEEK_SET);
  return written;
}

/// What a file's reading may cost goes by its size, so that the size must not come for nothing.
void refuse_holes(const OpenFile& file, const struct stat& status, const std::string& name) {
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::uint64_t written = written_bytes(file, status);
  if (size > written && size - written > written + kMiB) {
    throw InputError(name + " is mostly holes (of its " + std::to_string(size) + " bytes " + std::to_string(written) +
                     " were ever written) - fetch or export it again; if so it is meant, cp --sparse=never fills them");
  }
}

/// Fills `bytes` from its byte `at` on; returns how many came before the end. Throws InputError.
std::size_t read_until_full(int descriptor, std::size_t at, FileBytes* bytes, const std::string& name) {
  const std::size_t first = at;
  while (at < bytes->size()) {
    end_if_interrupted();
    const ssize_t n = ::read(descriptor, bytes->data() + at, std::min(bytes->size() - at, 16 * kMiB));
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

std::optional<FileStamp> file_stamp(const OpenFile& file) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return std::nullopt;
  return stamp_of(status);
}

std::uint64_t most_file_bytes() { return machine_memory() / 2; }

std::uintmax_t checked_file_size(const std::filesystem::path& path) {
  const OpenFile file(open_at_once(path));
  return static_cast<std::uintmax_t>(checked_status(file, path).st_size);
}

FileBytes read_file_bytes(const std::filesystem::path& path) {
  return read_file_bytes(OpenFile(open_at_once(path)), path);
}

FileBytes read_file_bytes(const OpenFile& file, const std::filesystem::path& path) {
  const std::string name = "the mesh file " + path.string();
  const struct stat before = checked_status(file, path);
  refuse_holes(file, before, name);
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
