// A program as a child process, in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vex::golden {

/// What a finished program left.
struct Finished {
  int exit_code = -1;  // 128 + signal where a signal ended it, as shells say; kHung where it had to be killed
  std::string out, err;
  double seconds = 0.0;
};
inline constexpr int kHung = -2;

using Words = std::vector<std::string>;

/// Seconds after which a program counts as hung; generous, because builds with sanitizers are slow.
inline constexpr double kTimeLimit = 120.0;

/// For the shell: waits until `$program` handles SIGUSR1, as all programs do from their first steps on, or a minute. A
/// signal that comes before that ends a program as it ends any other, and a busy machine takes its time.
inline const std::string kUntilItTakesSignals =
    "for k in $(seq 1200); do grep -qs '^SigCgt:.*[2367abef]..$' /proc/$program/status && break; sleep 0.05; done; ";

/// A test in an empty folder, which is the program's working folder and is gone afterwards.
class ProgramTest : public testing::Test {
 protected:
  /// Of vex_mesh, or another program of this build.
  explicit ProgramTest(std::string program = VEX_MESH_PROGRAM);
  ~ProgramTest() override;

  const std::filesystem::path& folder() const { return folder_; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write_file(const std::string& name, const std::string& content) const;
  std::string read_file(const std::string& name) const;
  /// The names of all files in the folder, sorted.
  std::vector<std::string> files() const;

  /// Runs the program to its end.
  Finished run(const Words& words) const;

  /// Starts the program, waits until `ready(process)`, sends the signal, and waits for the end; `seconds` counts from
  /// the signal.
  Finished run_and_signal(const Words& words, int signal, const std::function<bool(pid_t)>& ready) const;

  /// Runs it where the system refuses every further thread, as filters of system calls do that know no clone3.
  Finished run_without_threads(const Words& words) const;

  /// A line of the shell, in which "$VEX" is the program.
  Finished shell(const std::string& line) const;

  /// The program on a terminal of so many columns; `out` is all that the terminal receives.
  Finished run_on_terminal(const Words& words, unsigned short columns) const;

  /// Runs `program words --json -`, expects success, and gives the document.
  nlohmann::json json_of(Words words) const;

 private:
  Words with_program(const Words& words) const;

  std::string program_;
  std::filesystem::path folder_;
};

/// Cases that go through much the same lines with other numbers. Under a sanitizer, which looks at lines, and where
/// programs take ten times as long, every third of them.
template <class Case>
std::vector<Case> alike(std::vector<Case> cases) {
#ifdef VEX_SANITIZED
  for (std::size_t k = 0; 3 * k < cases.size(); ++k) std::swap(cases[k], cases[3 * k]);
  cases.resize((cases.size() + 2) / 3);
#endif
  return cases;
}

/// The names of the backends that this build has, the engine's own first.
std::vector<std::string> backends_of_this_build();

/// Before a line of the shell: root is then held to the permissions of its own files, as everybody else is.
extern const std::string kWithoutOverride;

/// The program runs trials: it has threads beside its main one. (Three: the thread sanitizer has one of its own.)
bool has_worker_threads(pid_t process);
/// The program has set a handler of SIGINT.
bool catches_interrupts(pid_t process);

/// Exit code, an empty standard output, and one line "vex_mesh: problem (where, which value) - what to do".
void expect_refusal(const Finished& finished, int exit_code, const std::string& part_of_message,
                    const std::string& program = "vex_mesh");

}  // namespace vex::golden
