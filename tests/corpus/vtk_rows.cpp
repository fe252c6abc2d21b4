// .vtk: legacy files of PolyData.
#include <limits>

#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Lines: version, title, ASCII, DATASET POLYDATA, POINTS 8 double, eight points from line 6 on, POLYGONS 6 30, six
// faces from line 15 on.
std::string vtk_box() { return vtk_text(box()); }

/// The first coordinate is 2560, whose first byte is 10 when it is a short number, most significant byte first.
Solid ten_wedge() {
  Solid solid = whole_wedge();
  for (Vec3d& p : solid.points) p.x += 2550;
  return solid;
}
std::string ten_first() {
  const Solid solid = ten_wedge();
  const std::string with_floats = vtk_binary(solid);
  std::string points;
  for (const Vec3d& p : solid.points) {
    for (const double x : {p.x, p.y, p.z}) put(static_cast<std::int16_t>(x), Order::big, &points);
  }
  const std::size_t n_head = up_to(with_floats, " float\n").size();
  return with_floats.substr(0, n_head) + " short\n" + points +
         with_floats.substr(n_head + 7 + 12 * solid.points.size());
}

void add_vtk_legal(Rows* rows) {
  const Solid body = box();
  const std::string text = vtk_box();
  rows->is("plain", text, body);
  rows->is("line ends of DOS", with_crlf(text), body);
  rows->is("no final newline", without_final_newline(text), body);
  rows->is("blank lines", with_line_behind(with_line_behind(text, 13, ""), 4, "\n"), body);
  rows->is("indented", up_to(text, "0.5") + with_at_every_line_start(text.substr(up_to(text, "0.5").size()), "  "),
           body);
  rows->is("keywords in small letters",
           replaced(replaced(replaced(text, "POINTS", "points"), "POLYGONS", "polygons"), "DATASET POLYDATA",
                    "dataset polydata"),
           body);
  rows->is("version 2.0", replaced(text, "3.0", "2.0"), body);
  rows->is("version 4.2", replaced(text, "3.0", "4.2"), body);
  rows->is("coordinates of floats", replaced(text, "double", "float"), body);
  rows->is("coordinates of whole numbers", replaced(vtk_text(whole_wedge()), "double", "int"), whole_wedge());
  rows->is("three points in a line", replaced_all(replaced_all(text, " 2\n0.5", " 2  0.5"), " 2\n1.5", " 2  1.5"),
           body);
  rows->is("exponents and signs", vtk_text(body, as_printed("%+.2e")), body);
  rows->is("data of points and cells behind",
           text +
               "CELL_DATA 6\nSCALARS part int 1\nLOOKUP_TABLE default\n1 1 1 1 1 1\nPOINT_DATA 8\nNORMALS n float\n" +
               point_lines(body),
           body);
  rows->is("polygons of five corners", vtk_text(five_prism()), five_prism());
  rows->is("polygons of twelve corners", vtk_text(twelve_prism()), twelve_prism());
  rows->is("polygons of twelve corners, version 5.1", vtk51_text(twelve_prism()), twelve_prism());
  rows->is("polygons of twelve corners, version 5.1, binary", vtk51_binary(twelve_prism()), twelve_prism());
  rows->is("offsets of 32 bits", replaced_all(vtk51_text(body), "vtktypeint64", "int"), body);
  rows->is("lines beside polygons", replaced(text, "POLYGONS", "LINES 1 4\n3 0 1 2\nPOLYGONS"), body);
  rows->is("vertices beside polygons", replaced(text, "POLYGONS", "VERTICES 2 4\n1 0\n1 3\nPOLYGONS"), body);
  rows->is("a strip of triangles",
           up_to(vtk_text(corner(1, 2, 3)), "POLYGONS") + "TRIANGLE_STRIPS 1 7\n6 0 2 1 3 0 2\n", corner(1, 2, 3));
  rows->is("a grid of triangles",
           replaced(replaced(vtk_text(triangulated(body)), "POLYDATA", "UNSTRUCTURED_GRID"), "POLYGONS", "CELLS") +
               "CELL_TYPES 12\n5 5 5 5 5 5 5 5 5 5 5 5\n",
           body);
  rows->is("points alone and the hull", up_to(text, "POLYGONS"), body).hull();
  rows->is("a point that no face uses, and the hull", vtk_text(with_point(body, far_point())), box_with_roof()).hull();
  rows->is("every corner a vertex of its own", vtk_text(with_own_corners(body)), body);
  rows->is("inside out", vtk_text(inside_out(body)), body).notes_that("inside out");
  rows->is("binary, polygons of twelve corners", vtk_binary(twelve_prism()), twelve_prism());
  rows->is("binary, a first byte of data that is a line end", ten_first(), ten_wedge());
}

