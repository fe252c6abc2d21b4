#include "apps/common/interrupt.h"

#include <csignal>

namespace vex {
namespace {

std::atomic<int> arrived{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void remember_signal(int signal) { arrived.store(signal); }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    // A program started in the background with SIGINT ignored keeps ignoring it.
    if (present.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

const std::atomic<int>& interrupting_signal() { return arrived; }

}  // namespace vex
