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

PolygonSoup soup_of_vtk(const std::string& bytes) { return read_vtk(bytes, "a.vtk"); }
std::string refused_vtk(const std::string& bytes) {
  return refusal_of([&] { static_cast<void>(soup_of_vtk(bytes)); });
}

const std::string kText = "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET POLYDATA\n";
const std::string kBinary = "# vtk DataFile Version 4.2\nby hand\nBINARY\nDATASET POLYDATA\n";
const std::string kVtkPoints = "POINTS 4 double\n0 0 0 1 0 0\n0 2 0 0 0 3\n";
const std::string kPolygons = "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kTetrahedron = kText + kVtkPoints + kPolygons;

std::string shorts(const std::vector<std::int16_t>& values) { return stored_all(values, std::endian::big); }
std::string ints(const std::vector<std::int32_t>& values) { return stored_all(values, std::endian::big); }
std::string longs(const std::vector<std::int64_t>& values) { return stored_all(values, std::endian::big); }
std::string floats(const std::vector<float>& values) { return stored_all(values, std::endian::big); }
std::string doubles(const std::vector<double>& values) { return stored_all(values, std::endian::big); }

const std::string kBinaryPoints = "POINTS 4 float\n" + floats({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}) + "\n";
const std::string kBinaryPolygons = "POLYGONS 4 16\n" + ints({3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3}) + "\n";
const std::string kBinaryTetrahedron = kBinary + kBinaryPoints + kBinaryPolygons;

void expect_vtk_tetrahedron(const PolygonSoup& soup) {
  EXPECT_EQ(points_of(soup), (Points{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}));
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3, 3, 3, 3}));
  EXPECT_EQ(soup.n_parts, 1U);
}

TEST(ReadVtk, ReadsTextInEveryLayout) {
  const std::vector<std::string> files = {
      kTetrahedron,
      replaced(kTetrahedron, "\n", "\r\n"),
      replaced(kTetrahedron, "\n", "\r"),
      kText + kVtkPoints + "\n" + replaced(kPolygons, "3 0 1 3\n3", "3 0\n1 3 3"),
      kTetrahedron.substr(0, kTetrahedron.size() - 1),
      replaced(replaced(kTetrahedron, "POINTS", "points"), "double", "FLOAT"),
      replaced(kTetrahedron, "double", "int"),
      kTetrahedron + "CELL_DATA 4\nSCALARS q float\nLOOKUP_TABLE default\n1 2 3 4\n",
      kText + "FIELD FieldData 2\nTIME 1 1 double\n0.5\nids 2 2 vtkIdType\n1 2\n3 4\n" + kVtkPoints +
          "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 3\n\n" + kPolygons,
      kText + "FIELD FieldData 1\nname 1 2 string\nPOINTS 1 float\n\n" + kVtkPoints + kPolygons};
  for (const std::string& bytes : files) {
    SCOPED_TRACE(bytes);
    expect_vtk_tetrahedron(soup_of_vtk(bytes));
  }
}

TEST(ReadVtk, ReadsEveryTypeInBinary) {
  expect_vtk_tetrahedron(soup_of_vtk(kBinaryTetrahedron));
  expect_vtk_tetrahedron(soup_of_vtk(replaced(kBinaryTetrahedron, "POLYDATA\n", "POLYDATA\r\n")));
  const std::vector<std::string> all_points = {"double\n" + doubles({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}),
                                               "int\n" + ints({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}),
                                               "vtktypeint64\n" + longs({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}),
                                               "short\n" + shorts({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}),
                                               "unsigned_char\n" + std::string("\0\0\0\1\0\0\0\2\0\0\0\3", 12)};
  for (const std::string& points : all_points) {
    std::string bytes = kBinary;
    bytes.append("POINTS 4 ").append(points).append(kBinaryPolygons);
    expect_vtk_tetrahedron(soup_of_vtk(bytes));
  }
  EXPECT_TRUE(contains(refused_vtk(kBinary + "POINTS 4 long\n" + std::string(96, '\0')), "'long' is no type"));
}

TEST(ReadVtk, ReadsBinaryDataThatLookLikeText) {
  // Points whose bytes are blanks and line ends, and arrays of such bytes before them.
  const std::string field = "FIELD FieldData 3\nc 1 3 unsigned_char\n\n\r\n\nb 1 9 bit\n\n\n\ns 1 2 string\n" +
                            std::string("\xC3\n\n\n\xC0") + "\n";
  const auto blank = std::bit_cast<float>(0x0a0d2009U);
  const PolygonSoup soup =
      soup_of_vtk(kBinary + field + "POINTS 2 float\n" + floats({blank, 1, 2, 3, 4, blank}) + "\n");
  EXPECT_EQ(points_of(soup), (Points{{double{blank}, 1, 2}, {3, 4, double{blank}}}));
}

