// Outputs cost no input and no other file: whatever their names, links and permissions, and whenever the run ends.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "tests/golden/pair.h"
#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

const Words kShortRun = {"--trials", "100", "--estimator", "hit-or-miss", "--quiet"};
const std::string kShortFile = " --trials 100 --estimator hit-or-miss --quiet";

class OutputSafety : public ProgramTest {
 protected:
  static Words with_short_run(Words words) {
    words.insert(words.end(), kShortRun.begin(), kShortRun.end());
    return words;
  }
  unsigned mode_of(const std::string& name) const {
    struct stat found = {};
    EXPECT_EQ(stat(path(name).c_str(), &found), 0) << name;
    return found.st_mode & 07777;
  }
};

class PairOutputSafety : public Pair {
 protected:
  PairOutputSafety() { write_file("poses.csv", kPoses); }
  const std::string kPoses = kQuaternionHeader + "0,0,0,1,0,0,0\n9,0,0,1,0,0,0\n";
};

class BenchOutputSafety : public ProgramTest {
 protected:
  BenchOutputSafety() : ProgramTest(VEX_BENCH_PROGRAM) {}
};

class StressOutputSafety : public ProgramTest {
 protected:
  StressOutputSafety() : ProgramTest(VEX_STRESS_PROGRAM) {}
};

class PaperOutputSafety : public ProgramTest {
 protected:
  PaperOutputSafety() : ProgramTest(VEX_PAPER_PROGRAM) {}
};

// `vex_mesh ico.gltf --json ico.bin` replaced the numbers of the mesh.
TEST_F(OutputSafety, TheBufferBesideAGltfIsAnInput) {
  write_file("body.gltf", tetrahedron_gltf("body.bin"));
  write_file("body.bin", tetrahedron_buffer());
  EXPECT_NEAR(json_of(with_short_run({"body.gltf"})).at("bodies")[0].at("volume").get<double>(), 1.0 / 6.0, 1e-15);
  std::filesystem::create_symlink("body.bin", folder() / "link.json");
  std::filesystem::create_hard_link(folder() / "body.bin", folder() / "twin.json");
  for (const char* output : {"body.bin", "./body.bin", "link.json", "twin.json"}) {
    SCOPED_TRACE(output);
    expect_refusal(run(with_short_run({"body.gltf", "--json", output})), 2, "is an input");
    expect_refusal(run(with_short_run({"box:1,1,1", "body.gltf", "--json", output})), 2, "is an input");
    expect_refusal(run(with_short_run({"rounded:0.1,body.gltf", "--json", output})), 2, "is an input");
    expect_refusal(
        run({"box:1,1,1", "--estimator", "radial", "--control-variate", "body.gltf", "--quiet", "--json", output}), 2,
        "is an input");
  }
  EXPECT_EQ(read_file("body.bin"), tetrahedron_buffer());
  EXPECT_EQ(files(), (std::vector<std::string>{"body.bin", "body.gltf", "link.json", "twin.json"}));
  EXPECT_EQ(run(with_short_run({"body.gltf", "--json", "other.bin"})).exit_code, 0) << "another file may be written";
}

// `vex_pair A B --poses - --json in.csv < in.csv` replaced the poses.
TEST_F(PairOutputSafety, TheFileBehindStandardInputIsAnInput) {
  const std::string pair = "\"$VEX\" box:1,1,1 box:1,1,1 --poses - --quiet --json ";
  expect_refusal(shell(pair + "poses.csv < poses.csv"), 2, "is an input (poses.csv, which is standard input)",
                 "vex_pair");
  ASSERT_EQ(shell("ln poses.csv twin.json && ln -s poses.csv link.json").exit_code, 0);
  expect_refusal(shell(pair + "twin.json < poses.csv"), 2, "is an input", "vex_pair");
  expect_refusal(shell(pair + "link.json < poses.csv"), 2, "is an input", "vex_pair");
  expect_refusal(shell("\"$VEX\" box:1,1,1 box:1,1,1 --poses poses.csv --quiet --json twin.json"), 2,
                 "is an input (twin.json, which is poses.csv)", "vex_pair");
  EXPECT_EQ(read_file("poses.csv"), kPoses);
  EXPECT_EQ(shell(pair + "result.json < poses.csv").exit_code, 0);
  EXPECT_EQ(json::parse(read_file("result.json")).at("rows"), 2);
}