void add_vtk_text_refusals(Rows* rows) {
  const std::string text = vtk_box();
  for (const char* token : {"1.0D+01", "1x", "0x1", "1,5", "nan", "inf", "1e400"}) {
    rows->refused(std::string("the coordinate ") + token, with_line(text, 8, std::string(token) + " 1 2"),
                  {token, "line 8"});
  }
  const std::string grid = up_to(replaced(vtk_text(triangulated(box())), "POLYDATA", "UNSTRUCTURED_GRID"), "POLYGONS");
  rows->refused("tetrahedra", grid + "CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n");
  rows->refused("a byte-order mark", with_bom(text));
  rows->refused("no first line", without_line(text, 1));
  rows->refused("neither ASCII nor BINARY", replaced(text, "ASCII", "TEXT"), {"TEXT"});
  rows->refused("a grid", replaced(text, "POLYDATA", "STRUCTURED_GRID"), {"STRUCTURED_GRID"});
  rows->refused("volumes", replaced(text, "POLYDATA", "UNSTRUCTURED_GRID"), {"POLYGONS"});
  rows->refused("no points", replaced(text, "POINTS 8 double\n" + point_lines(box()), ""));
  rows->refused("more points announced than there are", replaced(text, "POINTS 8", "POINTS 9"));
  rows->refused("fewer points announced than there are", replaced(text, "POINTS 8", "POINTS 7"));
  rows->refused("more points than any memory holds", replaced(text, "POINTS 8", "POINTS 4000000000"));
  rows->refused("a negative number of points", replaced(text, "POINTS 8", "POINTS -8"), {"-8"});
  rows->refused("more polygons announced than there are", replaced(text, "POLYGONS 6", "POLYGONS 7"));
  rows->refused("fewer polygons announced than there are", replaced(text, "POLYGONS 6", "POLYGONS 5"));
  rows->refused("a larger size announced than there is", replaced(text, "6 30", "6 31"));
  rows->refused("a smaller size announced than there is", replaced(text, "6 30", "6 29"));
  rows->refused("an index beyond the points", with_line(text, 16, "4 4 6 8 5"), {"8"});
  rows->refused("a negative index", with_line(text, 16, "4 4 6 -1 5"), {"-1"});
  rows->refused("a polygon of a negative number of corners", with_line(text, 16, "-4 4 6 7 5"), {"-4"});
  rows->refused("a polygon with fewer corners than it says", with_line(text, 16, "4 4 6 7"));
  rows->refused("cut within the points", up_to(text, "1.5 1 5"));
  rows->refused("cut within the polygons", up_to(text, "4 1 5 7 3"));
  rows->refused("version 5.1, offsets that fall", replaced(vtk51_text(box()), "0 4 8 12", "0 8 4 12"));
  rows->refused("version 5.1, a first offset that is not 0", replaced(vtk51_text(box()), "\n0 4 8 12", "\n1 4 8 12"));
  rows->refused("version 5.1, a last offset beyond the corners", replaced(vtk51_text(box()), " 24\nCONN", " 25\nCONN"));
  rows->refused("version 5.1, an index beyond the points", replaced(vtk51_text(box()), "\n4 6 7 5", "\n4 6 8 5"));
  rows->refused("version 5.1, cut", up_to(vtk51_text(box()), "\n4 6 7 5"));
  rows->no_body("points alone", up_to(text, "POLYGONS"), {"--hull"});
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("the newer XML form",
                "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData/></VTKFile>\n");
  rows->refused("a STEP file", step_text());
  rows->refused("a folder", "").as_folder();
}

void add_vtk_binary_refusals(Rows* rows) {
  const std::string bytes = vtk_binary(box());
  const std::size_t points = up_to(bytes, " float\n").size() + 7;
  const std::size_t faces = up_to(bytes, " 6 30\n").size() + 6;
  const auto with = [&](auto value, std::size_t at) {
    std::string raw;
    put(value, Order::big, &raw);
    return std::string(bytes).replace(at, raw.size(), raw);
  };
  rows->refused("binary, NaN", with(std::numeric_limits<float>::quiet_NaN(), points + 12));
  rows->refused("binary, an index beyond the points", with(std::int32_t{8}, faces + 8));
  rows->refused("binary, a negative index", with(std::int32_t{-1}, faces + 8));
  rows->refused("binary, a polygon of a thousand million corners", with(std::int32_t{1000000000}, faces));
  rows->refused("binary, cut within the points", bytes.substr(0, points + 50));
  rows->refused("binary, cut within the polygons", without_last(bytes, 30));
  rows->refused("binary, and text announced", replaced(bytes, "BINARY", "ASCII"));
  rows->refused("text, and binary announced", replaced(vtk_box(), "ASCII", "BINARY"));
  rows->refused("binary, version 5.1, cut", without_last(vtk51_binary(box()), 30));
  rows->refused("binary, more points announced than there are", replaced(bytes, "POINTS 8", "POINTS 9"));
}

}  // namespace

std::vector<Row> vtk_rows() {
  Rows rows(".vtk");
  add_vtk_legal(&rows);
  add_vtk_text_refusals(&rows);
  add_vtk_binary_refusals(&rows);
  return rows.rows();
}

}  // namespace vex::tests