TEST(ReadVtk, ReadsCellsAsOffsetsAndConnectivity) {
  const std::string cells = "0 3 6 9 12\nCONNECTIVITY vtktypeint64\n0 2 1 0 1 3 0 3 2 1 2 3\n";
  const std::string text = "# vtk DataFile Version 5.1\nby hand\nASCII\nDATASET POLYDATA\n" + kVtkPoints;
  expect_vtk_tetrahedron(soup_of_vtk(text + "POLYGONS 5 12\nOFFSETS vtktypeint64\n" + cells));
  const std::string binary = replaced(kBinary, "4.2", "5.1") + kBinaryPoints;
  expect_vtk_tetrahedron(soup_of_vtk(binary + "POLYGONS 5 12\nOFFSETS vtktypeint64\n" + longs({0, 3, 6, 9, 12}) +
                                     "\nCONNECTIVITY vtktypeint64\n" + longs({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) +
                                     "\n"));
  expect_vtk_tetrahedron(soup_of_vtk(binary + "POLYGONS 5 12\nOFFSETS vtktypeint32\n" + ints({0, 3, 6, 9, 12}) +
                                     "\nCONNECTIVITY vtktypeint32\n" + ints({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) +
                                     "\n"));
  for (const auto& [what, with] : std::vector<std::array<std::string, 2>>{{"0 3 6 9 12", "0 3 6 9 11"},
                                                                          {"0 3 6 9 12", "0 6 3 9 12"},
                                                                          {"0 3 6 9 12", "1 3 6 9 12"},
                                                                          {"0 3 6 9 12", "0 3 6 12"},
                                                                          {"1 2 3\n", "1 2 4\n"},
                                                                          {"1 2 3\n", "1 2 -1\n"},
                                                                          {"1 2 3\n", "1 2\n"},
                                                                          {"1 2 3\n", "1 2 3 0\n"},
                                                                          {"CONNECTIVITY", "CONNECT"}}) {
    SCOPED_TRACE(with);
    EXPECT_TRUE(
        contains(refused_vtk(text + "POLYGONS 5 12\nOFFSETS vtktypeint64\n" + replaced(cells, what, with)), "line"));
  }
}

TEST(ReadVtk, TurnsEveryOtherTriangleOfAStrip) {
  const PolygonSoup soup = soup_of_vtk(kText + kVtkPoints + "TRIANGLE_STRIPS 2 10\n5 0 1 3 2 0\n3 0 2 1\n");
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 3, 3, 1, 2, 3, 2, 0, 0, 2, 1}));
  EXPECT_EQ(soup_volume(soup), 1.0);
}

TEST(ReadVtk, CountsVerticesAndLines) {
  const PolygonSoup soup =
      soup_of_vtk(kText + kVtkPoints + "VERTICES 2 5\n1 0\n2 1 2\nLINES 1 4\n3 0 1 2\n" + kPolygons);
  EXPECT_EQ(soup.n_ignored_faces, 3U);
  EXPECT_EQ(soup.face_sizes.size(), 4U);
}

TEST(ReadVtk, ReadsTheSurfaceCellsOfAnUnstructuredGrid) {
  const std::string grid = replaced(kText, "POLYDATA", "UNSTRUCTURED_GRID") +
                           "POINTS 6 float\n0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1\n"
                           "CELLS 7 29\n3 0 1 2\n4 0 1 3 2\n4 0 1 2 3\n4 0 1 5 4\n2 0 1\n1 0\n4 0 1 2 3\n"
                           "CELL_TYPES 7\n5 9 8 7 3 1 6\n";
  const PolygonSoup soup = soup_of_vtk(grid + "POINT_DATA 6\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3 4 5 6\n");
  EXPECT_EQ(soup.face_sizes, (std::vector<std::uint32_t>{3, 4, 4, 4, 3, 3}));
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3, 2, 0, 1, 3, 2, 0, 1, 5, 4, 0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(soup.n_ignored_faces, 2U);
  EXPECT_TRUE(
      contains(refused_vtk(replaced(grid, "5 9 8", "5 10 8")), "cell 1, counted from 0, of type 10 and 4 points"));
  EXPECT_TRUE(
      contains(refused_vtk(replaced(grid, "5 9 8", "5 5 8")), "of type 5 and 4 points is no cell of a surface"));
  EXPECT_TRUE(contains(refused_vtk(replaced(grid, "CELL_TYPES 7\n5 ", "CELL_TYPES 6\n")), "7 cells have 6 types"));
  EXPECT_TRUE(contains(refused_vtk(grid.substr(0, grid.find("CELL_TYPES"))), "7 cells have 0 types"));
}

