// .off: Geomview's, as text.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Lines "OFF", "8 6 0", eight points from line 3 on, six faces "4 0 1 3 2" from line 11 on.
std::string off_box() { return off_text(box()); }

/// Line 5, "0.5 1 2", with another number for 0.5.
std::string off_with_number(const std::string& token) { return with_line(off_box(), 5, token + " 1 2"); }

/// `behind` at the end of the lines from `first` to `last`.
std::string with_behind(std::size_t first, std::size_t last, const std::string& behind) {
  std::string text = off_box();
  for (std::size_t i = last; i >= first; --i) text = with_line_behind(text, i, "\x01");
  return replaced_all(text, "\n\x01", behind);
}

void add_off_legal(Rows* rows) {
  const Solid body = box();
  const std::string text = off_box();
  rows->is("plain", text, body);
  rows->is("line ends of DOS", with_crlf(text), body);
  rows->is("line ends of old Macs", with_cr(text), body);
  rows->is("a byte-order mark", with_bom(text), body);
  rows->is("no final newline", without_final_newline(text), body);
  rows->is("indented", with_at_every_line_start(text, " \t"), body);
  rows->is("tabs between words", replaced_all(text, " ", "\t"), body);
  rows->is("blank lines", with_line_behind_every(text, " "), body);
  rows->is("blanks at the ends of lines", with_at_every_line_end(text, "  "), body);
  rows->is("fault 6, comments before the faces", with_line_behind(text, 10, "# the faces"), body);
  rows->is("fault 6, comments among the faces", with_line_behind(text, 13, "# more faces"), body);
  rows->is("fault 6, comments among the vertices", with_line_behind(text, 5, "# more vertices"), body);
  rows->is("comments everywhere", "# made by hand\n" + with_line_behind_every(text, "  # 9 9 9"), body);
  rows->is("comments behind every line", with_at_every_line_end(text, " # 9 9 9"), body);
  rows->is("fault 6, polygons of ten corners and more", off_text(twelve_prism()), twelve_prism());
  rows->is("polygons of five corners", off_text(five_prism()), five_prism());
  rows->is("counts in the first line", replaced(text, "OFF\n", "OFF "), body);
  rows->is("the number of edges", replaced(text, "8 6 0", "8 6 12"), body);
  rows->is("a wrong number of edges", replaced(text, "8 6 0", "8 6 77"), body);
  rows->is("colours of faces, whole numbers", with_behind(11, 16, " 255 0 0"), body);
  rows->is("colours of faces, fractions", with_behind(11, 16, " 0.5 0.25 1.0 0.75"), body);
  rows->is("a colour of faces by its number", with_behind(11, 16, " 3"), body);
  rows->is("colours of vertices", replaced(with_behind(3, 10, " 0.5 0.25 1.0 1.0"), "OFF", "COFF"), body);
  rows->is("colours of vertices, whole numbers", replaced(with_behind(3, 10, " 255 0 0 255"), "OFF", "COFF"), body);
  rows->is("normals of vertices", replaced(with_behind(3, 10, " 0 0 1"), "OFF", "NOFF"), body);
  rows->is("normals and colours", replaced(with_behind(3, 10, " 0 0 1 1 0 0 1"), "OFF", "CNOFF"), body);
  rows->is("texture coordinates", replaced(with_behind(3, 10, " 0.5 0.5"), "OFF", "STOFF"), body);
  rows->is("exponents and signs", off_text(body, as_printed("%+.2e")), body);
  rows->is("no digit before the point", replaced_all(text, "0.5 ", ".5 "), body);
  rows->is("every corner a vertex of its own", off_text(with_own_corners(body)), body);
  rows->is("inside out", off_text(inside_out(body)), body).notes_that("inside out");
  rows->is("a point that no face uses", off_text(with_point(body, far_point())), body);
  rows->is("a point that no face uses, and the hull", off_text(with_point(body, far_point())), box_with_roof()).hull();
  rows->is("points alone and the hull", "OFF\n8 0 0\n" + point_lines(body), body).hull();
  rows->is("coplanar vertices", off_text(cut_box(2)), body).drops(26 - 8);
  rows->is("a face of two corners beside the others", replaced(text, "8 6 0", "8 7 0") + "2 0 1\n", body)
      .notes_that("points or lines");
}

void add_off_refusals(Rows* rows) {
  const std::string text = off_box();
  for (const char* token : {"1.0D+01", "1x", "0x1", "1,5", "nan", "inf", "1e400"}) {
    rows->refused(std::string("the coordinate ") + token, off_with_number(token), {token, "line 5"});
  }
  rows->refused("two coordinates", with_line(text, 5, "0.5 1"), {"line 5"});
  rows->refused("more points announced than there are", replaced(text, "8 6 0", "9 6 0"));
  rows->refused("fewer points announced than there are", replaced(text, "8 6 0", "7 6 0"));
  rows->refused("more faces announced than there are", replaced(text, "8 6 0", "8 7 0"));
  rows->refused("fewer faces announced than there are", replaced(text, "8 6 0", "8 5 0"), {"line 16"});
  rows->refused("a negative number of points", replaced(text, "8 6 0", "-8 6 0"), {"-8", "line 2"});
  rows->refused("a number of points that is no whole number", replaced(text, "8 6 0", "8.5 6 0"), {"8.5", "line 2"});
  rows->refused("more points than any memory holds", replaced(text, "8 6 0", "4000000000 6 0"));
  rows->refused("a number of points beyond 64 bits", replaced(text, "8 6 0", "99999999999999999999 6 0"), {"line 2"});
  rows->refused("an index beyond the points", with_line(text, 12, "4 4 6 8 5"), {"'8'", "line 12"});
  rows->refused("a negative index", with_line(text, 12, "4 4 6 -1 5"), {"'-1'", "line 12"});
  rows->refused("an index with a letter", with_line(text, 12, "4 4 6 7x 5"), {"'7x'", "line 12"});
  rows->refused("a face with fewer corners than it says", with_line(text, 12, "4 4 6 7"), {"line 13"});
  rows->refused("a face of a thousand million corners", with_line(text, 12, "1000000000 4 6 7 5"), {"face 2"});
  rows->refused("a face of a negative number of corners", with_line(text, 12, "-4 4 6 7 5"), {"'-4'", "line 12"});
  rows->refused("cut within the points", up_to(text, "1.5 1 5"));
  rows->refused("cut within the faces", up_to(text, "4 1 5 7 3"));
  rows->refused("cut within a face", up_to(text, " 7 3"));
  rows->refused("cut within the counts", "OFF\n8");
  rows->refused("the first word only", "OFF\n");
  rows->refused("another first word", replaced(text, "OFF", "PFF"));
  rows->refused("a .ply file", ply_text(box()));
  rows->refused("the binary form", replaced(text, "OFF\n", "OFF BINARY\n"));
  rows->refused("four dimensions", replaced(text, "OFF", "4OFF"));
  rows->refused("any dimension", replaced(text, "OFF\n", "nOFF\n3\n"));
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("comments only", "# nothing\n");
  rows->refused("a folder", "", {"folder"}).as_folder();
  rows->refused("a STEP file", step_text());
  rows->no_body("points alone", "OFF\n8 0 0\n" + point_lines(box()), {"--hull"});
}

}  // namespace

std::vector<Row> off_rows() {
  Rows rows(".off");
  add_off_legal(&rows);
  add_off_refusals(&rows);
  return rows.rows();
}

}  // namespace vex::tests
