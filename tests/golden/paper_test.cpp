// vex_paper: its parts, its document, its refusals, and Ctrl-C.
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <sstream>
#include <thread>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Paper : public ProgramTest {
 protected:
  Paper() : ProgramTest(VEX_PAPER_PROGRAM) {}
};

void expect_row_keys(const json& row) {
  for (const char* const key : {"aspect_ratio", "exact", "excluded_volume", "std_error", "z", "paper",
                                "paper_uncertainty", "seconds", "trials", "hits", "undecided"}) {
    EXPECT_TRUE(row.contains(key)) << key << " is missing in " << row.dump();
  }
}

TEST_F(Paper, EveryRowIsThereAndWithinFourStandardErrors) {
  const json document = json_of({"--trials", "20000"});
  EXPECT_EQ(document.at("complete"), true);
  ASSERT_EQ(document.at("table_1").size(), 14u);
  ASSERT_EQ(document.at("table_2").size(), 11u);
  ASSERT_GE(document.at("text").size(), 12u);
  ASSERT_EQ(document.at("erratum").size(), 14u);
  EXPECT_TRUE(document.at("referees").empty());
  double sum_sq = 0.0;
  std::size_t n = 0;
  for (const char* const part : {"table_1", "table_2", "text"}) {
    for (const json& row : document.at(part)) {
      expect_row_keys(row);
      const double z = row.at("z");
      const double error = std::hypot(row.at("std_error").get<double>(), row.at("exact_error").get<double>());
      EXPECT_NEAR(z, (row.at("excluded_volume").get<double>() - row.at("exact").get<double>()) / error, 1e-9);
      EXPECT_LT(std::fabs(z), 4.0) << row.dump();
      EXPECT_EQ(row.at("trials"), 20000);
      EXPECT_GT(row.at("std_error"), 0.0);
      sum_sq += z * z;
      ++n;
    }
  }
  // Independent rows: chi^2 with 43 degrees of freedom is between 15.7 and 89.9 but for one run in 10^5 on either side.
  ASSERT_EQ(n, 43u);
  EXPECT_GT(sum_sq, 15.7);
  EXPECT_LT(sum_sq, 89.9);
  EXPECT_NEAR(document.at("z").at("spread").get<double>(), std::sqrt(sum_sq / static_cast<double>(n)), 1e-12);
}

TEST_F(Paper, ExactValuesAreTheReferences) {
  const json document = json_of({"--table", "1", "--table", "2", "--trials", "1000", "--max-z", "100"});
  EXPECT_TRUE(document.at("erratum").empty());
  for (const json& row : document.at("table_1")) {
    const double k = row.at("aspect_ratio");
    const double l2 = std::cbrt(1.0 / k), l1 = k * l2;  // V = 1, M = pi (l1 + 2 l2), S = 2 (2 l1 l2 + l2^2)
    EXPECT_NEAR(row.at("exact").get<double>(), 2.0 + (l1 + 2.0 * l2) * (2.0 * l1 * l2 + l2 * l2), 1e-9 / k) << k;
  }
  EXPECT_NEAR(document.at("table_1").at(0).at("exact").get<double>(), 2000007.000002, 1e-5);
  EXPECT_NEAR(document.at("table_2").at(0).at("exact").get<double>(), 77.74058929613692, 1e-10);
  EXPECT_NEAR(document.at("table_2").at(10).at("exact").get<double>(), 77.74058929613692, 1e-10);
  EXPECT_NEAR(document.at("table_2").at(5).at("exact").get<double>(), 8.0, 1e-12);
  // The two misprints of the paper's own column, and no others.
  std::vector<double> misprints;
  for (const json& row : document.at("table_1")) {
    if (row.at("remark").get<std::string>().find("misprint") != std::string::npos) {
      misprints.push_back(row.at("aspect_ratio"));
    }
  }
  EXPECT_EQ(misprints, (std::vector<double>{1e-6, 32.0}));
}

