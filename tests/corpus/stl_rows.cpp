// .stl: text and binary.
#include <limits>

#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Line 1 "solid body"; twelve times seven lines "facet normal", "outer loop", three of "vertex", "endloop", "endfacet"
// from line 2 on; "endsolid body".
std::string stl_box() { return stl_text(box()); }

void add_stl_text(Rows* rows) {
  const Solid body = box();
  const std::string text = stl_box();
  rows->is("plain", text, body);
  rows->is("line ends of DOS", with_crlf(text), body);
  rows->is("line ends of old Macs", with_cr(text), body);
  rows->is("a byte-order mark", with_bom(text), body);
  rows->is("no final newline", without_final_newline(text), body);
  rows->is("in capitals", in_upper_case(text), body);
  rows->is("a capital first", replaced(text, "solid", "Solid"), body);
  rows->is("not indented", replaced_all(text, "  ", ""), body);
  rows->is("tabs", replaced_all(text, "  ", "\t"), body);
  rows->is("blank lines", "\n  \n" + with_line_behind_every(text, " "), body);
  rows->is("blanks at the ends of lines", with_at_every_line_end(text, " "), body);
  rows->is("no name", replaced_all(text, "solid body", "solid"), body);
  rows->is("a name of several words", replaced_all(text, "solid body", "solid a body of facet and vertex"), body);
  rows->is("another name at the end", replaced_last(text, "endsolid body", "endsolid another"), body);
  rows->is("two solids that are one body",
           replaced(text, "  facet normal 0 0 0\n    outer loop\n      vertex 1.5 -1 2",
                    "endsolid body\n\nsolid rest\n  facet normal 0 0 0\n    outer loop\n      vertex 1.5 -1 2"),
           body);
  rows->is("an empty solid in front", "solid none\nendsolid none\n" + text, body);
  rows->is("wrong normals", replaced_all(text, "normal 0 0 0", "normal -1e5 0.5 .25"), body);
  rows->is("normals that are no numbers", replaced_all(text, "normal 0 0 0", "normal nan nan -nan(ind)"), body);
  rows->is("exponents", stl_text(body, as_printed("%.6e")), body);
  rows->is("exponents in capitals and signs", stl_text(body, as_printed("%+.2E")), body);
  rows->is("no digit before the point", replaced_all(text, "0.5 ", ".5 "), body);
  rows->is("fault 9, noise for zero", replaced(stl_text(corner(1, 2, 3)), "vertex 0 0 0", "vertex 5e-17 -3e-17 0"),
           corner(1, 2, 3))
      .within(1e-16, 1e-12);
  rows->is("noise for zero, and a wide weld",
           replaced(stl_text(corner(1, 2, 3)), "vertex 0 0 0", "vertex 5e-7 -3e-7 0"), corner(1, 2, 3))
      .within(1e-6, 1e-5)
      .welded_within(1e-6);
  rows->no_body("noise beyond all rounding", replaced(stl_text(corner(1, 2, 3)), "vertex 0 0 0", "vertex 1e-3 0 0"));
  rows->is("a facet of two corners",
           with_line_behind(text, 1,
                            "facet normal 0 0 0\nouter loop\nvertex 0.5 -1 2\n"
                            "vertex 0.5 -1 2\nvertex 0.5 -1 5\nendloop\nendfacet"),
           body)
      .notes_that("dropped");
  rows->is("inside out", stl_text(inside_out(body)), body).notes_that("inside out");
  rows->is("prisms over polygons", stl_text(twelve_prism()), twelve_prism());
  rows->is("coplanar vertices", stl_text(cut_box(2)), body).drops(26 - 8);
}

void add_stl_binary(Rows* rows) {
  const Solid body = box();
  const std::string bytes = stl_binary(body);
  rows->is("binary", bytes, body).has_digits(CoordinateDigits::Kind::floats);
  rows->is("binary, its heading begins with solid", stl_binary(body, "solid body\n"), body);
  rows->is("binary, its heading begins with solid and facet", stl_binary(body, "solid body\nfacet normal 0 0 0\n"),
           body);
  rows->is("binary, its heading begins in capitals", stl_binary(body, "SOLID BODY"), body);
  rows->is("binary, a heading of zeros", stl_binary(body, std::string(80, '\0')), body);
  rows->is("binary, a heading with a colour", stl_binary(body, "COLOR=\x01\x02\x03\x04,MATERIAL="), body);
  rows->is("fault 12, binary with trailing bytes", bytes + std::string(7, 'x'), body);
  rows->is("binary with trailing zeros", bytes + std::string(100, '\0'), body);
  rows->is("binary with one trailing line end", bytes + "\n", body);
  rows->is("binary, solid and a trailing byte", stl_binary(body, "solid body") + "\n", body);
  rows->is("binary with attributes", with_byte(with_byte(bytes, 84 + 48, 0xFF), 84 + 49, 0x7F), body);
  std::string normals = bytes;
  for (std::size_t at = 84; at < normals.size(); at += 50) normals.replace(at, 4, "\xFF\xFF\xFF\xFF");
  rows->is("binary with normals that are no numbers", normals, body);
  rows->is("binary, inside out", stl_binary(inside_out(body)), body).notes_that("inside out");
  rows->is("binary, the hull of an open surface", stl_binary(with_hole(triangulated(body))), body).hull();
  rows->is("binary, a body of many triangles", stl_binary(twelve_prism()), twelve_prism());
}

