// A process of its own for data that nobody vouches for, and what it writes back.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "meshes/confinement.h"
#include "meshes/machine_memory.h"
#include "meshes/open_file.h"

namespace vex {

/// How a confined process ended.
struct ProcessEnd {
  int status = -1;                 // waitpid's; -1 where it cannot be known (a caller that ignores SIGCHLD)
  double processor_seconds = 0.0;  // that it took; 0 where it cannot be known
  bool was_too_slow = false;       // it was killed by the clock on the wall
  bool was_killed_here = false;    // by that or by other means of this process
};

/// A forked process, which is gone when this is.
class ConfinedProcess {
 public:
  /// Runs `work` there, behind the barriers; it writes to kConfinedDescriptor, and must not return. Where the limits
  /// are refused, or what is required, it does not run at all. Throws std::runtime_error where no process can be
  /// started.
  ConfinedProcess(const ProcessLimits& limits, Confining confining, const std::function<void()>& work);
  ConfinedProcess(const ConfinedProcess&) = delete;
  ConfinedProcess& operator=(const ConfinedProcess&) = delete;
  ~ConfinedProcess();

  /// What holds it, as it said before it began to work. Where it said nothing, `has_barriers` is false.
  bool has_barriers() const { return has_barriers_; }
  const Barriers& barriers() const { return barriers_; }

  /// Reads `size` bytes, or fewer where the other end closes or its time is over. A signal that this process handles
  /// does not end it; an interruption (engine/numeric/interruption.h) does.
  std::size_t read(void* data, std::size_t size);

  /// `array` is filled with what arrives; what was only announced takes addresses, and no memory.
  template <class T>
  bool read_array(std::uint64_t size, std::vector<T>* array) {
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

  /// Waits for it a moment, and kills it then: for one that has closed its end, or has written what it must not.
  ProcessEnd end();

 private:
  explicit ConfinedProcess(std::uint64_t wall_seconds);

  bool wait_for_bytes();
  bool has_ended(ProcessEnd* end, int flags);

  int id_ = 0;
  OpenFile pipe_{-1};
  std::chrono::duration<double> left_{0.0};  // of its time on the wall
  bool has_barriers_ = false;
  Barriers barriers_;
};

}  // namespace vex
