// A system that refuses some calls, as containers and old kernels do: for this process and all that it starts.
#pragma once

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace vex::tests {

/// Filters and Landlock: without them the reader of mesh files is held by its limits alone.
inline constexpr std::initializer_list<long> kFilterCalls{SYS_seccomp};
inline constexpr std::initializer_list<long> kLandlockCalls{SYS_landlock_create_ruleset, SYS_landlock_restrict_self};
inline constexpr std::initializer_list<long> kLimitCalls{SYS_prlimit64, SYS_setrlimit};

/// Whether the calls fail with `error` from now on. With SYS_seccomp goes the older way to it, by prctl.
inline bool refuse_calls(std::initializer_list<long> calls, int error) {
  const auto load = [](std::size_t offset) {
    return sock_filter{BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)};
  };
  // Skips `n` statements where the loaded word is not `value`.
  const auto unless = [](long value, std::uint8_t n) {
    return sock_filter{BPF_JMP | BPF_JEQ | BPF_K, 0, n, static_cast<std::uint32_t>(value)};
  };
  const auto result = [](std::uint32_t value) { return sock_filter{BPF_RET | BPF_K, 0, 0, value}; };
  const std::uint32_t refused = SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error);
  std::vector<sock_filter> filter{load(offsetof(seccomp_data, nr))};
  for (const long call : calls) {
    filter.push_back(unless(call, 1));
    filter.push_back(result(refused));
    if (call == SYS_seccomp) {
      filter.push_back(unless(SYS_prctl, 4));
      filter.push_back(load(offsetof(seccomp_data, args)));
      filter.push_back(unless(PR_SET_SECCOMP, 1));
      filter.push_back(result(refused));
      filter.push_back(result(SECCOMP_RET_ALLOW));
    }
  }
  filter.push_back(result(SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace vex::tests