TEST_F(OutputSafety, AListThatALoopReadsIsNotOverwritten) {
  write_file("bodies.txt", "box:1,1,1\nsphere:1\n");
  const Finished finished =
      shell("while read body; do \"$VEX\" $body" + kShortFile + " --json bodies.txt; done < bodies.txt");
  EXPECT_NE(finished.err.find("is an input (bodies.txt, which is standard input)"), std::string::npos) << finished.err;
  EXPECT_EQ(read_file("bodies.txt"), "box:1,1,1\nsphere:1\n");
}

TEST_F(OutputSafety, StandardOutputIsNotAppendedToAnInput) {
  write_file("cube.obj", cube_obj());
  expect_refusal(shell("\"$VEX\" cube.obj --trials 100 >> cube.obj"), 2,
                 "standard output goes into an input (cube.obj)");
  expect_refusal(shell("\"$VEX\" cube.obj --trials 100 --json - >> cube.obj"), 2, "standard output goes into an input");
  expect_refusal(shell("\"$VEX\" - --format obj --trials 100 < cube.obj >> cube.obj"), 2,
                 "standard output goes into an input (standard input)");
  EXPECT_EQ(read_file("cube.obj"), cube_obj());
  EXPECT_EQ(shell("\"$VEX\" cube.obj" + kShortFile + " >> cube.obj").exit_code, 0) << "nothing is printed";
  EXPECT_EQ(read_file("cube.obj"), cube_obj());
}

TEST_F(PairOutputSafety, RowsAreNotAppendedToThePosesTheyAnswer) {
  expect_refusal(shell("\"$VEX\" box:1,1,1 box:1,1,1 --poses poses.csv --csv --quiet >> poses.csv"), 2,
                 "standard output goes into an input (poses.csv)", "vex_pair");
  EXPECT_EQ(read_file("poses.csv"), kPoses);
}

TEST_F(BenchOutputSafety, TwoOutputsAreTwoFiles) {
  write_file("old.csv", "kept");
  ASSERT_EQ(shell("ln old.csv twin.json && ln -s new.csv link.json && ln -s . here").exit_code, 0);
  for (const auto& [csv, document] : std::initializer_list<std::pair<const char*, const char*>>{
           {"x", "x"}, {"x", "./x"}, {"x", "here/x"}, {"old.csv", "twin.json"}, {"new.csv", "link.json"}, {"-", "-"}}) {
    SCOPED_TRACE(std::string(csv) + " and " + document);
    expect_refusal(run({"box:1,1,1", "--seconds", "0.01", "--quiet", "--csv", csv, "--json", document}), 2,
                   "one file for two outputs", "vex_bench");
  }
  expect_refusal(run({"box:1,1,1", "--seconds", "0.01", "--csv", "x.svg", "--plot", "./x.svg"}), 2,
                 "one file for two outputs (x.svg for --csv, ./x.svg for --plot)", "vex_bench");
  EXPECT_EQ(read_file("old.csv"), "kept");
  EXPECT_EQ(files(), (std::vector<std::string>{"here", "link.json", "old.csv", "twin.json"}));
}

TEST_F(BenchOutputSafety, NoOutputIsABody) {
  write_file("body.mesh.csv", "kept");
  for (const char* option : {"--json", "--csv", "--plot"}) {
    ASSERT_EQ(shell("ln -sf body.mesh.csv link.svg").exit_code, 0);
    expect_refusal(run({"body.mesh.csv", "--seconds", "0.01", option, "link.svg"}), 2,
                   "is an input (link.svg, which is body.mesh.csv)", "vex_bench");
  }
  EXPECT_EQ(read_file("body.mesh.csv"), "kept");
}

