// .ply: what is refused.
#include <limits>

#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Lines as in ply_rows.cpp: points from line 10 on, faces from line 18 on.
std::string wrong_ply_box() { return ply_text(box()); }

void add_wrong_ply_header(Rows* rows) {
  const std::string text = wrong_ply_box();
  rows->refused("another first word", replaced(text, "ply", "plx"), {});
  rows->refused("no format", without_line(text, 2));
  rows->refused("a format of no kind", replaced(text, "ascii", "binary_middle_endian"), {"binary_middle_endian"});
  rows->refused("a format of the future", replaced(text, "1.0", "2.0"), {"2.0"});
  rows->refused("no end of the header", without(text, "end_header\n"));
  rows->refused("a header alone", up_to(text, "0.5"));
  rows->refused("cut within the header", up_to(text, "element face"));
  rows->refused("no count", replaced(text, "element vertex 8", "element vertex"), {"line 3"});
  rows->refused("a count that is no number", replaced(text, "element vertex 8", "element vertex 8x"), {"8x", "line 3"});
  rows->refused("a negative count", replaced(text, "element vertex 8", "element vertex -8"), {"-8", "line 3"});
  rows->refused("a type of no kind", replaced(text, "property double y", "property real y"), {"real", "line 5"});
  rows->refused("no z", without_line(text, 6));
  rows->refused("x twice", replaced(text, "property double y", "property double x"));
  rows->refused("a word of no kind", with_line_behind(text, 2, "elements vertex 8"), {"line 3"});
  rows->refused("vertices twice", replaced(text, "element face", "element vertex 0\nproperty int x\nelement face"));
  rows->refused("a property of no element", with_line_behind(text, 2, "property int a"), {"line 3"});
  rows->refused("a list counted in fractions", replaced(text, "uchar int", "float int"));
  rows->refused("a list of fractions", replaced(text, "uchar int", "uchar float"));
}

void add_wrong_ply_text(Rows* rows) {
  const std::string text = wrong_ply_box();
  for (const char* token : {"1.0D+01", "1x", "0x1", "1,5", "nan", "inf", "1e400"}) {
    rows->refused(std::string("the coordinate ") + token, with_line(text, 12, std::string(token) + " 1 2"),
                  {token, "line 12"});
  }
  rows->refused("two coordinates", with_line(text, 12, "0.5 1"));
  rows->refused("four coordinates", with_line(text, 12, "0.5 1 2 3"));
  rows->refused("more vertices announced than there are", replaced(text, "vertex 8", "vertex 9"));
  rows->refused("fewer vertices announced than there are", replaced(text, "vertex 8", "vertex 7"));
  rows->refused("more faces announced than there are", replaced(text, "face 6", "face 7"));
  rows->refused("fewer faces announced than there are", replaced(text, "face 6", "face 5"));
  rows->refused("more vertices than any memory holds", replaced(text, "vertex 8", "vertex 4000000000000"));
  rows->refused("an index beyond the vertices", with_line(text, 19, "4 4 6 8 5"), {"8", "line 19"});
  rows->refused("a negative index", with_line(text, 19, "4 4 6 -1 5"), {"-1", "line 19"});
  rows->refused("an index with a letter", with_line(text, 19, "4 4 6 7x 5"), {"'7x'", "line 19"});
  rows->refused("a fraction for an index", with_line(text, 19, "4 4 6 7.5 5"), {"'7.5'", "line 19"});
  rows->refused("a face with fewer corners than it says", with_line(text, 19, "4 4 6 7"));
  rows->refused("a face with more corners than it says", with_line(text, 19, "3 4 6 7 5"));
  rows->refused("a face of a negative number of corners", with_line(text, 19, "-4 4 6 7 5"), {"-4", "line 19"});
  rows->refused("cut within the vertices", up_to(text, "1.5 1 5"));
  rows->refused("cut within the faces", up_to(text, "4 1 5 7 3"));
  rows->refused("cut within a face", up_to_last(text, " 7 3"));
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("the first word only", "ply\n");
  rows->refused("a folder", "", {"folder"}).as_folder();
  rows->refused("a STEP file", step_text());
  rows->refused("a page of the web", html_text());
  rows->refused("an .obj file", obj_text(box()));
  rows->no_body("points alone", up_to(replaced(text, "face 6", "face 0"), "4 0 1"), {"--hull"});
}

void add_wrong_ply_binary(Rows* rows) {
  for (const Order order : {Order::little, Order::big}) {
    const std::string label = order == Order::little ? ", little endian" : ", big endian";
    const std::string bytes = ply_binary(box(), order);
    const std::size_t header = up_to(bytes, "end_header\n").size() + 11;
    const std::size_t faces = header + 12 * 8;
    const auto with = [&](auto value, std::size_t at) {
      std::string raw;
      put(value, order, &raw);
      return std::string(bytes).replace(at, raw.size(), raw);
    };
    rows->refused("the coordinate NaN" + label, with(std::numeric_limits<float>::quiet_NaN(), header + 12));
    rows->refused("an infinite coordinate" + label, with(-std::numeric_limits<float>::infinity(), header + 20));
    rows->refused("an index beyond the vertices" + label, with(std::int32_t{8}, faces + 5));
    rows->refused("a negative index" + label, with(std::int32_t{-1}, faces + 5));
    rows->refused("a face of 255 corners" + label, with_byte(bytes, faces, 255));
    rows->refused("cut within the vertices" + label, bytes.substr(0, header + 50));
    rows->refused("cut behind the vertices" + label, bytes.substr(0, faces));
    rows->refused("cut within the faces" + label, without_last(bytes, 20));
    rows->refused("one byte short" + label, without_last(bytes, 1));
    rows->refused("more vertices announced than there are" + label, replaced(bytes, "vertex 8", "vertex 9"));
    rows->refused("fewer vertices announced than there are" + label, replaced(bytes, "vertex 8", "vertex 7"));
    rows->refused("more vertices than any memory holds" + label, replaced(bytes, "vertex 8", "vertex 4000000000"));
    rows->refused("fewer faces announced than there are" + label, replaced(bytes, "face 6", "face 5"));
    rows->refused("the other byte order announced" + label,
                  order == Order::little ? replaced(bytes, "little", "big") : replaced(bytes, "big", "little"));
    rows->refused("binary, and text announced" + label,
                  replaced(bytes, order == Order::little ? "binary_little_endian" : "binary_big_endian", "ascii"));
    rows->refused(
        "text, and binary announced" + label,
        replaced(wrong_ply_box(), "ascii", order == Order::little ? "binary_little_endian" : "binary_big_endian"));
  }
}

}  // namespace

std::vector<Row> ply_refusals() {
  Rows rows(".ply");
  add_wrong_ply_header(&rows);
  add_wrong_ply_text(&rows);
  add_wrong_ply_binary(&rows);
  return rows.rows();
}

}  // namespace vex::tests
