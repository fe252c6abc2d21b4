#include "meshes/isolated_reader.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <locale>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/assimp_reader.h"
#include "meshes/machine_memory.h"

namespace vex {
namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30U;

/// What the reading process may use.
struct Limits {
  std::uint64_t seconds = 0;  // of processor time
  std::uint64_t bytes = 0;    // of address space, beyond what this process has
};

Limits limits_for(std::uint64_t n_geometry_bytes) {
  const std::uint64_t size = std::min<std::uint64_t>(n_geometry_bytes, std::uint64_t{1} << 50U);
  return {10 + size / kMiB, std::min(kGiB + 100 * size, machine_memory() / 4 * 3)};
}

enum class Outcome : std::uint64_t { soup, input_error, out_of_memory };

/// Opens every message; `magic` tells it from what a broken process may write.
struct Header {
  static constexpr std::uint64_t kMagic = 0x7665782D736F7570;
  std::uint64_t magic = kMagic;
  Outcome outcome = Outcome::soup;
  std::uint64_t n_points = 0, n_corners = 0, n_faces = 0, n_parts = 0, n_ignored_faces = 0;
  CoordinateDigits digits;
  double unit_metres = 0.0;
  std::uint64_t text_length = 0;  // of the error's message, or of the unit's name
};

// --- the reading process

void write_all(int descriptor, const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor, next, std::min<std::size_t>(size, kGiB));
    if (written < 0 && errno != EINTR) {
      ::_exit(2);
    }
    if (written > 0) {
      next += written;
      size -= static_cast<std::size_t>(written);
    }
  }
}

template <class T>
void write_array(int descriptor, const std::vector<T>& array) {
  write_all(descriptor, array.data(), array.size() * sizeof(T));
}

void limit(decltype(RLIMIT_CPU) resource, std::uint64_t most) {
  struct rlimit now {};
  if (::getrlimit(resource, &now) == 0 && (now.rlim_cur == RLIM_INFINITY || now.rlim_cur > most)) {
    now.rlim_cur = most;
    ::setrlimit(resource, &now);
  }
}

void confine(const Limits& limits, pid_t parent) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL,
                           SIGXCPU, SIGUSR1, SIGUSR2}) {
    const bool was_ignored = std::signal(signal, SIG_DFL) == SIG_IGN;
    if (was_ignored && (signal == SIGINT || signal == SIGHUP || signal == SIGQUIT)) {
      std::signal(signal, SIG_IGN);  // a job in the background, or under nohup, is not to end with the terminal's
    }
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {  // it died before the line above
    ::_exit(2);
  }
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    ::dup2(nowhere, stream);
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve terabytes of address space
  limit(RLIMIT_AS, own_address_space() + limits.bytes);
#endif
}

[[noreturn]] void read_and_send(const AssimpInput& input, int descriptor) {
  Header header;
  std::string text;
  PolygonSoup soup;
  try {
    std::locale::global(std::locale::classic());
    soup = read_by_assimp(input, ImporterFate::left_alone);
    text = soup.unit;
  } catch (const std::bad_alloc&) {
    header.outcome = Outcome::out_of_memory;
  } catch (const std::exception& error) {
    header.outcome = Outcome::input_error;
    text = error.what();
  }
  header.n_points = soup.points.size();
  header.n_corners = soup.corners.size();
  header.n_faces = soup.face_sizes.size();
  header.n_parts = soup.n_parts;
  header.n_ignored_faces = soup.n_ignored_faces;
  header.digits = soup.digits;
  header.unit_metres = soup.unit_metres;
  text.resize(std::min<std::size_t>(text.size(), 2000));
  header.text_length = text.size();
  write_all(descriptor, &header, sizeof header);
  write_all(descriptor, text.data(), text.size());
  if (header.outcome == Outcome::soup) {
    write_array(descriptor, soup.points);
    write_array(descriptor, soup.corners);
    write_array(descriptor, soup.face_sizes);
  }
  ::_exit(0);
}

// --- this process

