#include "engine/sampling/poses/orientation_law_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

TEST(OrientationLawText, IsTheInverseOfTheName) {
  for (const OrientationLaw& law :
       {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::fixed(0.1, -2.0, 3e-5, 4.0),
        OrientationLaw::cone(0.1), OrientationLaw::cone(90.0), OrientationLaw::angle(180.0),
        OrientationLaw::onsager(1e3), OrientationLaw::maier_saupe(-0.1)}) {
    EXPECT_EQ(parse_orientation_law(law.name()), law) << law.name();
  }
}

TEST(OrientationLawText, RefusesWhatIsNoLawAndNamesTheOption) {
  for (const char* text : {"",
                           "wild",
                           "isotropic:1",
                           "aligned:",
                           "cone",
                           "cone:",
                           "cone:x",
                           "cone:91",
                           "cone:-1",
                           "cone:1,2",
                           "cone:nan",
                           "angle:181",
                           "onsager:-1",
                           "onsager:inf",
                           "maier-saupe:1001",
                           "maier-saupe:",
                           "table:",
                           "table",
                           "fixed:1,0,0",
                           "fixed:0,0,0,0",
                           "fixed:1,0,0,0,",
                           "Cone:30",
                           " cone:30"}) {
    EXPECT_THROW(parse_orientation_law(text), UsageError) << text;
  }
  const auto message = [](std::string_view option) {
    try {
      parse_orientation_law("wild", option);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string choices =
      "there are isotropic, aligned, fixed:W,X,Y,Z, angle:DEG, cone:DEG, onsager:ALPHA, maier-saupe:A, table:FILE";
  EXPECT_EQ(message(""), "not a choice (\"wild\") - " + choices);
  EXPECT_EQ(message("--orientations"), "not a choice (\"wild\" for --orientations) - " + choices);
}

TEST(OrientationLawText, ReadsTablesFromFiles) {
  const std::string path = testing::TempDir() + "orientation_law_text_test.txt";
  std::ofstream(path) << "0 1\n1 3\n";
  EXPECT_EQ(parse_orientation_law("table:" + path), OrientationLaw::table({{0.0, 1.0}, {1.0, 3.0}}));
  EXPECT_EQ(parse_axis_law("table:" + path), AxisLaw::table({{0.0, 1.0}, {1.0, 3.0}}));
  EXPECT_EQ(file_of_law("table:" + path), path);
  EXPECT_EQ(file_of_law("cone:20"), std::nullopt);
  std::filesystem::remove(path);
  EXPECT_THROW(parse_orientation_law("table:" + path), InputError);
}

TEST(OrientationLawText, ReadsLawsAndAxesOfOneBody) {
  EXPECT_EQ(parse_axis_law("isotropic"), AxisLaw());
  EXPECT_EQ(parse_axis_law("aligned"), AxisLaw::aligned());
  for (const char* text : {"angle:20", "fixed:1,0,0,0", "wild"}) EXPECT_THROW(parse_axis_law(text), UsageError);
  const auto is = [](const Vec3d& axis, double x, double y, double z) {
    return axis.x == x && axis.y == y && axis.z == z;
  };
  EXPECT_TRUE(is(parse_axis("x"), 1, 0, 0));
  EXPECT_TRUE(is(parse_axis("y"), 0, 1, 0));
  EXPECT_TRUE(is(parse_axis("z"), 0, 0, 1));
  EXPECT_TRUE(is(parse_axis("1,-2e3,0"), 1, -2000, 0));
  for (const char* text : {"", "w", "1,2", "0,0,0", "1,2,3,4", "nan,0,1", "-x"}) {
    EXPECT_THROW(parse_axis(text, "--axis"), UsageError) << text;
  }
}

}  // namespace
}  // namespace vex
