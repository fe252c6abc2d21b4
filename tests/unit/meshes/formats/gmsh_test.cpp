#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "meshes/formats/strict_readers.h"
#include "tests/unit/meshes/refusal.h"

namespace vex::tests {
namespace {

PolygonSoup soup_of_gmsh(const std::string& bytes) { return read_gmsh(bytes, "a.msh"); }
std::string refused_gmsh(const std::string& bytes) {
  return refusal_of([&] { static_cast<void>(soup_of_gmsh(bytes)); });
}

// The same tetrahedron in every version, with nodes 7, 3, 100 and 2000000000, a point, a line and a volume.
const std::string kText2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"skin\"\n$EndPhysicalNames\n$Nodes\n4\n7 0 0 0\n3 1 "
    "0 "
    "0\n100 0 2 0\n2000000000 0 0 3\n$EndNodes\n$Elements\n7\n1 15 2 0 1 7\n2 1 2 0 1 7 3\n3 2 2 1 1 7 100 3\n4 2 2 1 "
    "1 "
    "7 3 2000000000\n5 2 0 7 2000000000 100\n6 2 3 1 1 9 3 100 2000000000\n7 4 2 0 1 7 3 100 "
    "2000000000\n$EndElements\n";
const std::string kText41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 0 0\n1 0 0 0 0\n$EndEntities\n$Nodes\n3 4 3 2000000000\n0 1 "
    "1 "
    "1\n7\n0 0 0\n1 1 1 1\n3\n1 0 0 0.5\n2 1 1 2\n100\n2000000000\n0 2 0 .1 .2\n0 0 3 .3 .4\n$EndNodes\n$Elements\n4 7 "
    "1 7\n0 1 15 1\n1 7\n1 1 1 1\n2 7 3\n2 1 2 4\n3 7 100 3\n4 7 3 2000000000\n5 7 2000000000 100\n6 3 100 "
    "2000000000\n3 1 4 1\n7 7 3 100 2000000000\n$EndElements\n$Periodic\n0\n$EndPeriodic\n";
const std::string kText40 =
    "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Nodes\n2 4\n1 0 0 1\n7 0 0 0\n1 2 1 3\n3 1 0 0 .1 .2\n100 0 2 0 .1 "
    ".2\n2000000000 0 0 "
    "3 .1 .2\n$EndNodes\n$Elements\n4 7\n1 0 15 1\n1 7\n1 1 1 1\n2 7 3\n1 2 2 4\n3 7 100 3\n4 7 3 2000000000\n5 7 "
    "2000000000 100\n6 3 100 2000000000\n1 3 4 1\n7 7 3 100 2000000000\n$EndElements\n";

class Binary {
 public:
  Binary(const std::string& version, std::endian order) : order_(order) {
    text("$MeshFormat\n" + version + " 1 8\n").ints({1}).text("\n$EndMeshFormat\n");
  }
  Binary& text(const std::string& more) {
    bytes_ += more;
    return *this;
  }
  Binary& ints(const std::vector<std::int32_t>& values) { return text(stored_all(values, order_)); }
  Binary& sizes(const std::vector<std::uint64_t>& values) { return text(stored_all(values, order_)); }
  Binary& doubles(const std::vector<double>& values) { return text(stored_all(values, order_)); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::endian order_;
  std::string bytes_;
};

std::string binary2(std::endian order) {
  Binary file("2.2", order);
  file.text("$Nodes\n4\n").ints({7}).doubles({0, 0, 0}).ints({3}).doubles({1, 0, 0});
  file.ints({100}).doubles({0, 2, 0}).ints({2000000000}).doubles({0, 0, 3}).text("\n$EndNodes\n$Elements\n7\n");
  file.ints({15, 1, 2, 1, 0, 1, 7}).ints({1, 1, 2, 2, 0, 1, 7, 3}).ints({2, 3, 2, 3, 1, 1, 7, 100, 3});
  file.ints({4, 1, 1, 7, 3, 2000000000, 5, 1, 1, 7, 2000000000, 100}).ints({2, 1, 0, 6, 3, 100, 2000000000});
  return file.ints({4, 1, 2, 7, 0, 1, 7, 3, 100, 2000000000}).text("\n$EndElements\n").bytes();
}

std::string binary41(std::endian order) {
  Binary file("4.1", order);
  file.text("$Entities\n").sizes({0, 0, 0, 0}).text("\n$EndEntities\n$Nodes\n").sizes({2, 4, 3, 2000000000});
  file.ints({0, 1, 0}).sizes({1, 7}).doubles({0, 0, 0});
  file.ints({2, 1, 1}).sizes({3, 3, 100, 2000000000}).doubles({1, 0, 0, .1, .2, 0, 2, 0, .1, .2, 0, 0, 3, .1, .2});
  file.text("\n$EndNodes\n$Elements\n").sizes({4, 7, 1, 7}).ints({0, 1, 15}).sizes({1, 1, 7});
  file.ints({1, 1, 1}).sizes({1, 2, 7, 3}).ints({2, 1, 2}).sizes({4, 3, 7, 100, 3, 4, 7, 3, 2000000000});
  file.sizes({5, 7, 2000000000, 100, 6, 3, 100, 2000000000}).ints({3, 1, 4}).sizes({1, 7, 7, 3, 100, 2000000000});
  return file.text("\n$EndElements\n").bytes();
}

void expect_gmsh_tetrahedron(const PolygonSoup& soup) {
  EXPECT_EQ(points_of(soup), (Points{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}));
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3, 3, 3, 3}));
  EXPECT_EQ(soup.n_ignored_faces, 2U);
  EXPECT_EQ(soup.n_parts, 1U);
}

