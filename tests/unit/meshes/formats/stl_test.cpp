#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "meshes/formats/strict_readers.h"
#include "tests/unit/meshes/refusal.h"

namespace vex::tests {
namespace {

PolygonSoup soup_of_stl(const std::string& bytes) { return read_stl(bytes, "a.stl"); }
std::string refused_stl(const std::string& bytes) {
  return refusal_of([&] { static_cast<void>(soup_of_stl(bytes)); });
}

// A tetrahedron, V = 1.
constexpr std::array<std::array<std::array<float, 3>, 3>, 4> kTriangles{{{{{0, 0, 0}, {0, 2, 0}, {1, 0, 0}}},
                                                                         {{{0, 0, 0}, {1, 0, 0}, {0, 0, 3}}},
                                                                         {{{0, 0, 0}, {0, 0, 3}, {0, 2, 0}}},
                                                                         {{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}}}};

Points expected_points() {
  Points points;
  for (const auto& triangle : kTriangles) {
    for (const auto& [x, y, z] : triangle) points.push_back({double{x}, double{y}, double{z}});
  }
  return points;
}

std::string binary(std::string header, std::uint32_t n, const std::string& attribute = std::string(2, '\0')) {
  header.resize(80, ' ');
  std::string bytes = header + stored(n, std::endian::little);
  for (const auto& triangle : kTriangles) {
    bytes += stored_all<float>({0.5F, 0.5F, 0.5F}, std::endian::little);
    for (const auto& [x, y, z] : triangle) bytes += stored_all<float>({x, y, z}, std::endian::little);
    bytes += attribute;
  }
  return bytes;
}

std::string text(const std::string& name = "part") {
  std::string result = "solid " + name + "\n";
  for (const auto& triangle : kTriangles) {
    result += "  facet normal 0.577 -5.77e-1 0\n    outer loop\n";
    for (const auto& [x, y, z] : triangle) {
      result += "      vertex " + std::to_string(static_cast<int>(x)) + " " + std::to_string(static_cast<int>(y)) +
                " " + std::to_string(static_cast<int>(z)) + "\n";
    }
    result += "    endloop\n  endfacet\n";
  }
  return result + "endsolid " + name + "\n";
}

void expect_stl_tetrahedron(const PolygonSoup& soup) {
  EXPECT_EQ(points_of(soup), expected_points());
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3, 3, 3, 3}));
  EXPECT_EQ(soup.n_parts, 1U);
  EXPECT_EQ(soup_volume(soup), 1.0);
}

TEST(ReadStl, ReadsBinaryWhateverItsHeaderSays) {
  for (const char* header : {"", "solid part", "solid", "SOLID facet normal", "COLOR=abcd", "\xEF\xBB\xBFsolid"}) {
    SCOPED_TRACE(header);
    expect_stl_tetrahedron(soup_of_stl(binary(header, 4)));
    expect_stl_tetrahedron(soup_of_stl(binary(header, 4, "\x1f\x80")));
    expect_stl_tetrahedron(soup_of_stl(binary(std::string(header) + std::string(20, '\0'), 4)));
  }
  EXPECT_TRUE(soup_of_stl(binary("solid", 0).substr(0, 84)).points.empty());
}

TEST(ReadStl, ReadsBinaryWithBytesBehindThatHideNoTriangle) {
  for (const char* header : {"made by", "solid part"}) {
    for (const std::string& behind :
         {std::string("\n"), std::string(49, 'x'), std::string(1, '\0'), std::string(1000, '\0')}) {
      expect_stl_tetrahedron(soup_of_stl(binary(header, 4) + behind));
    }
  }
}

TEST(ReadStl, RefusesABinaryNumberOfTrianglesThatLies) {
  for (const char* header : {"made by", "solid part"}) {
    for (const std::uint32_t n : {0U, 1U, 3U, 5U, 1000000000U, 0xffffffffU}) {
      const std::string message = refused_stl(binary(header, n));
      EXPECT_TRUE(contains(message, "(a.stl, byte 80: " + std::to_string(n) + " triangles, expected no other"));
    }
    EXPECT_TRUE(contains(refused_stl(binary(header, 4) + std::string(50, 'x')), "the 5 that the file has bytes for"));
    EXPECT_TRUE(contains(refused_stl(binary(header, 4) + std::string(49, '\0') + "x"), "mend the number"));
  }
}

TEST(ReadStl, RefusesEveryFileThatIsCutOff) {
  const std::string bytes = binary("made by", 4);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_TRUE(contains(refused_stl(bytes.substr(0, size)), "a.stl")) << size;
  }
  const std::string whole = text();
  const std::size_t end = whole.find("endsolid") + 8;
  for (std::size_t size = 0; size < end; ++size) {
    EXPECT_TRUE(contains(refused_stl(whole.substr(0, size)), "a.stl")) << size;
  }
  expect_stl_tetrahedron(soup_of_stl(whole.substr(0, end)));
}

