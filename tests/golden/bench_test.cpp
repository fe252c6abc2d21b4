// vex_bench: its table, documents and picture, its refusals, and Ctrl-C.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <set>
#include <sstream>
#include <thread>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Bench : public ProgramTest {
 protected:
  Bench() : ProgramTest(VEX_BENCH_PROGRAM) {}
};

TEST_F(Bench, MeasuresEveryEstimatorAndBackendOfABody) {
  const json document = json_of({"box:1,1,1", "--seconds", "0.05", "--threads", "1"});
  for (const char* const key : {"version", "stream_version", "command", "seed", "threads", "complete", "seconds"}) {
    EXPECT_TRUE(document.contains(key)) << key;
  }
  EXPECT_EQ(document.at("complete"), true);
  EXPECT_FALSE(document.at("processor").get<std::string>().empty());
  ASSERT_EQ(document.at("bodies").size(), 1u);
  const json& body = document.at("bodies")[0];
  EXPECT_EQ(body.at("name"), "box:1,1,1");
  EXPECT_NEAR(body.at("excluded_volume").get<double>(), 11.0, 1e-14);
  std::set<std::string> names;
  for (const json& curve : body.at("curves")) {
    const std::string backend = curve.at("backend").is_null() ? "none" : curve.at("backend").get<std::string>();
    names.insert(curve.at("estimator").get<std::string>() + " " + curve.at("sequence").get<std::string>() + " " +
                 backend);
    SCOPED_TRACE(*names.rbegin());
    ASSERT_FALSE(curve.at("points").empty());
    double trials = 0.0;
    for (const json& point : curve.at("points")) {
      EXPECT_GT(point.at("trials").get<double>(), trials) << "in the order of the trials";
      trials = point.at("trials");
      EXPECT_GE(point.at("runs"), 1);
      EXPECT_GT(point.at("seconds"), 0.0);
      EXPECT_GT(point.at("relative_error"), 0.0);
      EXPECT_LE(point.at("true_relative_error").get<double>(), 6.0 * point.at("relative_error").get<double>());
      EXPECT_LE(point.at("largest_z"), 7.0);
    }
    const json& last = curve.at("points").back();
    const double error = last.at("relative_error");
    EXPECT_NEAR(curve.at("figure_of_merit").get<double>() * error * error * last.at("seconds").get<double>(), 1.0,
                1e-9);
    ASSERT_EQ(curve.at("seconds_to").size(), 3u);
    for (const json& time : curve.at("seconds_to")) {
      EXPECT_GT(time.at("seconds"), 0.0);
      EXPECT_EQ(time.at("extrapolated"), time.at("relative_error") < error);
    }
  }
  for (const char* const name :
       {"radial sobol gjk", "radial random gjk", "hit-or-miss random gjk", "hit-or-miss sobol gjk",
        "hit-or-miss-fitted random gjk", "hit-or-miss-fitted sobol gjk", "stratified random gjk",
        "mixed-volume sobol none", "mean-width sobol none"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  for (const std::string& backend : backends_of_this_build()) {
    EXPECT_TRUE(names.contains("hit-or-miss random " + backend)) << backend;
  }
}

TEST_F(Bench, TakesAMeshAndWritesATableRowsAndAPicture) {
  const Finished finished = run({sample("gem.obj"), "--seconds", "0.02", "--csv", "rows.csv", "--plot", "bench.svg"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  for (const char* const word : {"gem.obj", "radial, Sobol'", "hit-or-miss", "mean-width, Sobol'", "slope", "FOM",
                                 "to 1e-4", "they share the formula's geometry"}) {
    EXPECT_NE(finished.out.find(word), std::string::npos) << word << "\n" << finished.out;
  }
  std::istringstream rows(read_file("rows.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(rows, line));
  EXPECT_EQ(line,
            "body,source,estimator,sequence,backend,trials,runs,seconds,relative_error,true_relative_error,"
            "figure_of_merit");
  int n_rows = 0;
  while (std::getline(rows, line)) {
    EXPECT_EQ(std::ranges::count(line, ','), 10) << line;
    ++n_rows;
  }
  EXPECT_GE(n_rows, 9);
  const std::string picture = read_file("bench.svg");
  EXPECT_EQ(picture.rfind("<svg", 0), 0u);
  for (const char* const word : {"run time / s", "relative standard error", "slope", "radial, Sobol'", "gem.obj"}) {
    EXPECT_NE(picture.find(word), std::string::npos) << word;
  }
}

TEST_F(Bench, RefusesWhatItCannotMeasure) {
  expect_refusal(run({"needle:1", "--seconds", "0.01"}), 3, "two of it exclude no volume", "vex_bench");
  expect_refusal(run({"box:1,1", "--seconds", "0.01"}), 2, "box:1,1", "vex_bench");
  expect_refusal(run({"missing.obj"}), 3, "missing.obj", "vex_bench");
  expect_refusal(run({"box:1,1,1", "--seconds", "0"}), 2, "--seconds", "vex_bench");
  expect_refusal(run({"box:1,1,1", "--secnds", "1"}), 2, "did you mean --seconds?", "vex_bench");
  expect_refusal(run({"box:1,1,1", "--json", "-", "--csv", "-"}), 2, "one file for two outputs", "vex_bench");
  expect_refusal(run({"box:1,1,1", "--plot", "bench.png"}), 2, "only SVG is drawn", "vex_bench");
  expect_refusal(run({"box:1,1,1", "--plot", "no/folder/bench.svg"}), 2, "no/folder", "vex_bench");
}

TEST_F(Bench, InterruptedItReportsWhatItHas) {
  const Finished finished =
      run_and_signal({"box:1,1,1", "--seconds", "100", "--json", "bench.json"}, SIGINT, [](pid_t process) {
        if (!has_worker_threads(process)) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        return true;
      });
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, 20.0);
  const json document = json::parse(read_file("bench.json"), nullptr, false);
  ASSERT_TRUE(document.is_object());
  EXPECT_EQ(document.at("complete"), false);
  EXPECT_NE(finished.out.find("Interrupted"), std::string::npos) << finished.out;
}

}  // namespace
}  // namespace vex::golden