TEST(ReadGmsh, ReadsEveryVersionInText) {
  for (const std::string& text : {kText2, kText40, kText41}) {
    SCOPED_TRACE(text);
    expect_gmsh_tetrahedron(soup_of_gmsh(text));
    expect_gmsh_tetrahedron(soup_of_gmsh(replaced(text, "\n", "\r\n")));
    expect_gmsh_tetrahedron(soup_of_gmsh("$Comments\nby hand\n$EndComments\n" + text + "\n\n"));
    expect_gmsh_tetrahedron(soup_of_gmsh(text.substr(0, text.size() - 1)));
  }
  expect_gmsh_tetrahedron(soup_of_gmsh(replaced(kText2, "2.2 0 8", "2 0 8")));
}

TEST(ReadGmsh, ReadsBinaryInBothByteOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    expect_gmsh_tetrahedron(soup_of_gmsh(binary2(order)));
    expect_gmsh_tetrahedron(soup_of_gmsh(binary41(order)));
    EXPECT_EQ(soup_of_gmsh(binary41(order)).digits.kind, CoordinateDigits::Kind::doubles);
  }
}

TEST(ReadGmsh, ReadsParametricNodesOfVersion2) {
  const std::string text = replaced(replaced(kText2, "Nodes", "ParametricNodes"), "7 0 0 0\n", "7 0 0 0 0 1\n");
  const std::string lines =
      replaced(replaced(text, "3 1 0 0\n", "3 1 0 0 1 5 .5\n"), "100 0 2 0\n", "100 0 2 0 2 5 .5 .5\n");
  expect_gmsh_tetrahedron(soup_of_gmsh(replaced(lines, "2000000000 0 0 3\n", "2000000000 0 0 3 3 1\n")));
}

TEST(ReadGmsh, ReadsElementsBeforeNodes) {
  const std::size_t nodes = kText2.find("$Nodes");
  const std::size_t elements = kText2.find("$Elements");
  expect_gmsh_tetrahedron(
      soup_of_gmsh(kText2.substr(0, nodes) + kText2.substr(elements) + kText2.substr(nodes, elements - nodes)));
}

TEST(ReadGmsh, ReadsQuads) {
  const PolygonSoup soup = soup_of_gmsh(
      replaced(replaced(kText2, "6 2 3 1 1 9 3 100 2000000000\n", "6 3 0 3 100 2000000000 7\n"), "\n\n", "\n"));
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3, 3, 3, 4}));
}

TEST(ReadGmsh, TakesAnElementOfTwoPhysicalGroupsOnce) {
  // Version 2 lists such an element once for each group, with a number of its own.
  const std::string groups =
      replaced(replaced(kText2, "3 2 2 1 1 7 100 3\n", "3 2 2 1 1 7 100 3\n8 2 2 2 1 7 100 3\n9 2 2 3 1 7 100 3\n"),
               "\n7\n1 15", "\n9\n1 15");
  expect_gmsh_tetrahedron(soup_of_gmsh(groups));
  // On another part of the geometry, or in the same group, it is another face.
  EXPECT_EQ(soup_of_gmsh(replaced(groups, "8 2 2 2 1 7", "8 2 2 2 4 7")).face_sizes.size(), 6U);
  EXPECT_EQ(soup_of_gmsh(replaced(groups, "8 2 2 2 1 7", "8 2 2 1 1 7")).face_sizes.size(), 5U);
}

TEST(ReadGmsh, RefusesVolumesWithoutASurfaceAndCurvedElements) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 2 0\n4 0 0 3\n$EndNodes\n"
      "$Elements\n1\n1 4 0 1 2 3 4\n$EndElements\n";
  EXPECT_TRUE(contains(refused_gmsh(text), "volume elements and no surface"));
  EXPECT_TRUE(contains(refused_gmsh(replaced(text, "1 4 0 1 2 3 4", "1 9 0 1 2 3 4 1 2")), "Mesh.ElementOrder = 1"));
  EXPECT_TRUE(contains(refused_gmsh(replaced(text, "1 4 0 1 2 3 4", "1 99 0 1 2 3 4")), "99 is no type of elements"));
  // Nodes alone are points.
  EXPECT_EQ(soup_of_gmsh(text.substr(0, text.find("$Elements"))).points.size(), 4U);
}

