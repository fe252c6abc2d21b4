#include "apps/common/interrupt.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "apps/common/replace_file.h"

namespace vex {
namespace {

void wait_until_the_next_one_counts() { poll(nullptr, 0, 250); }

void wait_for_a_signal() {
  for (int k = 0; k < 5000 && interrupting_signal().load() == 0; ++k) poll(nullptr, 0, 1);
}

TEST(Interrupt, TheFirstIsRememberedAndTheSecondEndsTheProgram) {
  EXPECT_EXIT(
      {
        end_on_interrupts("program");
        catch_interrupts();
        std::raise(SIGHUP);
        std::raise(SIGTERM);  // at once: the same wish
        std::fprintf(stderr, "%d\n", interrupting_signal().load());
        wait_until_the_next_one_counts();
        std::raise(SIGXCPU);  // which comes again every second
        std::fprintf(stderr, "still here\n");
        std::raise(SIGTERM);
        std::fprintf(stderr, "never\n");
        std::exit(0);
      },
      testing::ExitedWithCode(128 + SIGTERM), "^1\nstill here\n$");
}

TEST(Interrupt, TheEndWaitsWhileAFileWouldBeLeftBehind) {
  EXPECT_EXIT(
      {
        end_on_interrupts("program");
        catch_interrupts();
        std::raise(SIGTERM);
        wait_until_the_next_one_counts();
        {
          const EndHeldBack held;
          std::raise(SIGTERM);
          std::fprintf(stderr, "the file is in place\n");
        }
        std::fprintf(stderr, "never\n");
        std::exit(0);
      },
      testing::ExitedWithCode(128 + SIGTERM), "^the file is in place\n$");
}

// Some were lost by runs that saved themselves on a slow disk: the signal was ignored as long as a file was written,
// and threads that do not write took it meanwhile.
TEST(Interrupt, WhatSomebodySendsWhileAFileIsWrittenCounts) {
  EXPECT_EXIT(
      {
        end_on_interrupts("program");
        catch_interrupts();
        const pid_t program = getpid();
        if (fork() == 0) {
          poll(nullptr, 0, 5);
          kill(program, SIGXFSZ);
          _exit(0);
        }
        std::thread([] { wait_for_a_signal(); }).detach();
        const std::string file = testing::TempDir() + "vex_written_" + std::to_string(program);
        const std::string text(std::size_t{1} << 24, 'x');
        for (int k = 0; k < 20 && interrupting_signal().load() == 0; ++k) replace_file(file, text);
        unlink(file.c_str());
        wait(nullptr);
        wait_for_a_signal();
        std::exit(interrupting_signal().load());
      },
      testing::ExitedWithCode(SIGXFSZ), "");
}

TEST(Interrupt, AQuestionIsAnsweredOnce) {
  EXPECT_EXIT(
      {
        end_on_interrupts("program");
        std::raise(SIGUSR1);
        catch_interrupts();
        const auto answer = [] { answer_if_asked([] { return std::string("half"); }); };
        answer();
        std::raise(SIGUSR1);
        answer();
        answer();
        std::exit(interrupting_signal().load());
      },
      testing::ExitedWithCode(0), "^program: bodies are being loaded, the run has not begun\nprogram: half\n$");
}

}  // namespace
}  // namespace vex
