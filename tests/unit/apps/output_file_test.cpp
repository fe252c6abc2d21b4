#include "apps/common/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
 protected:
  OutputFileTest()
      : folder_(fs::temp_directory_path() /
                ("vex_output_file_test_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~OutputFileTest() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string content(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  fs::path folder_;
};

TEST_F(OutputFileTest, IsWrittenWholeAndLeavesNothingBeside) {
  const OutputFile file(path("result.json"), {});
  file.write("{}\n");
  EXPECT_EQ(content(path("result.json")), "{}\n");
  OutputFile(path("result.json"), {}).write("[]\n");
  EXPECT_EQ(content(path("result.json")), "[]\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

TEST_F(OutputFileTest, ThroughALinkReplacesWhatItPointsTo) {
  OutputFile(path("result.json"), {}).write("old\n");
  fs::create_symlink("result.json", folder_ / "link.json");
  OutputFile(path("link.json"), {}).write("new\n");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_EQ(content(path("result.json")), "new\n");
}

TEST_F(OutputFileTest, ThroughALinkToNothingMakesWhatItPointsTo) {
  fs::create_symlink("new.json", folder_ / "link.json");
  OutputFile(path("link.json"), {}).write("new\n");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_EQ(content(path("new.json")), "new\n");
}

TEST_F(OutputFileTest, RefusesLinksInACircleBeforeTheRun) {
  fs::create_symlink("b.json", folder_ / "a.json");
  fs::create_symlink("a.json", folder_ / "b.json");
  EXPECT_THROW(OutputFile(path("a.json"), {}), UsageError);
}

TEST_F(OutputFileTest, RefusesWhatWouldCostTheUserAFile) {
  const std::vector<std::string> inputs = {path("body.json")};
  std::ofstream(inputs[0]) << "input";
  fs::create_symlink("body.json", folder_ / "alias.json");
  EXPECT_THROW(OutputFile(inputs[0], inputs), UsageError);
  EXPECT_THROW(OutputFile(path("alias.json"), inputs), UsageError);
  EXPECT_THROW(OutputFile(path("other.obj"), inputs), UsageError);
  EXPECT_THROW(OutputFile(path("other.STL"), inputs), UsageError);
  EXPECT_THROW(OutputFile(path("other.amf"), inputs), UsageError) << "whatever is read as a mesh";
  EXPECT_THROW(OutputFile(path("other.step"), inputs), UsageError);
  EXPECT_THROW(OutputFile(folder_.string(), inputs), UsageError);
  EXPECT_THROW(OutputFile(path("no/such/folder.json"), inputs), UsageError);
  EXPECT_THROW(OutputFile("", inputs), UsageError);
  EXPECT_EQ(content(inputs[0]), "input");
}

}  // namespace
}  // namespace vex