TEST(ReadGmsh, RefusesEveryFileThatIsCutOff) {
  const std::vector<std::string> files = {kText2, kText40, kText41, binary2(std::endian::big),
                                          binary41(std::endian::little)};
  for (const std::string& whole : files) {
    const std::size_t end_of_nodes = whole.find("$EndNodes") + 9;
    const std::size_t end = whole.find("$EndElements") + 12;
    for (std::size_t size = 0; size < end; ++size) {
      if (size == end_of_nodes || size == end_of_nodes + 1) continue;  // points alone
      EXPECT_TRUE(contains(refused_gmsh(whole.substr(0, size)), "a.msh")) << size;
    }
  }
}

struct GmshFault {
  std::string what;
  std::string with;
  std::string told;
};

void expect_refused(const std::string& text, const std::vector<GmshFault>& faults) {
  for (const GmshFault& fault : faults) {
    SCOPED_TRACE(fault.with);
    const std::string bytes = replaced(text, fault.what, fault.with);
    ASSERT_NE(bytes, text);
    const std::string message = refused_gmsh(bytes);
    EXPECT_TRUE(contains(message, fault.told));
    EXPECT_TRUE(contains(message, " - "));
  }
}

TEST(ReadGmsh, RefusesWhatIsWrongInVersion2AndSaysWhere) {
  expect_refused(
      kText2,
      {{"$MeshFormat\n", "$NOD\n", "this is version 1 of Gmsh's format (a.msh, line 1"},
       {"$MeshFormat\n", "MeshVersionFormatted 2\n", "it does not begin like a .msh file"},
       {"2.2 0 8", "3.0 0 8", "'3.0' is no version that is read (a.msh, line 2"},
       {"2.2 0 8", "2.2 2 8", "'2' is out of range"},
       {"$Nodes\n4\n", "$Nodes\n5\n", "'$EndNodes' is no whole number (a.msh, line 14: expected the number of node 4"},
       {"$Nodes\n4\n", "$Nodes\n3\n", "'2000000000' is out of place (a.msh, line 13: expected '$EndNodes')"},
       {"$Nodes\n4\n", "$Nodes\n99999999999\n", "too large"},
       {"$Elements\n7\n", "$Elements\n8\n", "'$EndElements' is no whole number"},
       {"$Elements\n7\n", "$Elements\n6\n", "expected '$EndElements')"},
       {"3 1 0 0\n", "3 1 0x 0\n", "'0x' is no finite decimal number (a.msh, line 11: expected a coordinate of node 1"},
       {"3 1 0 0\n", "3 1 inf 0\n", "'inf' is no finite"},
       {"3 1 0 0\n", "3 1 0 0 0\n", "'0' is left over (a.msh, line 11: expected the end of the line of node 1"},
       {"3 1 0 0\n", "7 1 0 0\n", "two nodes have one number (a.msh, node 7"},
       {"3 1 0 0\n", "-3 1 0 0\n", "'-3' is out of range"},
       {"7 100 3\n", "7 100 4\n", "an element names a node that is not there (a.msh, node 4"},
       {"7 100 3\n", "7 100 0\n", "'0' is out of range (a.msh, line 19: expected a node of element 2"},
       {"$EndElements", "$EndElement", "expected '$EndElements')"},
       {"$EndPhysicalNames", "$EndNames", "the section '$PhysicalNames' does not end"},
       {"$Nodes", "$Points", "does not end"},
       {"$PhysicalNames\n1",
        "$a\x01\n$Enda\x01"
        "b",
        "(a.msh, line 5: expected '$Enda?')"},
       {"$PhysicalNames", "x $PhysicalNames", "'x' stands outside of sections (a.msh, line 4"}});
  EXPECT_TRUE(contains(refused_gmsh(kText2 + kText2.substr(kText2.find("$Nodes"))), "a second section of nodes"));
  EXPECT_TRUE(contains(refused_gmsh(kText2 + kText2.substr(kText2.find("$Elements"))), "a second section $Elements"));
}

