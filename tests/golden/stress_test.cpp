// vex_stress: its table, its document, its picture, its refusals, and Ctrl-C.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Stress : public ProgramTest {
 protected:
  Stress() : ProgramTest(VEX_STRESS_PROGRAM) {}
};

TEST_F(Stress, EveryStratumIsThereWithEveryBackend) {
  const json document =
      json_of({"--pairs", "30", "--stratum", "random", "--stratum", "contact", "--stratum", "parallel", "--stratum",
               "touching", "--stratum", "symmetric", "--stratum", "far-from-origin", "--stratum", "cases"});
  for (const char* const key : {"version", "stream_version", "command", "seed", "threads", "complete", "seconds"}) {
    EXPECT_TRUE(document.contains(key)) << key;
  }
  EXPECT_EQ(document.at("complete"), true);
  ASSERT_GE(document.at("strata").size(), 50u);
  for (const json& stratum : document.at("strata")) {
    SCOPED_TRACE(stratum.at("name").dump());
    EXPECT_FALSE(stratum.at("bodies").get<std::string>().empty());
    EXPECT_EQ(stratum.at("pairs"), 30);
    EXPECT_LE(stratum.at("unjudged"), 1);
    for (const auto& [name, counts] : stratum.at("backends").items()) {
      EXPECT_EQ(counts.at("wrong"), counts.at("missed").get<int>() + counts.at("invented").get<int>()) << name;
      EXPECT_LE(counts.at("wrong").get<int>() + counts.at("undecided").get<int>(), counts.at("pairs").get<int>());
      EXPECT_GE(counts.at("escalated"), counts.at("undecided"));
      EXPECT_LE(counts.at("undecided_beyond_band"), counts.at("undecided"));
      EXPECT_LE(counts.at("capped"), counts.at("undecided"));
      EXPECT_GT(counts.at("slowest_us"), 0.0);
      EXPECT_EQ(counts.at("first_wrong").is_null(), counts.at("wrong") == 0);
    }
    EXPECT_EQ(stratum.at("backends").at("gjk").at("pairs"), 30);
    for (const char* const fault : {"wrong", "undecided_beyond_band", "capped", "unproven"}) {
      EXPECT_EQ(stratum.at("backends").at("gjk").at(fault), 0) << fault;
    }
  }
  for (const std::string& backend : backends_of_this_build()) {
    if (backend != "specialised") {
      EXPECT_TRUE(document.at("strata").at(0).at("backends").contains(backend)) << backend;
    }
    EXPECT_TRUE(document.at("total").contains(backend)) << backend;
  }
}

TEST_F(Stress, TheSameCountsForAnyNumberOfThreads) {
  const auto counts = [this](const char* threads) {
    json document = json_of(
        {"--pairs", "50", "--threads", threads, "--backend", "gjk", "--stratum", "parallel", "--stratum", "feature"});
    for (json& stratum : document.at("strata")) stratum.at("backends").at("gjk").erase("slowest_us");
    return document.at("strata");
  };
  EXPECT_EQ(counts("1"), counts("2"));
}

TEST_F(Stress, AnotherSeedIsAnotherSample) {
  const auto overlaps = [this](const char* seed) {
    json all = json::array();
    const json document = json_of({"--pairs", "100", "--seed", seed, "--stratum", "random"});
    for (const json& stratum : document.at("strata")) {
      all.push_back(stratum.at("overlaps"));
    }
    return all;
  };
  EXPECT_EQ(overlaps("1").size(), 4u);
  EXPECT_EQ(overlaps("1"), overlaps("1"));
  EXPECT_NE(overlaps("1"), overlaps("2"));
}

TEST_F(Stress, ABackendByNameComesBesideTheEngine) {
  const json alone = json_of({"--pairs", "5", "--backend", "gjk", "--stratum", "random/cubes"});
  EXPECT_EQ(alone.at("total").size(), 1u);
  const json both = json_of({"--pairs", "5", "--backend", "specialised", "--stratum", "random"});
  EXPECT_EQ(both.at("total").size(), 2u);
  // It has no test of cylinders, and most kinds with others.
  EXPECT_LT(both.at("total").at("specialised").at("pairs"), both.at("total").at("gjk").at("pairs"));
}

