// .obj: what is legal.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Eight lines "v 0.5 -1 2" ... "v 1.5 1 5", six lines "f 1 2 4 3", "f 5 7 8 6", "f 1 5 6 2", "f 3 4 8 7", "f 1 3 7 5",
// "f 2 6 8 4".
std::string obj_box() { return obj_text(box()); }
std::string box_points() { return point_lines(box(), "v "); }

/// The box's faces, each corner followed by what `behind` says, which may hold # for the corner's number.
std::string faces_with(const std::string& behind) {
  std::string lines;
  for (const Face& face : box().faces) {
    lines += "f";
    for (const std::uint32_t corner : face) {
      const std::string number = std::to_string(corner + 1);
      lines += " " + number + (behind.find('#') == std::string::npos ? behind : replaced_all(behind, "#", number));
    }
    lines += "\n";
  }
  return lines;
}

std::string texture_lines() {
  std::string lines;
  for (int i = 0; i < 8; ++i) lines += "vt 0." + std::to_string(i) + " 0.25\n";
  return lines;
}
std::string normal_lines() {
  std::string lines;
  for (int i = 0; i < 8; ++i) lines += "vn 0 " + std::to_string(i) + " 1\n";
  return lines;
}

/// Corners counted back from the last vertex.
std::string negative_faces() {
  std::string lines;
  for (const Face& face : box().faces) {
    lines += "f";
    for (const std::uint32_t corner : face) lines += " -" + std::to_string(8 - corner);
    lines += "\n";
  }
  return lines;
}

/// Each face behind vertices of its own, which it names as the last ones.
std::string vertices_among_faces() {
  std::string text;
  for (const Face& face : box().faces) {
    for (const std::uint32_t corner : face) {
      text += "v " + up_to(point_lines({{box().points[corner]}, {}, {}, {}}), "\n") + "\n";
    }
    text += "f -4 -3 -2 -1\n";
  }
  return text;
}

void add_obj_text_forms(Rows* rows) {
  const Solid body = box();
  const std::string text = obj_box();
  rows->is("plain", text, body).has_digits(CoordinateDigits::Kind::doubles);
  rows->is("line ends of DOS", with_crlf(text), body);
  rows->is("line ends of old Macs", with_cr(text), body);
  rows->is("fault 12, a byte-order mark", with_bom(text), body);
  rows->is("a byte-order mark before a comment", with_bom("# made by hand\n" + text), body);
  rows->is("fault 12, indented by blanks", with_at_every_line_start(text, "   "), body);
  rows->is("indented by tabs", with_at_every_line_start(text, "\t"), body);
  rows->is("tabs between words", replaced_all(text, " ", "\t"), body);
  rows->is("several blanks between words", replaced_all(text, " ", "  \t "), body);
  rows->is("blanks at the ends of lines", with_at_every_line_end(text, " \t "), body);
  rows->is("blank lines", "\n\n" + with_line_behind_every(text, "") + "  \n", body);
  rows->is("comment lines", "# made by hand\n" + with_line_behind_every(text, "  # v 9 9 9"), body);
  rows->is("fault 12, a comment behind every line", with_at_every_line_end(text, " # v 9 9 9"), body);
  rows->is("a comment without a blank before it", with_at_every_line_end(text, "# comment"), body);
  rows->is("letters beyond ASCII in a comment", "# W\xC3\xBCrfel \xE7\n" + text, body);
  rows->is("no final newline", without_final_newline(text), body);
  rows->is("a name with blanks", text, body).named("a body of two words.obj");
  rows->is("an extension in capitals", text, body).named("BODY.OBJ");
  rows->is("another extension, and told the format", text, body).named("body.dat").read_as(".obj");
  rows->is("a wrong extension, and told the format", text, body).named("body.stl").read_as(".obj");
}

void add_obj_numbers(Rows* rows) {
  const Solid body = box();
  const std::string text = obj_box();
  rows->is("exponents", obj_text(body, as_printed("%.3e")), body);
  rows->is("exponents in capitals", obj_text(body, as_printed("%.1E")), body);
  rows->is("exponents without a sign", replaced_all(text, "v 0.5", "v 5e-1"), body);
  rows->is("an exponent with a plus", replaced_all(text, "v 0.5", "v 0.005e+2"), body);
  rows->is("signs before all numbers", obj_text(body, as_printed("%+.2f")), body);
  rows->is("no digit before the point", replaced_all(text, " 0.5", " .5"), body);
  rows->is("a plus and no digit before the point", replaced_all(text, " 0.5", " +.5"), body);
  rows->is("no digit behind the point", replaced_all(text, "1 5\n", "1. 5.\n"), body);
  rows->is("zeros in front", replaced_all(text, "1 5\n", "0001 05\n"), body);
  rows->is("zeros at the end", obj_text(body, as_printed("%.30f")), body);
  rows->is("numbers of seventeen digits", obj_text(icosahedron(), as_printed("%.17g")), icosahedron())
      .has_digits(CoordinateDigits::Kind::doubles);
  rows->is("numbers of nineteen digits", obj_text(icosahedron(), as_printed("%.18e")), icosahedron());
  const std::string faces = "v 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  rows->is("minus zero", "v -0 -0.0 -0e5\n" + faces, corner(1, 2, 3));
  rows->is("numbers too small for a double are zero", "v 1e-400 -1e-500 0\n" + faces, corner(1, 2, 3));
}

