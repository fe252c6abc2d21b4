// Ctrl-C and termination: what was done is reported, soon.
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

constexpr double kSoon = 10.0;  // a tenth of a second is usual; this only tells a stop from a hang on a busy machine

class Interrupt : public ProgramTest {
 protected:
  /// Interrupts a run that would never end after some tenths of a second of it.
  Finished interrupted(Words words, int signal) const {
    words.insert(words.end(), {"--rel-error", "1e-12", "--threads", "2"});
    return run_and_signal(words, signal, [](pid_t process) {
      if (!has_worker_threads(process)) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      return true;
    });
  }

  static void expect_partial(const json& document) {
    expect_partial_or_nothing(document);
    ASSERT_TRUE(document.is_object());
    EXPECT_GT(document.at("estimate").at("trials"), 0);
  }

  /// Of a large mesh, whose table of directions comes before the first trial.
  static void expect_partial_or_nothing(const json& document) {
    ASSERT_TRUE(document.is_object());
    EXPECT_EQ(document.at("complete"), false);
    const json& estimate = document.at("estimate");
    if (estimate.at("trials") == 0) {
      EXPECT_TRUE(estimate.at("std_error").is_null());
    } else {
      EXPECT_GT(estimate.at("std_error"), 0.0);
    }
    std::uint64_t decided = 0;
    for (const json& n : estimate.at("decided_by")) decided += n.get<std::uint64_t>();
    EXPECT_EQ(decided + estimate.at("undecided").get<std::uint64_t>(), estimate.at("trials").get<std::uint64_t>());
  }
};

TEST_F(Interrupt, ReportsWhatWasDone) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const Finished finished = interrupted({"box:1,1,1", "--json", "result.json", "--estimator", "hit-or-miss"}, signal);
    EXPECT_EQ(finished.exit_code, code) << finished.err;
    EXPECT_LT(finished.seconds, kSoon);
    EXPECT_NE(finished.out.find("interrupted"), std::string::npos) << finished.out;
    EXPECT_NE(finished.out.find("hits / trials"), std::string::npos) << finished.out;
    EXPECT_TRUE(finished.err.starts_with("vex_mesh: hit-or-miss will take about ")) << finished.err;
    expect_partial(json::parse(read_file("result.json"), nullptr, false));
    EXPECT_EQ(files(), std::vector<std::string>{"result.json"});
  }
}

TEST_F(Interrupt, WritesTheDocumentToStandardOutput) {
  const Finished finished =
      interrupted({"box:1,1,1", "ellipsoid:1,2,3", "--json", "-", "--estimator", "hit-or-miss"}, SIGTERM);
  EXPECT_EQ(finished.exit_code, 143);
  expect_partial(json::parse(finished.out, nullptr, false));
}

TEST_F(Interrupt, ThePartialHitsAreThoseOfTheFirstTrials) {
  const Finished finished = interrupted({"box:1,1,2", "--json", "-", "--estimator", "hit-or-miss"}, SIGINT);
  const json partial = json::parse(finished.out, nullptr, false);
  expect_partial(partial);
  const std::string trials = std::to_string(partial.at("estimate").at("trials").get<std::uint64_t>());
  EXPECT_EQ(json_of({"box:1,1,2", "--trials", trials, "--estimator", "hit-or-miss"}).at("estimate").at("hits"),
            partial.at("estimate").at("hits"));
}

TEST_F(Interrupt, AnswersSoonWithAHeavyMesh) {
  write_file("sphere.obj", sphere_obj(100, 150));
  const Finished finished = interrupted(
      {"sphere.obj", "box:1,1,1", "--no-quick-verdicts", "--json", "-", "--estimator", "hit-or-miss"}, SIGINT);
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, kSoon);
  expect_partial_or_nothing(json::parse(finished.out, nullptr, false));
}

TEST_F(Interrupt, AnswersSoonWhileTheEstimatorIsChosen) {
  write_file("sphere.obj", sphere_obj(100, 150));
  const Finished finished = interrupted({"sphere.obj", "box:1,1,1", "--json", "-"}, SIGINT);
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, kSoon);
  const json document = json::parse(finished.out, nullptr, false);
  ASSERT_TRUE(document.is_object()) << finished.out;
  EXPECT_EQ(document.at("complete"), false);  // of how many trials depends on how far it came
}

TEST_F(Interrupt, AnswersSoonWhileBackendsAreCompared) {
  write_file("sphere.obj", sphere_obj(60, 90));
  const Finished finished = interrupted({"sphere.obj", "box:1,1,1", "--cross-check", "--json", "-"}, SIGTERM);
  EXPECT_EQ(finished.exit_code, 143) << finished.err;
  EXPECT_LT(finished.seconds, kSoon);
  const json document = json::parse(finished.out, nullptr, false);
  expect_partial_or_nothing(document);
  EXPECT_TRUE(document.at("disagreements").is_array());
}

TEST_F(Interrupt, EndsTheLoadingOfAMesh) {
  write_file("sphere.obj", sphere_obj(200, 300));
  const Finished finished =
      run_and_signal({"sphere.obj", "--rel-error", "1e-12", "--json", "result.json"}, SIGINT, catches_interrupts);
  EXPECT_EQ(finished.exit_code, 130);
  EXPECT_LT(finished.seconds, kSoon);
  // Where the machine was so slow to send it that the run had begun, its report says so.
  EXPECT_NE((finished.out + finished.err).find("interrupted"), std::string::npos);
  if (finished.out.empty()) {
    EXPECT_EQ(files(), std::vector<std::string>{"sphere.obj"});
  }
}

TEST_F(Interrupt, AnIgnoredInterruptStaysIgnored) {
  const Finished finished =
      shell("trap '' INT; \"$VEX\" box:1,1,1 --seconds 1 --estimator hit-or-miss & sleep 0.5; kill -INT $!; wait $!");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("hits / trials"), std::string::npos);
}

}  // namespace
}  // namespace vex::golden
