// Laws of orientations on the command line of vex_mesh.
#include <cmath>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

using nlohmann::json;

using Laws = ProgramTest;

TEST_F(Laws, OfADensityInAFileAreHeldAgainstTheirExactAverage) {
  std::string density;
  for (int k = -100; k <= 100; ++k) {
    density += std::to_string(k / 100.0) + " " + std::to_string(std::cosh(5.0 * k / 100.0)) + "\n";
  }
  write_file("density.txt", density);
  const json table = json_of({"capsule:5,0.5", "--orientations", "table:density.txt", "--trials", "16384"});
  const json onsager = json_of({"capsule:5,0.5", "--orientations", "onsager:5", "--trials", "16384"});
  EXPECT_LT(std::fabs(table["z"].get<double>()), 5.0);
  EXPECT_EQ(table["reference"]["kind"], "exact");
  const double truth = onsager["reference"]["excluded_volume"];
  EXPECT_NEAR(table["reference"]["excluded_volume"], truth, 1e-3 * truth);
  EXPECT_NEAR(table["order_parameter"], onsager["order_parameter"], 1e-3);
  EXPECT_EQ(table["estimate"]["orientations"].get<std::string>().find("table:"), 0u);
}

TEST_F(Laws, OfEachBodySayTheOrderOfEach) {
  const Finished finished = run({"capsule:5,0.5", "--orientations-a", "maier-saupe:4", "--orientations-b", "cone:20",
                                 "--trials", "16384", "--json", "out.json"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("order parameter S"), std::string::npos);
  const json found = json::parse(read_file("out.json"));
  EXPECT_TRUE(found["order_parameter"].is_null());
  EXPECT_NEAR(found["order_parameters"][1], 0.91135742, 1e-7);
  EXPECT_LT(std::fabs(found["z"].get<double>()), 5.0);
  const json isotropic = json_of({"capsule:5,0.5", "--orientations-b", "cone:20", "--trials", "4096"});
  EXPECT_FALSE(isotropic["formula"].is_null()) << "beside a body that is turned in any way";
}

TEST_F(Laws, AboutAnotherAxisAreThoseOfTheBodyThatIsTurned) {
  const json upright = json_of({"box:1,1,4", "--orientations", "cone:20", "--trials", "4096"});
  const json lying = json_of({"box:4,1,1", "--orientations", "cone:20", "--axis", "x", "--trials", "16384"});
  const double truth = upright["reference"]["excluded_volume"];
  EXPECT_NEAR(lying["reference"]["excluded_volume"], truth, 1e-4 * truth);
  EXPECT_LT(std::fabs(lying["z"].get<double>()), 5.0);
  EXPECT_EQ(lying["estimate"]["orientations"], "cone:20 about 1,0,0");
}

TEST_F(Laws, ARunGoesOnWithTheSameNumbersWhateverTheFileIsCalled) {
  write_file("density.txt", "-1 1\n0 0.5\n1 1\n");
  write_file("copy.txt", "# the same\n-1, 2\n0, 1\n1, 2\n");
  write_file("other.txt", "-1 1\n0 0.6\n1 1\n");
  const auto words = [](const std::string& file, const Words& more) {
    Words all = {"box:1,1,2", "--estimator", "hit-or-miss", "--orientations", "table:" + file, "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(run(words("density.txt", {"--trials", "1e5", "--checkpoint", "state"})).exit_code, 0);
  const json whole = json_of(words("density.txt", {"--trials", "2e5"}));
  const json resumed = json_of(words("copy.txt", {"--trials", "2e5", "--resume", "state"}));
  EXPECT_EQ(resumed["estimate"]["hits"], whole["estimate"]["hits"]);
  const Finished refused = run(words("other.txt", {"--trials", "2e5", "--resume", "state"}));
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("orientations"), std::string::npos) << refused.err;
}

TEST_F(Laws, AreRefusedWithTheirReason) {
  write_file("descending.txt", "1 1\n0 1\n");
  write_file("negative.txt", "0 1\n1 -1\n");
  write_file("letters.txt", "cos density\n");
  for (const auto& [file, part] : {std::pair{"descending.txt", "do not ascend"}, std::pair{"negative.txt", "negative"},
                                   std::pair{"letters.txt", "letters.txt, line 1"},
                                   std::pair{"missing.txt", "missing.txt"}, std::pair{"/dev/zero", "no file"}}) {
    expect_refusal(run({"sphere:1", "--orientations", std::string("table:") + file}), 3, part);
  }
  expect_refusal(run({"sphere:1", "--orientations", "table:"}), 2, "a table without a file");
  expect_refusal(run({"sphere:1", "--orientations-a", "angle:30"}), 2, "a law of two bodies");
  expect_refusal(run({"sphere:1", "--orientations", "fixed:1,0,0,0", "--orientations-b", "cone:20"}), 2,
                 "a law of two bodies");
  expect_refusal(run({"sphere:1", "--axis", "x"}), 2, "nothing hangs on the bodies' axes");
  expect_refusal(run({"sphere:1", "--orientations", "cone:20", "--axis", "w"}), 2, "not a number");
  expect_refusal(run({"sphere:1", "--orientations", "maier-saupe:1e9"}), 2, "too strong a law");
  write_file("right.txt", "0 1\n1 1\n");
  expect_refusal(run({"sphere:1", "--orientations", "table:right.txt", "--json", "right.txt"}), 2,
                 "the output file is an input");
}

}  // namespace
}  // namespace vex::golden
