// Memory that a process shares with others: what a forked one must not be able to write to.
#pragma once

#include <cstdint>
#include <vector>

namespace vex {

/// A mapping of this process that it could write to, or make writable, and that other processes would see change.
struct SharedMapping {
  std::uint64_t begin, end;  // addresses
};

/// All of them, as the kernel lists them (/proc/self/maps; /proc/self/smaps tells which could be made writable, and
/// where it does not, all that are shared count). The error number where it lists none.
int shared_mappings(std::vector<SharedMapping>* found);

/// Unmaps them. For a process that was just forked and does nothing with what its parent shares: who touches it, ends.
/// 0, or the error number where they cannot be listed, or one cannot be unmapped.
int give_up_shared_memory();

}  // namespace vex