TEST(ReadGmsh, RefusesWhatIsWrongInVersion41AndSaysWhere) {
  expect_refused(kText41, {{"3 4 3 2000000000\n", "3 5 3 2000000000\n", "the blocks have 4 nodes"},
                           {"3 4 3 2000000000\n", "3 3 3 2000000000\n", "'2' is out of range"},
                           {"3 4 3 2000000000\n", "2 4 3 2000000000\n", "the blocks have 2 nodes"},
                           {"3 4 3 2000000000\n", "4 4 3 2000000000\n", "'$EndNodes'"},
                           {"2 1 1 2\n", "2 1 1 3\n", "out of range"},
                           {"2 1 1 2\n", "2 1 0 2\n", "a.msh"},
                           {"4 7 1 7\n", "4 8 1 7\n", "the blocks have 7 elements"},
                           {"4 7 1 7\n", "4 6 1 7\n", "'1' is out of range"},
                           {"2 1 2 4\n", "2 1 2 3\n", "a.msh"},
                           {"2 1 2 4\n", "2 1 3 4\n", "a.msh"},
                           {"3 7 100 3\n", "3 7 100 5\n", "node 5"}});
}

TEST(ReadGmsh, RefusesALineThatLacksANumberOrHasOneTooMany) {
  // The numbers of the next line would make the line whole.
  expect_refused(kText2,
                 {{"3 1 0 0\n", "3 1 0 \n", "the line ends early (a.msh, line 11: expected a coordinate of node 1"},
                  {"3 1 0 0\n", "3\n1 0 0\n", "the line ends early (a.msh, line 11"},
                  {"3 1 0 0\n", "3 1 0 0 100 0 2 0\n", "'100' is left over (a.msh, line 11"},
                  {"7 100 3\n", "7 100\n", "the line ends early (a.msh, line 19: expected a node of element 2"},
                  {"7 100 3\n", "7 100\r\n", "the line ends early (a.msh, line 19"},
                  {"7 100 3\n", "7 100 3 7\n", "'7' is left over (a.msh, line 19: expected the end of the line of"},
                  {"3 2 2 1 1 7 100 3\n", "3 2\n2 1 1 7 100 3\n", "the line ends early (a.msh, line 19"},
                  {"1 2 0 1 7 3\n", "1 2 0 1 7\n", "the line ends early (a.msh, line 18: expected the nodes of"}});
  expect_refused(kText40, {{"7 0 0 0\n", "7 0 0\n", "the line ends early (a.msh, line 7"},
                           {"3 1 0 0 .1 .2\n", "3 1 0 0 .1\n", "the line ends early (a.msh, line 9"},
                           {"3 7 100 3\n", "3 7 100\n", "the line ends early (a.msh, line 20"}});
  expect_refused(kText41, {{"\n0 0 0\n", "\n0 0\n", "the line ends early (a.msh, line 12: expected a coordinate of"},
                           {"0 2 0 .1 .2\n", "0 2 0 .1\n", "the line ends early (a.msh, line 19"},
                           {"0 2 0 .1 .2\n", "0 2 0 .1 .2 0\n", "'0' is left over (a.msh, line 19"},
                           {"100\n2000000000\n0 2", "100 2000000000 0 2", "'0' is left over (a.msh, line 17"},
                           {"2 1 1 2\n", "2 1 1\n", "the line ends early (a.msh, line 16"},
                           {"3 7 100 3\n", "3 7 100\n", "the line ends early (a.msh, line 29"},
                           {"3 7 100 3\n", "3 7 100 3 7\n", "'7' is left over (a.msh, line 29"}});
  // Of version 4.1, the numbers of nodes may share a line.
  expect_gmsh_tetrahedron(soup_of_gmsh(replaced(kText41, "100\n2000000000\n0 2", "100 2000000000\n0 2")));
}

TEST(ReadGmsh, RefusesWhatIsWrongInBinary) {
  std::string order = binary41(std::endian::little);
  order.replace(order.find("8\n") + 2, 4, std::string(4, '\0'));
  EXPECT_TRUE(contains(refused_gmsh(order), "the order of bytes cannot be told (a.msh, byte 20"));
  EXPECT_TRUE(contains(refused_gmsh(replaced(binary41(std::endian::big), "4.1 1 8", "4.1 1 4")), "numbers of 4 bytes"));
  std::string infinite = binary2(std::endian::big);
  infinite.replace(infinite.find("$Nodes\n4\n") + 13, 8,
                   stored(std::numeric_limits<double>::infinity(), std::endian::big));
  EXPECT_TRUE(contains(refused_gmsh(infinite), "a coordinate is not finite"));
  for (const std::endian byte_order : {std::endian::little, std::endian::big}) {
    const Binary head("4.1", byte_order);
    // Counts without data: nothing may be made room for.
    for (const std::uint64_t n : {std::uint64_t{1} << 29U, ~std::uint64_t{0}}) {
      Binary file = head;
      EXPECT_TRUE(contains(
          refused_gmsh(file.text("$Nodes\n").sizes({n, n, 1, n}).ints({2, 1, 0}).sizes({n, 1}).bytes()), "a.msh"));
    }
  }
}

}  // namespace
}  // namespace vex::tests