void add_obj_elements(Rows* rows) {
  const Solid body = box();
  const std::string text = obj_box();
  rows->is("texture coordinates", box_points() + texture_lines() + faces_with("/#"), body);
  rows->is("normals", box_points() + normal_lines() + faces_with("//#"), body);
  rows->is("texture coordinates and normals", box_points() + texture_lines() + normal_lines() + faces_with("/#/#"),
           body);
  rows->is("fault 12, texture coordinates that are not there", box_points() + faces_with("/#"), body);
  rows->is("normals that are not there", box_points() + faces_with("//7"), body);
  rows->is("a slash and no number behind it", box_points() + faces_with("/"), body);
  rows->is("two slashes and no number behind them", box_points() + faces_with("//"), body);
  rows->is("negative indices", box_points() + negative_faces(), body);
  rows->is("negative indices of all kinds", box_points() + texture_lines() + normal_lines() + faces_with("/-1/-2"),
           body);
  rows->is("vertices among faces, named from behind", vertices_among_faces(), body);
  rows->is("a line that goes on", replaced(text, "f 1 2 4 3", "f 1 2 \\\n4 3"), body);
  rows->is("a vertex that goes on", replaced(text, "v 0.5 -1 2", "v 0.5 \\\n-1 \\\n2"), body);
  rows->is("lines that go on, with line ends of DOS", with_crlf(replaced(text, "f 1 2 4 3", "f 1 2 \\\n4 3")), body);
  rows->is("colours of vertices", with_at_every_line_end(box_points(), " 1 0 0.5") + faces_with(""), body);
  rows->is("a weight of 1", replaced_all(text, "1 5\n", "1 5 1.0\n"), body);
  rows->is("materials, groups and names",
           "mtllib none.mtl\no box\n" + replaced(text, "f 1", "g side front\nusemtl red paint\ns off\nf 1") +
               "usemtl blue\ns 1\n",
           body);
  rows->is("empty groups", "g\ng empty\n" + replaced(text, "f 5", "g\no\ng other\nf 5") + "g last\n", body);
  rows->is("two objects that are one body", "o lower\n" + replaced(text, "f 1 3 7 5", "o upper\nf 1 3 7 5"), body);
  rows->is("points and lines beside faces", text + "p 1 2\nl 1 2 3\n", body).notes_that("points or lines");
  rows->is("a vertex that no face uses", obj_text(with_point(body, far_point())), body);
  rows->is("fault 10, a vertex that no face uses, and the hull", obj_text(with_point(body, far_point())),
           box_with_roof())
      .hull();
  rows->is("an open surface and the hull", obj_text(with_hole(body)), body).hull();
  rows->is("points alone and the hull", box_points(), body).hull();
  rows->is("a dent and the hull", obj_text(dented_box(0.5)), body).hull();
  rows->is("a face whose corners are two", text + "f 1 1 2\n", body).notes_that("dropped");
  rows->is("a corner named twice running", replaced(text, "f 1 2 4 3", "f 1 2 2 4 3"), body);
  rows->is("every corner a vertex of its own", obj_text(with_own_corners(body)), body);
  rows->is("inside out", obj_text(inside_out(body)), body).notes_that("inside out");
  rows->is("faces of five corners", obj_text(five_prism()), five_prism());
  rows->is("faces of twelve corners", obj_text(twelve_prism()), twelve_prism());
  rows->is("triangles", obj_text(triangulated(twelve_prism())), twelve_prism());
  rows->is("fault 11, coplanar vertices", obj_text(cut_box(4)), body).drops(98 - 8);
  rows->is("fault 11, coplanar vertices of many triangles", obj_text(triangulated(cut_box(16))), body).drops(1538 - 8);
}

}  // namespace

std::vector<Row> obj_rows() {
  Rows rows(".obj");
  add_obj_text_forms(&rows);
  add_obj_numbers(&rows);
  add_obj_elements(&rows);
  return rows.rows();
}

}  // namespace vex::tests
