#include "apps/common/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "apps/common/command_files.h"
#include "apps/common/replace_file.h"
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
  EXPECT_THROW(OutputFile(path("other.obj.gz"), inputs), UsageError);
  EXPECT_NO_THROW(OutputFile(path("other.csv"), inputs)) << "points for hulls, but first of all a table";
  EXPECT_THROW(OutputFile(folder_.string(), inputs), UsageError);
  EXPECT_THROW(OutputFile(path("no/such/folder.json"), inputs), UsageError);
  EXPECT_THROW(OutputFile("", inputs), UsageError);
  EXPECT_EQ(content(inputs[0]), "input");
}

TEST_F(OutputFileTest, IsKnownByWhatItIsAndNotByItsName) {
  std::ofstream(path("one.json")) << "1";
  std::ofstream(path("two.json")) << "1";
  fs::create_hard_link(folder_ / "one.json", folder_ / "twin.json");
  fs::create_symlink("new.json", folder_ / "link.json");
  fs::create_directory_symlink(".", folder_ / "here");
  const auto identity = [&](const std::string& name) { return identity_of(path(name), 1); };
  EXPECT_TRUE(identity("one.json") == identity("twin.json"));
  EXPECT_TRUE(identity("one.json") == identity("here/one.json"));
  EXPECT_FALSE(identity("one.json") == identity("two.json"));
  EXPECT_TRUE(identity("new.json") == identity("link.json")) << "which is not there yet";
  EXPECT_TRUE(identity("new.json") == identity("here/./new.json"));
  EXPECT_FALSE(identity("new.json") == identity("newer.json"));
  EXPECT_TRUE(identity("one.json")->is_regular());
  EXPECT_FALSE(identity("new.json")->is_regular());
  EXPECT_FALSE(identity("no/folder/new.json").has_value());
  EXPECT_TRUE(identity_of("/dev/null", 1)->is_character_device());
  const std::vector<std::string> inputs = {path("missing.json"), path("two.json"), path("twin.json")};
  EXPECT_EQ(input_that_is(*identity("one.json"), inputs), path("twin.json"));
  EXPECT_FALSE(input_that_is(*identity("new.json"), inputs).has_value());
}

TEST_F(OutputFileTest, TwoOutputsOfACommandAreTwoFiles) {
  CommandFiles files({path("input.json")});
  std::ofstream(path("input.json")) << "1";
  EXPECT_FALSE(files.output("--json", "").has_value()) << "not asked for";
  EXPECT_TRUE(files.output("--json", path("a.json")).has_value());
  EXPECT_TRUE(files.output("--csv", path("b.json")).has_value());
  EXPECT_THROW(files.output("--plot", path("./a.json")), UsageError);
  EXPECT_THROW(files.output("--plot", path("input.json")), UsageError);
  EXPECT_TRUE(files.output("--plot", "/dev/null").has_value());
  EXPECT_TRUE(files.output("--log", "/dev/null").has_value()) << "there is room for all";
}

TEST_F(OutputFileTest, ReplacingWhatCannotBeReplacedThrowsAndLeavesNothing) {
  fs::create_directory(folder_ / "folder");
  std::ofstream(path("folder/kept")) << "kept";
  EXPECT_THROW(replace_file(path("folder"), "text"), std::system_error);
  EXPECT_THROW(replace_file(path("no/folder"), "text"), std::system_error);
  EXPECT_EQ(content(path("folder/kept")), "kept");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
  replace_file(path("new"), std::string(1000000, 'x'));
  EXPECT_EQ(content(path("new")).size(), 1000000u);
}

}  // namespace
}  // namespace vex
