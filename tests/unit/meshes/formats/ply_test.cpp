#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "file_bytes.h"
#include "meshes/formats/strict_readers.h"
#include "tests/unit/meshes/refusal.h"

namespace vex::tests {
namespace {

constexpr auto kLittle = std::endian::little;
constexpr auto kBig = std::endian::big;

PolygonSoup soup_of_ply(const std::string& bytes) { return read_ply(bytes, "a.ply"); }
std::string refused_ply(const std::string& bytes) {
  return refusal_of([&] { static_cast<void>(soup_of_ply(bytes)); });
}

std::string format_line(std::endian order) {
  return order == kLittle ? "ply\nformat binary_little_endian 1.0\n" : "ply\nformat binary_big_endian 1.0\n";
}

const Points kPlyPoints = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};  // a tetrahedron, V = 1
const std::vector<std::vector<std::uint8_t>> kPlyFaces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

const std::string kTextTetrahedron =
    "ply\nformat ascii 1.0\ncomment made by hand\nobj_info nothing\nelement vertex 4\nproperty float x\nproperty float "
    "y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 2 0\n0 0 "
    "3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

void expect_ply_tetrahedron(const PolygonSoup& soup) {
  EXPECT_EQ(points_of(soup), kPlyPoints);
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3, 3, 3, 3}));
  EXPECT_EQ(soup.n_parts, 1U);
  EXPECT_EQ(soup.n_ignored_faces, 0U);
}

template <class Coordinate, class Count, class Index>
std::string binary_tetrahedron(std::endian order, const std::string& coordinate, const std::string& list) {
  std::string bytes = format_line(order) + "element vertex 4\nproperty " + coordinate + " x\nproperty " + coordinate +
                      " y\nproperty " + coordinate + " z\nelement face 4\nproperty list " + list +
                      " vertex_index\nend_header\n";
  for (const auto& [x, y, z] : kPlyPoints) {
    bytes += stored_all<Coordinate>(
        {static_cast<Coordinate>(x), static_cast<Coordinate>(y), static_cast<Coordinate>(z)}, order);
  }
  for (const auto& face : kPlyFaces) {
    bytes += stored<Count>(3, order);
    for (const auto corner : face) bytes += stored<Index>(static_cast<Index>(corner), order);
  }
  return bytes;
}

TEST(ReadPly, ReadsTextWithEveryLineEnd) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    SCOPED_TRACE(testing::PrintToString(end));
    expect_ply_tetrahedron(soup_of_ply(replaced(kTextTetrahedron, "\n", end)));
  }
}

TEST(ReadPly, ReadsEveryTypeInBothByteOrders) {
  for (const std::endian order : {kLittle, kBig}) {
    for (const std::string& bytes : {
             binary_tetrahedron<float, std::uint8_t, std::int32_t>(order, "float", "uchar int"),
             binary_tetrahedron<double, std::int8_t, std::uint32_t>(order, "double", "char uint"),
             binary_tetrahedron<float, std::uint16_t, std::uint16_t>(order, "float32", "ushort uint16"),
             binary_tetrahedron<double, std::int16_t, std::int16_t>(order, "float64", "int16 short"),
             binary_tetrahedron<std::int8_t, std::int32_t, std::uint8_t>(order, "int8", "int32 uint8"),
             binary_tetrahedron<std::uint8_t, std::uint32_t, std::int8_t>(order, "uchar", "uint32 int8"),
             binary_tetrahedron<std::int16_t, std::uint8_t, std::int32_t>(order, "short", "uint8 int32"),
             binary_tetrahedron<std::uint16_t, std::uint8_t, std::int32_t>(order, "ushort", "uint8 int32"),
             binary_tetrahedron<std::int32_t, std::uint8_t, std::int32_t>(order, "int", "uint8 int32"),
             binary_tetrahedron<std::uint32_t, std::uint8_t, std::int32_t>(order, "uint", "uint8 int32"),
         }) {
      SCOPED_TRACE(bytes.substr(0, 150));
      expect_ply_tetrahedron(soup_of_ply(bytes));
      EXPECT_NO_FATAL_FAILURE(expect_ply_tetrahedron(soup_of_ply(bytes + "\n")));
    }
  }
}