/// The reading process and the pipe from it; both are gone when this is.
class Child {
 public:
  Child(pid_t id, int descriptor) : id_(id), descriptor_(descriptor) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::close(descriptor_);
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      wait();
    }
  }

  /// Reads `size` bytes, or fewer where the other end closes. A signal that this process handles does not end it.
  std::size_t read(void* data, std::size_t size) const {
    std::size_t n_read = 0;
    while (n_read < size) {
      const ssize_t n =
          ::read(descriptor_, static_cast<char*>(data) + n_read, std::min<std::size_t>(size - n_read, kGiB));
      if (n > 0) {
        n_read += static_cast<std::size_t>(n);
      } else if (n == 0 || errno != EINTR) {
        break;
      }
    }
    return n_read;
  }

  /// `array` is filled with what arrives; what was only announced takes addresses, and no memory.
  template <class T>
  bool read_array(std::uint64_t size, std::vector<T>* array) const {
    constexpr std::uint64_t kChunk = 16 * kMiB / sizeof(T);
    array->reserve(static_cast<std::size_t>(size));
    while (array->size() < size) {
      const std::size_t before = array->size();
      const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(size - before, kChunk));
      array->resize(before + n);
      if (read(array->data() + before, n * sizeof(T)) != n * sizeof(T)) {
        return false;
      }
    }
    return true;
  }

  /// How the process ended; -1 where that cannot be known (a caller that ignores SIGCHLD).
  int wait() {
    int status = -1;
    while (::waitpid(id_, &status, 0) < 0) {
      if (errno != EINTR) {
        status = -1;
        break;
      }
    }
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
  int descriptor_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason, const std::string& advice) {
  throw InputError("the reader of " + path.string() + " failed (" + reason + ") - " + advice);
}

[[noreturn]] void refuse_for_status(const std::filesystem::path& path, int status, const Limits& limits) {
  const char* const unreadable =
      "the file may be damaged, or hold something that assimp cannot read: convert it to .obj, .off, .ply or .stl";
  if (status >= 0 && WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) {
      refuse(path, "assimp took more than " + std::to_string(limits.seconds) + " s of processor time", unreadable);
    }
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGQUIT) {
      refuse(path, "interrupted by signal " + std::to_string(signal), "start again");
    }
    refuse(path, "assimp crashed with signal " + std::to_string(signal), unreadable);
  }
  refuse(path, "it ended early, with exit status " + std::to_string(status >= 0 ? WEXITSTATUS(status) : -1),
         unreadable);
}

PolygonSoup receive(const std::filesystem::path& path, const Limits& limits, Child* child) {
  Header header;
  if (child->read(&header, sizeof header) != sizeof header || header.magic != Header::kMagic) {
    refuse_for_status(path, child->wait(), limits);
  }
  const std::string out_of_memory =
      "assimp asked for more than " + std::to_string(limits.bytes / kMiB) + " MiB of memory";
  if (header.outcome == Outcome::out_of_memory) {
    refuse(path, out_of_memory, "the file may be damaged, or too large for this machine: convert it to .ply or .stl");
  }
  std::vector<char> text;
  if (header.text_length > 4000 || !child->read_array(header.text_length, &text)) {
    refuse_for_status(path, child->wait(), limits);
  }
  if (header.outcome == Outcome::input_error) {
    throw InputError(std::string(text.begin(), text.end()));
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 31U;
  if (header.n_points > kMost || header.n_corners > kMost || header.n_faces > kMost ||
      header.n_points * sizeof(Vec3d) + (header.n_corners + header.n_faces) * sizeof(std::uint32_t) > limits.bytes) {
    refuse(path, "it announced an impossible amount", "the file may be damaged: convert it to .ply or .stl");
  }
  PolygonSoup soup;
  soup.n_parts = header.n_parts;
  soup.n_ignored_faces = header.n_ignored_faces;
  soup.digits = header.digits;
  soup.unit.assign(text.begin(), text.end());
  soup.unit_metres = header.unit_metres;
  if (!child->read_array(header.n_points, &soup.points) || !child->read_array(header.n_corners, &soup.corners) ||
      !child->read_array(header.n_faces, &soup.face_sizes)) {
    refuse_for_status(path, child->wait(), limits);
  }
  return soup;
}

/// Above the three standard streams, which a caller may have closed and the reading process redirects.
int above_standard_streams(int descriptor) {
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(descriptor);
  return moved;
}

}  // namespace

PolygonSoup read_by_assimp_isolated(const AssimpInput& input) {
  const Limits limits = limits_for(input.n_geometry_bytes);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("cannot make a pipe for the file reader: ") + std::strerror(errno));
  }
  ::fcntl(ends[1], F_SETPIPE_SZ, static_cast<int>(kMiB));  // fewer changes between the processes; it may be refused
  const int read_end = above_standard_streams(ends[0]);
  const int write_end = above_standard_streams(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id == 0) {
    ::close(read_end);
    confine(limits, parent);
    read_and_send(input, write_end);
  }
  ::close(write_end);
  Child child(id, read_end);
  if (id < 0) {
    throw std::runtime_error(std::string("cannot start the file reader: ") + std::strerror(errno));
  }
  return receive(input.path, limits, &child);
}

}  // namespace vex
