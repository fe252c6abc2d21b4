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

PolygonSoup soup_of_obj(const std::string& text) { return read_obj(text, "a.obj"); }
std::string obj_refusal(const std::string& text) {
  return refusal_of([&] { static_cast<void>(soup_of_obj(text)); });
}

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1.25 0\nv 0 0 1\n";

/// The tetrahedron of the four points, however it is written.
void expect_tetrahedron(const std::string& text) {
  SCOPED_TRACE(text);
  PolygonSoup soup;
  ASSERT_NO_THROW(soup = soup_of_obj(text));
  ASSERT_EQ(soup.points.size(), 4U);
  const std::vector<Vec3d> expected{{0, 0, 0}, {1, 0, 0}, {0, 1.25, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(soup.points[i].x, expected[i].x);
    EXPECT_EQ(soup.points[i].y, expected[i].y);
    EXPECT_EQ(soup.points[i].z, expected[i].z);
  }
  EXPECT_EQ(soup.face_sizes, std::vector<std::uint32_t>(4, 3));
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
  EXPECT_EQ(soup.n_ignored_faces, 0U);
}

const std::string kFaces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST(Obj, ReadsTheLegalWaysOfWritingOneBody) {
  expect_tetrahedron(kPoints + kFaces);
  expect_tetrahedron("\xEF\xBB\xBF" + kPoints + kFaces);
  expect_tetrahedron(kPoints + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4");  // no end of the last line
  expect_tetrahedron("# a comment\n\n  \t\n" + kPoints + "#f 1 2 3\n" + kFaces + "# the end");
  expect_tetrahedron("  v 0 0 0\n\tv 1 0 0\n v\t0  1.25\t0 \nv 0 0 1\t\n" + kFaces);  // indented
  expect_tetrahedron(
      "v 0 0 0 # origin\nv 1 0 0#\nv 0 1.25 0 #v\nv 0 0 1\nf 1 3 2 # one\nf 1 2 4#two\nf 2 3 4\nf 3 1 4");
  expect_tetrahedron("v 0 0 0\r\nv 1 0 0\r\nv 0 1.25 0\r\nv 0 0 1\r\nf 1 3 2\r\nf 1 2 4\r\nf 2 3 4\r\nf 3 1 4\r\n");
  expect_tetrahedron("v 0 0 0\rv 1 0 0\rv 0 1.25 0\rv 0 0 1\rf 1 3 2\rf 1 2 4\rf 2 3 4\rf 3 1 4");
  expect_tetrahedron("v 0 0 0\rv 1 0 0\nv 0 1.25 0\r\nv 0 0 1\n\rf 1 3 2\r\r\nf 1 2 4\nf 2 3 4\nf 3 1 4");
  expect_tetrahedron("v -0 .0 0.\nv +1 0e5 0\nv 0 125e-2 0\nv 0 0 1.0E+00\n" + kFaces);
}

TEST(Obj, ReadsEveryFormOfACorner) {
  expect_tetrahedron(kPoints + "f 1/1 3/2 2/3\nf 1//1 2//1 4//1\nf 2/1/1 3/1/1 4/1/1\nf 3 1/7 4//8\n");
  expect_tetrahedron(kPoints + "f 1/ 3/ 2/\nf 1// 2// 4//\nf 2/1/ 3/1/ 4/1/\nf 3 1 4\n");
  expect_tetrahedron(kPoints + "f -4 -2 -3\nf -4/-9 -3/-9/-9 -1//-9\nf +2 +3 +4\nf 3 1 -1\n");
  // Texture coordinates and normals that are not there.
  expect_tetrahedron(kPoints + "f 1/100 3/0 2/99999999999999999999999999\nf 1//5 2//5 4//5\nf 2 3 4\nf 3 1 4\n");
  // A relative index counts from where it stands, an absolute one may come early.
  expect_tetrahedron("v 0 0 0\nv 1 0 0\nv 0 1.25 0\nf -3 -1 -2\nv 0 0 1\nf -4 -3 -1\nf 2 3 4\nf 3 1 4\n");
  expect_tetrahedron(kFaces + kPoints);
}

TEST(Obj, GoesOnInTheNextLineBehindABackslash) {
  expect_tetrahedron(kPoints + "f 1 3 \\\n2\nf 1 \\\n2 \\\n4\nf 2 3 4\\\n\nf 3\\\n 1 4\n");
  expect_tetrahedron(kPoints + "f 1 3 \\\r\n2\nf 1 2 \\ \t\n 4\nf 2 3 \\\n4 # c\nf 3 1 4\n");
  expect_tetrahedron("v 0 0\\\n 0\nv \\\n1 0 0\nv 0 1.25 0\nv 0 0 1\ng one \\\ntwo\n\\\n\n" + kFaces);
  // Behind comments and what is skipped, where both readings are the same.
  expect_tetrahedron("# C:\\a\\\n# b\n" + kPoints + "usemtl a\\\n\n# \\\nusemtl b\nvt 0.5 \\\n0.5\n" + kFaces);
}

TEST(Obj, RefusesABackslashThatMayMeanTwoThings) {
  EXPECT_TRUE(contains(obj_refusal("# C:\\a\\\n" + kPoints + kFaces), "line 2: expected no backslash there"));
  EXPECT_TRUE(contains(obj_refusal(kPoints + "f 1 2 3 # \\\nf 1 2 4\n"), "line 6"));
  EXPECT_TRUE(contains(obj_refusal("o C:\\a\\\n" + kPoints + kFaces), "line 2: expected no backslash there"));
  EXPECT_TRUE(contains(obj_refusal(kPoints + "f 1 2 \\\n3 # \\\nf 1 2 4\n"), "no backslash there"));
  EXPECT_TRUE(contains(obj_refusal(kPoints + "f 1 2\\\n3\n"), "within a word"));
  EXPECT_TRUE(contains(obj_refusal(kPoints + "f 1 2 3 \\\n"), "ends behind a backslash"));
  EXPECT_TRUE(contains(obj_refusal(kPoints + "f 1 2 3 \\\nf 1 2 4\n"), "'f' is no corner"));
  EXPECT_TRUE(contains(obj_refusal(kPoints + "f 1 2 3 \\\n\n4\n"), "'4' is no keyword"));
}

TEST(Obj, SkipsWhatIsNoGeometry) {
  expect_tetrahedron("mtllib a.mtl b.mtl\no body\ng\ns off\nvt 0 0\nvn nan 0 1\nvp 1\n" + kPoints +
                     "usemtl red\ns 1\nmg 0\nlod 3\n" + kFaces + "g end\nusemap off\nbevel on\n");
}

TEST(Obj, ReadsWeightsOfOneAndColoursOfVertices) {
  expect_tetrahedron("v 0 0 0 1\nv 1 0 0 1.0\nv 0 1.25 0 0.5 0.5 0.5\nv 0 0 1 1 0.5 0.5 0\n" + kFaces);
  EXPECT_TRUE(contains(obj_refusal("v 0 0 0 2\n" + kFaces), "has a weight other than 1"));
  EXPECT_TRUE(contains(obj_refusal("v 0 0 0 0.5\n"), "line 1"));
  EXPECT_TRUE(contains(obj_refusal("v 0 0 0 1 1\n"), "a vertex of 5 numbers"));
  EXPECT_TRUE(contains(obj_refusal("v 0 0 0 1 1 1 1 1\n"), "a vertex of 8 numbers"));
  EXPECT_TRUE(contains(obj_refusal("v 0 0 0 1 red 1\n"), "'red' is no finite decimal number"));
}

TEST(Obj, KeepsPolygonsAndPointsThatNoFaceUses) {
  const PolygonSoup soup = soup_of_obj(kPoints + "v 5 5 5\nf 1 2 3 4\nf 1 2 3 4 5 1 2 3 4 5 1 2\nv 6 6 6\n");
  EXPECT_EQ(soup.points.size(), 6U);
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{4, 12}));
  EXPECT_EQ(soup_of_obj(kPoints).points.size(), 4U);
  EXPECT_EQ(soup_of_obj(kPoints).n_parts, 1U);
}