TEST(ReadStl, RefusesBinaryCoordinatesThatAreNotFinite) {
  for (const float bad : {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    std::string bytes = binary("made by", 4);
    bytes.replace(84 + 2 * 50 + 12 + 12 + 8, 4, stored(bad, std::endian::little));
    EXPECT_TRUE(contains(refused_stl(bytes), "(a.stl, byte 208: expected vertex 1 of triangle 2, counted from 0)"));
    bytes = binary("made by", 4);
    bytes.replace(84 + 50, 4, stored(bad, std::endian::little));  // a normal
    expect_stl_tetrahedron(soup_of_stl(bytes));
  }
}

TEST(ReadStl, ReadsTextInEveryLayout) {
  const std::string plain = text();
  std::string upper;
  for (const char c : plain) upper += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  for (const std::string& bytes :
       {plain, upper, replaced(plain, "\n", "\r\n"), replaced(plain, "\n", "\r"), replaced(plain, "\n", " "),
        replaced(plain, "\n", "\n\n\t"), replaced(plain, " ", "\t"), "\xEF\xBB\xBF" + plain, "\n\n  " + plain,
        plain + "\n \n", text(""), text("facet of a box"), text("solid endsolid"),
        text("Gr\xC3\xB6\xC3\x9F"
             "e 1"),
        replaced(plain, "0.577 -5.77e-1 0", "nan -nan inf"), replaced(plain, "0.577", "-1.#IND"),
        replaced(plain, "0.577", "-nan(ind)"), replaced(plain, "endsolid part", "endsolid"),
        replaced(plain, "vertex 0 2 0", "vertex\n0\n+2.0\n0e5")}) {
    SCOPED_TRACE(bytes);
    expect_stl_tetrahedron(soup_of_stl(bytes));
  }
}

TEST(ReadStl, ReadsAllSolidsOfAText) {
  const PolygonSoup soup = soup_of_stl(text("one") + text("two") + "solid\nendsolid\n");
  EXPECT_EQ(soup.n_parts, 3U);
  EXPECT_EQ(soup.face_sizes.size(), 8U);
  EXPECT_EQ(soup_volume(soup), 2.0);
  // In one line the second solid would be part of a name.
  EXPECT_TRUE(contains(refused_stl(replaced(text("one") + text("two"), "\n", " ")), "in one line"));
}

TEST(ReadStl, ReadsLoopsOfMoreVertices) {
  const PolygonSoup soup = soup_of_stl(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n");
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(soup.points.size(), 4U);
}

TEST(ReadStl, ReadsTextExactlyAndSaysHowFineItIs) {
  const PolygonSoup soup = soup_of_stl(replaced(text(), "vertex 0 2 0", "vertex 5e-17 2.7183 -0.3333"));
  EXPECT_EQ(points_of(soup)[1], (std::array<double, 3>{5e-17, 2.7183, -0.3333}));
  EXPECT_EQ(soup.digits.kind, CoordinateDigits::Kind::decimals);
  const PolygonSoup floats = soup_of_stl(binary("", 4));
  EXPECT_EQ(floats.digits.kind, CoordinateDigits::Kind::floats);
  EXPECT_EQ(floats.digits.last_place, std::ldexp(1.0, -22));
}

struct StlFault {
  std::string what;
  std::string with;
  std::string told;
};

TEST(ReadStl, RefusesWhatIsWrongAndSaysWhere) {
  const std::vector<StlFault> faults = {
      {"vertex 0 2 0", "vertex 0 2x 0",
       "'2x' is no finite decimal number (a.stl, line 5: expected a coordinate of point 1"},
      {"vertex 0 2 0", "vertex 0 1.0D+01 0", "'1.0D+01' is no finite"},
      {"vertex 0 2 0", "vertex 0 nan 0", "'nan' is no finite"},
      {"vertex 0 2 0", "vertex 0 2", "'vertex' is no finite decimal number (a.stl, line 6"},
      {"vertex 0 2 0", "vertex 0 2 0 0", "'0' is out of place (a.stl, line 5: expected vertex)"},
      {"      vertex 0 2 0\n", "", "a loop of 2 vertices (a.stl, line 6: expected three or more)"},
      {"    outer loop\n", "", "'vertex' is out of place (a.stl, line 3: expected outer)"},
      {"    endloop\n", "", "'endfacet' is out of place (a.stl, line 7: expected vertex or endloop)"},
      {"  endfacet\n", "", "'facet' is out of place (a.stl, line 8: expected endfacet)"},
      {"0.577 -5.77e-1 0", "0.577 -5.77e-1",
       "'outer' is out of place (a.stl, line 3: expected a number of the normal)"},
      {"0.577 -5.77e-1 0", "0.577 -5.77e-1 up", "'up' is out of place"},
      {"endsolid part\n", "", "the file ends early (a.stl, line 30: expected facet or endsolid)"},
      {"endsolid part\n", "endsolid part\nfacet\n", "'facet' stands behind a solid (a.stl, line 31"},
      {"solid part", "solid part\ncolor 1 0 0", "'color' is out of place (a.stl, line 2: expected facet or endsolid)"},
  };
  for (const StlFault& fault : faults) {
    SCOPED_TRACE(fault.with);
    const std::string bytes = replaced(text(), fault.what, fault.with);
    ASSERT_NE(bytes, text());
    const std::string message = refused_stl(bytes);
    EXPECT_TRUE(contains(message, fault.told));
    EXPECT_TRUE(contains(message, " - "));
  }
  EXPECT_TRUE(contains(refused_stl("ISO-10303-21;"), "this is no .stl file"));
  EXPECT_TRUE(contains(refused_stl(replaced(text(), "solid", "body")), "this is no .stl file"));
}

}  // namespace
}  // namespace vex::tests