TEST_F(StressOutputSafety, TwoOutputsAreTwoFiles) {
  expect_refusal(run({"--pairs", "1", "--json", "x.svg", "--plot", "./x.svg"}), 2, "one file for two outputs",
                 "vex_stress");
  EXPECT_TRUE(files().empty());
}

TEST_F(PaperOutputSafety, TheReportDoesNotGoIntoTheDocument) {
  expect_refusal(shell("\"$VEX\" --table 1 --trials 10 --json result.json > result.json"), 2, "", "vex_paper");
}

TEST_F(OutputSafety, StandardOutputIsNotTheFileOfAnotherOutput) {
  const Finished finished = shell("\"$VEX\" box:1,1,1 --trials 100 --json result.json > result.json");
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.err.find("standard output goes into the file of another output (result.json for --json)"),
            std::string::npos)
      << finished.err;
  EXPECT_EQ(shell("\"$VEX\" box:1,1,1 --trials 100 --json /dev/null > /dev/null").exit_code, 0);
}

TEST_F(OutputSafety, DevicesAndPipesAreWrittenWhereTheyAre) {
  EXPECT_TRUE(json::accept(shell("\"$VEX\" box:1,1,1" + kShortFile + " --json /dev/stdout | cat").out));
  EXPECT_TRUE(json::accept(shell("{ \"$VEX\" box:1,1,1" + kShortFile + " --json /dev/fd/3 3>&1; } | cat").out));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(shell("cat pipe > received & \"$VEX\" box:1,1,1" + kShortFile + " --json pipe && wait").exit_code, 0);
  EXPECT_TRUE(json::accept(read_file("received")));
  EXPECT_TRUE(std::filesystem::is_fifo(folder() / "pipe"));
  // A file whose name is gone is still written to through its descriptor.
  EXPECT_TRUE(json::accept(
      shell("exec 3<> gone; rm gone; \"$VEX\" box:1,1,1" + kShortFile + " --json /dev/fd/3; cat /dev/fd/3").out));
  EXPECT_EQ(files(), (std::vector<std::string>{"pipe", "received"}));
}

// The file beside the output was called result.json.tmp and the process's number, and was opened through a link.
TEST_F(OutputSafety, ALinkThatWaitsIsNotFollowed) {
  write_file("victim", "kept");
  EXPECT_EQ(
      shell("ln -s victim result.json.tmp$$; exec \"$VEX\" box:1,1,1" + kShortFile + " --json result.json").exit_code,
      0);
  EXPECT_EQ(read_file("victim"), "kept");
  EXPECT_TRUE(json::accept(read_file("result.json")));
}

TEST_F(OutputSafety, PermissionsAreKept) {
  for (const unsigned mode : {0600u, 0640u, 0664u, 0666u, 0700u}) {
    write_file("result.json", "old");
    chmod(path("result.json").c_str(), mode);
    EXPECT_EQ(shell("umask 027; \"$VEX\" box:1,1,1" + kShortFile + " --json result.json").exit_code, 0);
    EXPECT_EQ(mode_of("result.json"), mode);
    EXPECT_TRUE(json::accept(read_file("result.json")));
  }
  std::filesystem::create_symlink("secret.json", folder() / "link.json");
  write_file("secret.json", "old");
  chmod(path("secret.json").c_str(), 0600);
  EXPECT_EQ(run(with_short_run({"box:1,1,1", "--json", "link.json"})).exit_code, 0);
  EXPECT_EQ(mode_of("secret.json"), 0600u);
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link.json"));
}

TEST_F(OutputSafety, ANewFileHasWhatTheMaskLeaves) {
  for (const auto& [mask, mode] : std::initializer_list<std::pair<const char*, unsigned>>{
           {"022", 0644u}, {"077", 0600u}, {"027", 0640u}, {"000", 0666u}}) {
    const std::string name = std::string("result") + mask + ".json";
    EXPECT_EQ(shell(std::string("umask ") + mask + "; \"$VEX\" box:1,1,1" + kShortFile + " --json " + name).exit_code,
              0);
    EXPECT_EQ(mode_of(name), mode) << mask;
  }
}