TEST(ReadPly, ReadsTheLastNumberOfATextWithoutFinalNewline) {
  const PolygonSoup soup = soup_of_ply(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 "
      "0\n1 0 0\n0 1.25 0\n0 0 1");
  EXPECT_EQ(points_of(soup), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1.25, 0}, {0, 0, 1}}));
  EXPECT_TRUE(soup.face_sizes.empty());
}

TEST(ReadPly, ReadsDataThatBeginWithAnyByte) {
  for (const std::string end : {"\n", "\r\n"}) {
    for (std::uint32_t first = 0; first < 65536; first += first < 256 ? 1 : 251) {
      for (const std::endian order : {kLittle, kBig}) {
        // The bytes `first` come first, whether they look like the end of a line or not.
        const std::uint32_t bits = order == kLittle ? 0x3f000000U | (first & 0xffU) | (first & 0xff00U)
                                                    : 0x00003f00U | (first & 0xffU) << 24U | (first & 0xff00U) << 8U;
        const auto x = std::bit_cast<float>(bits);
        if (!std::isfinite(x)) continue;
        const std::string header = replaced(
            format_line(order) + "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
            "\n", end);
        const PolygonSoup soup = soup_of_ply(header + stored_all<float>({x, 2.0F, 3.0F}, order));
        ASSERT_EQ(soup.points.size(), 1U);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(soup.points[0].x), std::bit_cast<std::uint64_t>(double{x}));
        ASSERT_EQ(soup.points[0].z, 3.0);
      }
    }
  }
}

TEST(ReadPly, ReadsDataThatBeginWithALineEndBehindAHeaderOfReturns) {
  const std::string header =
      replaced(format_line(kLittle) + "element vertex 1\nproperty int x\nproperty int y\nproperty int z\nend_header\n",
               "\n", "\r");
  const PolygonSoup soup = soup_of_ply(header + stored_all<std::int32_t>({0x0a, 2, 3}, kLittle));
  EXPECT_EQ(points_of(soup), (Points{{10, 2, 3}}));
}

TEST(ReadPly, StepsOverElementsBeforeAndBehindTheVertices) {
  const std::string header =
      "element camera 2\nproperty float fx\nproperty list uchar short marks\nelement vertex 3\nproperty uchar "
      "red\nproperty float z\nproperty list int float weights\nproperty double x\nproperty float y\nelement edge "
      "1\nproperty int vertex1\nproperty int vertex2\nelement face 1\nproperty uchar flags\nproperty list uchar int "
      "vertex_index\nproperty list uchar float texcoord\nelement user 3\nproperty short data\nend_header\n";
  const std::string text = "ply\nformat ascii 1.0\n" + header +
                           "1.5 2 7 8\nnan 0\n255 3 2 .5 .5 1 2\n0 6 0 4 5\n1 9 1 .25 7 8\n0 1\n4 3 0 1 2 2 .5 "
                           ".5\n1\n2\n3\n";
  const Points points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const auto check = [&](const PolygonSoup& soup) {
    EXPECT_EQ(points_of(soup), points);
    EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3}));
  };
  check(soup_of_ply(text));
  for (const std::endian order : {kLittle, kBig}) {
    const auto f = [&](float value) { return stored(value, order); };
    const auto vertex = [&](const std::array<double, 3>& p, const std::string& weights) {
      return "\xff" + f(static_cast<float>(p[2])) + weights + stored(p[0], order) + f(static_cast<float>(p[1]));
    };
    check(soup_of_ply(format_line(order) + header + f(1.5F) + "\2" + stored_all<std::int16_t>({7, 8}, order) + f(0.0F) +
                      std::string(1, '\0') + vertex(points[0], stored(2, order) + f(.5F) + f(.5F)) +
                      vertex(points[1], stored(0, order)) + vertex(points[2], stored(1, order) + f(.25F)) +
                      stored_all<std::int32_t>({0, 1}, order) + "\4\3" + stored_all<std::int32_t>({0, 1, 2}, order) +
                      "\2" + f(.5F) + f(.5F) + stored_all<std::int16_t>({1, 2, 3}, order)));
  }
}

