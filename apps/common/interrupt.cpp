#include "apps/common/interrupt.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string>

namespace vex {
namespace {

std::atomic<int> arrived{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

// Written before the handler is set, and only read by it.
char last_words[128];
std::size_t n_last_words = 0;

extern "C" void remember_signal(int signal) {
  if (arrived.exchange(signal) != 0) _exit(128 + signal);
}

extern "C" void end_silently(int signal) { _exit(128 + signal); }

extern "C" void end_at_once(int signal) {
  static_cast<void>(write(STDERR_FILENO, last_words, n_last_words) == 0);
  _exit(128 + signal);
}

void handle_with(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    // A program started in the background with SIGINT ignored keeps ignoring it.
    if (present.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

void end_on_interrupts(const std::string& program) {
  const std::string text = program + ": interrupted before there was a result - nothing was written\n";
  n_last_words = std::min(text.size(), sizeof last_words);
  std::copy_n(text.begin(), n_last_words, last_words);
  handle_with(end_at_once);
}

void catch_interrupts() { handle_with(remember_signal); }

void stop_catching_interrupts() { handle_with(end_silently); }

const std::atomic<int>& interrupting_signal() { return arrived; }

}  // namespace vex
