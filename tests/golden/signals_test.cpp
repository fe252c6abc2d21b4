// Signals besides Ctrl-C: those that schedulers, limits and terminals send end a run as SIGTERM does, with its report;
// SIGUSR1 asks how far it is.
#include <sys/resource.h>

#include <csignal>
#include <sstream>
#include <thread>
#include <tuple>

#include "tests/golden/pair.h"
#include "tests/golden/program.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

const std::string kEndless = "\"$VEX\" box:1,1,1 --rel-error 1e-12 --estimator hit-or-miss --threads 1 ";

class Signals : public ProgramTest {
 protected:
  json document(const std::string& name = "result.json") const { return json::parse(read_file(name), nullptr, false); }
  static std::string signalled(const std::string& line, const std::string& signals) {
    return line + " & program=$!; " + kUntilItTakesSignals + "sleep 0.2; " + signals + "wait $program";
  }
};

TEST_F(Signals, EndARunWithItsReport) {
  for (const int signal : {SIGHUP, SIGUSR2, SIGXCPU, SIGXFSZ}) {
    SCOPED_TRACE(signal);
    const Finished finished =
        run_and_signal({"box:1,1,1", "--rel-error", "1e-12", "--estimator", "hit-or-miss", "--json", "result.json"},
                       signal, [](pid_t process) {
                         if (!has_worker_threads(process)) return false;
                         std::this_thread::sleep_for(std::chrono::milliseconds(100));
                         return true;
                       });
    EXPECT_EQ(finished.exit_code, 128 + signal) << finished.err;
    EXPECT_NE(finished.out.find("interrupted"), std::string::npos) << finished.out;
    ASSERT_TRUE(document().is_object());
    EXPECT_EQ(document().at("complete"), false);
    EXPECT_GT(document().at("estimate").at("trials"), 0);
    EXPECT_EQ(files(), std::vector<std::string>{"result.json"}) << "and nothing beside it";
  }
}

TEST_F(Signals, OfEveryProgram) {
  const std::string pair = VEX_PAIR_PROGRAM, paper = VEX_PAPER_PROGRAM, bench = VEX_BENCH_PROGRAM,
                    stress = VEX_STRESS_PROGRAM, scene = VEX_SCENE_PROGRAM, percolate = VEX_PERCOLATE_PROGRAM;
  for (const std::string& line : {paper + " --table 1 --trials 1e9 --threads 1", bench + " --seconds 10 --threads 1",
                                  stress + " --pairs 1e7 --threads 1",
                                  percolate + " box:1,1,1 --sizes 10,20 --realisations 100000 --threads 1"}) {
    SCOPED_TRACE(line);
    // The answer comes with the next look at the run: it is waited for.
    const Finished finished = shell(signalled(line + " --quiet --json result.json 2> told",
                                              "kill -USR1 $program; for k in $(seq 200); do [ -s told ] && break; "
                                              "sleep 0.05; done; kill -HUP $program; ") +
                                    "; code=$?; cat told >&2; exit $code");
    EXPECT_EQ(finished.exit_code, 129) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << "an answer: " << finished.err;
    EXPECT_EQ(finished.err.rfind("vex_", 0), 0u) << finished.err;
    EXPECT_EQ(document().at("complete"), false);
  }
}

TEST_F(Signals, OfProgramsThatWaitForTheirInput) {
  write_file("poses.csv", kQuaternionHeader);
  write_file("scene.csv", kSceneHeader);
  const std::string pair = VEX_PAIR_PROGRAM, scene = VEX_SCENE_PROGRAM;
  for (const auto& [input, line, answer] :
       {std::tuple{"poses.csv", pair + " box:1,1,1 sphere:1 --poses pipe --quiet", "vex_pair: 0 poses answered\n"},
        std::tuple{"scene.csv", scene + " pipe --quiet", "vex_scene: 0 lines read"}}) {
    SCOPED_TRACE(line);
    const Finished finished =
        shell("mkfifo pipe; exec 3<> pipe; cat " + std::string(input) + " >&3; " +
              signalled(line + " --json result.json", "kill -USR1 $program; sleep 0.2; kill -USR2 $program; ") +
              "; code=$?; rm pipe; exit $code");
    EXPECT_NE(finished.err.find(answer), std::string::npos) << finished.err;
    EXPECT_EQ(finished.exit_code, 140);
    EXPECT_EQ(document().at("complete"), false);
  }
}

