#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "meshes/formats/strict_readers.h"
#include "tests/unit/meshes/refusal.h"

namespace vex::tests {
namespace {

PolygonSoup soup_of_xyz(const std::string& text) { return read_points(text, "a.xyz"); }
std::string points_refusal(const std::string& text) {
  return refusal_of([&] { static_cast<void>(soup_of_xyz(text)); });
}

/// (0, 0.5, 0), (1, 0, 0), (0, 1.25, -2)
void expect_points(const std::string& text) {
  SCOPED_TRACE(text);
  PolygonSoup soup;
  ASSERT_NO_THROW(soup = soup_of_xyz(text));
  ASSERT_EQ(soup.points.size(), 3U);
  const std::vector<Vec3d> expected{{0, 0.5, 0}, {1, 0, 0}, {0, 1.25, -2}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(soup.points[i].x, expected[i].x);
    EXPECT_EQ(soup.points[i].y, expected[i].y);
    EXPECT_EQ(soup.points[i].z, expected[i].z);
  }
  EXPECT_TRUE(soup.corners.empty());
  EXPECT_TRUE(soup.face_sizes.empty());
  EXPECT_EQ(soup.n_parts, 1U);
}

TEST(Points, ReadsOnePointALineWhateverPartsTheNumbers) {
  expect_points("0 .5 0\n1 0 0\n0 1.25 -2\n");
  expect_points("\xEF\xBB\xBF 0\t0.5  0 \n+1 0 0\n\n0 1.25 -2");
  expect_points("0,.5,0\n1,0,0\n0,1.25,-2\n");
  expect_points("0, 0.5, 0\n1 ,0 , 0\n 0,  1.25,-2 \n");
  expect_points("0;.5;0\r\n1;0;0\r\n0; 1.25; -2\r\n");
  expect_points("0,\t0.5,\t0\n1,\t0,\t0\n0,\t1.25,\t-2\n");
  expect_points("\"0\",\"0.5\",\"0\"\n\"1\",\"0\",\"0\"\n\"0\",\"1.25\",\"-2\"\n");
  expect_points("# three points\n0 .5 0 # one\n\n  # two\n1 0 0\r0 1.25 -2#\n#");
  expect_points("// three points\n0 .5 0\n1 0 0\n0 1.25 -2\n");
}

TEST(Points, IgnoresOtherColumns) {
  expect_points("0 .5 0 255 0 0\n1 0 0 0 1 1\n0 1.25 -2 3 4 5\n");
  expect_points("0,.5,0,7\n1,0,0,7\n0,1.25,-2,9\n");
  expect_points("0,.5,0,\n1,0,0,\n0,1.25,-2,\n");
  EXPECT_TRUE(contains(points_refusal("0 .5 0 a\n1 0 0 b\n"), "'a' is no finite decimal number"));
  EXPECT_TRUE(contains(points_refusal("0 .5 0 nan\n"), "'nan'"));
}

TEST(Points, TakesTheColumnsThatAFirstLineNames) {
  expect_points("x y z\n0 .5 0\n1 0 0\n0 1.25 -2\n");
  expect_points("\"X\",\"Y\",\"Z\"\n0,.5,0\n1,0,0\n0,1.25,-2\n");
  expect_points(",x,y,z\n0,0,.5,0\n1,1,0,0\n2,0,1.25,-2\n");
  expect_points("name;z;y;x\na;0;.5;0\n\"b;c\";0;0;1\n;-2;1.25;0\n");
  expect_points("x,y,z,colour\n0,.5,0,#ff0000\n1,0,0,#ff0000\n0,1.25,-2,#ff0000\n");
  expect_points("Velocity,Points:0,Points:1,Points:2\n9,0,.5,0\n9,1,0,0\n9,0,1.25,-2\n");
  expect_points("# id x y z\n1 0 .5 0\n2 1 0 0\n3 0 1.25 -2\n");
  expect_points("//X Y Z Intensity\n0 .5 0 9\n1 0 0 9\n0 1.25 -2 9\n");
  expect_points("# axes are x y z\n0 .5 0\n1 0 0\n0 1.25 -2\n");
  expect_points("i x y z\n# y x z i\n1 0 .5 0\n2 1 0 0\n3 0 1.25 -2\n");  // the line of words counts
  expect_points("x,y,z,n\n0,.5,0,1\n1,0,0,2\n0,1.25,-2,3\n");
  for (const char* names :
       {"id,px,py,pz", "x,y,height,id", "x,y,z,x", ",,,", "id,x,y", "r,theta,phi", "nx,ny,nz", "x,y,value", ",,"}) {
    EXPECT_TRUE(contains(points_refusal(std::string(names) + "\n1,2.5,3,4\n"), "do not say which are the coordinates"));
  }
  EXPECT_TRUE(contains(points_refusal("x y z\n1,2,3\n"), "a line of 1 field (a.xyz, line 2: expected 3"));
  EXPECT_TRUE(contains(points_refusal("x y z\n"), "the file holds no point"));
}

TEST(Points, RefusesDecimalCommas) {
  for (const char* text :
       {"1,5 2,5 3,5\n", "1,5\t2,5\t3,5\n", "1,5;2,5;3,5\n1;2;3\n", "1 2 3\n1,5 2 3\n", "1,5 2 3\n", "1;2;3\n1;2,5;3\n",
        "1,5,2,5,3,5\n", "1,500000,2,500000,3,500000\n-1,500000,2,500000,3,500000\n", "1,5, 2,5, 3,5\n", "1,2,3,4\n",
        "1.000,5 2.000,5 3.000,5\n", "x,y,z\n1,5 2,5 3,5\n", "x;y;z\n1,5;2,5;3,5\n", "x,y,z\n1,5,2,5,3,5\n"}) {
    EXPECT_FALSE(points_refusal(text).empty()) << text;
  }
  EXPECT_TRUE(contains(points_refusal("1,5,2,5,3,5\n"), "or be decimal commas"));
  EXPECT_TRUE(contains(points_refusal("1,5;2,5;3,5\n"), "decimals have a point"));
}

TEST(Points, RefusesAFirstColumnThatCountsTheLines) {
  EXPECT_TRUE(contains(points_refusal("0 0.5 1 2\n1 0.25 2 3\n2 0.5 0 1\n"), "or number the points"));
  EXPECT_TRUE(contains(points_refusal("1,0.5,1,2\n2,0.25,2,3\n3,0.5,0,1\n"), "name the columns"));
  // Numbers with gaps, as of nodes some of which were deleted, became x.
  EXPECT_TRUE(
      contains(points_refusal("1, 0.0, 0.0, 0.0\n2, 1.0, 0.0, 0.0\n4, 0.0, 1.25, 0.0\n"), "or number the points"));
  EXPECT_TRUE(contains(points_refusal("10 0.5 1 2\n7 0.25 2 3\n12 0.5 0 1\n"), "or number the points"));
  EXPECT_TRUE(contains(points_refusal("3\nlabels\nC1 1 0 0 0\nC2 2 1 0 0\nC3 3 0 1.25 0\n"), "count the atoms"));
  EXPECT_EQ(soup_of_xyz("0 0.5 1 2\n1 0.25 2 3\n0 0.5 0 1\n").points.size(), 3U);
  EXPECT_EQ(soup_of_xyz("0 0.5 1\n1 0.25 2\n2 0.5 0\n").points.size(), 3U);
  EXPECT_EQ(soup_of_xyz("x y z i\n0 0.5 1 1\n1 0.25 2 1\n2 0.5 0 1\n").points.size(), 3U);
}

TEST(Points, ReadsTheXyzOfChemistry) {
  expect_points("3\nwater\nO 0 0.5 0\nH 1 0 0\nH1 0 1.25 -2\n");
  expect_points("3\n\nO 0 0.5 0 0.3\n  H 1 0 0 -0.1\nH 0\t1.25 -2 -0.2\n\n \n");
  expect_points(" 3 \n0 0 0\nO 0 0.5 0\nH 1 0 0\nH 0 1.25 -2");  // a comment of numbers
  expect_points("3\nProperties=species:S:1:pos:R:3:charge:R:1\nO 0 0.5 0 1\nH 1 0 0 1\nH 0 1.25 -2 1\n");
  EXPECT_TRUE(contains(points_refusal("3\nProperties=species:S:1:charge:R:1:pos:R:3\nO 1 0 0.5 0\n"), "another order"));
  EXPECT_TRUE(
      contains(points_refusal("2\nwater\nO 0 0 0\nH 1 0 0\nH 0 1 0\n"), "there is more than 2 atoms (a.xyz, line 5"));
  EXPECT_TRUE(contains(points_refusal("4\nwater\nO 0 0 0\nH 1 0 0\nH 0 1 0\n"),
                       "the count does not hold: the file has 3 points (a.xyz, line 1"));
  EXPECT_TRUE(contains(points_refusal("1\na\nO 0 0 0\n1\nb\nO 0 0 0\n"), "keep one frame of several"));
  EXPECT_TRUE(contains(points_refusal("2\nwater\nO 0 0 0\n1 0 0 1\n"), "there is no atom (a.xyz, line 4"));
  EXPECT_TRUE(contains(points_refusal("2\nwater\nO 0 0 0\n\nH 0 0 1\n"), "there is no atom"));
  EXPECT_TRUE(contains(points_refusal("1\nwater\nO 0 0\n"), "a number is missing (a.xyz, line 3: expected C x y z)"));
  EXPECT_TRUE(contains(points_refusal("2\nions\n6 0 0.5 0\n1 1 0 0\n"), "or number the points"));
}

TEST(Points, ReadsACountBeforeThePoints) {
  expect_points("3\n0 .5 0\n1 0 0\n0 1.25 -2\n");
  expect_points("3\na comment\n0 .5 0\n1 0 0\n0 1.25 -2\n");
  expect_points("3\n0 .5 0 10 1 1 1\n1 0 0 10 1 1 1\n0 1.25 -2 10 1 1 1\n");
  EXPECT_TRUE(contains(points_refusal("4\n0 .5 0\n1 0 0\n"), "the count does not hold: the file has 2 points"));
  EXPECT_TRUE(contains(points_refusal("1\n0 .5 0\n1 0 0\n"), "the count does not hold"));
  EXPECT_TRUE(contains(points_refusal("3\n"), "the count does not hold: the file has 0 points"));
  EXPECT_TRUE(contains(points_refusal("0\n"), "the file holds no point"));
  EXPECT_TRUE(contains(points_refusal(std::string(500, '9') + "\n0 0 0\n"), "the count does not hold"));
}

TEST(Points, RefusesSinsAndNamesTheLine) {
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "the file holds no point"},
           {"# nothing\n", "the file holds no point"},
           {"0 0\n", "a line of 2 fields"},
           {"0.5\n", "a line of 1 field"},
           {"0 0 0\n1 0\n", "a line of 2 fields (a.xyz, line 2: expected 3"},
           {"0 0 0\n1 0 0 0\n", "a line of 4 fields (a.xyz, line 2: expected 3"},
           {"0 0 0\n1 x 0\n", "'x' is no finite decimal number (a.xyz, line 2"},
           {"0 0 0\nx y z\n", "'x' is no finite decimal number (a.xyz, line 2"},
           {"0 0 0\n1.0D+01 0 0\n", "'1.0D+01' is no finite decimal number"},
           {"1.0D+01 1.0D+01 1.0D+01\n0 0 0\n", "'1.0D+01' is no finite decimal number (a.xyz, line 1"},
           {"nan nan nan\n0 0 0\n", "'nan' is no finite decimal number (a.xyz, line 1"},
           {"Inf -inf infinity\n0 0 0\n", "is no finite decimal number (a.xyz, line 1"},
           {"1e400 0 0\n", "'1e400'"},
           {"0x10 0 0\n", "'0x10'"},
           {"1,,3\n", "a field is empty"},
           {",1,2\n", "a field is empty"},
           {"\"1,2,3\n", "a line of 1 field"},
           {"1,2,\"3\n", "'\"3' is no finite decimal number"},
           {"v 0 0 0\n", "'v' is no finite decimal number"},
           {std::string("\xFF\xFE"
                        "1\0 \0",
                        6),
            "UTF-16"},
           {std::string("1 2 3\0\n", 7), "'3?'"}}) {
    SCOPED_TRACE(text);
    const std::string message = points_refusal(text);
    EXPECT_TRUE(contains(message, part));
    EXPECT_EQ(message.find(" - "), message.rfind(" - ")) << message;
    EXPECT_TRUE(contains(message, "(a.xyz, line "));
    EXPECT_TRUE(contains(message, ": expected "));
  }
}

TEST(Points, SaysHowFineItsNumbersAre) {
  const CoordinateDigits digits =
      soup_of_xyz("x y z w\n1.123 0 0 0.123456\n0 2.5 0 0.123456\n").digits;  // of coordinates alone
  EXPECT_EQ(digits.kind, CoordinateDigits::Kind::decimals);
  EXPECT_EQ(digits.n_digits, 4);
  EXPECT_DOUBLE_EQ(digits.last_place, 1e-3);
}

}  // namespace
}  // namespace vex::tests
