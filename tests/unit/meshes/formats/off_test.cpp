#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "meshes/formats/strict_readers.h"
#include "tests/unit/meshes/refusal.h"

namespace vex::tests {
namespace {

PolygonSoup soup_of_off(const std::string& text) { return read_off(text, "a.off"); }
std::string off_refusal(const std::string& text) {
  return refusal_of([&] { static_cast<void>(soup_of_off(text)); });
}

const std::string kOffPoints = "0 0 0\n1 0 0\n0 1.25 0\n0 0 1\n";
const std::string kOffFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

/// The tetrahedron of the four points, however it is written.
void expect_off_tetrahedron(const std::string& text) {
  SCOPED_TRACE(text);
  PolygonSoup soup;
  ASSERT_NO_THROW(soup = soup_of_off(text));
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
  EXPECT_EQ(soup.n_parts, 1U);
}

TEST(Off, ReadsTheLegalWaysOfWritingOneBody) {
  expect_off_tetrahedron("OFF\n4 4 6\n" + kOffPoints + kOffFaces);
  expect_off_tetrahedron("\xEF\xBB\xBFOFF\n4 4 0\n" + kOffPoints + kOffFaces);
  expect_off_tetrahedron("OFF 4 4 6\n" + kOffPoints + kOffFaces);
  expect_off_tetrahedron("OFF4 4 6\n" + kOffPoints + kOffFaces);  // a well-known collection has this
  expect_off_tetrahedron("  OFF # a body\n\n 4 4\n" + kOffPoints + kOffFaces);
  expect_off_tetrahedron("off\n4 4 6\n" + kOffPoints + kOffFaces);
  expect_off_tetrahedron("4 4 6\n" + kOffPoints + kOffFaces);
  expect_off_tetrahedron("# 9 9 9\n4 4 6 # counts\n" + kOffPoints + kOffFaces + "\n# the end\n \n");
  expect_off_tetrahedron("OFF\n4 4 6\n" + kOffPoints + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3");
  expect_off_tetrahedron(
      "OFF\r\n4 4 6\r\n0 0 0\r\n1 0 0\r\n0 1.25 0\r\n0 0 1\r\n3 0 2 1\r\n3 0 1 3\r\n3 1 2 3\r\n3 2 0 3\r\n");
  expect_off_tetrahedron("OFF\r4 4 6\r0 0 0\r1 0 0\r0 1.25 0\r0 0 1\r3 0 2 1\r3 0 1 3\r3 1 2 3\r3 2 0 3");
}

TEST(Off, ReadsCommentsAndBlankLinesAnywhere) {
  expect_off_tetrahedron(
      "# one\nOFF # two\n# three\n\n4 4 6 # four\n# 3 0 1 2\n0 0 0 # 1 1 1\n\n1 0 0\n  # five\n0 1.25 0#\n0 0 1\n"
      "# six\n\n3 0 2 1 # 3\n#\n3 0 1 3\n\t\n3 1 2 3 #\n3 2 0 3\n#");
}

TEST(Off, ReadsPrefixesAndLeavesOutWhatTheyAnnounce) {
  const auto with = [](const std::string& word, const std::string& more) {
    return word + "\n4 4 6\n0 0 0" + more + "\n1 0 0" + more + "\n0 1.25 0" + more + "\n0 0 1" + more + "\n" +
           kOffFaces;
  };
  expect_off_tetrahedron(with("COFF", " 255 0 0 255"));
  expect_off_tetrahedron(with("COFF", " 0.5 0.5 0.5"));
  expect_off_tetrahedron(with("NOFF", " 0 0 1"));
  expect_off_tetrahedron(with("STOFF", " 0.5 1"));
  expect_off_tetrahedron(with("CNOFF", " 0 0 1 1 0 0 1"));
  expect_off_tetrahedron(with("NCOFF", " 0 0 1 1 0 0"));
  expect_off_tetrahedron(with("STCNOFF", " 0 0 1 1 0 0 1 0 0"));
  EXPECT_TRUE(contains(off_refusal(with("OFF", " 255 0 0 255")), "a line of 7 numbers (a.off, line 3"));
  EXPECT_TRUE(contains(off_refusal(with("NOFF", " nan 0 0")), "'nan'"));
  EXPECT_FALSE(off_refusal(with("OFF", " 255 0 0")).empty());
  EXPECT_FALSE(off_refusal(with("NOFF", "")).empty());
  EXPECT_FALSE(off_refusal(with("COFF", " 1 0")).empty());
  for (const char* word : {"4OFF", "nOFF", "COFFX", "CCOFF", "SOFF", "OFFF", "ply", "OFF-4", "COF"}) {
    EXPECT_TRUE(contains(off_refusal(with(word, "")), "(a.off, line 1: expected OFF, or COFF, NOFF, STOFF)")) << word;
  }
  EXPECT_TRUE(contains(off_refusal("OFF BINARY\n1234"), "the file is binary"));
  EXPECT_TRUE(contains(off_refusal("COFF  BINARY\n1234"), "convert it to .off as text"));
}

TEST(Off, ReadsNumbersThatFollowOneAnotherOverLines) {
  expect_off_tetrahedron("OFF\n4 4 6\n0\n0 0 1 0\n0 0 1.25 0 0\n0 1\n" + kOffFaces);
  expect_off_tetrahedron("OFF\n4 4 6\n0 0 0 1 0 0 0 1.25 0 0 0 1\n" + kOffFaces);
  expect_off_tetrahedron("COFF\n4 4 6\n0 0 0\n1 1 1 1\n1 0 0\n1 1 1 1\n0 1.25 0\n1 1 1 1\n0 0 1\n1 1 1 1\n" +
                         kOffFaces);
  expect_off_tetrahedron("OFF\n4 4 6\n" + kOffPoints + "3 0 2\n1\n3\n0 1 3\n3 # c\n\n1\n2\n3\n3 2 0 3\n");
  // The first vertex fills its line, so a line that lost a number takes none from the next.
  EXPECT_TRUE(contains(off_refusal("OFF\n4 4 6\n0 0 0\n1 0\n0 0 1.25 0\n0 0 1\n" + kOffFaces), "line 4"));
  EXPECT_TRUE(contains(off_refusal("OFF\n4 4 6\n0 0 0\n1 0 0 0\n1.25 0\n0 0 1\n" + kOffFaces), "'0' is too much"));
  EXPECT_TRUE(contains(off_refusal("OFF\n4 4 6\n0 0 0 1 0 0 0 1.25 0 0 0 1 3 0 2 1\n" + kOffFaces), "line 3"));
  // The same for faces.
  EXPECT_TRUE(contains(off_refusal("OFF\n4 4 6\n" + kOffPoints + "3 0 2\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 2 1\n"),
                       "expected the end of a face that goes on over several lines"));
}

TEST(Off, ReadsColoursOfFaces) {
  expect_off_tetrahedron("OFF\n4 4 6\n" + kOffPoints +
                         "3 0 2 1 7\n3 0 1 3 255 0 0\n3 1 2 3 0.5 0.5 0.5 1.0 # c\n3 2 0 3\n");
  EXPECT_TRUE(contains(off_refusal("OFF\n4 1 0\n" + kOffPoints + "3 0 2 1 1 1\n"), "a colour of 2 numbers"));
  EXPECT_TRUE(contains(off_refusal("OFF\n4 1 0\n" + kOffPoints + "3 0 2 1 1 1 1 1 1\n"), "a colour of 5 numbers"));
  EXPECT_TRUE(contains(off_refusal("OFF\n4 1 0\n" + kOffPoints + "3 0 2 1 red\n"), "'red'"));
}

TEST(Off, KeepsPolygonsOfAnyNumberOfCornersAndPointsThatNoFaceUses) {
  std::string text = "OFF\n101 3 0\n";
  std::string all = "100";
  for (int i = 0; i <= 100; ++i) text += std::to_string(i) + " 0 1\n";
  for (int i = 0; i < 100; ++i) all += " " + std::to_string(i);
  const PolygonSoup soup = soup_of_off(text + "10 0 1 2 3 4 5 6 7 8 9\n" + all + "\n12 0 1 2 3 4 5 6 7 8 9 10 11\n");
  EXPECT_EQ(soup.points.size(), 101U);
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{10, 100, 12}));
  std::vector<std::uint32_t> expected(10 + 100 + 12);
  std::iota(expected.begin(), expected.begin() + 10, 0U);
  std::iota(expected.begin() + 10, expected.begin() + 110, 0U);
  std::iota(expected.begin() + 110, expected.end(), 0U);
  EXPECT_EQ(soup.corners, expected);
}

TEST(Off, CountsFacesOfOneAndTwoCornersAsIgnored) {
  const PolygonSoup soup = soup_of_off("OFF\n4 4 0\n" + kOffPoints + "1 0\n3 0 1 2\n2 0 1\n2 1 3 1 0 0\n");
  EXPECT_EQ(soup.n_ignored_faces, 3U);
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(soup_of_off("OFF\n4 0 0\n" + kOffPoints).points.size(), 4U);  // points for a hull
}

TEST(Off, RefusesSinsAndNamesTheLine) {
  const std::string head = "OFF\n4 4 6\n";
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "the file holds nothing"},
           {"\n# OFF\n", "the file holds nothing"},
           {"OFF\n", "the file ends early"},
           {"OFF\n4\n", "a number is missing (a.off, line 2: expected the number of faces)"},
           {"OFF\n4 4 6 1\n", "more than three counts"},
           {"OFF\n4.0 4 6\n", "'4.0' is no whole number"},
           {"OFF\n-4 4 6\n", "'-4' is out of range"},
           {"OFF\n4 x 6\n", "'x' is no whole number"},
           {"OFF\n4 4 x\n", "'x' is no whole number"},
           {"OFF\n0 0 0\n", "the file holds no vertex"},
           {"OFF\n99999999999999999999 1 1\n", "is out of range"},
           {"OFF\n2000000000 1 1\n0 0 0\n", "is out of range"},
           {"OFF\n1000000000 1000000000 1\n0 0 0\n",
            "the file ends early (a.off, line 3: expected vertex 2 of 1000000000)"},
           {head, "the file ends early (a.off, line 2: expected vertex 1 of 4)"},
           {head + "0 0 0\n1 0 0\n", "the file ends early (a.off, line 4: expected vertex 3 of 4)"},
           {head + kOffPoints + "3 0 1 2\n", "the file ends early (a.off, line 7: expected face 2 of 4)"},
           {head + kOffPoints + kOffFaces + "3 0 1 2\n", "there is more than 4 vertices and 4 faces (a.off, line 11"},
           {"OFF\n3 4 6\n" + kOffPoints + kOffFaces, "(a.off, line 6"},
           {"OFF\n5 4 6\n" + kOffPoints + kOffFaces, "'1' is too much (a.off, line 7"},
           {head + kOffPoints + "3 0 2 4\n",
            "'4' is out of range (a.off, line 7: expected a vertex index from 0 to 3)"},
           {head + kOffPoints + "3 0 2 -1\n", "'-1' is out of range"},
           {head + kOffPoints + "3 0 2 1.0\n", "'1.0' is no whole number"},
           {head + kOffPoints + "3 0 2 1x\n", "'1x' is no whole number"},
           {head + kOffPoints + "0\n", "'0' is out of range"},
           {head + kOffPoints + "-3 0 1 2\n", "'-3' is out of range"},
           {head + kOffPoints + "4000000000 0 1 2\n", "is out of range"},
           {head + kOffPoints + "1000000000 0 1 2\n", "the file ends early"},
           {head + "0 0 0\n1.0D+01 0 0\n", "'1.0D+01' is no finite decimal number (a.off, line 4"},
           {head + "0 0 nan\n", "'nan'"},
           {head + "0 0 1e999\n", "'1e999'"},
           {head + "0,5 0 0\n", "'0,5'"},
           {head + std::string("0 0 0\0\n", 7), "'0?'"}}) {
    SCOPED_TRACE(text);
    const std::string message = off_refusal(text);
    EXPECT_TRUE(contains(message, part));
    EXPECT_EQ(message.find(" - "), message.rfind(" - ")) << message;
    EXPECT_TRUE(contains(message, "(a.off, line "));
    EXPECT_TRUE(contains(message, ": expected "));
  }
}

TEST(Off, SaysHowFineItsNumbersAre) {
  const CoordinateDigits digits = soup_of_off("OFF\n1 0 0\n-12.1234 0.1230 0\n").digits;
  EXPECT_EQ(digits.kind, CoordinateDigits::Kind::decimals);
  EXPECT_EQ(digits.n_digits, 6);
  EXPECT_DOUBLE_EQ(digits.last_place, 1e-4);
}

}  // namespace
}  // namespace vex::tests