TEST(Obj, CountsPointsAndLinesAsIgnored) {
  const PolygonSoup soup = soup_of_obj(kPoints + "p 1\np 1 2 3\nl 1 2 3 4\nl 1/1 2/2\nf 1 2\nf 3\n" + kFaces);
  EXPECT_EQ(soup.n_ignored_faces, 6U);
  EXPECT_EQ(soup.face_sizes.size(), 4U);
  EXPECT_EQ(soup.corners.size(), 12U);
  EXPECT_TRUE(contains(obj_refusal(kPoints + "l 1 5\n"), "vertex 5 is not in the file"));
}

TEST(Obj, CountsObjectsWithFaces) {
  EXPECT_EQ(soup_of_obj(kPoints + kFaces).n_parts, 1U);
  EXPECT_EQ(soup_of_obj("o a\n" + kPoints + kFaces).n_parts, 1U);
  EXPECT_EQ(soup_of_obj("o empty\no a\n" + kPoints + kFaces + "o b\nf 1 2 3\no none\n").n_parts, 2U);
}

TEST(Obj, SaysHowFineItsNumbersAre) {
  EXPECT_EQ(soup_of_obj(kPoints + kFaces).digits.kind, CoordinateDigits::Kind::doubles);
  const CoordinateDigits digits =
      soup_of_obj("v 1.1234 -2.5000 0 0.123456789 0 0\n").digits;  // of coordinates, not of colours
  EXPECT_EQ(digits.kind, CoordinateDigits::Kind::decimals);
  EXPECT_DOUBLE_EQ(digits.last_place, 1e-4);
}

