#include "apps/vex_scene/scene_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "apps/common/common_options.h"
#include "apps/common/line_reader.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

class SceneFile : public testing::Test {
 protected:
  SceneFile()
      : path_((std::filesystem::temp_directory_path() / ("vex_scene_file_" + std::to_string(getpid()))).string()) {}
  ~SceneFile() override { std::filesystem::remove(path_); }

  SceneInput read(const std::string& content, const std::map<std::string, std::string, std::less<>>& named = {}) const {
    std::ofstream(path_, std::ios::binary) << content << std::flush;
    return read_scene_file(path_, named);
  }
  std::string problem_of(const std::string& content) const {
    try {
      read(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  std::string path_;
};

const std::string kHeader = "body,x,y,z,qw,qx,qy,qz\n";

TEST_F(SceneFile, HasEachTextOnce) {
  const SceneInput scene = read(kHeader + "a,1,2,3,1,0,0,0\n\"b,c\",4,5,6,1,0,0,0\na,7,8,9,1,0,0,0\nd,0,0,0,1,0,0,0\n",
                                {{"d", "a"}, {"unused", "e"}});
  ASSERT_EQ(scene.n_bodies(), 4u);
  ASSERT_EQ(scene.shapes().size(), 3u);
  EXPECT_EQ(scene.texts(), (std::vector<std::string>{"a", "e", "b,c"}));
  EXPECT_EQ(scene.shapes_of_bodies, (std::vector<std::uint32_t>{0, 2, 0, 0})) << "d is a name of a";
  EXPECT_EQ(scene.shapes()[0].line, 0u);
  EXPECT_EQ(scene.shapes()[2].line, 3u);
  EXPECT_EQ(scene.shapes()[0].n_bodies, 3u);
  EXPECT_EQ(scene.shapes()[1].n_bodies, 0u);
  EXPECT_EQ(scene.poses[2].translation.y, 8.0);
  EXPECT_EQ(scene.place_of(2), path_ + ", line 4");
}

TEST_F(SceneFile, HasPosesOfQuaternionsAndOfMatrices) {
  const SceneInput quaternion = read(kHeader + "a,0.1,0x1.8p-3,-0,1,2,3,4");
  Transformd expected = rotation_from_quaternion(1, 2, 3, 4);
  expected.translation = {0.1, 0.1875, -0.0};
  EXPECT_EQ(twelve_numbers(quaternion.poses.at(0)), twelve_numbers(expected));
  const SceneInput matrix = read(scene_file_text(quaternion));
  EXPECT_EQ(twelve_numbers(matrix.poses.at(0)), twelve_numbers(expected));
  EXPECT_EQ(scene_file_text(matrix), scene_file_text(quaternion));
}

TEST_F(SceneFile, TellsTheLineOfWhatIsWrong) {
  const std::string row = "a,1,2,3,1,0,0,0\n";
  EXPECT_EQ(problem_of(kHeader + row + row + "\n\r\n"), "none");
  EXPECT_EQ(
      problem_of(kHeader + row + "a,1,2,3,1,0,0,x\n" + row).rfind(path_ + ", line 3: not a number (\"x\" for qz)", 0),
      0u);
  EXPECT_EQ(problem_of(kHeader + row + "\n" + row).rfind(path_ + ", line 4: an empty row (line 3)", 0), 0u);
  EXPECT_EQ(problem_of("").rfind("the scene is empty (" + path_ + ")", 0), 0u);
  EXPECT_EQ(problem_of(kHeader + std::string(LineReader::kLongestLine + 1, 'a')).rfind(path_ + ", line 2: too long", 0),
            0u);
  EXPECT_EQ(problem_of(kHeader + std::string(3 << 20, 'a')).rfind(path_ + ", line 2: too long", 0), 0u);
}

TEST_F(SceneFile, IsReadInPiecesOfAnySize) {
  std::string text = kHeader;
  for (std::size_t k = 0; k < 60000; ++k) {
    text += "a," + std::to_string(k) + ",2,3,1,0,0,0" + std::string(k % 40, ' ') + "\n";
  }
  const SceneInput scene = read(text);
  ASSERT_EQ(scene.n_bodies(), 60000u);
  for (std::size_t k = 0; k < scene.n_bodies(); ++k) ASSERT_EQ(scene.poses[k].translation.x, static_cast<double>(k));
}

}  // namespace
}  // namespace vex
