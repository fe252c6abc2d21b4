#include "apps/vex_scene/beside.h"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "apps/common/interrupt.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

struct WorkState {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_done = false;
  std::exception_ptr fault;
};

// Threads have the mask of the one that starts them.
void start_without_signals(std::vector<std::jthread>& threads, const std::function<void()>& work) {
  sigset_t every, before;
  sigfillset(&every);
  pthread_sigmask(SIG_SETMASK, &every, &before);
  start_threads(threads, 1, [work](int) { work(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

bool done_before_an_interrupt(const std::function<void()>& work, const std::function<void()>& meanwhile,
                              std::chrono::milliseconds grace) {
  const auto state = std::make_shared<WorkState>();
  std::vector<std::jthread> beside;
  start_without_signals(beside, [work, state] {
    std::exception_ptr fault;
    try {
      work();
    } catch (...) {
      fault = std::current_exception();
    }
    const std::lock_guard lock(state->mutex);
    state->is_done = true;
    state->fault = fault;
    state->changed.notify_one();
  });
  if (beside.empty()) {
    note_threads(2, 1);
    work();  // here then: an interrupt waits for its end, and a second one ends the program
    return true;
  }
  std::unique_lock lock(state->mutex);
  while (!state->changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return state->is_done; })) {
    if (interrupting_signal().load() != 0) {
      state->changed.wait_for(lock, grace, [&] { return state->is_done; });
      beside.front().detach();
      return false;
    }
    meanwhile();
  }
  lock.unlock();
  beside.front().join();
  if (state->fault) std::rethrow_exception(state->fault);
  return true;
}

}  // namespace vex
