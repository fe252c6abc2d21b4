#include "meshes/confined_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "engine/numeric/interruption.h"

namespace vex {
namespace {

constexpr std::uint64_t kMostAtOnce = std::uint64_t{1} << 30U;

/// Above the three standard streams, which a caller may have closed and the process redirects.
OpenFile above_standard_streams(int descriptor) {
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(descriptor);
  return OpenFile(moved);
}

/// As in a process that was just started, and it does not outlive its parent.
void take_signals_as_usual(pid_t parent) {
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
}

}  // namespace

// From the first constructor on it is gone by its destructor, also where an interruption ends the second one.
ConfinedProcess::ConfinedProcess(std::uint64_t wall_seconds) : left_(static_cast<double>(wall_seconds)) {}

ConfinedProcess::ConfinedProcess(const ProcessLimits& limits, Confining confining, const std::function<void()>& work)
    : ConfinedProcess(limits.wall_seconds) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("cannot make a pipe for the file reader: ") + std::strerror(errno));
  }
  ::fcntl(ends[1], F_SETPIPE_SZ, static_cast<int>(kMiB));  // fewer changes between the processes; it may be refused
  pipe_ = above_standard_streams(ends[0]);
  {
    const OpenFile write_end = above_standard_streams(ends[1]);
    const pid_t parent = ::getpid();
    id_ = ::fork();
    if (id_ < 0) {
      throw std::runtime_error(std::string("cannot start the file reader: ") + std::strerror(errno));
    }
    if (id_ == 0) {
      const Interruption nobody([] { return false; });  // the parent's asks what this process does not have
      take_signals_as_usual(parent);
      const Barriers barriers = confine_this_process(limits, write_end.number());
      const bool is_said = ::write(kConfinedDescriptor, &barriers, sizeof barriers) == sizeof barriers;
      if (is_said && (barriers.limits == 0 && (confining != Confining::required || barriers.is_confined()))) work();
      ::_exit(2);
    }
  }
  has_barriers_ = read(&barriers_, sizeof barriers_) == sizeof barriers_;
}

ConfinedProcess::~ConfinedProcess() {
  if (id_ > 0) {
    ::kill(id_, SIGKILL);
    ProcessEnd end;
    static_cast<void>(has_ended(&end, 0));
  }
}

std::size_t ConfinedProcess::read(void* data, std::size_t size) {
  std::size_t n_read = 0;
  while (n_read < size && wait_for_bytes()) {
    const ssize_t n =
        ::read(pipe_.number(), static_cast<char*>(data) + n_read, std::min<std::size_t>(size - n_read, kMostAtOnce));
    if (n > 0) {
      n_read += static_cast<std::size_t>(n);
    } else if (n == 0 || errno != EINTR) {
      break;
    }
  }
  return n_read;
}

/// While this process is stopped, by Ctrl-Z for instance, so is the other, mostly: no wait counts for more than it was
/// asked to be.
bool ConfinedProcess::wait_for_bytes() {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds kAtOnce{0.25};
  while (left_.count() > 0.0) {
    end_if_interrupted();
    struct pollfd awaited {};
    awaited.fd = pipe_.number();
    awaited.events = POLLIN;
    const Seconds asked = std::min(left_, kAtOnce);
    const auto start = std::chrono::steady_clock::now();
    const int n = ::poll(&awaited, 1, static_cast<int>(1000.0 * asked.count()) + 1);
    left_ -= std::min<Seconds>(std::chrono::steady_clock::now() - start, asked);
    if (n > 0) return true;
    if (n < 0 && errno != EINTR) return false;
  }
  return false;
}

bool ConfinedProcess::has_ended(ProcessEnd* end, int flags) {
  struct rusage usage {};
  int status = -1;
  pid_t ended = -1;
  do {
    ended = ::wait4(id_, &status, flags, &usage);
  } while (ended < 0 && errno == EINTR);
  if (ended == 0) return false;
  id_ = 0;
  if (ended < 0) return true;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  end->status = status;
  end->processor_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return true;
}

ProcessEnd ConfinedProcess::end() {
  ProcessEnd end;
  constexpr int kMostWaits = 5000;  // of a millisecond: on a busy machine a process takes that long to end
  for (int n = 0; n < kMostWaits && left_.count() > 0.0; ++n) {
    if (has_ended(&end, WNOHANG)) return end;
    end_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(id_, SIGKILL);
  static_cast<void>(has_ended(&end, 0));
  end.was_killed_here = true;
  end.was_too_slow = !(left_.count() > 0.0);
  return end;
}

}  // namespace vex