TEST(Obj, RefusesSinsAndNamesTheLine) {
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"v 0 0\n", "a number is missing (a.obj, line 1: expected v x y z)"},
           {"v\n", "a number is missing"},
           {"v 1.0D+01 0 0\n", "'1.0D+01' is no finite decimal number (a.obj, line 1: expected v x y z)"},
           {"v 0 0 0\nv 1x 0 0\n", "'1x' is no finite decimal number (a.obj, line 2"},
           {"v 1,5 0 0\n", "'1,5'"},
           {"v nan 0 0\n", "'nan'"},
           {"v 0 inf 0\n", "'inf'"},
           {"v 0 1e400 0\n", "'1e400'"},
           {kPoints + "f 1 2 5\n", "vertex 5 is not in the file (a.obj, line 5: expected an index from 1 to 4)"},
           {"f 1 2 9\nf 1 2 3\n" + kPoints, "vertex 9 is not in the file (a.obj, line 1"},
           {kPoints + "f 0 1 2\n", "'0' names no vertex"},
           {kPoints + "f -5 1 2\n",
            "'-5' names no vertex (a.obj, line 5: expected an index from 1, or from -1 down to -4"},
           {"f -1 -2 -3\n" + kPoints, "'-1' names no vertex"},
           {kPoints + "f 1 2 4294967297\n", "'4294967297' names no vertex"},
           {kPoints + "f 1 2 99999999999999999999999\n", "names no vertex"},
           {kPoints + "f 1 2 -99999999999999999999999\n", "names no vertex"},
           {kPoints + "f 1 2 3.0\n", "'3.0' is no corner"},
           {kPoints + "f 1 2 3x\n", "'3x' is no corner"},
           {kPoints + "f 1 2 x\n", "'x' is no corner"},
           {kPoints + "f 1 2 /3\n", "'/3' is no corner"},
           {kPoints + "f 1/a 2/1 3/1\n", "'1/a' is no corner"},
           {kPoints + "f 1/1/a 2 3\n", "'1/1/a' is no corner"},
           {kPoints + "f 1/1/1/1 2 3\n", "is no corner"},
           {kPoints + "f 1/1.5 2 3\n", "is no corner"},
           {kPoints + "f 1 / 2 3\n", "'/' is no corner"},
           {kPoints + "f\n", "no vertex is named"},
           {kPoints + "f # 1 2 3\n", "no vertex is named"},
           {kPoints + "f1 2 3\n", "'f1' is no keyword (a.obj, line 5"},
           {"v1 0 0\n", "'v1' is no keyword"},
           {"V 0 0 0\n", "'V' is no keyword"},
           {"0 0 0\n", "'0' is no keyword"},
           {"vertex 0 0 0\n", "'vertex' is no keyword"},
           {std::string("v 0 0 0\0\n", 9), "'0?'"},
           {kPoints + "curv 0 1 1 2\n", "curves or surfaces that are no polygons (a.obj, line 5"},
           {kPoints + "cstype bezier\n", "curves or surfaces"},
           {kPoints + "surf 0 1 0 1 1 2\n", "curves or surfaces"},
           {kPoints + "deg 3\n", "curves or surfaces"},
           {kPoints + "call other.obj\n", "runs another file"},
           {"", "the file holds no vertex"},
           {"# nothing\n", "the file holds no vertex"},
           {"vn 0 0 1\n", "the file holds no vertex"},
           {std::string("\xFF\xFEv\0 \0", 6), "UTF-16"}}) {
    SCOPED_TRACE(text);
    const std::string message = obj_refusal(text);
    EXPECT_TRUE(contains(message, part));
    EXPECT_EQ(message.find(" - "), message.rfind(" - ")) << message;
    EXPECT_TRUE(contains(message, "(a.obj, line "));
    EXPECT_TRUE(contains(message, ": expected "));
    EXPECT_TRUE(contains(message, ") - "));
  }
}

}  // namespace
}  // namespace vex::tests
