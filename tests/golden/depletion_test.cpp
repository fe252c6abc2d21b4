// vex_depletion as users meet it.
#include <cmath>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class DepletionProgram : public ProgramTest {
 protected:
  DepletionProgram() : ProgramTest(VEX_DEPLETION_PROGRAM) {}

  void expect_refused(const Words& words, int code, const std::string& part) const {
    SCOPED_TRACE(testing::PrintToString(words));
    expect_refusal(run(words), code, part, "vex_depletion");
  }
};

TEST_F(DepletionProgram, HoldsTwoSpheresAgainstTheClosedForm) {
  const json found = json_of({"sphere:1", "--depletant", "0.2", "--distance", "2.05:2.55:0.25", "--fraction", "0.3"});
  const double pi = std::acos(-1.0), n = 0.3 / (4.0 / 3.0 * pi * 0.008);
  EXPECT_NEAR(found["depletant"]["number_density"], n, 1e-12 * n);
  ASSERT_EQ(found["rows"].size(), 3u);
  for (const json& row : found["rows"]) {
    const double d = row["distance"], gap = std::max(0.0, 2.4 - d);
    const double truth = pi / 12.0 * (4.8 + d) * gap * gap;
    EXPECT_NEAR(row["exact"], truth, 1e-14);
    EXPECT_LE(std::fabs(row["overlap_volume"].get<double>() - truth), 5.0 * row["std_error"].get<double>());
    EXPECT_NEAR(row["potential"], -n * row["overlap_volume"].get<double>(), 1e-12);
    EXPECT_EQ(row["bodies"], "disjoint");
    EXPECT_EQ(row["complete"], true);
  }
  EXPECT_NE(found["rows"][0]["seed"], found["rows"][1]["seed"]);
  EXPECT_EQ(found["rows"][2]["overlap_volume"], 0.0);
}

TEST_F(DepletionProgram, SaysWhyItGaveUp) {
  const Words words = {"box:1,1,1", "--depletant",  "1",  "--distance", "1.5", "--rel-error",
                       "1e-9",      "--max-trials", "1e4"};
  EXPECT_EQ(json_of(words)["rows"][0]["stopped_by"], "max-trials");
  EXPECT_NE(run(words).out.find("NOT COMPLETE - incomplete: --max-trials was reached first"), std::string::npos);
}

TEST_F(DepletionProgram, TurnsTheSecondBodyAboutTheLineBetweenThem) {
  const Words words = {"capsule:4,0.5", "--depletant", "0.2", "--distance", "1.1", "--trials", "40000"};
  const auto rows = [&](const Words& more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    return json_of(all)["rows"];
  };
  const json turned = rows({"--angle", "0:90:45"});
  ASSERT_EQ(turned.size(), 3u);
  EXPECT_GT(turned[0]["overlap_volume"].get<double>(), 2.0 * turned[1]["overlap_volume"].get<double>());
  EXPECT_GT(turned[1]["overlap_volume"], turned[2]["overlap_volume"]);
  const auto agree = [](const json& x, const json& y) {
    const double error = std::hypot(x["std_error"].get<double>(), y["std_error"].get<double>());
    EXPECT_LE(std::fabs(x["overlap_volume"].get<double>() - y["overlap_volume"].get<double>()), 5.0 * error);
  };
  // The same pose by its quaternion, and by another line.
  agree(turned[2], rows({"--rotation", "1,1,0,0"})[0]);
  agree(turned[1], rows({"--direction", "0,3,0", "--angle", "45"})[0]);
  agree(turned[1], rows({"--angle", "-45"})[0]);
  agree(turned[1], rows({"--angle", "405"})[0]);
}

TEST_F(DepletionProgram, TellsOfBodiesThatOverlapAndWritesItsFiles) {
  const Finished finished = run({"box:1,1,1", "--depletant", "0.2", "--distance", "0.5:1.5:0.5", "--fraction", "0.1",
                                 "--trials", "2000", "--csv", "rows.csv", "--plot", "rows.svg", "--json", "all.json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("infinite: they overlap"), std::string::npos);
  const json found = json::parse(read_file("all.json"));
  EXPECT_TRUE(found["rows"][0]["potential"].is_null());
  EXPECT_EQ(found["rows"][0]["bodies"], "overlap");
  EXPECT_EQ(read_file("rows.csv").find("distance,angle,bodies,"), 0u);
  EXPECT_EQ(read_file("rows.svg").find("nan"), std::string::npos);
}

TEST_F(DepletionProgram, AveragesOverOrientations) {
  const json found = json_of({"box:1,1,1", "--depletant", "0.3", "--distance", "1.3:1.9:0.6", "--orientations",
                              "isotropic", "--trials", "10000"});
  const json& near = found["rows"][0];
  EXPECT_GT(near["free_share"], 0.1);
  EXPECT_LT(near["free_share"], 0.9);
  EXPECT_GT(near["overlap_volume"], 10.0 * near["std_error"].get<double>());
  EXPECT_EQ(found["rows"][1]["free_share"], 1.0);
  EXPECT_EQ(found["orientations"], "isotropic");
}

TEST_F(DepletionProgram, RefusesWhatMakesNoSense) {
  const Words good = {"sphere:1", "--depletant", "0.2", "--distance", "2"};
  const auto with = [&](const Words& more) {
    Words all = good;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refused({"sphere:1", "--distance", "2"}, 2, "--depletant");
  expect_refused({"sphere:1", "--depletant", "0.2"}, 2, "--distance");
  expect_refused({"sphere:1", "--depletant", "0", "--distance", "2"}, 2, "--depletant");
  expect_refused({"sphere:1", "--depletant", "0.2", "--distance", "-1"}, 2, "a distance below 0");
  expect_refused({"sphere:1", "--depletant", "0.2", "--distance", "1:2"}, 2, "not a range");
  expect_refused(with({"--fraction", "1"}), 2, "not below 1");
  expect_refused(with({"--orientations", "isotropic", "--angle", "30"}), 2, "leave out one of them");
  expect_refused(with({"--rotation", "1,0,0"}), 2, "wrong number of numbers (3 for --rotation)");
  expect_refused(with({"--rotation", "0,0,0,0"}), 2, "length 0");
  expect_refused(with({"--direction", "0,0,0"}), 2, "a direction of length 0");
  expect_refused(with({"--csv", "a.obj"}), 2, "a.obj");
  expect_refused({"missing.obj", "--depletant", "0.2", "--distance", "2"}, 3, "cannot read");
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace vex::golden
