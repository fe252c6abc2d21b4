#include "apps/common/interrupt.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>

#include "apps/common/text.h"

namespace vex {
namespace {

constexpr int kEnding[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR2, SIGXCPU, SIGXFSZ};
constexpr std::int64_t kOneWish = 200'000'000;  // nanoseconds

std::atomic<int> arrived{0};
std::atomic<std::int64_t> arrived_at{0};
std::atomic<int> n_held_back{0}, owed{0};
std::atomic<bool> is_asked{false};
static_assert(std::atomic<std::int64_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

// Written before the handlers are set, and only read by them.
struct Words {
  char text[160];
  std::size_t size = 0;

  void set(const std::string& words) {
    size = std::min(words.size(), sizeof text);
    std::copy_n(words.begin(), size, text);
  }
  void write() const { static_cast<void>(::write(STDERR_FILENO, text, size) == 0); }
};
Words last_words, still_loading;
std::string program_name;

// Either this sees that nothing is held back, or whoever ends holding back sees that an end is owed.
void end(int signal) {
  owed.store(signal);
  if (n_held_back.load() == 0) _exit(128 + signal);
}

// The kernel sends SIGXFSZ to who writes beyond a limit; the write then fails, and says so.
bool is_of_a_write(int signal, const siginfo_t* info) { return signal == SIGXFSZ && info->si_pid == getpid(); }

std::int64_t now() {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec + 1;
}

extern "C" void remember_signal(int signal, siginfo_t* info, void*) {
  const int error = errno;
  std::int64_t first = 0;
  if (is_of_a_write(signal, info)) {
    // Nothing is wrong but that file.
  } else if (arrived_at.compare_exchange_strong(first, now())) {
    arrived.store(signal);
  } else if (signal != SIGXCPU && now() - first > kOneWish) {
    end(signal);
  }
  errno = error;
}

extern "C" void end_at_once(int signal, siginfo_t* info, void*) {
  if (is_of_a_write(signal, info)) return;
  last_words.write();
  end(signal);
}

extern "C" void remember_question(int) { is_asked.store(true); }

extern "C" void answer_at_once(int) {
  const int error = errno;
  still_loading.write();
  errno = error;
}

void set_unless_ignored(int signal, struct sigaction action) {
  action.sa_flags |= SA_RESTART;
  sigemptyset(&action.sa_mask);
  struct sigaction present = {};
  sigaction(signal, nullptr, &present);
  // A program started in the background with SIGINT ignored keeps ignoring it.
  if (present.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}

void handle_with(void (*ending)(int, siginfo_t*, void*), void (*asking)(int)) {
  struct sigaction action = {};
  action.sa_sigaction = ending;
  action.sa_flags = SA_SIGINFO;
  for (const int signal : kEnding) set_unless_ignored(signal, action);
  struct sigaction question = {};
  question.sa_handler = asking;
  set_unless_ignored(SIGUSR1, question);
}

}  // namespace

void end_on_interrupts(const std::string& program) {
  program_name = program;
  last_words.set(program + ": interrupted before there was a result - nothing was written\n");
  still_loading.set(program + ": bodies are being loaded, the run has not begun\n");
  handle_with(end_at_once, answer_at_once);
}

void catch_interrupts() { handle_with(remember_signal, remember_question); }

const std::atomic<int>& interrupting_signal() { return arrived; }

void answer_if_asked(const std::function<std::string()>& how_far) {
  if (!is_asked.load(std::memory_order_relaxed) || !is_asked.exchange(false)) return;
  std::fprintf(stderr, "%s: %s\n", program_name.c_str(), printable(how_far()).c_str());
}

EndHeldBack::EndHeldBack() { ++n_held_back; }

EndHeldBack::~EndHeldBack() {
  if (--n_held_back == 0 && owed.load() != 0) _exit(128 + owed.load());
}

}  // namespace vex