TEST_F(Stress, ListsItsStrata) {
  const Finished all = run({"--list"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  for (const char* const name : {"random/cubes", "contact/curved/d=1e-16", "coordinates/1e150", "hull/1e5-vertices"}) {
    EXPECT_NE(all.out.find(name), std::string::npos) << name;
  }
  const Finished some = run({"--list", "--stratum", "aspect/cones"});
  EXPECT_EQ(std::count(some.out.begin(), some.out.end(), '\n'), 6);
  EXPECT_EQ(run({"--list", "--json", "-"}).exit_code, 2) << "there is nothing to write";
}

TEST_F(Stress, PrintsATableAndNothingWhenQuiet) {
  const Words words = {"--pairs", "20", "--stratum", "random", "--backend", "gjk"};
  const Finished finished = run(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  for (const char* const part : {"stratum", "unjudged", "random/curved", "escalated", "gjk: 0 wrong"}) {
    EXPECT_NE(finished.out.find(part), std::string::npos) << part << " is missing in\n" << finished.out;
  }
  Words quiet = words;
  quiet.push_back("--quiet");
  const Finished silent = run(quiet);
  EXPECT_EQ(silent.out + silent.err, "");
}

TEST_F(Stress, DrawsAPicture) {
  const Finished finished = run({"--pairs", "20", "--stratum", "contact/curved", "--plot", "stress.svg", "--quiet"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  const std::string svg = read_file("stress.svg");
  EXPECT_EQ(svg.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\"", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find(">contact/curved/d=1e-9</text>"), std::string::npos);
  // Every element is closed, and nothing is left of a number that is none.
  const auto count = [&svg](const std::string& part) {
    int n = 0;
    for (std::size_t at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<text"), count("</text>"));
  EXPECT_EQ(count("<rect"), count("/>"));
  EXPECT_EQ(count("nan"), 0);
  if (shell("command -v xmllint").exit_code == 0) {
    EXPECT_EQ(shell("xmllint --noout stress.svg").exit_code, 0);
  }
}

TEST_F(Stress, RefusesWhatItDoesNotKnow) {
  expect_refusal(run({"--stratum", "contcat"}), 2, "no such stratum (\"contcat\" for --stratum)", "vex_stress");
  expect_refusal(run({"--backend", "bullet"}), 2, "no such backend (\"bullet\" for --backend)", "vex_stress");
  expect_refusal(run({"--pairs", "0"}), 2, "not positive (\"0\" for --pairs)", "vex_stress");
  expect_refusal(run({"--pairs", "1e9"}), 2, "too many pairs", "vex_stress");
  expect_refusal(run({"--stratun", "random"}), 2, "did you mean --stratum?", "vex_stress");
  expect_refusal(run({"--plot"}), 2, "a value is missing", "vex_stress");
  expect_refusal(run({"--plot", "no/folder/stress.svg"}), 2, "no/folder", "vex_stress");
  expect_refusal(run({"--json", "no/folder/stress.json"}), 2, "no/folder", "vex_stress");
  expect_refusal(run({"--json", "-", "--plot", "-"}), 2, "one file for two outputs", "vex_stress");
  expect_refusal(run({"box:1,1,1"}), 2, "not understood (box:1,1,1)", "vex_stress");
  EXPECT_TRUE(files().empty());
}

TEST_F(Stress, ReportsWhatWasDoneWhenInterrupted) {
  const Finished finished = run_and_signal(
      {"--pairs", "1e7", "--threads", "4", "--backend", "gjk", "--json", "stress.json"}, SIGINT, [](pid_t process) {
        if (!has_worker_threads(process)) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return true;
      });
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, 10.0);
  EXPECT_NE(finished.out.find("Interrupted"), std::string::npos) << finished.out;
  const json document = json::parse(read_file("stress.json"), nullptr, false);
  ASSERT_TRUE(document.is_object());
  EXPECT_EQ(document.at("complete"), false);
  ASSERT_EQ(document.at("strata").size(), 1u);
  EXPECT_EQ(document.at("strata").at(0).at("complete"), false);
  EXPECT_GT(document.at("strata").at(0).at("pairs"), 0);
  EXPECT_LT(document.at("strata").at(0).at("pairs"), 1e7);
}

}  // namespace
}  // namespace vex::golden
