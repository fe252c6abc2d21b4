#include "tests/golden/program.h"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pty.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace vex::golden {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void pause_briefly() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

std::string content_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<char*> pointers(Words& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

/// The exit code as a shell gives it, or kHung after the time limit, when the process is killed.
int wait_for(pid_t process) {
  const Clock::time_point start = Clock::now();
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    if (seconds_since(start) > kTimeLimit) {
      kill(process, SIGKILL);
      waitpid(process, &status, 0);
      return kHung;
    }
    pause_briefly();
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// For this process and those it starts, with an error that glibc does not take for a missing call.
bool refuse_threads() {
  constexpr unsigned kRefused = SECCOMP_RET_ERRNO | EPERM;
  constexpr unsigned kNumber = offsetof(seccomp_data, nr), kFlags = offsetof(seccomp_data, args);
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kNumber),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_clone3, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_clone, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kFlags),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, kRefused),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog program = {sizeof filter / sizeof filter[0], filter};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

/// A child whose output goes into two files beside the folder it works in.
class Child {
 public:
  explicit Child(Words words, const fs::path& folder, bool may_start_threads = true) : base_(folder.string()) {
    std::vector<char*> arguments = pointers(words);
    id_ = fork();
    if (id_ != 0) return;
    const int in = open("/dev/null", O_RDONLY);
    const int out = open((base_ + ".out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err = open((base_ + ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    for (const int extra : {in, out, err}) close(extra);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE}) signal(number, SIG_DFL);
    if (chdir(folder.c_str()) != 0) _exit(126);
    if (!may_start_threads && !refuse_threads()) _exit(125);
    execv(arguments[0], arguments.data());
    _exit(127);
  }

  pid_t id() const { return id_; }

  Finished finish() const {
    const Clock::time_point start = Clock::now();
    Finished finished;
    finished.exit_code = wait_for(id_);
    finished.seconds = seconds_since(start);
    finished.out = content_of(base_ + ".out");
    finished.err = content_of(base_ + ".err");
    fs::remove(base_ + ".out");
    fs::remove(base_ + ".err");
    return finished;
  }

 private:
  std::string base_;
  pid_t id_ = -1;
};

}  // namespace

const std::string kWithoutOverride =
    geteuid() == 0 ? "exec setpriv --bounding-set -dac_override,-dac_read_search " : "";

ProgramTest::ProgramTest(std::string program) : program_(std::move(program)) {
  std::string name = (fs::temp_directory_path() / "vex_golden_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder could be made");
  folder_ = name;
  setenv("VEX", program_.c_str(), 1);
}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  fs::permissions(folder_, fs::perms::owner_all, ignored);
  fs::remove_all(folder_, ignored);
}

Words ProgramTest::with_program(const Words& words) const {
  Words all = {program_};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

void ProgramTest::write_file(const std::string& name, const std::string& content) const {
  std::ofstream file(folder_ / name, std::ios::binary);
  file << content << std::flush;
  if (!file) throw std::runtime_error("a test's file could not be written");
}

std::string ProgramTest::read_file(const std::string& name) const { return content_of(folder_ / name); }

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

Finished ProgramTest::run(const Words& words) const { return Child(with_program(words), folder_).finish(); }

Finished ProgramTest::run_without_threads(const Words& words) const {
  return Child(with_program(words), folder_, false).finish();
}

Finished ProgramTest::run_and_signal(const Words& words, int signal, const std::function<bool(pid_t)>& ready) const {
  const Child child(with_program(words), folder_);
  const Clock::time_point start = Clock::now();
  while (!ready(child.id()) && seconds_since(start) < kTimeLimit) pause_briefly();
  kill(child.id(), signal);
  return child.finish();
}

Finished ProgramTest::shell(const std::string& line) const { return Child({"/bin/sh", "-c", line}, folder_).finish(); }

Finished ProgramTest::run_on_terminal(const Words& words, unsigned short columns) const {
  Words all = with_program(words);
  std::vector<char*> arguments = pointers(all);
  struct winsize size = {};
  size.ws_row = 24;
  size.ws_col = columns;
  int terminal = -1;
  const Clock::time_point start = Clock::now();
  const pid_t process = forkpty(&terminal, nullptr, nullptr, &size);
  if (process == 0) {
    if (chdir(folder_.c_str()) != 0) _exit(126);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  Finished finished;
  char buffer[4096];
  ssize_t n = 0;
  while ((n = read(terminal, buffer, sizeof buffer)) > 0) finished.out.append(buffer, static_cast<std::size_t>(n));
  close(terminal);
  finished.exit_code = wait_for(process);
  finished.seconds = seconds_since(start);
  return finished;
}

nlohmann::json ProgramTest::json_of(Words words) const {
  words.insert(words.end(), {"--json", "-"});
  const Finished finished = run(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  nlohmann::json json = nlohmann::json::parse(finished.out, nullptr, false);
  EXPECT_TRUE(json.is_object()) << finished.out;
  return json;
}

bool has_worker_threads(pid_t process) {
  std::error_code error;
  const auto threads = fs::directory_iterator("/proc/" + std::to_string(process) + "/task", error);
  return !error && std::distance(begin(threads), end(threads)) >= 3;
}

bool catches_interrupts(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) == 0) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0;
  }
  return false;
}

std::vector<std::string> backends_of_this_build() {
  std::vector<std::string> names = {"gjk"};
#ifdef VEX_WITH_CCD
  names.insert(names.end(), {"ccd-gjk", "ccd-mpr"});
#endif
#ifdef VEX_WITH_FCL
  names.emplace_back("fcl");
#endif
  names.emplace_back("specialised");
  return names;
}

void expect_refusal(const Finished& finished, int exit_code, const std::string& part_of_message,
                    const std::string& program) {
  EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
  EXPECT_EQ(finished.out, "");
  EXPECT_EQ(finished.err.rfind(program + ": ", 0), 0u) << finished.err;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_NE(finished.err.find(" - "), std::string::npos) << "what to do is missing: " << finished.err;
  EXPECT_NE(finished.err.find(part_of_message), std::string::npos)
      << "\"" << part_of_message << "\" is missing: " << finished.err;
}

}  // namespace vex::golden
