#include "meshes/confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "meshes/confined_process.h"
#include "meshes/shared_memory.h"
#include "temporary_folder.h"
#include "tests/setup/refused_calls.h"

namespace vex::tests {
namespace {

constexpr ProcessLimits kLimits{5, 256 * kMiB, 10};

/// Of each, what a reader that was taken over would try: 0 where it worked, and otherwise the error.
struct Probe {
  int internet_socket, local_socket, open_file, create_file, unlink_file, execute, start_process, raise_time,
      raise_files, signal_parent, trace_parent, duplicate, executable_memory, read_pipe, inherited_descriptor;
};

struct Tried {
  Barriers barriers;
  Probe probe;
};

int error_of(long result) { return result == -1 ? errno : 0; }

int raise_limit(decltype(RLIMIT_CPU) resource) {
  const struct rlimit more { 1000, 1000 };
  return error_of(::setrlimit(resource, &more));
}

/// In the confined process. `existing` and `inherited` are of the caller.
Probe probe(const std::string& existing, int inherited) {
  Probe probe{};
  probe.internet_socket = error_of(::socket(AF_INET, SOCK_STREAM, 0));
  probe.local_socket = error_of(::socket(AF_UNIX, SOCK_STREAM, 0));
  probe.open_file = error_of(::open(existing.c_str(), O_RDONLY));
  probe.create_file = error_of(::open((existing + ".new").c_str(), O_WRONLY | O_CREAT, 0600));
  probe.unlink_file = error_of(::unlink(existing.c_str()));
  probe.duplicate = error_of(::dup(kConfinedDescriptor));
  probe.raise_time = raise_limit(RLIMIT_CPU);
  probe.raise_files = raise_limit(RLIMIT_NOFILE);
  probe.signal_parent = error_of(::kill(::getppid(), 0));
  probe.trace_parent = error_of(::ptrace(PTRACE_SEIZE, ::getppid(), nullptr, nullptr));
  void* const memory = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  probe.executable_memory = memory == MAP_FAILED ? errno : 0;
  char byte = 0;
  probe.read_pipe = error_of(::read(STDIN_FILENO, &byte, 1));
  probe.inherited_descriptor = error_of(::write(inherited, "x", 1));
  const pid_t child = ::fork();
  probe.start_process = error_of(child);
  if (child == 0) ::_exit(0);
  char program[] = "/bin/true";
  char* const words[] = {program, nullptr};
  probe.execute = error_of(::execve(program, words, words));  // does not come back where it works
  return probe;
}

Tried try_everything() {
  const TemporaryFolder folder;
  const std::string existing = folder.file("secret", "x").string();
  const int opened = ::open(existing.c_str(), O_RDWR);
  const int inherited = ::fcntl(opened, F_DUPFD, 20);  // not a number that the process has for something else
  Tried tried{};
  ConfinedProcess process(kLimits, Confining::as_far_as_possible, [&] {
    const Probe result = probe(existing, inherited);
    static_cast<void>(!::write(kConfinedDescriptor, &result, sizeof result));
    ::_exit(0);
  });
  EXPECT_TRUE(process.has_barriers());
  tried.barriers = process.barriers();
  EXPECT_EQ(process.read(&tried.probe, sizeof tried.probe), sizeof tried.probe);
  ::close(inherited);
  ::close(opened);
  EXPECT_TRUE(std::filesystem::exists(existing));
  EXPECT_FALSE(std::filesystem::exists(existing + ".new"));
  return tried;
}

/// Runs `action` in a process of its own, where calls are refused; whether it found nothing wrong.
bool holds_where_refused(std::initializer_list<long> calls, int error, const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (!refuse_calls(calls, error)) ::_exit(2);
    action();
    ::_exit(::testing::Test::HasFailure() ? 1 : 0);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  return status == 0;
}

void expect_nothing_works(const Probe& probe) {
  EXPECT_NE(probe.internet_socket, 0);
  EXPECT_NE(probe.local_socket, 0);
  EXPECT_NE(probe.open_file, 0);
  EXPECT_NE(probe.create_file, 0);
  EXPECT_NE(probe.duplicate, 0);
  EXPECT_NE(probe.raise_time, 0);
  EXPECT_NE(probe.raise_files, 0);
  EXPECT_NE(probe.inherited_descriptor, 0);
}

TEST(Confinement, LetsAProcessDoNothingButCompute) {
  const Tried tried = try_everything();
  EXPECT_EQ(tried.barriers.limits, 0);
  expect_nothing_works(tried.probe);
  if (tried.barriers.filter == Barriers::kNotBuilt) {
    EXPECT_NE(tried.barriers.problem().find("libseccomp"), std::string::npos);
    return;
  }
  EXPECT_TRUE(tried.barriers.is_confined()) << tried.barriers.problem();
  EXPECT_EQ(tried.barriers.problem(), "");
  for (const int error :
       {tried.probe.unlink_file, tried.probe.execute, tried.probe.start_process, tried.probe.signal_parent,
        tried.probe.trace_parent, tried.probe.executable_memory, tried.probe.read_pipe}) {
    EXPECT_EQ(error, EPERM);
  }
}

TEST(Confinement, HoldsFilesAndLimitsWithoutAFilter) {
  EXPECT_TRUE(holds_where_refused(kFilterCalls, EPERM, [] {
    const Tried tried = try_everything();
    EXPECT_EQ(tried.barriers.limits, 0);
    EXPECT_NE(tried.barriers.filter, 0);
    EXPECT_FALSE(tried.barriers.is_confined());
    EXPECT_FALSE(tried.barriers.problem().empty());
    expect_nothing_works(tried.probe);
    if (tried.barriers.landlock == 0) {
      EXPECT_EQ(tried.probe.execute, EACCES);
      EXPECT_EQ(tried.probe.unlink_file, EACCES);
    }
  }));
}

TEST(Confinement, HoldsByTheFilterWithoutLandlock) {
  EXPECT_TRUE(holds_where_refused(kLandlockCalls, ENOSYS, [] {
    const Tried tried = try_everything();
    EXPECT_EQ(tried.barriers.landlock, ENOSYS);
    expect_nothing_works(tried.probe);
    if (tried.barriers.filter != Barriers::kNotBuilt) {
      EXPECT_TRUE(tried.barriers.is_confined());
      EXPECT_EQ(tried.probe.execute, EPERM);
      EXPECT_EQ(tried.probe.unlink_file, EPERM);
    }
  }));
}

/// A page that others see change; `file`, where there is one, is behind it.
void* shared_page(int rights, int file) {
  void* const page = ::mmap(nullptr, 4096, rights, MAP_SHARED | (file < 0 ? MAP_ANONYMOUS : 0), file, 0);
  EXPECT_NE(page, MAP_FAILED);
  return page;
}

// Ranks of MPI share memory with each other, and a forked reader inherited it.
TEST(Confinement, LeavesNoMemoryThatOthersShare) {
  const TemporaryFolder folder;
  const std::string name = folder.file("shared", std::string(4096, 'x')).string();
  const int both = ::open(name.c_str(), O_RDWR | O_CLOEXEC), only_read = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  void* const writable = shared_page(PROT_READ | PROT_WRITE, -1);
  void* const of_file = shared_page(PROT_READ | PROT_WRITE, both);
  void* const may_become = shared_page(PROT_READ, both);  // mprotect would make it writable
  void* const never = shared_page(PROT_READ, only_read);
  // The kernel reads the page that is to be written: EFAULT, where there is none.
  struct Seen {
    int writable, of_file, may_become, become, never;
  } seen{};
  ConfinedProcess process(kLimits, Confining::as_far_as_possible, [&] {
    std::array<int, 4> errors{};
    std::size_t k = 0;
    for (void* const page : {writable, of_file, may_become, never}) {
      errors[k++] = error_of(::write(kConfinedDescriptor, page, 1));
    }
    const Seen result{errors[0], errors[1], errors[2], error_of(::mprotect(may_become, 4096, PROT_READ | PROT_WRITE)),
                      errors[3]};
    static_cast<void>(!::write(kConfinedDescriptor, &result, sizeof result));
    ::_exit(0);
  });
  EXPECT_EQ(process.barriers().memory, 0);
  char byte = 0;  // of the page that nobody can write to
  EXPECT_EQ(process.read(&byte, 1), 1u);
  ASSERT_EQ(process.read(&seen, sizeof seen), sizeof seen);
  EXPECT_EQ(seen.writable, EFAULT);
  EXPECT_EQ(seen.of_file, EFAULT);
  EXPECT_EQ(seen.may_become, EFAULT);
  EXPECT_EQ(seen.become, ENOMEM);
  EXPECT_EQ(seen.never, 0);
  // And as the kernel lists it, of a process that gave up what it shares.
  std::vector<SharedMapping> before;
  EXPECT_EQ(shared_mappings(&before), 0);
  EXPECT_GE(before.size(), 3u);
  const pid_t child = ::fork();
  if (child == 0) {
    std::vector<SharedMapping> after;
    ::_exit(give_up_shared_memory() == 0 && shared_mappings(&after) == 0 && after.empty() ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  std::memcpy(writable, "there", 5);  // in this process it still is
  for (void* const page : {writable, of_file, may_become, never}) ::munmap(page, 4096);
  ::close(both);
  ::close(only_read);
}

/// Whether `work` was begun.
bool begins(Confining confining) {
  ConfinedProcess process(kLimits, confining, [] {
    static_cast<void>(!::write(kConfinedDescriptor, "x", 1));
    ::_exit(0);
  });
  char byte = 0;
  return process.read(&byte, 1) == 1;
}

TEST(Confinement, LetsNothingBeginWithoutWhatIsRequired) {
  EXPECT_TRUE(begins(Confining::as_far_as_possible));
  EXPECT_TRUE(holds_where_refused(kFilterCalls, EPERM, [] {
    EXPECT_TRUE(begins(Confining::as_far_as_possible));
    EXPECT_FALSE(begins(Confining::required));
  }));
  EXPECT_TRUE(holds_where_refused(kLimitCalls, EPERM, [] {  // limits are always required
    EXPECT_FALSE(begins(Confining::as_far_as_possible));
    EXPECT_FALSE(begins(Confining::required));
  }));
}

TEST(ConfinedProcess, ThatIsStoppedEndsByTheClockOnTheWall) {
  const auto start = std::chrono::steady_clock::now();
  ConfinedProcess process({5, 256 * kMiB, 1}, Confining::as_far_as_possible, [] {
    while (true) ::raise(SIGSTOP);
  });
  char byte = 0;
  EXPECT_EQ(process.read(&byte, 1), 0U);
  const ProcessEnd end = process.end();
  EXPECT_TRUE(end.was_too_slow);
  EXPECT_TRUE(end.was_killed_here);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(ConfinedProcess, ThatSendsAByteNowAndThenEndsByTheSameClock) {
  ConfinedProcess process({5, 256 * kMiB, 1}, Confining::as_far_as_possible, [] {
    const auto is_over = [begin = std::chrono::steady_clock::now()](double seconds) {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > seconds;
    };
    for (double next = 0.0; true; next += 0.1) {
      while (!is_over(next)) {
      }
      static_cast<void>(!::write(kConfinedDescriptor, "x", 1));
    }
  });
  std::string bytes(1000, '\0');
  EXPECT_LT(process.read(bytes.data(), bytes.size()), 100U);
  EXPECT_TRUE(process.end().was_too_slow);
}

TEST(ConfinedProcess, ThatHeedsNoSignalMeetsTheHardLimitOnItsTime) {
  // A second before the soft limit: a limit of none would strike before the child ignores its signal.
  ConfinedProcess process({1, 256 * kMiB, 60}, Confining::as_far_as_possible, [] {
    std::signal(SIGXCPU, SIG_IGN);
    for (std::atomic<unsigned> n = 0; true; ++n) {
    }
  });
  char byte = 0;
  EXPECT_EQ(process.read(&byte, 1), 0U);
  const ProcessEnd end = process.end();
  ASSERT_TRUE(WIFSIGNALED(end.status));
  EXPECT_EQ(WTERMSIG(end.status), SIGKILL);
  EXPECT_FALSE(end.was_killed_here);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ConfinedProcess, GetsNoMoreMemoryThanItsLimit) {
  ConfinedProcess process(kLimits, Confining::as_far_as_possible, [] {
    char answer = 'n';
    try {
      std::string large(512 * kMiB, 'x');
      answer = large[1000] == 'x' ? 'y' : 'n';
    } catch (const std::bad_alloc&) {
      answer = 'b';
    }
    static_cast<void>(!::write(kConfinedDescriptor, &answer, 1));
    ::_exit(0);
  });
  char answer = 0;
  EXPECT_EQ(process.read(&answer, 1), 1U);
  EXPECT_EQ(answer, 'b');
}
#endif

}  // namespace
}  // namespace vex::tests
