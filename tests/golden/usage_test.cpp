// Wrong usage: exit code 2 and one line that says what is wrong and what to do.
#include <sys/stat.h>

#include <algorithm>
#include <span>

#include "engine/numeric/instruction_set.h"
#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

class Usage : public ProgramTest {
 protected:
  void expect_wrong(const Words& words, const std::string& part_of_message) const {
    SCOPED_TRACE(testing::PrintToString(words));
    expect_refusal(run(words), 2, part_of_message);
  }
};

TEST_F(Usage, ABodyIsNeeded) {
  expect_wrong({}, "nothing is given for A");
  expect_wrong({"--trials", "10"}, "nothing is given for A");
  expect_wrong({""}, "empty");
  expect_wrong({"box:1,1,1", ""}, "empty");
  expect_wrong({"box:1,1,1", "box:1,1,1", "third"}, "not understood (third)");
}

TEST_F(Usage, AnUnknownOptionIsNamedWithWhatWasMeant) {
  expect_wrong({"box:1,1,1", "--trails", "10"}, "did you mean --trials?");
  expect_wrong({"box:1,1,1", "-trials", "10"}, "did you mean --trials?");
  expect_wrong({"box:1,1,1", "--rel-eror=1e-2"}, "did you mean --rel-error?");
  expect_wrong({"box:1,1,1", "--bananas"}, "not understood (--bananas) - vex_mesh --help");
  expect_wrong({"box:1,1,1", "-q"}, "-q");
}

TEST_F(Usage, AValueThatIsMissingOrEmpty) {
  for (const char* option : {"--trials",    "--rel-error",        "--seconds", "--max-trials", "--orientations",
                             "--estimator", "--sequence",         "--domain",  "--seed",       "--threads",
                             "--backend",   "--convex-tolerance", "--json",    "--max-z",      "--scale",
                             "--scale-a",   "--scale-b",          "--unit",    "--weld",       "--format"}) {
    expect_wrong({"box:1,1,1", option}, std::string("a value is missing (after ") + option);
    expect_wrong({"box:1,1,1", option, ""}, "empty");
    expect_wrong({"box:1,1,1", std::string(option) + "="}, "missing");
  }
  expect_wrong({"box:1,1,1", "--json"}, "--json FILE");
  expect_wrong({"box:1,1,1", "--trials", "10", "--json", "--quiet"}, "--quiet");
  EXPECT_TRUE(files().empty());
}

TEST_F(Usage, AnOptionGivenTwice) {
  expect_wrong({"box:1,1,1", "--trials", "10", "--trials", "20"}, "more than once (--trials)");
  expect_wrong({"box:1,1,1", "--seed=1", "--seed=1"}, "more than once (--seed)");
  expect_wrong({"box:1,1,1", "--json", "a", "--json", "b"}, "more than once (--json)");
}

TEST_F(Usage, AFlagWithAValue) {
  expect_wrong({"box:1,1,1", "--quiet=no"}, "takes no value (--quiet)");
  expect_wrong({"box:1,1,1", "--no-quick-verdicts=false"}, "takes no value (--no-quick-verdicts)");
}

TEST_F(Usage, ACountThatIsNone) {
  for (const char* option : {"--trials", "--max-trials", "--threads"}) {
    for (const char* word :
         {"0", "-1", "1.5", "1e-3", "many", "1e400", "nan", "inf", "-0.0", "1e20", "1,000", "0x10"}) {
      expect_wrong({"box:1,1,1", option, word}, std::string("\"") + word + "\" for " + option);
    }
  }
  for (const char* word : {"-1", "1.5", "x", "1e400", "18446744073709551616"}) {
    expect_wrong({"box:1,1,1", "--seed", word}, "not a count");
  }
  expect_wrong({"box:1,1,1", "--threads", "1000000"}, "too many threads");
}

TEST_F(Usage, ANumberThatIsNone) {
  for (const char* option : {"--rel-error", "--seconds", "--max-z"}) {
    for (const char* word : {"0", "-1", "little", "nan", "inf", "1e400", "1,5", "1e-3x"}) {
      expect_wrong({"box:1,1,1", option, word}, std::string("\"") + word + "\" for " + option);
    }
  }
  for (const char* word : {"-1e-9", "0.2", "nan", "tight"}) {
    expect_wrong({"box:1,1,1", "--convex-tolerance", word}, "--convex-tolerance");
  }
}

