#include "meshes/confinement.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <initializer_list>

#include "meshes/machine_memory.h"
#include "meshes/shared_memory.h"

#ifdef VEX_HAS_SECCOMP
#include <seccomp.h>
#endif

namespace vex {
namespace {

/// The soft limit may be below the hard one, so that the kernel can say which limit was met (SIGXCPU) before it kills.
/// The error number.
int set_limit(decltype(RLIMIT_CPU) resource, std::uint64_t soft, std::uint64_t hard) {
  struct rlimit now {};
  if (::getrlimit(resource, &now) != 0) return errno;
  now.rlim_max = std::min<rlim_t>(now.rlim_max, hard);  // RLIM_INFINITY is the largest number
  now.rlim_cur = std::min<rlim_t>({now.rlim_cur, now.rlim_max, soft});
  return ::setrlimit(resource, &now) == 0 ? 0 : errno;
}

/// All of them, though one may fail.
int set_limits(const ProcessLimits& limits, std::uint64_t own_bytes) {
  int error = 0;
  const auto set = [&error](decltype(RLIMIT_CPU) resource, std::uint64_t soft, std::uint64_t hard) {
    const int result = set_limit(resource, soft, hard);
    if (error == 0) error = result;
  };
  set(RLIMIT_CORE, 0, 0);
  set(RLIMIT_CPU, limits.processor_seconds, limits.processor_seconds + 1);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve terabytes of address space
  set(RLIMIT_AS, own_bytes + limits.bytes, own_bytes + limits.bytes);
#else
  static_cast<void>(own_bytes);
#endif
  set(RLIMIT_FSIZE, 0, 0);
  set(RLIMIT_NPROC, 0, 0);
  set(RLIMIT_NOFILE, 0, 0);  // no further descriptor: what is open stays open
  return error;
}

/// linux/landlock.h has it, on an older system with less in it than the kernel knows.
struct LandlockRuleset {
  std::uint64_t handled_access_fs = 0;
  std::uint64_t handled_access_net = 0;
  std::uint64_t scoped = 0;
};

/// A ruleset that handles everything this kernel knows, and allows none of it.
int shut_files_and_ports() {
#ifdef SYS_landlock_create_ruleset
  constexpr unsigned kAskForVersion = 1;
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, kAskForVersion);
  if (version < 1) return errno;
  LandlockRuleset ruleset;
  const int n_accesses = version >= 5 ? 16 : version >= 3 ? 15 : version == 2 ? 14 : 13;
  ruleset.handled_access_fs = (std::uint64_t{1} << static_cast<unsigned>(n_accesses)) - 1;
  if (version >= 4) ruleset.handled_access_net = 3;  // bind and connect
  if (version >= 6) ruleset.scoped = 3;              // abstract sockets and signals of others
  // What an older kernel does not know is 0, and so it takes the whole of the structure.
  const long rules = ::syscall(SYS_landlock_create_ruleset, &ruleset, sizeof ruleset, 0);
  if (rules < 0) return errno;
  const int error = ::syscall(SYS_landlock_restrict_self, rules, 0) == 0 ? 0 : errno;
  ::close(static_cast<int>(rules));
  return error;
#else
  return ENOSYS;
#endif
}

/// Root's limits could be raised by root's capabilities, where nothing filters the call.
void give_up_capabilities() {
  struct __user_cap_header_struct header {};
  header.version = _LINUX_CAPABILITY_VERSION_3;
  const std::array<struct __user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
  static_cast<void>(::syscall(SYS_capset, &header, none.data()));
}

#ifdef VEX_HAS_SECCOMP
/// What is not named fails with EPERM, as if the system did not allow it: a reader that asks for the time of day in an
/// unusual way then still reads. Another architecture's calls, which have other numbers, kill.
int filter_system_calls() {
  const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (filter == nullptr) return ENOMEM;
  int error = 0;
  const auto allow = [&](int call, std::initializer_list<scmp_arg_cmp> arguments = {}) {
    const int result = ::seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, call, static_cast<unsigned>(arguments.size()),
                                                arguments.begin());
    if (error == 0) error = -result;
  };
  const auto is = [](unsigned argument, std::uint64_t value) { return scmp_arg_cmp{argument, SCMP_CMP_EQ, value, 0}; };
  const scmp_arg_cmp not_executable{2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0};
  allow(SCMP_SYS(write), {is(0, kConfinedDescriptor)});
  allow(SCMP_SYS(mmap), {not_executable});
  allow(SCMP_SYS(mprotect), {not_executable});
  allow(SCMP_SYS(tgkill), {is(0, static_cast<std::uint64_t>(::getpid()))});  // abort() signals itself
  for (const int call :
       {SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(futex), SCMP_SYS(sched_yield),
        SCMP_SYS(getrandom), SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(getpid), SCMP_SYS(gettid),
        SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigaction), SCMP_SYS(sigaltstack),
        SCMP_SYS(restart_syscall), SCMP_SYS(exit), SCMP_SYS(exit_group)}) {
    allow(call);
  }
  if (error == 0) error = -::seccomp_load(filter);  // sets no_new_privs first
  ::seccomp_release(filter);
  return error;
}
#else
int filter_system_calls() { return Barriers::kNotBuilt; }
#endif

/// What the caller has open, its sockets and files among them, is not the reader's.
void close_all_but(int kept) {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (nowhere >= 0) {
      ::dup2(nowhere, stream);
    } else {
      ::close(stream);
    }
  }
  if (kept != kConfinedDescriptor) ::dup2(kept, kConfinedDescriptor);
  ::closefrom(kConfinedDescriptor + 1);
}

}  // namespace

std::string Barriers::problem() const {
  if (limits != 0) return std::string("its limits are refused: ") + std::strerror(limits);
  if (filter == kNotBuilt) return "this vex was built without libseccomp, which filters system calls";
  if (filter != 0) return std::string("a filter of system calls is refused: ") + std::strerror(filter);
  if (memory != 0) return std::string("memory that others share cannot be given up: ") + std::strerror(memory);
  return "";
}

Barriers confine_this_process(const ProcessLimits& limits, int kept) {
  const std::uint64_t own_bytes = own_address_space();
  Barriers barriers;
  barriers.memory = give_up_shared_memory();
  close_all_but(kept);
  const bool gains_nothing = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
  const int refused = gains_nothing ? 0 : errno;
  barriers.landlock = gains_nothing ? shut_files_and_ports() : refused;
  give_up_capabilities();
  barriers.limits = set_limits(limits, own_bytes);
  barriers.filter = gains_nothing ? filter_system_calls() : refused;
  return barriers;
}

}  // namespace vex
