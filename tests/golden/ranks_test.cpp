// mpirun -n K: what one process says, whatever the number of ranks; and what is left where one is lost.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/golden/program.h"
#include "tests/golden/run_documents.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class RanksTest : public ProgramTest {
 protected:
  explicit RanksTest(const std::string& program = VEX_MESH_PROGRAM) : ProgramTest(program) {}

  void SetUp() override {
#ifndef VEX_WITH_MPI
    GTEST_SKIP() << "this build is without MPI";
#endif
    if (shell("command -v mpirun").exit_code != 0) GTEST_SKIP() << "no mpirun";
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // Open MPI keeps memory to its end
  }
  void TearDown() override {
    unsetenv("ASAN_OPTIONS");
    ProgramTest::TearDown();
  }
  void expect_what_one_process_says(const std::vector<std::string>& runs) const;
  Finished on_ranks(int n, const std::string& arguments) const {
    return shell("exec mpirun --oversubscribe --allow-run-as-root --bind-to none -n " + std::to_string(n) +
                 " \"$VEX\" " + arguments);
  }
};

void RanksTest::expect_what_one_process_says(const std::vector<std::string>& runs) const {
  for (const std::string& words : runs) {
    ASSERT_EQ(shell("\"$VEX\" " + words + " --quiet --json one.json").exit_code, 0);
    const json one = without_times(json::parse(read_file("one.json")));
    for (const int n : {1, 2, 4}) {
      if (n == 1 && words != runs.front()) continue;
      const Finished finished = on_ranks(n, words + " --quiet --threads 1 --json ranks.json");
      ASSERT_EQ(finished.exit_code, 0) << finished.err;
      EXPECT_EQ(without_times(json::parse(read_file("ranks.json"))), one) << n << " ranks: " << words;
    }
  }
}

TEST_F(RanksTest, AnyNumberOfThemSaysWhatOneProcessSays) {
  expect_what_one_process_says({"box:1,1,2 capsule:1,0.3 --estimator hit-or-miss --trials 3e6",
                                "box:1,1,2 capsule:1,0.3 --estimator hit-or-miss-fitted --rel-error 1e-3",
                                "box:1,1,2 --rel-error 3e-5",
                                // Read by a confined process, which gives up what ranks share.
                                VEX_SOURCE_DIR "/meshes/data/icosahedron.gltf --estimator hit-or-miss --trials 1e5"});
}

TEST_F(RanksTest, WithoutItsPartAProgramSaysSo) {
  ASSERT_EQ(shell("mkdir bin && cp \"$VEX\" bin/vex_mesh").exit_code, 0);
  const Finished finished = shell("OMPI_COMM_WORLD_SIZE=2 bin/vex_mesh box:1,1,1 --rel-error 1e-3");
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_EQ(finished.err.rfind("vex_mesh: a part of the program cannot be loaded", 0), 0u) << finished.err;
  EXPECT_EQ(shell("bin/vex_mesh box:1,1,1 --trials 100").exit_code, 0) << "one process needs no such part";
}

class VirialRanks : public RanksTest {
 protected:
  VirialRanks() : RanksTest(VEX_VIRIAL_PROGRAM) {}
};

// A run of the driver for each coefficient: what was asked or made for the one before must not count.
TEST_F(VirialRanks, AnyNumberOfThemSaysWhatOneProcessSays) {
  expect_what_one_process_says(
      {"box:1,1,2 --order 5 --trials 500", "cylinder:2,0.5 --rel-error 5e-3", "sphere:1 box:1,1,1 --trials 100"});
}

class PercolateRanks : public RanksTest {
 protected:
  PercolateRanks() : RanksTest(VEX_PERCOLATE_PROGRAM) {}
};

TEST_F(PercolateRanks, AnyNumberOfThemSaysWhatOneProcessSays) {
  expect_what_one_process_says({"box:1,1,1 --sizes 3,4 --realisations 200 --first-realisation 0",
                                "box:1,1,1 sphere:0.5 --sizes 3,5 --std-error 5e-3"});
}

