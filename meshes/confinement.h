// What holds a process that looks into data nobody vouches for: should a reader be taken over by what it reads, it can
// compute, and write into the one pipe it was given.
//
// docs/security.md says what is promised of it, docs/decisions/0021-confined-reader.md why it is made so.
#pragma once

#include <cstdint>
#include <string>

namespace vex {

enum class Confining : std::uint8_t {
  as_far_as_possible,  // hard limits always; the filter of system calls and Landlock where the system grants them
  required             // without the filter of system calls the process ends before it looks at anything
};

/// Limits that cannot be raised again.
struct ProcessLimits {
  std::uint64_t processor_seconds = 0;
  std::uint64_t bytes = 0;         // of address space, beyond what the process has; not held under a sanitizer
  std::uint64_t wall_seconds = 0;  // held by the process that waits for it (confined_process.h)
};

/// What came of each barrier: 0 where it is in force, otherwise the error number.
struct Barriers {
  static constexpr std::int32_t kNotBuilt = -1;  // vex was built without libseccomp

  std::int32_t limits = 0;    // hard limits on time, memory, open files (none further), files written, processes
  std::int32_t filter = 0;    // of system calls; with no_new_privs
  std::int32_t memory = 0;    // none that is shared with other processes
  std::int32_t landlock = 0;  // no way to any file or port; kernels from 5.13 have it where it is switched on

  /// The filter alone already lets nothing be opened, connected, started or raised; Landlock is a second lock.
  bool is_confined() const { return limits == 0 && filter == 0 && memory == 0; }
  /// Why it is not; empty where it is.
  std::string problem() const;
};

/// For a process of one thread that was just forked: unmaps what it shares with others, closes every descriptor but
/// `kept`, which must be at least 3 and becomes kConfinedDescriptor, puts /dev/null in the place of the standard
/// streams, gives up all capabilities, and raises the barriers. What follows may take memory, and write to
/// kConfinedDescriptor; any other system call fails.
Barriers confine_this_process(const ProcessLimits& limits, int kept);

inline constexpr int kConfinedDescriptor = 3;

}  // namespace vex