TEST(ReadPly, ReadsFacesBeforeVertices) {
  const PolygonSoup soup = soup_of_ply(
      "ply\ncomment first\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex "
      "3\nproperty float x\nproperty float y\nproperty float z\nend_header\n3 2 1 0\n1 2 3\n4 5 6\n7 8 9\n");
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{2, 1, 0}));
  EXPECT_EQ(points_of(soup).back(), (std::array<double, 3>{7, 8, 9}));
}

TEST(ReadPly, CountsFacesOfFewerThanThreeCorners) {
  const PolygonSoup soup =
      soup_of_ply(replaced(replaced(kTextTetrahedron, "3 0 1 3\n", "2 0 1\n"), "3 0 3 2\n", "0\n"));
  EXPECT_EQ(soup.n_ignored_faces, 2U);
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 2, 1, 1, 2, 3}));
}

TEST(ReadPly, ReadsPolygonsAndStripsOfTriangles) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string points = "0 0 0\n1 0 0\n0 2 0\n0 0 3\n";
  const PolygonSoup polygon = soup_of_ply(
      head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + points + "4 0 1 2 3\n");
  EXPECT_EQ(polygon.face_sizes, (std::vector<std::uint32_t>{4}));
  // One strip goes round the tetrahedron; a second one, parted by -1, shows that turning begins anew.
  const PolygonSoup strips =
      soup_of_ply(head + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + points +
                  "9 0 1 3 2 0 -1 0 2 1\n");
  EXPECT_EQ(strips.corners, (std::vector<std::uint32_t>{0, 1, 3, 3, 1, 2, 3, 2, 0, 0, 2, 1}));
  EXPECT_EQ(soup_volume(strips), 1.0);
}

TEST(ReadPly, LetsAnElementOfATextGoOnInTheNextLine) {
  expect_ply_tetrahedron(
      soup_of_ply(replaced(replaced(kTextTetrahedron, "3 0 1 3\n", "3\n0 1\n3\n"), "0 2 0\n", "0\n2 0\n\n")));
}

TEST(ReadPly, NeverTakesAWrongLineForABrokenOne) {
  // One number more or less in any line of the data is refused.
  const std::size_t begin = kTextTetrahedron.find("end_header\n") + 11;
  for (std::size_t at = begin; at < kTextTetrahedron.size(); ++at) {
    if (kTextTetrahedron[at] == '\n' || kTextTetrahedron[at] == ' ') continue;
    std::string more = kTextTetrahedron;
    EXPECT_FALSE(refused_ply(more.insert(at, "0 ")).empty()) << more;
    std::string less = kTextTetrahedron;
    EXPECT_FALSE(refused_ply(less.replace(at, 1, "")).empty()) << less;
  }
  for (std::size_t end = kTextTetrahedron.find('\n', begin); end != std::string::npos;
       end = kTextTetrahedron.find('\n', end + 1)) {
    const std::size_t line = kTextTetrahedron.rfind('\n', end - 1) + 1;
    std::string without = kTextTetrahedron;
    EXPECT_FALSE(refused_ply(without.erase(line, end + 1 - line)).empty()) << without;
    std::string twice = kTextTetrahedron;
    EXPECT_FALSE(refused_ply(twice.insert(line, kTextTetrahedron.substr(line, end + 1 - line))).empty()) << twice;
    if (end + 1 == kTextTetrahedron.size()) continue;
    std::string joined = kTextTetrahedron;
    EXPECT_FALSE(refused_ply(joined.replace(end, 1, " ")).empty()) << joined;
  }
}

TEST(ReadPly, RefusesEveryFileThatIsCutOff) {
  for (const std::string& bytes :
       {kTextTetrahedron, binary_tetrahedron<float, std::uint8_t, std::int32_t>(kLittle, "float", "uchar int"),
        binary_tetrahedron<double, std::uint32_t, std::uint16_t>(kBig, "double", "uint ushort")}) {
    const std::size_t whole = bytes.size() - (bytes.ends_with('\n') ? 1 : 0);
    for (std::size_t size = 0; size < whole; ++size) {
      EXPECT_TRUE(contains(refused_ply(bytes.substr(0, size)), "a.ply")) << size;
    }
  }
}