TEST(ReadVtk, RefusesGeometryThatAttributesWouldHide) {
  const std::string attributes = "CELL_DATA 4\nSCALARS q float\nLOOKUP_TABLE default\n1 2 3 4\n";
  EXPECT_TRUE(
      contains(refused_vtk(kText + kVtkPoints + attributes + kPolygons), "'POLYGONS' stands behind 'CELL_DATA'"));
  EXPECT_TRUE(contains(refused_vtk(kTetrahedron + attributes + kVtkPoints), "'POINTS' stands behind"));
  EXPECT_TRUE(
      contains(refused_vtk(kText + kVtkPoints + "METADATA\nINFORMATION 0\n" + kPolygons), "stands within METADATA"));
  // An array may have such a name.
  expect_vtk_tetrahedron(soup_of_vtk(kTetrahedron + "CELL_DATA 4\nFIELD FieldData 1\nPOLYGONS 1 4 int\n1 2 3 4\n"));
}

TEST(ReadVtk, RefusesEveryFileThatIsCutOff) {
  for (const std::string& whole : {kTetrahedron, kBinaryTetrahedron}) {
    const std::size_t begin = whole.find("POLYGONS");
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
      // Points alone are a mesh of points, with or without blanks behind them.
      if (size >= begin - 1 && size <= begin) continue;
      EXPECT_TRUE(contains(refused_vtk(whole.substr(0, size)), "a.vtk")) << size;
    }
  }
}

struct VtkFault {
  std::string what;
  std::string with;
  std::string told;
};

TEST(ReadVtk, RefusesWhatIsWrongAndSaysWhere) {
  const std::vector<VtkFault> faults = {
      {"# vtk DataFile", "# DataFile", "it does not begin like a legacy .vtk file (a.vtk, line 1"},
      {"# vtk DataFile", "<?xml version='1.0'?><VTKFile># vtk", "this is an XML file of VTK"},
      {"ASCII", "TEXT", "'TEXT' is out of place (a.vtk, line 3"},
      {"DATASET", "DATA", "'DATA' is out of place (a.vtk, line 4"},
      {"POLYDATA", "STRUCTURED_GRID", "the data set 'STRUCTURED_GRID' holds no surface"},
      {"POINTS 4", "POINTS 5",
       "'POLYGONS' is no finite decimal number (a.vtk, line 8: expected a coordinate of point 4"},
      {"POINTS 4", "POINTS 3", "'0' is no keyword"},
      {"POINTS 4", "POINTS -4", "'-4' is out of range"},
      {"POINTS 4", "POINTS 4000000000", "too large"},
      {"POINTS 4", "POINTS 1000000000", "'POLYGONS' is no finite"},
      {"POINTS 4 double", "POINTS 4 bit", "'bit' is no type"},
      {"1 0 0\n", "1 0 0x\n", "'0x' is no finite decimal number (a.vtk, line 6: expected a coordinate of point 1"},
      {"1 0 0\n", "1 0 nan\n", "'nan' is no finite"},
      {"POLYGONS 4", "POLYGONS 5", "the file ends early (a.vtk, line 13"},
      {"POLYGONS 4", "POLYGONS 3", "fewer numbers than announced"},
      {"4 16", "4 17", "fewer numbers than announced"},
      {"4 16", "4 15", "'3' is out of range (a.vtk, line 12"},
      {"3 1 2 3\n", "3 1 2 4\n",
       "'4' is out of range (a.vtk, line 12: expected a point of cell 3, counted from 0, from 0 to 3)"},
      {"3 1 2 3\n", "3 1 2 -1\n", "'-1' is out of range"},
      {"3 1 2 3\n", "3 1 2\n", "the file ends early"},
      {"3 1 2 3\n", "3 1 2 3 3\n", "'3' is no keyword"},
      {"POLYGONS", "POLYGON", "'POLYGON' is no keyword that is known here (a.vtk, line 8"},
      {"POINTS 4 double", "POLYGONS 1 4\n3 0 1 2\nPOINTS 4 double", "cells stand before the points"},
      {"POLYGONS", "POINTS 0 float\nPOLYGONS", "POINTS stands there twice"},
  };
  for (const VtkFault& fault : faults) {
    SCOPED_TRACE(fault.with);
    const std::string bytes = replaced(kTetrahedron, fault.what, fault.with);
    ASSERT_NE(bytes, kTetrahedron);
    const std::string message = refused_vtk(bytes);
    EXPECT_TRUE(contains(message, fault.told));
    EXPECT_TRUE(contains(message, " - "));
  }
  EXPECT_TRUE(contains(refused_vtk(kText), "the file has no points"));
  EXPECT_TRUE(
      contains(refused_vtk(kBinary + "POINTS 1 float\n" + floats({1, std::numeric_limits<float>::infinity(), 2})),
               "a coordinate is not finite (a.vtk, byte"));
}

}  // namespace
}  // namespace vex::tests
