#include "apps/common/patient_write.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>

#include "apps/common/descriptor.h"
#include "apps/common/interrupt.h"

namespace vex {
namespace {

// An interrupt that comes just before a wait is seen this much later.
constexpr int kMilliseconds = 50;

// So much goes into a pipe that has room at all without waiting for more; whole lines, where there are any.
std::string_view next_piece(std::string_view text) {
  if (text.size() <= PIPE_BUF) return text;
  const std::size_t end = text.rfind('\n', PIPE_BUF - 1);
  return text.substr(0, end == std::string_view::npos ? PIPE_BUF : end + 1);
}

bool is_pipe(const std::filesystem::path& path) {
  struct stat found = {};
  return stat(path.c_str(), &found) == 0 && S_ISFIFO(found.st_mode);
}

// Negative where an interrupt came before a reader.
int open_for_writing(const std::filesystem::path& path) {
  for (;;) {
    const int number = open(path.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (number >= 0) {
      fcntl(number, F_SETFL, fcntl(number, F_GETFL) & ~O_NONBLOCK);
      return number;
    }
    if (errno != EINTR && !(errno == ENXIO && is_pipe(path))) fail_with(errno);
    if (interrupting_signal().load() != 0) return -1;
    poll(nullptr, 0, kMilliseconds);
  }
}

}  // namespace

bool write_until_interrupted(int descriptor, std::string_view text) {
  const int before = interrupting_signal().load();
  struct stat found = {};
  const bool never_waits = fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
  while (!text.empty()) {
    if (!never_waits) {
      if (interrupting_signal().load() != before) return false;
      pollfd writable = {descriptor, POLLOUT, 0};
      const int n_ready = poll(&writable, 1, kMilliseconds);
      if (n_ready < 0 && errno != EINTR) fail_with(errno);
      if (n_ready <= 0) continue;
    }
    const std::string_view piece = never_waits ? text : next_piece(text);
    const ssize_t n = ::write(descriptor, piece.data(), piece.size());
    if (n < 0 && errno != EINTR && errno != EAGAIN) fail_with(errno);
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

bool write_in_place(const std::filesystem::path& path, std::string_view text) {
  Descriptor file(open_for_writing(path));
  if (file.number() < 0 || !write_until_interrupted(file.number(), text)) return false;
  file.close();
  return true;
}

}  // namespace vex
