// vex_virial as users meet it.
#include <cmath>
#include <csignal>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Virial : public ProgramTest {
 protected:
  Virial() : ProgramTest(VEX_VIRIAL_PROGRAM) {}

  void expect_refused(const Words& words, int code, const std::string& part) const {
    expect_refusal(run(words), code, part, "vex_virial");
  }
};

TEST_F(Virial, TellsTheCoefficientsInBothUnits) {
  const json found = json_of({"sphere:0.5", "--order", "5", "--samples", "3e5"});
  EXPECT_TRUE(found["complete"]);
  EXPECT_NEAR(found["b2"], 2.0 / 3.0 * 3.14159265358979, 1e-12);
  EXPECT_NEAR(found["b2_per_volume"], 4.0, 1e-12);
  ASSERT_EQ(found["coefficients"].size(), 3u);
  const double known[] = {0.625, 0.28694950598, 0.110252};
  for (std::size_t k = 0; k < 3; ++k) {
    const json& one = found["coefficients"][k];
    EXPECT_EQ(one["n"], 3 + k);
    EXPECT_GE(one["samples"], 300'000);
    EXPECT_LT(one["samples"], 300'500);
    const double reduced = one["reduced"], error = one["std_error"],
                 power = std::pow(4.0, 2.0 + static_cast<double>(k));
    EXPECT_NEAR(reduced, known[k], 4.5 * error);
    EXPECT_LT(error, 0.01);
    EXPECT_NEAR(one["per_volume"], reduced * power, 1e-9);
    EXPECT_NEAR(one["per_volume_std_error"], error * power, 1e-9);
    const json& pairs = one["pairs"];
    EXPECT_EQ(pairs["seen"], pairs["by_balls"].get<std::uint64_t>() + pairs["searched"].get<std::uint64_t>() +
                                 pairs["skipped"].get<std::uint64_t>());
    EXPECT_EQ(one["undecided"], 0);
  }
  EXPECT_GT(found["coefficients"][2]["pairs"]["skipped"], 0);
  // 1 + 4 phi + 10 phi^2 + 18.36 phi^3 + 28.2 phi^4, and Carnahan and Starling's own beside it.
  const json& row = found["compressibility"][1];
  EXPECT_NEAR(row["phi"], 0.1, 1e-12);
  EXPECT_NEAR(row["series"], 1.5212, 2e-3);
  for (const char* name : {"Parsons-Lee", "Nezbeda", "Boublik"}) EXPECT_NEAR(row[name], 1.109 / 0.729, 1e-9);
}

TEST_F(Virial, OneSeedIsOneResultForAnyNumberOfThreads) {
  const Words words = {"box:2,1,1", "--samples", "1e5", "--seed", "9"};
  json one = json_of({"box:2,1,1", "--samples", "1e5", "--seed", "9", "--threads", "1"});
  for (const char* isa : {"scalar", "best"}) {
    json other = json_of({"box:2,1,1", "--samples", "1e5", "--seed", "9", "--threads", "3", "--isa", isa});
    for (std::size_t k = 0; k < one["coefficients"].size(); ++k) {
      EXPECT_EQ(one["coefficients"][k]["reduced"], other["coefficients"][k]["reduced"]);
      EXPECT_EQ(one["coefficients"][k]["std_error"], other["coefficients"][k]["std_error"]);
    }
  }
}

TEST_F(Virial, SaysWhereASignIsNotSettled) {
  const Finished finished = run({"box:50,1,1", "--order", "7", "--samples", "1000", "--threads", "1"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_NE(finished.out.find("NOT SETTLED: the sign of"), std::string::npos) << finished.out;
}

TEST_F(Virial, FlatBodiesHaveNoVolumeToDivideBy) {
  const json found = json_of({"disc:1", "--order", "3", "--samples", "1e5", "--plot", path("disc.svg")});
  EXPECT_TRUE(found["b2_per_volume"].is_null());
  EXPECT_TRUE(found["coefficients"][0]["per_volume"].is_null());
  // R. Eppenga and D. Frenkel, Mol. Phys. 52, 1303 (1984): .4447.
  EXPECT_NEAR(found["coefficients"][0]["reduced"], 0.4447, 0.01);
  EXPECT_NE(read_file("disc.svg").find("</svg>"), std::string::npos);
}

TEST_F(Virial, MixturesHaveFourThirdCoefficients) {
  const json found = json_of({"sphere:0.5", "sphere:1", "--samples", "2e5"});
  ASSERT_EQ(found["mixture"].size(), 4u);
  EXPECT_NEAR(found["mixture"][0]["reduced"], 0.625, 5.0 * found["mixture"][0]["reduced_std_error"].get<double>());
  EXPECT_NEAR(found["mixture"][3]["reduced"], 0.625, 5.0 * found["mixture"][3]["reduced_std_error"].get<double>());
  EXPECT_EQ(found["mixture"][1]["bodies"], "AAB");
  EXPECT_GT(found["mixture"][2]["value"], found["mixture"][1]["value"]);
}

TEST_F(Virial, DrawsThePictureAndReadsMeshes) {
  write_file("cube.obj", cube_obj());
  const Finished finished = run({path("cube.obj"), "--samples", "1e4", "--plot", path("z.svg")});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(read_file("z.svg").find("series to B4"), std::string::npos);
  EXPECT_NE(finished.out.find("B2 / V = 5.5"), std::string::npos) << finished.out;
}

// Poses of long bodies were drawn from a domain of which next to nothing overlaps: neither --seconds nor a signal ended
// such a run, and it was refused in the end.
TEST_F(Virial, ThinBodiesAreDrawnAsAnyOthers) {
  for (const char* const body :
       {"box:1e4,1,1", "ellipsoid:1e6,1,1", "cylinder:1e4,0.5", "cone:1e3,0.5", "box:1e4,30,1"}) {
    const json found = json_of({body, "--order", "3", "--samples", "1e4", "--threads", "1"});
    EXPECT_GE(found["coefficients"][0]["samples"], 10'000) << body;
  }
  // Aligned spheroids are spheres.
  const json found = json_of({"ellipsoid:1,1,1e3", "--order", "3", "--samples", "1e5", "--orientations", "aligned"});
  const json& b3 = found["coefficients"][0];
  EXPECT_NEAR(b3["reduced"], 0.625, 4.5 * b3["std_error"].get<double>());
  const Finished finished = run_and_signal({"box:1e6,1,1", "--seconds", "100"}, SIGINT, has_worker_threads);
  EXPECT_EQ(finished.exit_code, 130);
  EXPECT_LT(finished.seconds, 20.0);
}

TEST_F(Virial, AnInterruptedRunTellsWhatItHas) {
  const Finished finished =
      run_and_signal({"box:1,1,1", "--seconds", "100", "--json", path("found.json")}, SIGINT, [](pid_t process) {
        if (!has_worker_threads(process)) return false;
        ::usleep(700'000);
        return true;
      });
  EXPECT_EQ(finished.exit_code, 130);
  const json found = json::parse(read_file("found.json"), nullptr, false);
  ASSERT_TRUE(found.is_object());
  EXPECT_FALSE(found["complete"]);
  EXPECT_GT(found["coefficients"][0]["samples"], 0);
}

TEST_F(Virial, OneCoefficientAloneIsThatOfTheSeries) {
  const json series = json_of({"box:1,1,1", "--order", "5", "--samples", "1e5"});
  const json alone = json_of(
      {"box:1,1,1", "--only", "5", "--samples", "1e5", "--report", path("b5.html"), "--checkpoint", path("b5")});
  ASSERT_EQ(alone["coefficients"].size(), 1u);
  for (const char* key : {"n", "reduced", "std_error", "per_volume", "samples", "pairs"}) {
    EXPECT_EQ(alone["coefficients"][0][key], series["coefficients"][2][key]) << key;
  }
  EXPECT_TRUE(alone["compressibility"].empty());
  EXPECT_NE(alone["compressibility_reason"].get<std::string>().find("--only"), std::string::npos);
  EXPECT_FALSE(series.contains("compressibility_reason"));
  EXPECT_NE(read_file("b5.html").find("/coefficients/0/reduced"), std::string::npos);
  EXPECT_EQ(read_file("b5.html").find("The equation of state"), std::string::npos);
  const Finished finished = run({"box:1,1,1", "--only", "5", "--samples", "1e5"});
  EXPECT_NE(finished.out.find("no series of Z"), std::string::npos) << finished.out;
  // It is no part of another run.
  expect_refused({"box:1,1,1", "--only", "6", "--samples", "2e5", "--resume", path("b5")}, 3, "B5");
  expect_refused({"box:1,1,1", "--order", "5", "--samples", "2e5", "--resume", path("b5")}, 3, "B5");
  const json resumed = json_of({"box:1,1,1", "--only", "5", "--samples", "2e5", "--resume", path("b5")});
  const json whole = json_of({"box:1,1,1", "--only", "5", "--samples", "2e5"});
  EXPECT_EQ(resumed["coefficients"][0]["reduced"], whole["coefficients"][0]["reduced"]);
}

TEST_F(Virial, BodiesMayBeTurnedByALawOfOneBody) {
  const auto b3_of = [](const json& found) { return found["coefficients"][0]["reduced"].get<double>(); };
  const auto error_of = [](const json& found) { return found["coefficients"][0]["std_error"].get<double>(); };
  const json along_z = json_of({"box:1,1,4", "--orientations", "onsager:6", "--order", "3", "--samples", "3e5"});
  const json along_x =
      json_of({"box:4,1,1", "--axis", "x", "--orientations", "onsager:6", "--order", "3", "--samples", "3e5"});
  EXPECT_EQ(along_z["orientations"], "onsager:6");
  EXPECT_EQ(along_x["orientations"], "onsager:6 about 1,0,0");
  EXPECT_NEAR(along_z["b2"], along_x["b2"], 1e-7);
  EXPECT_NEAR(b3_of(along_z), b3_of(along_x), 4.5 * std::hypot(error_of(along_z), error_of(along_x)));
  EXPECT_LT(error_of(along_z), 3e-3);
  // Neither that of random nor that of parallel boxes.
  const json isotropic = json_of({"box:1,1,4", "--order", "3", "--samples", "3e5"});
  EXPECT_GT(isotropic["b2"], along_z["b2"].get<double>() * 1.05);
  EXPECT_GT(along_z["b2"], 4.0 * 4.0 * 1.1);
  EXPECT_GT(std::fabs(b3_of(along_z) - b3_of(isotropic)), 8.0 * error_of(along_z));

  // A table that is flat is isotropic.
  write_file("flat.csv", "-1 1\n1 1\n");
  const std::string table = "table:" + path("flat.csv");
  const json flat = json_of({"box:1,1,4", "--orientations", table.c_str(), "--order", "3", "--samples", "3e5"});
  EXPECT_NEAR(flat["b2"], isotropic["b2"], 1e-7);
  EXPECT_NEAR(b3_of(flat), b3_of(isotropic), 4.5 * error_of(flat));
  const json mixture = json_of({"sphere:0.5", "box:1,1,2", "--orientations", "maier-saupe:3", "--samples", "2e5"});
  EXPECT_NEAR(mixture["mixture"][0]["reduced"], 0.625, 4.5 * mixture["mixture"][0]["reduced_std_error"].get<double>());
}

TEST_F(Virial, RefusesWhatItCannotDo) {
  expect_refused({"box:1,1,1", "--order", "9"}, 2, "out of range (9 for --order)");
  expect_refused({"box:1,1,1", "--order", "2"}, 2, "out of range (2 for --order)");
  expect_refused({"box:1,1,1", "--orientations", "uniform-angle"}, 2, "not a choice");
  expect_refused({"box:1,1,1", "--orientations", "fixed:1,0,0,0"}, 2, "how two bodies are turned to each other");
  expect_refused({"box:1,1,1", "--orientations", "angle:20"}, 2, "how two bodies are turned to each other");
  expect_refused({"box:1,1,1", "--orientations", "table:none.csv"}, 3, "none.csv");
  expect_refused({"box:1,1,1", "--only", "9"}, 2, "out of range (9 for --only)");
  expect_refused({"box:1,1,1", "--only", "4", "--order", "4"}, 2, "leave out one of them");
  expect_refused({"box:1,1,1", "--only", "4", "--plot", path("b4.svg")}, 2, "no series to draw");
  expect_refused({"box:1,1,1", "sphere:1", "--only", "4"}, 2, "a mixture's coefficients of this order");
  expect_refused({"box:1,1,1", "sphere:1", "--order", "4"}, 2, "a mixture's coefficients of this order");
  expect_refused({"box:1,1,1", "--samples", "0"}, 2, "--samples");
  expect_refused({"box:1,1,1", "--rel-error", "-1"}, 2, "--rel-error");
  expect_refused({"needle:1"}, 3, "never overlap");
  expect_refused({"disc:1", "--orientations", "aligned"}, 3, "never overlap");
  expect_refused({"nothing.obj"}, 3, "nothing.obj");
}

}  // namespace
}  // namespace vex::golden