TEST(ReadPly, RefusesWhatStandsBehindTheLastElement) {
  EXPECT_TRUE(contains(refused_ply(kTextTetrahedron + "3 0 1 2\n"), "(a.ply, line 20: expected the end of the file"));
  const std::string binary = binary_tetrahedron<float, std::uint8_t, std::int32_t>(kLittle, "float", "uchar int");
  expect_ply_tetrahedron(soup_of_ply(binary + "\r\n"));
  EXPECT_TRUE(contains(refused_ply(binary + "\n\n"), "2 bytes stand behind the last element"));
  EXPECT_TRUE(contains(refused_ply(binary + std::string(1, '\0')), "1 bytes stand behind the last element"));
}

TEST(ReadPly, SaysHowFineTheCoordinatesAre) {
  using DigitsKind = CoordinateDigits::Kind;
  const auto floats =
      soup_of_ply(binary_tetrahedron<float, std::uint8_t, std::int32_t>(kLittle, "float", "uchar int")).digits;
  EXPECT_EQ(floats.kind, DigitsKind::floats);
  EXPECT_EQ(floats.last_place, std::ldexp(1.0, -22));  // of 3
  const auto doubles =
      soup_of_ply(binary_tetrahedron<double, std::uint8_t, std::int32_t>(kBig, "double", "uchar int")).digits;
  EXPECT_EQ(doubles.kind, DigitsKind::doubles);
  EXPECT_EQ(doubles.last_place, std::ldexp(1.0, -51));
  const auto whole =
      soup_of_ply(binary_tetrahedron<std::int32_t, std::uint8_t, std::int32_t>(kBig, "int", "uchar int")).digits;
  EXPECT_EQ(whole.kind, DigitsKind::doubles);
  const auto text = soup_of_ply(replaced(kTextTetrahedron, "0 2 0\n", "0.3333 2.7182 0\n")).digits;
  EXPECT_EQ(text.kind, DigitsKind::decimals);
  EXPECT_NEAR(text.last_place, 1e-4, 1e-12);
}

TEST(ReadPly, TellsTextToTheLastDigit) {
  const PolygonSoup soup = soup_of_ply(replaced(kTextTetrahedron, "0 2 0\n", "0.1 -3.14159265358979312e+00 +1E-300\n"));
  EXPECT_EQ(points_of(soup)[2], (std::array<double, 3>{0.1, -3.14159265358979312, 1e-300}));
}

struct PlyFault {
  std::string what;
  std::string with;
  std::string told;
};

