// Long work that may be told to end early.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace vex {

/// Thrown out of long work that was told to end (`Interruption`).
class Interrupted final : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// While one lives, long work that its thread begins asks `is_wanted` now and then, on this thread alone, and ends by
/// throwing Interrupted once the answer is yes; so do the threads that share the work (engine/scene/threads.h). It is
/// asked by queries of scenes, hulls, meshes and `validate`, often: it should answer in some tens of nanoseconds. What
/// was worked on is as before, or as after an exception of any other kind: a scene answers its next query as always.
class Interruption {
 public:
  explicit Interruption(std::function<bool()> is_wanted)
      : is_wanted_(std::move(is_wanted)), owner_(std::this_thread::get_id()), outer_(current_) {
    current_ = this;
  }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption() { current_ = outer_; }

  /// Of this thread; null where there is none.
  static Interruption* current() { return current_; }

  /// As if the answer had been yes; by any thread that works.
  void end() { has_come_ = true; }
  /// Throws Interrupted where this has been told to end.
  void check() {
    if (!has_come_ && std::this_thread::get_id() == owner_ && is_wanted_()) has_come_ = true;
    if (has_come_) throw Interrupted();
  }

 private:
  friend class SharedInterruption;

  inline static thread_local Interruption* current_ = nullptr;

  std::function<bool()> is_wanted_;
  std::thread::id owner_;
  Interruption* outer_;
  std::atomic<bool> has_come_{false};
};

/// Makes another thread's current one this thread's, which works for that one.
class SharedInterruption {
 public:
  explicit SharedInterruption(Interruption* of_caller) : own_(Interruption::current_) {
    Interruption::current_ = of_caller;
  }
  SharedInterruption(const SharedInterruption&) = delete;
  SharedInterruption& operator=(const SharedInterruption&) = delete;
  ~SharedInterruption() { Interruption::current_ = own_; }

 private:
  Interruption* own_;
};

/// For loops of long work.
inline void end_if_interrupted() {
  if (Interruption* const current = Interruption::current()) current->check();
}

}  // namespace vex