TEST_F(Paper, ARowIsTheRunOfVexMeshThatItNames) {
  const json document = json_of({"--text", "--trials", "5000", "--seed", "7", "--max-z", "100"});
  class Mesh : public ProgramTest {
   public:
    using ProgramTest::json_of;
    void TestBody() override {}
  } mesh;
  for (const json& row : document.at("text")) {
    std::istringstream words(row.at("command").get<std::string>());
    std::string word;
    words >> word;
    EXPECT_EQ(word, "vex_mesh");
    Words arguments;
    while (words >> word) arguments.push_back(word);
    const json same = mesh.json_of(arguments);
    EXPECT_EQ(same.at("estimate").at("hits"), row.at("hits")) << row.at("command");
    EXPECT_EQ(same.at("estimate").at("excluded_volume"), row.at("excluded_volume")) << row.at("command");
  }
}

TEST_F(Paper, TheOneSidedTestGivesThePapersFaultyValues) {
  const json document = json_of({"--erratum", "--trials", "200000"});
  EXPECT_TRUE(document.at("table_1").empty());
  for (const json& row : document.at("erratum")) {
    expect_row_keys(row);
    EXPECT_LT(std::fabs(row.at("z").get<double>()), 4.0) << row.at("aspect_ratio");
    EXPECT_FALSE(row.at("example").is_null());
    // The exact value and every other wrong test are far from what the paper has.
    const double paper = row.at("paper"), uncertainty = row.at("paper_uncertainty");
    if (row.at("aspect_ratio") == 1.0) {
      EXPECT_GT(std::fabs(row.at("exact").get<double>() - paper), 100.0 * uncertainty);
      for (const auto& [name, value] : row.at("tests").items()) {
        if (name == "one-sided") continue;
        EXPECT_GT(std::fabs(value.at("excluded_volume").get<double>() - paper), 0.3) << name;
      }
    }
  }
  EXPECT_GT(document.at("erratum_chi_squared").at("p").get<double>(), 1e-4);
  double sum_sq = 0.0;
  for (const json& row : document.at("erratum")) sum_sq += std::pow(row.at("z").get<double>(), 2);
  EXPECT_NEAR(document.at("erratum_chi_squared").at("value").get<double>(), sum_sq, 1e-9);

  // The values of the other tests for the cube, 5 standard errors; twice the deficit where edges are required both
  // ways.
  const json& cube = document.at("erratum").at(7);
  ASSERT_EQ(cube.at("aspect_ratio"), 1.0);
  for (const auto& [name, value] : std::map<std::string, double>{{"one-sided", 10.569},
                                                                 {"edges-required-both-ways", 10.138},
                                                                 {"vertices-either-way", 9.661},
                                                                 {"vertices-one-way", 7.313},
                                                                 {"face-normals-only", 12.169}}) {
    const json& test = cube.at("tests").at(name);
    EXPECT_LT(std::fabs(test.at("excluded_volume").get<double>() - value), 5.0 * test.at("std_error").get<double>())
        << name;
  }
  // It invents overlaps far outside of any true contact: of prisms 64:1:1 most of what it finds.
  EXPECT_NEAR(document.at("erratum").at(13).at("tests").at("face-normals-only").at("excluded_volume").get<double>(),
              616.4, 30.0);
  for (const json& row : document.at("erratum")) EXPECT_LT(std::fabs(row.at("z_of_exact_test").get<double>()), 4.5);
  // Turned about an edge it misses nothing.
  ASSERT_EQ(document.at("erratum_orientations").size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const json& row = document.at("erratum_orientations").at(k);
    if (k < 3) {
      EXPECT_EQ(row.at("deficit"), 0.0) << row.at("label");
    } else {
      EXPECT_GT(row.at("deficit").get<double>(), 0.3) << row.at("label");
    }
  }
}

TEST_F(Paper, TheCurveGoesThroughTheTablesRows) {
  const json document = json_of({"--curve", "--trials", "20000"});
  ASSERT_GE(document.at("curve").size(), 30u);
  double last = 0.0;
  for (const json& row : document.at("curve")) {
    EXPECT_GT(row.at("aspect_ratio").get<double>(), last);
    last = row.at("aspect_ratio");
    const double deficit = row.at("deficit").get<double>() / row.at("exact").get<double>();
    EXPECT_GT(deficit, 0.0);
    EXPECT_LT(deficit, 0.15);
    if (row.at("aspect_ratio") == 1.0) {
      EXPECT_NEAR(deficit, 0.0392, 0.01);
    }
  }
}

