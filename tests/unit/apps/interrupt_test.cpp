#include "apps/common/interrupt.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "apps/common/replace_file.h"

namespace vex {
namespace {

void wait_until_the_next_one_counts() { poll(nullptr, 0, 250); }

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
        std::raise(SIGINT);
        wait_until_the_next_one_counts();
        {
          const EndHeldBack held;
          std::raise(SIGINT);
          std::fprintf(stderr, "the file is in place\n");
        }
        std::fprintf(stderr, "never\n");
        std::exit(0);
      },
      testing::ExitedWithCode(128 + SIGINT), "^the file is in place\n$");
}

// One of four was lost by a run that saved itself on a slow disk: the signal was ignored as long as a file was written.
TEST(Interrupt, WhatSomebodySendsWhileAFileIsWrittenCounts) {
  EXPECT_EXIT(
      {
        end_on_interrupts("program");
        catch_interrupts();
        const pid_t program = getpid();
        const std::string file = testing::TempDir() + "vex_written_" + std::to_string(program);
        if (fork() == 0) {
          poll(nullptr, 0, 5);
          kill(program, SIGXFSZ);
          _exit(0);
        }
        const std::string text(std::size_t{1} << 24, 'x');
        for (int k = 0; k < 20 && interrupting_signal().load() == 0; ++k) replace_file(file, text);
        wait(nullptr);
        unlink(file.c_str());
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