void add_stl_text_refusals(Rows* rows) {
  const std::string text = stl_box();
  for (const char* token : {"1.0D+01", "1x", "0x1", "1,5", "nan", "inf", "1e400"}) {
    rows->refused(std::string("the coordinate ") + token, with_line(text, 5, "vertex " + std::string(token) + " -1 5"),
                  {token, "line 5"});
  }
  rows->refused("two coordinates", with_line(text, 5, "vertex 0.5 -1"), {"line 6"});
  rows->refused("four coordinates", with_line(text, 5, "vertex 0.5 -1 5 1"), {"line 5"});
  rows->refused("a facet of two vertices", without_line(text, 5));
  rows->no_body("a facet of four vertices", with_line_behind(text, 5, "vertex 0.5 0 5"), {"not closed"});
  rows->refused("no end of a loop", without_line(text, 7));
  rows->refused("no end of a facet", without_line(text, 8));
  rows->refused("no beginning of a loop", without_line(text, 3));
  rows->refused("a vertex outside", with_line_behind(text, 1, "vertex 0 0 0"), {"line 2"});
  rows->refused("a word of no kind", with_line_behind(text, 1, "face normal 0 0 0"), {"line 2"});
  rows->refused("cut within a facet", up_to_last(text, "vertex"));
  rows->refused("cut within a number", up_to_last(text, "\n    endloop"));
  rows->refused("cut before the end", up_to_last(text, "endsolid"));
  rows->no_body("a facet is missing", up_to_last(text, "  facet") + "endsolid\n", {"not closed"});
  rows->refused("the first line only", "solid body\n");
  rows->no_body("an empty solid", "solid body\nendsolid body\n");
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("a folder", "", {"folder"}).as_folder();
  rows->refused("a page of the web", html_text(), {"web page"});
  rows->refused("a STEP file", step_text());
  rows->refused("an .obj file", obj_text(box()));
}

void add_stl_binary_refusals(Rows* rows) {
  const std::string bytes = stl_binary(box());
  const auto with = [&](auto value, std::size_t at) {
    std::string raw;
    put(value, Order::little, &raw);
    return std::string(bytes).replace(at, raw.size(), raw);
  };
  rows->refused("binary, NaN", with(std::numeric_limits<float>::quiet_NaN(), 84 + 50 + 12));
  rows->refused("binary, infinite", with(std::numeric_limits<float>::infinity(), 84 + 50 + 40));
  rows->refused("binary, more triangles announced than there are", with(std::uint32_t{13}, 80));
  rows->refused("binary, more triangles announced than any memory holds", with(std::uint32_t{0xFFFFFFFF}, 80));
  rows->refused("binary, no triangles announced", with(std::uint32_t{0}, 80));
  rows->refused("binary, one byte short", without_last(bytes, 1));
  rows->refused("binary, cut within a triangle", without_last(bytes, 30));
  rows->refused("binary, cut behind a triangle", without_last(bytes, 50));
  rows->refused("binary, cut within the heading", bytes.substr(0, 60));
  rows->refused("binary, cut behind the heading", bytes.substr(0, 80));
  rows->refused("binary, cut within the count", bytes.substr(0, 82));
  rows->refused("binary, no triangle of those announced", bytes.substr(0, 84));
  rows->refused("binary, its heading begins with solid, cut", without_last(stl_binary(box(), "solid body\n"), 30));
}

}  // namespace

std::vector<Row> stl_rows() {
  Rows rows(".stl");
  add_stl_text(&rows);
  add_stl_binary(&rows);
  add_stl_text_refusals(&rows);
  add_stl_binary_refusals(&rows);
  return rows.rows();
}

}  // namespace vex::tests
