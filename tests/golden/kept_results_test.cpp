// A result that was computed is not lost: where its file cannot be written it is on standard output, and no other file
// is missing.
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "tests/golden/pair.h"
#include "tests/golden/program.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

const std::string kRun = "\"$VEX\" box:1,1,1 --trials 100 --estimator hit-or-miss ";
const std::string kEndless = "\"$VEX\" box:1,1,1 --rel-error 1e-12 --estimator hit-or-miss --threads 1 ";

class KeptResults : public ProgramTest {
 protected:
  void SetUp() override {
    write_file("scene.csv", kSceneHeader + upright("box:1,1,1", 0, 0, 0) + upright("box:1,1,1", 0.75, 0, 0));
    write_file("poses.csv", kQuaternionHeader + "0,0,0,1,0,0,0\n9,0,0,1,0,0,0\n");
  }
  static json parsed(const std::string& text) { return json::parse(text, nullptr, false); }

  void expect_document(const Finished& finished, int exit_code, const std::string& part_of_message) const {
    EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
    EXPECT_TRUE(parsed(finished.out).is_object()) << finished.out;
    EXPECT_NE(finished.err.find(part_of_message), std::string::npos) << finished.err;
    EXPECT_NE(finished.err.find("its text is on standard output"), std::string::npos) << finished.err;
  }
};

const char* const kFull = "No space left on device";

TEST_F(KeptResults, TheDocumentOfAFullDiskIsOnStandardOutput) {
  expect_document(shell(kRun + "--quiet --json /dev/full"), 1, kFull);
  const std::string pair = VEX_PAIR_PROGRAM, paper = VEX_PAPER_PROGRAM, bench = VEX_BENCH_PROGRAM,
                    stress = VEX_STRESS_PROGRAM, scene = VEX_SCENE_PROGRAM, percolate = VEX_PERCOLATE_PROGRAM;
  for (const std::string& line :
       {pair + " box:1,1,1 sphere:1 --rotation 1,0,0,0 --translation 1,0,0",
        pair + " box:1,1,1 sphere:1 --poses poses.csv", paper + " --table 2 --trials 100",
        bench + " sphere:1 --seconds 0.001", stress + " --pairs 1 --stratum touching",
        scene + " scene.csv --query counts", percolate + " box:1,1,1 --sizes 2,3 --realisations 2"}) {
    SCOPED_TRACE(line);
    expect_document(shell(line + " --quiet --json /dev/full"), 1, kFull);
  }
}

TEST_F(KeptResults, BehindAReportTheDocumentFollows) {
  const Finished finished = shell(kRun + "--json /dev/full");
  EXPECT_EQ(finished.exit_code, 1);
  const std::size_t begin = finished.out.find("\n{");
  ASSERT_NE(begin, std::string::npos) << finished.out;
  EXPECT_NE(finished.out.substr(0, begin).find("Monte Carlo"), std::string::npos);
  EXPECT_TRUE(parsed(finished.out.substr(begin)).is_object());
}

TEST_F(KeptResults, AFolderThatGoesAwayCostsNothing) {
  const Finished finished =
      shell("mkdir gone; cd gone; " + kEndless +
            "--quiet --json result.json & program=$!; " + kUntilItTakesSignals +
            "sleep 0.4; rmdir ../gone; kill -TERM $program; wait $program; exit $?");
  expect_document(finished, 1, "cannot be written (result.json: No such file or directory)");
}