TEST_F(Paper, RefereesFindNoVerdictOfTheEngineWrong) {
  const json document = json_of({"--referees", "--trials", "20000"});
  ASSERT_GE(document.at("referees").size(), 15u);
  for (const json& row : document.at("referees")) {
    EXPECT_EQ(row.at("poses"), 20000);
    EXPECT_EQ(row.at("test_right"), 0) << row.dump();
    EXPECT_EQ(row.at("disagreements"), row.at("engine_right").get<int>() + row.at("test_right").get<int>());
    EXPECT_LE(row.at("test_undecided"), 20) << row.dump();
  }
}

TEST_F(Paper, TheSameHitsForAnyNumberOfThreads) {
  const auto hits = [this](const char* threads) {
    json all = json::array();
    const json document = json_of({"--trials", "3000", "--threads", threads, "--max-z", "100"});
    for (const char* const part : {"table_1", "table_2", "text", "erratum"}) {
      for (const json& row : document.at(part)) {
        all.push_back({row.at("hits"), row.at("excluded_volume"), row.at("std_error")});
      }
    }
    return all;
  };
  EXPECT_EQ(hits("1"), hits("3"));
}

TEST_F(Paper, RefusesWhatItDoesNotKnow) {
  expect_refusal(run({"--table", "3"}), 2, "no such table (\"3\" for --table)", "vex_paper");
  expect_refusal(run({"--table"}), 2, "a value is missing", "vex_paper");
  expect_refusal(run({"--trials", "0"}), 2, "not positive (\"0\" for --trials)", "vex_paper");
  expect_refusal(run({"--trials", "many"}), 2, "not a count", "vex_paper");
  expect_refusal(run({"--threads", "2000"}), 2, "too many threads", "vex_paper");
  expect_refusal(run({"--max-z", "-1"}), 2, "not positive", "vex_paper");
  expect_refusal(run({"--seed", "18446744073709551615"}), 2, "too large a seed", "vex_paper");
  expect_refusal(run({"--tabel", "1"}), 2, "did you mean --table?", "vex_paper");
  expect_refusal(run({"body.obj"}), 2, "not understood (body.obj)", "vex_paper");
  expect_refusal(run({"--json", "no/folder/paper.json"}), 2, "no/folder", "vex_paper");
  EXPECT_TRUE(files().empty());
}

TEST_F(Paper, PrintsTablesAndNothingWhenQuiet) {
  const Finished finished = run({"--table", "1", "--trials", "2000", "--max-z", "100"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  for (const char* const part :
       {"Table 1", "l1/l2", "trials for 0.1 %", "2000007", "misprint", "the needle (64)", "z over"}) {
    EXPECT_NE(finished.out.find(part), std::string::npos) << part << " is missing in\n" << finished.out;
  }
  const Finished quiet = run({"--table", "1", "--trials", "2000", "--quiet", "--max-z", "100"});
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Paper, ExitsWithFourWhereARowIsOff) {
  EXPECT_EQ(run({"--table", "2", "--trials", "2000", "--max-z", "1e-3"}).exit_code, 4);
}

TEST_F(Paper, ReportsWhatWasDoneWhenInterrupted) {
  const Finished finished =
      run_and_signal({"--trials", "1e9", "--threads", "2", "--json", "paper.json"}, SIGINT, [](pid_t process) {
        if (!has_worker_threads(process)) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return true;
      });
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, 10.0);
  EXPECT_NE(finished.out.find("Interrupted"), std::string::npos) << finished.out;
  const json document = json::parse(read_file("paper.json"), nullptr, false);
  ASSERT_TRUE(document.is_object());
  EXPECT_EQ(document.at("complete"), false);
  ASSERT_EQ(document.at("table_1").size(), 1u);
  EXPECT_EQ(document.at("table_1").at(0).at("complete"), false);
  EXPECT_GT(document.at("table_1").at(0).at("trials"), 0);
}

}  // namespace
}  // namespace vex::golden
