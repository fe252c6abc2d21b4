// .obj: what is refused, with the line.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

std::string wrong_obj_box() { return obj_text(box()); }

/// The box, its third line "v 0.5 1 2" with another number for 0.5.
std::string wrong_obj_with_number(const std::string& token) {
  return with_line(wrong_obj_box(), 3, "v " + token + " 1 2");
}
/// The box, its tenth line "f 5 7 8 6" with another word for 7.
std::string with_corner(const std::string& word) { return with_line(wrong_obj_box(), 10, "f 5 " + word + " 8 6"); }

void add_wrong_obj_numbers(Rows* rows) {
  rows->refused("fault 4, an exponent of Fortran", wrong_obj_with_number("1.0D+01"), {"1.0D+01", "line 3"});
  rows->refused("fault 4, a letter behind the number", wrong_obj_with_number("1x"), {"'1x'", "line 3"});
  rows->refused("a hexadecimal number", wrong_obj_with_number("0x1"), {"'0x1'", "line 3"});
  rows->refused("a decimal comma", wrong_obj_with_number("1,5"), {"'1,5'", "line 3"});
  rows->refused("not a number", wrong_obj_with_number("nan"), {"'nan'", "line 3"});
  rows->refused("infinity", wrong_obj_with_number("-inf"), {"'-inf'", "line 3"});
  rows->refused("a number too large for a double", wrong_obj_with_number("1e400"), {"'1e400'", "line 3"});
  rows->refused("an exponent without digits", wrong_obj_with_number("1e"), {"'1e'", "line 3"});
  rows->refused("two signs", wrong_obj_with_number("--1"), {"'--1'", "line 3"});
  rows->refused("two other signs", wrong_obj_with_number("+-1"), {"'+-1'", "line 3"});
  rows->refused("two points", wrong_obj_with_number("1.2.3"), {"'1.2.3'", "line 3"});
  rows->refused("a point alone", wrong_obj_with_number("."), {"'.'", "line 3"});
  rows->refused("a sign alone", wrong_obj_with_number("-"), {"'-'", "line 3"});
  rows->refused("a word for a number", wrong_obj_with_number("one"), {"'one'", "line 3"});
  rows->refused("a minus sign beyond ASCII",
                wrong_obj_with_number("\xE2\x88\x92"
                                      "1"),
                {"line 3"});
  rows->refused("two coordinates", with_line(wrong_obj_box(), 3, "v 0.5 1"), {"line 3"});
  rows->refused("no coordinates", with_line(wrong_obj_box(), 3, "v"), {"line 3"});
  rows->refused("the wrong line with line ends of DOS", with_crlf(wrong_obj_with_number("1x")), {"'1x'", "line 3"});
  rows->refused("the wrong line with line ends of old Macs", with_cr(wrong_obj_with_number("1x")), {"'1x'", "line 3"});
}

void add_wrong_obj_indices(Rows* rows) {
  rows->refused("index 0", with_corner("0"), {"'0'", "line 10"});
  rows->refused("an index beyond the vertices", with_corner("9"), {"9", "line 10"});
  rows->refused("a negative index beyond the vertices", with_corner("-9"), {"-9", "line 10"});
  rows->refused("an index of twenty digits", with_corner("99999999999999999999"), {"99999999999999999999", "line 10"});
  rows->refused("an index beyond 32 bits", with_corner("4294967303"), {"4294967303", "line 10"});
  rows->refused("an index that is no whole number", with_corner("7.0"), {"7.0", "line 10"});
  rows->refused("an index with a letter", with_corner("7x"), {"7x", "line 10"});
  rows->refused("a slash without an index", with_corner("/7"), {"/7", "line 10"});
  rows->refused("a word for an index", with_corner("seven"), {"seven", "line 10"});
  rows->no_body("faces of two corners only", up_to(wrong_obj_box(), "f") + "f 1 2\nf 3 4\n", {"no faces"});
  rows->refused("a face without corners", with_line(wrong_obj_box(), 10, "f"), {"line 10"});
}

void add_wrong_obj_truncated(Rows* rows) {
  rows->no_body("cut within the vertices", up_to(wrong_obj_box(), "v 1.5 1 2"), {"--hull"});
  rows->refused("a vertex is missing", without_line(wrong_obj_box(), 8), {"8"});
  rows->refused("a damaged keyword", with_line(wrong_obj_box(), 3, "V 0.5 1 2"), {"'V'", "line 3"});
  rows->refused("a weight of 2", with_line(wrong_obj_box(), 3, "v 0.5 1 2 2"), {"line 3"});
  rows->refused("cut within a number's line", up_to(wrong_obj_box(), " 2\nv 1.5 1 5"));
  rows->no_body("cut behind the vertices", up_to(wrong_obj_box(), "f"), {"--hull"});
  rows->no_body("cut within the faces", up_to(wrong_obj_box(), "f 1 3 7 5"), {"not closed"});
  rows->no_body("cut within a face's line", up_to_last(wrong_obj_box(), " 8 4"), {"not closed"});
  rows->no_body("cut before a face's last corner", up_to_last(wrong_obj_box(), " 4"), {"not closed"});
}

void add_wrong_obj_no_mesh(Rows* rows) {
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("comments only", "# nothing\n# here\n");
  rows->refused("blank lines only", "\n\n  \n");
  rows->refused("a byte-order mark only", with_bom(""));
  rows->refused("a folder", "", {"folder"}).as_folder();
  rows->refused("a STEP file", step_text(), {"STEP"});
  rows->refused("a page of the web", html_text(), {"web page"});
  rows->refused("zeros", std::string(500, '\0'));
  rows->refused("a text of another kind", "Dear reader,\nthis is no mesh.\n");
  rows->refused("an .stl file", stl_text(box()));
  rows->refused("an .off file", off_text(box()));
  rows->refused("a .ply file", ply_text(box()));
  rows->refused("a binary .stl file", stl_binary(box()));
  rows->refused("an extension that no format has", wrong_obj_box(), {"'.mesh2'"}).named("body.mesh2");
  rows->refused("no extension", wrong_obj_box()).named("body");
  rows->no_body("a unit wanted of a file that states none", wrong_obj_box(), {"unit"}).converted_to("mm");
  rows->no_body("a format that does not exist", wrong_obj_box(), {".xxx"}).read_as(".xxx");
}

}  // namespace

std::vector<Row> obj_refusals() {
  Rows rows(".obj");
  add_wrong_obj_numbers(&rows);
  add_wrong_obj_indices(&rows);
  add_wrong_obj_truncated(&rows);
  add_wrong_obj_no_mesh(&rows);
  return rows.rows();
}

}  // namespace vex::tests