TEST_F(RanksTest, OneOfThemSpeaks) {
  const Finished report = on_ranks(3, "box:1,1,2 --trials 1e4 --threads 1");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.out.find("<V_ex>, Monte Carlo"), report.out.rfind("<V_ex>, Monte Carlo")) << report.out;
  const Finished refused = on_ranks(3, "missing.obj");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.err.find("vex_mesh: "), refused.err.rfind("vex_mesh: ")) << refused.err;
  EXPECT_EQ(on_ranks(2, "needle:1 --quiet").exit_code, 0);  // nothing to do for anybody
}

TEST_F(RanksTest, OneThatHasAnotherBodyTakesNoPart) {
  const Finished finished = shell(
      "printf 'exec \"$VEX\" box:1,1,$((1 + OMPI_COMM_WORLD_RANK)) --estimator hit-or-miss --seconds 20 --threads 1' > "
      "run.sh; "
      "exec mpirun --oversubscribe --allow-run-as-root --bind-to none -n 2 sh run.sh");
  EXPECT_EQ(finished.exit_code, 3) << finished.out;
  EXPECT_NE(finished.err.find("rank 1 has other bodies"), std::string::npos) << finished.err;
}

TEST_F(RanksTest, WhereOneIsLostTheCheckpointIsUsable) {
  const Finished finished = shell(
      "printf 'if [ $OMPI_COMM_WORLD_RANK = 1 ]; then (until [ -s c.state ]; do sleep 0.1; done; kill -KILL $$) & fi; "
      "exec \"$VEX\" box:1,1,2 --estimator hit-or-miss --trials 1e11 --threads 1 --checkpoint c.state "
      "--checkpoint-every 0.2 --quiet' > run.sh; "
      "exec mpirun --oversubscribe --allow-run-as-root --bind-to none -n 2 sh run.sh");
  EXPECT_NE(finished.exit_code, 0);
  const std::string state = read_file("c.state");
  ASSERT_NE(state.find("# end, crc32 "), std::string::npos) << finished.err;
  // What it holds is what one process finds: "trials N HITS UNDECIDED".
  std::istringstream line(state.substr(state.find("\ntrials ") + 8));
  std::string n_trials;
  std::uint64_t n_hits = 0;
  line >> n_trials >> n_hits;
  EXPECT_EQ(json_of({"box:1,1,2", "--estimator", "hit-or-miss", "--trials", n_trials})["estimate"]["hits"], n_hits);
  EXPECT_EQ(json_of({"box:1,1,2", "--estimator", "hit-or-miss", "--trials", n_trials, "--resume",
                     "c.state"})["estimate"]["hits"],
            n_hits);
}

// A program of which nothing is for many ranks says so.
class CopiesOfALauncher : public ProgramTest {
 protected:
  CopiesOfALauncher() : ProgramTest(VEX_PAIR_PROGRAM) {}
};

TEST_F(CopiesOfALauncher, AreToldThatEachDoesAllOfTheWork) {
  const std::string words = "\"$VEX\" box:1,1,1 sphere:1 --rotation 1,0,0,0 --translation 0,0,0 --quiet";
  const Finished first = shell("OMPI_COMM_WORLD_SIZE=3 OMPI_COMM_WORLD_RANK=0 " + words);
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_NE(first.err.find("3 copies were started together"), std::string::npos) << first.err;
  EXPECT_EQ(shell("OMPI_COMM_WORLD_SIZE=3 OMPI_COMM_WORLD_RANK=1 " + words).err, "");
  EXPECT_EQ(shell("OMPI_COMM_WORLD_SIZE=1 OMPI_COMM_WORLD_RANK=0 " + words).err, "");
}

}  // namespace
}  // namespace vex::golden
