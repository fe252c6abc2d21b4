// That vex_trial_bench ends in every mode, and writes what it says. Not how long anything takes.
#include <gtest/gtest.h>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class TrialBench : public ProgramTest {
 protected:
  TrialBench() : ProgramTest(VEX_TRIAL_BENCH_PROGRAM) {}

  /// What stands under `key` in the document of a short run.
  json rows_of(const std::string& key, Words words) const {
    for (const char* word : {"--rounds", "1", "--turn-ms", "0", "--poses", "200"}) words.emplace_back(word);
    const json document = json_of(words);
    for (const char* head :
         {"version", "command", "seed", "processor", "compiler", "optimised", "instruction_sets", "rounds"}) {
      EXPECT_TRUE(document.contains(head)) << head;
    }
    EXPECT_FALSE(document.at(key).empty());
    return document.at(key);
  }
};

TEST_F(TrialBench, ComparesWholeTrialsWithQueriesOnTheSamePoses) {
  for (const json& row : rows_of("trials", {})) {
    EXPECT_EQ(row.at("poses"), 200);
    EXPECT_EQ(row.at("undecided"), 0);
    // The trials drew the poses that were stored.
    EXPECT_EQ(row.at("hits"), row.at("hits_of_trials"));
    EXPECT_GT(row.at("contenders").at("trial").at("median_ns").get<double>(), 0.0);
  }
}

TEST_F(TrialBench, NamesThePeersOwnSettings) {
  for (const json& row : rows_of("peers_best", {"--peers-best"})) {
    for (const auto& [name, contender] : row.at("contenders").items()) {
      if (name == "trial" || name == "query") continue;
      EXPECT_FALSE(contender.at("setting").get<std::string>().empty());
      EXPECT_GT(contender.at("verdicts_against_proven").at("compared"), 0);
    }
  }
}

TEST_F(TrialBench, ShowsEveryKindOfBody) {
  const json rows = rows_of("kinds", {"--kinds"});
  EXPECT_GT(rows.size(), 40u);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("hits"), row.at("hits_of_trials")) << row.at("pair");
    EXPECT_EQ(row.at("undecided"), 0) << row.at("pair");
  }
}

TEST_F(TrialBench, ShowsWhatATrialCannotDoWithout) {
  const json rows = rows_of("parts", {"--parts"});
  for (const json& row : rows) {
    EXPECT_LT(row.at("left").get<int>(), 200) << row.at("pair");
    EXPECT_GT(row.at("contenders").at("pose").at("median_ns").get<double>(), 0.0) << row.at("pair");
  }
  EXPECT_GT(rows.back().at("supports_of_one_left").get<double>(), 1.0);
}

TEST_F(TrialBench, PlotsTheCostAgainstTheVertices) {
  const json rows = rows_of("vertices", {"--vertices", "--most-vertices", "100", "--svg", "cost.svg"});
  EXPECT_EQ(rows.at(0).at("vertices"), 8);
  EXPECT_NE(read_file("cost.svg").find("</svg>"), std::string::npos);
}

TEST_F(TrialBench, ComparesThreadsWithProcesses) {
  EXPECT_GT(rows_of("thread_scaling", {"--threads"}).at(0).at("threads_of_processes").get<double>(), 0.0);
}

TEST_F(TrialBench, PrintsTablesBesideTheFile) {
  const Finished finished =
      run({"--threads", "--rounds", "1", "--turn-ms", "0", "--poses", "200", "--json", "all.json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("### Threads"), std::string::npos);
  EXPECT_FALSE(json::parse(read_file("all.json")).empty());
}

TEST_F(TrialBench, RefusesTwoModes) { expect_refusal(run({"--threads", "--vertices"}), 2, "", "vex_trial_bench"); }

}  // namespace
}  // namespace vex::golden