TEST_F(OutputSafety, TheOwnerIsKeptWhereThisUserMayGiveFilesAway) {
  if (geteuid() != 0) {
    // Then it is this user's file before and after.
    write_file("result.json", "old");
    EXPECT_EQ(run(with_short_run({"box:1,1,1", "--json", "result.json"})).exit_code, 0);
    struct stat found = {};
    ASSERT_EQ(stat(path("result.json").c_str(), &found), 0);
    EXPECT_EQ(found.st_uid, geteuid());
    return;
  }
  write_file("result.json", "old");
  ASSERT_EQ(chown(path("result.json").c_str(), 12345, 23456), 0);
  EXPECT_EQ(run(with_short_run({"box:1,1,1", "--json", "result.json"})).exit_code, 0);
  struct stat found = {};
  ASSERT_EQ(stat(path("result.json").c_str(), &found), 0);
  EXPECT_EQ(found.st_uid, 12345u);
  EXPECT_EQ(found.st_gid, 23456u);
  EXPECT_TRUE(json::accept(read_file("result.json")));
}

TEST_F(OutputSafety, AFileThatCannotBeWrittenLeavesTheOldOneAndNothingBeside) {
  write_file("result.json", "old");
  // A document has more than the 512 or 1024 bytes that the limit lets through.
  const Finished finished = shell("ulimit -f 1; \"$VEX\" box:1,1,1" + kShortFile + " --json result.json");
  EXPECT_EQ(finished.exit_code, 1) << finished.err;
  EXPECT_NE(finished.err.find("cannot be written (result.json: File too large)"), std::string::npos) << finished.err;
  EXPECT_EQ(read_file("result.json"), "old");
  EXPECT_EQ(files(), std::vector<std::string>{"result.json"});
}

TEST_F(OutputSafety, ALongNameIsStillAName) {
  const std::string name(255, 'n');
  EXPECT_EQ(run(with_short_run({"box:1,1,1", "--json", name})).exit_code, 0);
  EXPECT_TRUE(json::accept(read_file(name)));
  EXPECT_EQ(files(), std::vector<std::string>{name});
  EXPECT_EQ(run(with_short_run({"box:1,1,1", "--json", std::string(300, 'n')})).exit_code, 2);
  EXPECT_EQ(files(), std::vector<std::string>{name});
}

// The signal was remembered for a run that had ended, and the program waited on.
TEST_F(OutputSafety, ASignalEndsTheWaitForAPipeThatNobodyReads) {
  const Finished result = shell("mkfifo pipe && timeout -k 20 2 \"$VEX\" box:1,1,1 --json pipe" + kShortFile);
  EXPECT_EQ(result.exit_code, 124) << "timeout's own; 137 where it had to kill";
}

TEST_F(OutputSafety, ANameThatCannotBeIsRefusedBeforeTheRun) {
  expect_refusal(run(with_short_run({"box:1,1,1", "--json", std::string(256, 'n')})), 2, "cannot be there");
}

TEST_F(OutputSafety, AnInterruptedRunLeavesTheDocumentAndNothingBeside) {
  // The second signal ends the program at once, unless the document is being written.
  for (int k = 0; k < 8; ++k) {
    const Finished finished = run_and_signal({"box:1,1,1", "--rel-error", "1e-12", "--threads", "2", "--quiet",
                                              "--estimator", "hit-or-miss", "--json", "result.json"},
                                             SIGINT, [k](pid_t process) {
                                               if (!has_worker_threads(process)) return false;
                                               std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                               kill(process, SIGINT);
                                               std::this_thread::sleep_for(std::chrono::milliseconds(2 * k));
                                               return true;
                                             });
    EXPECT_EQ(finished.exit_code, 130) << finished.err;
    for (const std::string& name : files()) EXPECT_EQ(name, "result.json");
    if (!files().empty()) {
      EXPECT_TRUE(json::accept(read_file("result.json")));
    }
  }
}

}  // namespace
}  // namespace vex::golden