TEST_F(Signals, AQuestionIsAnsweredAndTheRunGoesOn) {
  std::string ask;
  for (const std::string line : {"1", "2"})
    ask += "kill -USR1 $program; until [ $(wc -l < told) = " + line + " ]; do sleep 0.05; done; ";
  const Finished finished =
      shell(signalled(kEndless + "--quiet --json result.json 2> told", ask + "kill -HUP $program; "));
  EXPECT_EQ(finished.exit_code, 129);
  EXPECT_EQ(document().at("complete"), false);
  std::istringstream told(read_file("told"));
  double before = 0.0;
  for (std::string line; std::getline(told, line);) {
    EXPECT_EQ(line.rfind("vex_mesh: ", 0), 0u) << line;
    const std::size_t end = line.find(" trials ");
    ASSERT_NE(end, std::string::npos) << line;
    const double trials = std::stod(line.substr(line.rfind("  ", end)));
    EXPECT_GT(trials, before) << line;
    before = trials;
  }
}

TEST_F(Signals, OneThatIsIgnoredStaysIgnored) {
  const Finished finished =
      shell("trap '' HUP USR2; " + signalled("\"$VEX\" box:1,1,1 --seconds 0.4 --estimator hit-or-miss --threads 1",
                                             "kill -HUP $program; kill -USR2 $program; "));
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
}

// timeout sends its signal twice, to the program and to its group; a terminal that closes and its shell do likewise.
TEST_F(Signals, TheSameOneTwiceAtOnceIsOne) {
  for (int k = 0; k < 2; ++k) {
    const Finished finished = shell(signalled(kEndless + "--quiet --json result" + std::to_string(k) + ".json",
                                              "kill -HUP $program; kill -TERM $program; kill -HUP $program; "));
    EXPECT_TRUE(finished.exit_code == 129 || finished.exit_code == 143) << finished.exit_code;
    EXPECT_TRUE(document("result" + std::to_string(k) + ".json").is_object());
  }
  // SIGALRM is what timeout's clock sends it: so its time is up once the run has begun, however slow the machine.
  EXPECT_EQ(shell("timeout 1000 " + kEndless +
                  "--quiet --json timed.json & clock=$!; until [ \"$program\" ]; do sleep 0.05; "
                  "read -r program < /proc/$clock/task/$clock/children; done; " +
                  kUntilItTakesSignals + "sleep 0.2; kill -ALRM $clock; wait $clock")
                .exit_code,
            124);
  ASSERT_TRUE(document("timed.json").is_object());
  EXPECT_EQ(document("timed.json").at("complete"), false);
}

TEST_F(Signals, ALimitOnProcessorTimeEndsARunWithItsReport) {
  const Finished finished = shell(
      "ulimit -S -t 1; exec \"$VEX\" box:1,1,1 --rel-error 1e-12 --estimator hit-or-miss --threads 2 --quiet --json "
      "result.json");
  EXPECT_EQ(finished.exit_code, 128 + SIGXCPU) << finished.err;
  EXPECT_EQ(document().at("complete"), false);
  EXPECT_GT(document().at("estimate").at("trials"), 0);
}

TEST_F(Signals, WhileABodyIsLoadedTheyEndTheProgram) {
  const std::string loading = "mkfifo pipe; exec 3<> pipe; " +
                              signalled("\"$VEX\" - --format obj --json result.json < pipe",
                                        "kill -USR1 $program; sleep 0.1; kill -HUP $program; ") +
                              "; code=$?; rm pipe; exit $code";
  const Finished finished = shell(loading);
  EXPECT_EQ(finished.exit_code, 129);
  EXPECT_NE(finished.err.find("vex_mesh: bodies are being loaded"), std::string::npos) << finished.err;
  EXPECT_NE(finished.err.find("interrupted before there was a result"), std::string::npos) << finished.err;
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace vex::golden