TEST_F(KeptResults, ALimitOnTheSizeOfFilesCostsNothing) {
  const Finished finished = shell("{ (ulimit -f 1; " + kRun + "--quiet --json result.json; echo $? > code); } | cat");
  EXPECT_TRUE(parsed(finished.out).is_object()) << finished.out;
  EXPECT_NE(finished.err.find("File too large"), std::string::npos) << finished.err;
  EXPECT_EQ(read_file("code"), "1\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"code", "poses.csv", "scene.csv"}));
}

// What another program reads is not mixed with the document.
TEST_F(KeptResults, TheDocumentIsNotAmongRows) {
  const std::string scene = VEX_SCENE_PROGRAM, pair = VEX_PAIR_PROGRAM, bench = VEX_BENCH_PROGRAM;
  for (const std::string& line : {scene + " scene.csv", pair + " box:1,1,1 sphere:1 --poses poses.csv --csv",
                                  bench + " sphere:1 --seconds 0.001 --csv -"}) {
    SCOPED_TRACE(line);
    const Finished finished = shell(line + " --quiet --json /dev/full");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_EQ(finished.out.find('{'), std::string::npos) << finished.out;
    EXPECT_FALSE(finished.out.empty());
    EXPECT_NE(finished.err.find("its text follows\n"), std::string::npos) << finished.err;
    EXPECT_TRUE(parsed(finished.err.substr(finished.err.find("\n{"))).is_object()) << finished.err;
  }
}

TEST_F(KeptResults, WhereStandardOutputFailsTooItIsOnStandardError) {
  for (const char* words : {"--quiet --json /dev/full > /dev/full", "--json - > /dev/full", "--quiet --json - >&-"}) {
    const Finished finished = shell(kRun + words);
    EXPECT_EQ(finished.exit_code, 1);
    const std::size_t begin = finished.err.find("\n{");
    ASSERT_NE(begin, std::string::npos) << finished.err;
    EXPECT_TRUE(parsed(finished.err.substr(begin)).is_object()) << finished.err;
  }
  EXPECT_NE(shell(kRun + "> /dev/full").err.find("Monte Carlo"), std::string::npos) << "the report";
}

TEST_F(KeptResults, OneOutputThatFailsDropsNoOther) {
  const std::string bench = std::string(VEX_BENCH_PROGRAM) + " sphere:1 --seconds 0.001 --quiet ";
  Finished finished = shell(bench + "--json /dev/full --csv table.csv --plot plot.svg");
  expect_document(finished, 1, kFull);
  EXPECT_NE(read_file("table.csv").find("relative_error"), std::string::npos) << read_file("table.csv");
  EXPECT_NE(read_file("plot.svg").find("</svg>"), std::string::npos);
  finished = shell(bench + "--json result.json --csv /dev/full --plot /dev/full");
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_TRUE(parsed(read_file("result.json")).is_object());
  EXPECT_NE(finished.out.find("relative_error"), std::string::npos) << "the table";
  EXPECT_EQ(finished.out.find("</svg>"), std::string::npos) << "and no picture behind it";

  const std::string percolate = std::string(VEX_PERCOLATE_PROGRAM) + " box:1,1,1 --sizes 2,3 --realisations 2 --quiet ";
  finished = shell(percolate + "--csv /dev/full --plot /dev/full --json p.json --gltf p.glb");
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_TRUE(parsed(read_file("p.json")).is_object());
  EXPECT_EQ(read_file("p.glb").substr(0, 4), "glTF");

  const std::string scene = std::string(VEX_SCENE_PROGRAM) + " scene.csv --quiet ";
  ASSERT_EQ(symlink("/dev/full", path("full.glb").c_str()), 0);
  finished = shell(scene + "--save /dev/full --gltf full.glb --svg s.svg --json s.json");
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_EQ(finished.out, kPairHeader + "0,1,0,0,0\n");
  EXPECT_NE(read_file("s.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(parsed(read_file("s.json")).at("pairs"), 1);

  finished =
      shell(std::string(VEX_STRESS_PROGRAM) + " --pairs 1 --stratum touching --quiet --json /dev/full --plot p.svg");
  expect_document(finished, 1, kFull);
  EXPECT_NE(read_file("p.svg").find("</svg>"), std::string::npos);
}

TEST_F(KeptResults, ANameThatIsTooLongIsRefusedBeforeTheRun) {
  const std::string name(256, 'n'), folder(255, 'f');
  std::string path;
  for (int k = 0; k < 17; ++k) path += folder + "/";
  const std::string bench = VEX_BENCH_PROGRAM, percolate = VEX_PERCOLATE_PROGRAM, scene = VEX_SCENE_PROGRAM;
  for (const std::string& line :
       {kEndless + "--json " + name, kEndless + "--json " + path + "r.json", bench + " sphere:1 --csv " + name,
        bench + " sphere:1 --plot " + name, percolate + " box:1,1,1 --gltf " + name + ".glb",
        percolate + " box:1,1,1 --checkpoint " + name, scene + " scene.csv --save " + name}) {
    const Finished finished = shell(line);
    EXPECT_EQ(finished.exit_code, 2) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_NE(finished.err.find("name too long"), std::string::npos) << finished.err;
  }
}

// A pipe's reader was waited for behind a signal that had ended the run, for ever.
TEST_F(KeptResults, ASignalEndsARunWhosePipeNobodyReads) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const std::string message = "interrupted before pipe was written";
  expect_document(shell(kEndless + "--quiet --json pipe & program=$!; " + kUntilItTakesSignals +
                        "sleep 0.4; kill -TERM $program; wait $program"),
                  143, message);
  expect_document(shell(kRun + "--quiet --json pipe & program=$!; " + kUntilItTakesSignals +
                        "sleep 0.4; kill -TERM $program; wait $program"),
                  143, message);
  const std::string percolate = std::string(VEX_PERCOLATE_PROGRAM) + " box:1,1,1 --sizes 2,3 --realisations 2 --quiet ";
  const Finished finished = shell(percolate + "--csv pipe --json p.json & program=$!; " + kUntilItTakesSignals +
                                  "sleep 0.4; kill -TERM $program; wait $program");
  EXPECT_EQ(finished.exit_code, 143) << finished.err;
  EXPECT_EQ(finished.out.rfind("# vex_percolate", 0), 0u) << "the realisations: " << finished.out;
  EXPECT_TRUE(parsed(read_file("p.json")).is_object());
}

}  // namespace
}  // namespace vex::golden
