// What programs keep of what they read besides meshes has an end (docs/security.md): an input beyond it is refused, by
// name, with what to do.
#include "tests/golden/pair.h"
#include "tests/golden/program.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

class InputBounds : public ProgramTest {
 protected:
  void expect_refused(const std::string& line, const std::string& text) const {
    SCOPED_TRACE(line);
    const Finished finished = shell(line);
    EXPECT_EQ(finished.exit_code, 3) << finished.err.substr(0, 500);
    EXPECT_EQ(finished.out, "");
    EXPECT_NE(finished.err.find(text), std::string::npos) << finished.err.substr(0, 500);
    EXPECT_NE(finished.err.find(" - "), std::string::npos) << finished.err.substr(0, 500);
    EXPECT_LT(finished.err.size(), 1000u);
  }
};

constexpr std::size_t kMiB = std::size_t{1} << 20;

TEST_F(InputBounds, OfStates) {
  ASSERT_EQ(shell("\"$VEX\" box:1,1,1 --trials 1000 --checkpoint c --quiet").exit_code, 0);
  const std::string state = read_file("c");
  const std::size_t end = state.rfind('\n', state.size() - 2) + 1;
  std::string line(1000, 'a');
  line.back() = '\n';
  std::string lines;
  while (lines.size() < 17 * kMiB) lines += line;
  write_file("long", state.substr(0, end) + lines + state.substr(end));
  expect_refused("\"$VEX\" box:1,1,1 --trials 1000 --resume long", "longer than any state");
  write_file("wide", state.substr(0, end) + std::string(70000, 'a') + "\n" + state.substr(end));
  expect_refused("\"$VEX\" box:1,1,1 --trials 1000 --resume wide", "wide");
}

TEST_F(InputBounds, OfTables) {
  std::string points;
  for (int k = 0; k <= 100000; ++k) points += std::to_string(-1.0 + k * 1e-5) + " 1\n";
  write_file("points", points);
  expect_refused("\"$VEX\" box:1,1,1 --orientations table:points --trials 10", "more than 100000 points");
  write_file("long", "-1 1\n1 1\n" + std::string(17 * kMiB, '\n'));
  expect_refused("\"$VEX\" box:1,1,1 --orientations table:long --trials 10", "more than 16 MiB");
}

TEST_F(InputBounds, OfScenesAndPoses) {
  const std::string scene = VEX_SCENE_PROGRAM, pair = VEX_PAIR_PROGRAM;
  write_file("scene.csv", kSceneHeader + upright("box:1,1,1", 0, 0, 0) + std::string(70000, '1') + "\n");
  expect_refused(scene + " scene.csv", "write one body a line");
  write_file("poses.csv", kQuaternionHeader + std::string(70000, '1') + "\n");
  expect_refused(pair + " box:1,1,1 sphere:1 --quiet --poses poses.csv > rows", "too long a row");
}

}  // namespace
}  // namespace vex::golden