TEST_F(Usage, AnEstimatorWithoutVerdictsHasNoBackendAndNothingToCheck) {
  for (const char* estimator : {"radial", "mixed-volume", "mean-width"}) {
    for (const Words& words :
         {Words{"--verify"}, Words{"--cross-check"}, Words{"--no-quick-verdicts"}, Words{"--backend", "specialised"}}) {
      Words all = {"box:1,1,1", "--estimator", estimator};
      all.insert(all.end(), words.begin(), words.end());
      expect_wrong(all, words[0].substr(2) + " is about overlap verdicts");
    }
  }
  expect_wrong({"box:1,1,1", "--estimator", "radiant"},
               "there are radial, hit-or-miss-fitted, hit-or-miss, stratified, mixed-volume, mean-width");
  expect_wrong({"box:1,1,1", "--sequence", "halton"}, "there are random, sobol");
}

TEST_F(Usage, AChoiceThatDoesNotExist) {
  for (const auto& [option, known] :
       std::initializer_list<std::pair<const char*, const char*>>{{"--estimator", "radial"},
                                                                  {"--sequence", "random"},
                                                                  {"--domain", "ball, box, best"},
                                                                  {"--backend", "gjk"},
                                                                  {"--isa", "best, scalar, sse2, avx2, avx512"},
                                                                  {"--orientations", "isotropic, aligned"}}) {
    expect_wrong({"box:1,1,1", option, "wild"}, std::string("(\"wild\" for ") + option + ") - there are " + known);
  }
  expect_wrong({"box:1,1,1", "--orientations", "aligned:30"}, "not a choice");
  expect_wrong({"box:1,1,1", "--domain", "Box"}, "not a choice");
}

TEST_F(Usage, AnInstructionSetThatThisMachineLacks) {
  const std::span<const InstructionSet> sets = instruction_sets();
  for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    if (std::find(sets.begin(), sets.end(), set) != sets.end()) continue;
    const std::string name(name_of(set));
    expect_wrong({"box:1,1,1", "--isa", name},
                 "this machine or build has none (\"" + name + "\" for --isa) - its best is");
  }
  EXPECT_EQ(run({"box:1,1,1", "--trials", "10", "--isa", "best"}).exit_code, 0);
}

TEST_F(Usage, OrientationsThatMeanNothing) {
  const auto expect_refused = [this](const std::string& law, const std::string& part) {
    expect_wrong({"box:1,1,1", "--trials", "10", "--orientations", law}, part);
  };
  for (const char* law : {"cone:91", "cone:90.0001", "cone:-1", "cone:-1e-300"}) {
    expect_refused(law, std::string("not an angle from +-z (\"") + law + "\" for --orientations)");
  }
  expect_refused("onsager:-1", "a negative alpha (\"onsager:-1\" for --orientations)");
  expect_refused("fixed:0,0,0,0", "a quaternion of length 0");
  expect_refused("fixed:0,-0,0.0,0", "a quaternion of length 0");
  for (const char* law : {"fixed:1", "fixed:1,2,3", "fixed:1,2,3,4,5"}) expect_refused(law, "not a quaternion");
  for (const char* law : {"cone:1,2", "onsager:1,2"}) expect_refused(law, "more than one number");
  for (const char* law :
       {"cone:", "onsager:", "fixed:", "cone:nan", "onsager:nan", "onsager:inf", "cone:1e400", "fixed:1,0,0,nan",
        "fixed:1,0,0,inf", "fixed:1,0,0,", "fixed:1,,0,0", "cone:wide", "cone: 1", "cone:1deg"}) {
    expect_refused(law, "--orientations");
  }
  for (const char* law :
       {"cone", "fixed", "onsager", "cones:1", "Cone:1", ":1", "isotropic:", "isotropic:1", "fixed1"}) {
    expect_refused(law, "there are isotropic, aligned, fixed:W,X,Y,Z, angle:DEG, cone:DEG, onsager:ALPHA");
  }
}

TEST_F(Usage, OnlyHitOrMissHasAChoiceOfDomains) {
  for (const char* estimator : {"hit-or-miss-fitted", "stratified", "radial", "mixed-volume", "mean-width"}) {
    for (const char* domain : {"ball", "box", "best"}) {
      expect_wrong(
          {"box:1,1,1", "--estimator", estimator, "--domain", domain},
          std::string("only hit-or-miss has a choice of domains (\"") + domain + "\" for domain with " + estimator);
    }
  }
  expect_wrong({"box:1,1,1", "--domain", "fitted"}, "there are ball, box, best");
}

