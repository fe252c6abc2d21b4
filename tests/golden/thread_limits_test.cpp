// As many threads as can be had: a system that refuses some, or all, costs time and no result.
#include "tests/golden/pair.h"
#include "tests/golden/program.h"
#include "tests/golden/run_documents.h"
#include "tests/golden/sample_files.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class ThreadLimits : public ProgramTest {
 protected:
  using ProgramTest::ProgramTest;

  static json without_times(const std::string& text) {
    json document = json::parse(text, nullptr, false);
    EXPECT_TRUE(document.is_object()) << text;
    if (document.contains("tally")) return golden::without_times(document);
    for (const char* const key : {"seconds", "command"}) document.erase(key);
    return document;
  }

  /// The same as with threads, and a note.
  void expect_the_same(Words words) const {
    words.insert(words.end(), {"--threads", "4", "--quiet"});
    SCOPED_TRACE(words.front());
    const Finished usual = run(words), confined = run_without_threads(words);
    EXPECT_EQ(usual.exit_code, 0) << usual.err;
    EXPECT_EQ(confined.exit_code, 0) << confined.err;
    if (usual.out.starts_with('{')) {
      EXPECT_EQ(without_times(confined.out), without_times(usual.out));
    } else {
      EXPECT_EQ(confined.out, usual.out);
    }
    EXPECT_NE(confined.err.find("this system gave 1 of "), std::string::npos) << confined.err;
    EXPECT_EQ(std::count(confined.err.begin(), confined.err.end(), '\n'), 1) << confined.err;
  }
};

class PairThreadLimits : public ThreadLimits {
 protected:
  PairThreadLimits() : ThreadLimits(VEX_PAIR_PROGRAM) {}
};
class SceneThreadLimits : public ThreadLimits {
 protected:
  SceneThreadLimits() : ThreadLimits(VEX_SCENE_PROGRAM) {}
};
class PercolateThreadLimits : public ThreadLimits {
 protected:
  PercolateThreadLimits() : ThreadLimits(VEX_PERCOLATE_PROGRAM) {}
};
class StressThreadLimits : public ThreadLimits {
 protected:
  StressThreadLimits() : ThreadLimits(VEX_STRESS_PROGRAM) {}
};
class PaperThreadLimits : public ThreadLimits {
 protected:
  PaperThreadLimits() : ThreadLimits(VEX_PAPER_PROGRAM) {}
};
class BenchThreadLimits : public ThreadLimits {
 protected:
  BenchThreadLimits() : ThreadLimits(VEX_BENCH_PROGRAM) {}
};

TEST_F(ThreadLimits, NoneIsEnough) {
  write_file("cube.obj", cube_obj());
  expect_the_same({"cube.obj", "ellipsoid:1,2,3", "--trials", "1e5", "--estimator", "hit-or-miss", "--json", "-"});
  expect_the_same({"cube.obj", "--trials", "1e4", "--json", "-"});
}

TEST_F(ThreadLimits, ARunWithoutThreadsTellsItsProgressAndCanBeInterrupted) {
  const Finished finished = run_without_threads({"box:1,1,1", "--seconds", "0.3", "--estimator", "hit-or-miss"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("hits / trials"), std::string::npos);
}

TEST_F(PairThreadLimits, NoneIsEnough) {
  write_file("poses.csv", quaternion_file(random_poses(3000)));
  expect_the_same({"box:1,1,1", "box:1,1,1", "--poses", "poses.csv", "--csv"});
}

TEST_F(SceneThreadLimits, NoneIsEnough) { expect_the_same({"--random", "3000,box:1,1,1,0.5"}); }

TEST_F(PercolateThreadLimits, NoneIsEnough) {
  expect_the_same({"box:1,1,1", "--sizes", "2,3", "--realisations", "5", "--json", "-"});
}

// std::terminate, of threads that had been started and were not joined.
TEST_F(StressThreadLimits, NoneIsEnough) {
  const Finished finished =
      run_without_threads({"--pairs", "50", "--stratum", "touching", "--threads", "4", "--json", "-"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out, nullptr, false).at("complete"), true);
}

TEST_F(PaperThreadLimits, NoneIsEnough) {
  const Finished finished = run_without_threads({"--table", "2", "--trials", "1000", "--threads", "4", "--json", "-"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out, nullptr, false).at("complete"), true);
}

TEST_F(BenchThreadLimits, NoneIsEnough) {
  const Finished finished = run_without_threads({"sphere:1", "--seconds", "0.001", "--threads", "4", "--json", "-"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out, nullptr, false).at("complete"), true);
}

// Stacks of a quarter of a gigabyte: three or four of them fit.
TEST_F(ThreadLimits, SomeAreTaken) {
#ifdef VEX_SANITIZED
  GTEST_SKIP() << "the sanitizer reserves more address space than the limit";
#endif
  const Finished finished = shell(
      "ulimit -s 262144; ulimit -v 1400000; \"$VEX\" box:1,1,1 --trials 1e5 --estimator hit-or-miss --threads 40 "
      "--json -");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out, nullptr, false).at("complete"), true);
  EXPECT_NE(finished.err.find(" of 40 threads"), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.find("gave 1 of"), std::string::npos) << finished.err;
}

}  // namespace
}  // namespace vex::golden