TEST(ReadPly, RefusesWhatIsWrongAndSaysWhere) {
  const std::vector<PlyFault> faults = {
      {"ply\n", "plyx\n", "line 1: expected the word ply"},
      {"ascii 1.0", "ascii 2.0", "line 2: expected format ascii 1.0"},
      {"ascii 1.0", "binary 1.0", "'format binary 1.0' names no format"},
      {"element vertex 4", "element vertex -4", "line 5: expected element NAME NUMBER"},
      {"element vertex 4", "element vertex 4.0", "line 5: expected element NAME NUMBER"},
      {"element vertex 4", "element vertex 5",
       "'1' is left over (a.ply, line 16: expected the end of the line behind vertex 4"},
      {"element vertex 4", "element vertex 3", "expected"},
      {"element vertex 4", "element vertex 18446744073709551615", "too large"},
      {"element vertex 4", "element vertex 1000000000", "a.ply"},
      {"element face 4", "element face 5",
       "the file ends early (a.ply, line 20: expected the number of corners of face 4"},
      {"element face 4", "element face 3", "line 19"},
      {"element face 4", "element vertex 4", "stands there twice"},
      {"element vertex 4", "element point 4", "no element vertex"},
      {"property float z\n", "", "no x, y and z"},
      {"property float z\n", "property list uchar float z\n", "no x, y and z"},
      {"property float z\n", "property float z\nproperty float z\n", "'z' stands there twice"},
      {"property float z\n", "property half z\n", "'half' is no type"},
      {"property float z\n", "property float\n", "names no property"},
      {"element vertex 4\n", "property float w\nelement vertex 4\n", "before any element"},
      {"list uchar int vertex_indices", "list uchar float vertex_indices", "no list of corners"},
      {"list uchar int vertex_indices", "list float int vertex_indices", "length is no whole number"},
      {"list uchar int vertex_indices", "list uchar int corners", "no list of corners"},
      {"property list uchar int vertex_indices\n", "", "has no property"},
      {"list uchar int vertex_indices", "list uchar int vertex_indices\nproperty list uchar int vertex_index",
       "or two"},
      {"obj_info nothing", "objinfo nothing", "line 4: expected element, property"},
      {"end_header\n", "", "expected element, property, comment"},
      {"0 2 0\n", "0 2x 0\n", "'2x' is no finite decimal number (a.ply, line 14: expected y of vertex 2"},
      {"0 2 0\n", "0 1.0D+01 0\n", "'1.0D+01' is no finite decimal number"},
      {"0 2 0\n", "0 nan 0\n", "'nan' is no finite"},
      {"0 2 0\n", "0 1e999 0\n", "'1e999' is no finite"},
      {"0 2 0\n", "0 2,5 0\n", "'2,5' is no finite"},
      {"3 1 2 3\n", "3 1 2 4\n",
       "'4' is out of range (a.ply, line 19: expected a vertex of face 3, counted from 0, from 0 to 3)"},
      {"3 1 2 3\n", "3 1 2 -1\n", "'-1' is out of range"},
      {"3 1 2 3\n", "3 1 2 3.0\n", "'3.0' is no whole number"},
      {"3 1 2 3\n", "-3 1 2 3\n", "'-3' is out of range"},
      {"3 1 2 3\n", "99999999999999999999 1 2 3\n", "is out of range"},
      {"property float x", "property int x", ""},
  };
  for (const PlyFault& fault : faults) {
    SCOPED_TRACE(fault.with);
    const std::string bytes = replaced(kTextTetrahedron, fault.what, fault.with);
    ASSERT_NE(bytes, kTextTetrahedron);
    if (fault.told.empty()) {
      expect_ply_tetrahedron(soup_of_ply(bytes));
      continue;
    }
    const std::string message = refused_ply(bytes);
    EXPECT_TRUE(contains(message, fault.told));
    EXPECT_TRUE(contains(message, " - "));
  }
  EXPECT_TRUE(contains(refused_ply(replaced(replaced(kTextTetrahedron, "float x", "int x"), "1 0 0", "1.5 0 0")),
                       "'1.5' is no whole number"));
}

TEST(ReadPly, RefusesBinaryCoordinatesThatAreNotFinite) {
  const std::string header =
      format_line(kLittle) + "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    const std::string message = refused_ply(header + stored_all<float>({1, 2, 3, 4, bad, 6}, kLittle));
    EXPECT_TRUE(contains(message, "a coordinate is not finite (a.ply, byte " + std::to_string(header.size() + 16) +
                                      ": expected y of vertex 1, counted from 0)"));
  }
}

TEST(ReadPly, RefusesBinaryCountsThatLieAtOnce) {
  // Nothing near 2^30 points, or 2^31 corners, may be made room for.
  const std::string header = format_line(kLittle) +
                             "element vertex 1000000000\nproperty float x\nproperty float y\nproperty float "
                             "z\nelement face 1000000000\nproperty list uint int vertex_indices\nend_header\n";
  EXPECT_TRUE(contains(refused_ply(header + std::string(120, '\0')), "the file ends early"));
  const std::string list = replaced(header, "1000000000", "1");
  EXPECT_TRUE(
      contains(refused_ply(list + std::string(12, '\0') + "\xff\xff\xff\x7f" + std::string(40, '\0')), "ends early"));
  EXPECT_TRUE(contains(refused_ply(list + std::string(12, '\0') + "\xff\xff\xff\xff" + std::string(40, '\0')),
                       "4294967295 is out of range"));
  EXPECT_TRUE(contains(refused_ply(list + std::string(12, '\0') + "\1" + std::string(3, '\0') + "\xff\xff\xff\xff"),
                       "-1 is out of range"));
}

}  // namespace
}  // namespace vex::tests