TEST_F(Usage, ABodyThatDoesNotExist) {
  for (const char* body : {"spher:1", "cube:1", "Sphere:1", "BOX:1,1,1"}) expect_wrong({body}, "sphere:R");
  expect_wrong({"sphere"}, "sphere:R (radius)");
  expect_wrong({"needle"}, "needle:L (length");
  for (const char* body : {"truncated_cube:1", "truncated-cubes:1"})
    expect_wrong({body}, "did you mean truncated-cube:E?");
  expect_wrong({"rounded"}, "rounded:r,BODY");
  expect_wrong({"rounded:0.1"}, "rounded:r,BODY");
  expect_wrong({"rounded:0.1,sphere"}, "sphere:R (radius)");
  expect_wrong({"rounded:0.1,spher:1"}, "no body of this name (spher:1)");
  expect_wrong({"rounded:wide,sphere:1"}, "not a number (\"wide\"");
  expect_wrong({"frustum:1,2"}, "frustum:H,R1,R2");
  expect_wrong({"box:"}, "wrong number of sizes (0 in box:) - write box:A,B,C");
  expect_wrong({"box:1,2"}, "wrong number of sizes (2 in box:1,2) - write box:A,B,C");
  expect_wrong({"box:1,2,3,4"}, "wrong number of sizes (4");
  expect_wrong({"sphere:1,2"}, "wrong number of sizes");
  expect_wrong({"capsule:1"}, "wrong number of sizes");
  expect_wrong({"ellipsoid:1"}, "wrong number of sizes");
  for (const char* body : {"sphere:one", "sphere:1 ", "box:1,,1", "box:1;1;1", "sphere:1m"}) {
    expect_wrong({body}, "not a number");
  }
}

TEST_F(Usage, ScalesAndVerticesThatMeanNothing) {
  for (const char* word : {"0", "-2", "nan", "inf", "large", "1e400"}) {
    expect_wrong({"box:1,1,1", "--scale", word}, std::string("\"") + word + "\" for --scale");
  }
  expect_wrong({"sphere:1", "capsule:1,1", "--dump-vertices"},
               "not a polytope, so it has no vertices to list (sphere:1)");
  expect_refusal(run({"disc:1", "--unit-volume"}), 3, "no volume to scale to 1 (disc:1)");
  expect_refusal(run({"box:1,1,1", "needle:1", "--unit-volume"}), 3, "no volume to scale to 1 (needle:1)");
  expect_refusal(run({"box:1,1,1", "--scale", "1e46"}), 3, "out of range");
  expect_refusal(run({"rounded:0,box:1,1,1"}), 3, "not positive");
}

TEST_F(Usage, AnOutputThatWouldCostAFile) {
  write_file("cube.obj", cube_obj());
  write_file("body.mesh.json", "kept");
  const auto expect_refused = [&](const std::string& body, const std::string& output, const std::string& part) {
    expect_wrong({body, "--trials", "10", "--json", output}, part);
  };
  expect_refused("cube.obj", "cube.obj", "extension of a mesh");
  for (const char* extension : {".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf", ".OBJ", ".Stl"}) {
    expect_refused("cube.obj", std::string("result") + extension, "extension of a mesh");
  }
  expect_refused("body.mesh.json", "body.mesh.json", "is an input");
  expect_refused("body.mesh.json", "./body.mesh.json", "is an input");
  expect_refused("body.mesh.json", path("body.mesh.json"), "is an input");
  std::filesystem::create_symlink("body.mesh.json", folder() / "alias.json");
  expect_refused("body.mesh.json", "alias.json", "is an input");
  std::filesystem::create_hard_link(folder() / "body.mesh.json", folder() / "twin.json");
  expect_refused("body.mesh.json", "twin.json", "is an input");
  expect_wrong({"box:1,1,1", "body.mesh.json", "--json", "body.mesh.json"}, "is an input");
  expect_wrong({"rounded:0.1,body.mesh.json", "--json", "body.mesh.json"}, "is an input");
  expect_refused("cube.obj", ".", "is a folder");
  expect_refused("cube.obj", "/", "is a folder");
  expect_refused("cube.obj", "no/such/folder/result.json", "folder does not exist");
  expect_refused("cube.obj", "cube.obj/result.json", "folder does not exist");
  EXPECT_EQ(read_file("cube.obj"), cube_obj());
  EXPECT_EQ(read_file("body.mesh.json"), "kept");
  EXPECT_EQ(files(), (std::vector<std::string>{"alias.json", "body.mesh.json", "cube.obj", "twin.json"}));
}

TEST_F(Usage, AWriteProtectedOutputIsRefusedBeforeTheRun) {
  write_file("result.json", "kept");
  chmod(path("result.json").c_str(), 0444);
  expect_refusal(shell(kWithoutOverride + "\"$VEX\" box:1,1,1 --json result.json"), 2, "write-protected");
  chmod(folder().c_str(), 0555);
  expect_refusal(shell(kWithoutOverride + "\"$VEX\" box:1,1,1 --json other.json"), 2, "cannot be written");
}

}  // namespace
}  // namespace vex::golden
