// vex_nematic as users meet it.
#include <cmath>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class NematicProgram : public ProgramTest {
 protected:
  NematicProgram() : ProgramTest(VEX_NEMATIC_PROGRAM) {}

  void expect_refused(const Words& words, int code, const std::string& part) const {
    SCOPED_TRACE(testing::PrintToString(words));
    expect_refusal(run(words), code, part, "vex_nematic");
  }
};

TEST_F(NematicProgram, FindsTheTransitionOfLongRods) {
  const json found = json_of({"capsule:1e6,0.5"});
  for (const char* key : {"isotropic", "nematic", "pressure", "chemical_potential", "bodies", "complete", "theory"}) {
    EXPECT_TRUE(found.contains(key)) << key;
  }
  EXPECT_NEAR(found["isotropic"]["reduced_density"], 3.290, 1e-3);
  EXPECT_NEAR(found["nematic"]["reduced_density"], 4.191, 1e-3);
  EXPECT_NEAR(found["nematic"]["order_parameter"], 0.792, 1e-3);
  EXPECT_LT(found["grid_error"], 1e-10);
  EXPECT_EQ(found["theory"], "onsager");
  const json trial = json_of({"capsule:1e6,0.5", "--trial-function", "onsager"});
  EXPECT_NEAR(trial["isotropic"]["reduced_density"], 3.340, 1e-3);
  EXPECT_NEAR(trial["nematic"]["reduced_density"], 4.486, 1e-3);
}

TEST_F(NematicProgram, TellsDensitiesInEveryUnit) {
  const json found = json_of({"cylinder:10,0.5", "--theory", "parsons-lee"});
  const double volume = found["bodies"][0]["volume"], excluded = found["excluded_volume"];
  for (const char* fluid : {"isotropic", "nematic"}) {
    const double n = found[fluid]["number_density"];
    EXPECT_NEAR(found[fluid]["volume_fraction"], n * volume, 1e-14);
    EXPECT_NEAR(found[fluid]["reduced_density"], 0.5 * n * excluded, 1e-12);
  }
  EXPECT_NEAR(found["pressure"].get<double>() * excluded / 2.0, found["reduced_pressure"], 1e-10);
  // Another unit of length changes number density and pressure alone.
  const json larger = json_of({"cylinder:10,0.5", "--theory", "parsons-lee", "--scale", "10"});
  EXPECT_NEAR(larger["nematic"]["volume_fraction"], found["nematic"]["volume_fraction"], 1e-11);
  EXPECT_NEAR(larger["nematic"]["number_density"].get<double>() * 1e3, found["nematic"]["number_density"], 1e-11);
  EXPECT_NEAR(larger["chemical_potential"], found["chemical_potential"], 1e-9);
}

TEST_F(NematicProgram, FollowsMixturesFromOneBodyToTheOther) {
  const json mixture = json_of({"capsule:1000,0.5", "capsule:1500,0.5", "--composition", "0:1:0.5"});
  const json a = json_of({"capsule:1000,0.5"}), b = json_of({"capsule:1500,0.5"});
  ASSERT_EQ(mixture["mixture"].size(), 3u) << mixture["reason"];
  for (const auto& [row, pure] : {std::pair{mixture["mixture"][0], a}, std::pair{mixture["mixture"][2], b}}) {
    for (const char* phase : {"isotropic", "nematic"}) {
      EXPECT_NEAR(row[phase]["reduced_density"], pure[phase]["reduced_density"], 1e-5);
      EXPECT_NEAR(row[phase]["volume_fraction"], pure[phase]["volume_fraction"], 1e-8);
    }
  }
  EXPECT_NE(run({"capsule:1000,0.5", "capsule:1500,0.5", "--composition", "0:0:1"}).out.find("stand for a trace"),
            std::string::npos);
  // The longer rods order first.
  EXPECT_GT(mixture["mixture"][1]["nematic"]["composition"], 0.55);
  EXPECT_LT(mixture["mixture"][1]["residual"], 1e-9);
}

TEST_F(NematicProgram, PrintsAndDraws) {
  const Finished finished = run({"disc:1", "--plot", "discs.svg"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("reduced density c"), std::string::npos);
  EXPECT_EQ(finished.out.find("volume fraction"), std::string::npos) << "a disc has no volume";
  const std::string picture = read_file("discs.svg");
  EXPECT_NE(picture.find("angle from the director"), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST_F(NematicProgram, SaysWhereThereIsNoTransition) {
  const Finished finished = run({"sphere:1", "--json", "sphere.json", "--plot", "sphere.svg"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("none: "), std::string::npos);
  const json found = json::parse(read_file("sphere.json"));
  EXPECT_TRUE(found["isotropic"].is_null());
  EXPECT_TRUE(found["nematic"].is_null());
  EXPECT_NE(found["no_transition_reason"], "");
}

TEST_F(NematicProgram, NotesWhatAReaderShouldKnow) {
  const auto notes = [&](const Words& words) { return json_of(words)["notes"].dump(); };
  EXPECT_NE(notes({"cone:5,0.5"}).find("two ends differ"), std::string::npos);
  EXPECT_NE(notes({"box:5,1,1"}).find("along x"), std::string::npos);
  EXPECT_NE(notes({"ellipsoid:1,1,1.5"}).find("volume fraction is above 1"), std::string::npos);
  EXPECT_NE(notes({"box:1,1,1"}).find("fourth rank"), std::string::npos);
  EXPECT_EQ(notes({"cylinder:20,0.5"}), "[]");
}

TEST_F(NematicProgram, RefusesWhatMakesNoSense) {
  expect_refused({}, 2, "nothing is given for BODY");
  expect_refused({"rod:1"}, 2, "no body of this name (rod:1)");
  expect_refused({"capsule:10,0.5", "disc:1", "sphere:1"}, 2, "not understood (sphere:1)");
  expect_refused({"capsule:10,0.5", "--composition", "0:1:0.5"}, 2, "one body has no composition");
  expect_refused({"capsule:10,0.5", "capsule:20,0.5", "--composition", "0:2:0.5"}, 2, "not a share");
  expect_refused({"capsule:10,0.5", "--theory", "landau"}, 2, "there are onsager, parsons-lee");
  expect_refused({"capsule:10,0.5", "--trial-function", "gauss"}, 2, "there are onsager");
  expect_refused({"capsule:10,0.5", "--teory", "onsager"}, 2, "did you mean --theory?");
  expect_refused({"disc:1", "--theory", "parsons-lee"}, 2, "a flat body has no volume");
  expect_refused({"needle:1"}, 3, "bodies that exclude no volume");
  expect_refused({"ellipsoid:1,1,500"}, 3, "would take too long");
  expect_refused({"missing.obj"}, 3, "cannot read");
  expect_refused({"disc:1", "--plot", "a.obj"}, 2, "a.obj");
  expect_refused({"disc:1", "--plot", "a", "--json", "a"}, 2, "one file for two outputs");
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace vex::golden
