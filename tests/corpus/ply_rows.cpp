// .ply: what is legal, as text and binary.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Lines: ply, format, element vertex 8, three properties, element face 6, its list, end_header, eight points from line
// 10 on, six faces from line 18 on.
std::string ply_box() { return ply_text(box()); }

const char* format_of(Order order) { return order == Order::little ? "binary_little_endian" : "binary_big_endian"; }

/// The four points, as a last line without its end.
std::string four_points() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
         "0 0 0\n1 0 0\n0 1.25 0\n0 0 1";
}

/// The text without its faces.
std::string without_faces(const std::string& text) {
  return without(up_to(text, "4 0 1"), "element face 6\nproperty list uchar int vertex_indices\n");
}

void add_ply_text_forms(Rows* rows) {
  const Solid body = box();
  const std::string text = ply_box();
  rows->is("plain", text, body);
  rows->is("a byte-order mark", with_bom(text), body);
  rows->is("line ends of DOS", with_crlf(text), body);
  rows->is("line ends of old Macs", with_cr(text), body);
  rows->is("comments", with_line_behind(with_line_behind(text, 2, "comment made by hand"), 7, "comment faces"), body);
  rows->is("words about the object", with_line_behind(text, 2, "obj_info num_cols 512"), body);
  rows->is("no final newline", without_final_newline(text), body);
  rows->is("fault 1, no final newline behind the points", four_points(), corner(1, 1.25, 1)).hull();
  rows->is("a final newline behind the points", four_points() + "\n", corner(1, 1.25, 1)).hull();
  rows->is("tabs between numbers", up_to(text, "0.5") + replaced_all(text.substr(up_to(text, "0.5").size()), " ", "\t"),
           body);
  rows->is("blanks at the ends of lines",
           up_to(text, "0.5") + with_at_every_line_end(text.substr(up_to(text, "0.5").size()), "  "), body);
  rows->is("exponents and signs", ply_text(body, as_printed("%+.2e")), body);
  rows->is("no digit before the point", replaced_all(text, "\n0.5 ", "\n.5 "), body);
  for (const char* type : {"float", "float32", "float64"}) {
    rows->is(std::string("coordinates of ") + type, replaced_all(text, "double", type), body);
  }
  rows->is("coordinates of whole numbers", replaced_all(ply_text(whole_wedge()), "double", "short"), whole_wedge());
  rows->is("vertex_index", replaced(text, "vertex_indices", "vertex_index"), body);
  for (const char* types : {"uint8 int32", "int int", "ushort uint", "uchar short", "char uchar", "uint32 uint16"}) {
    rows->is(std::string("lists of ") + types, replaced(text, "uchar int", types), body);
  }
  rows->is("polygons of five corners", ply_text(five_prism()), five_prism());
  rows->is("polygons of twelve corners", ply_text(twelve_prism()), twelve_prism());
  rows->is("triangles", ply_text(triangulated(body)), body);
  rows->is("every corner a vertex of its own", ply_text(with_own_corners(body)), body);
  rows->is("inside out", ply_text(inside_out(body)), body).notes_that("inside out");
  rows->is("coplanar vertices", ply_text(cut_box(2)), body).drops(26 - 8);
  rows->is("a point that no face uses", ply_text(with_point(body, far_point())), body);
  rows->is("a point that no face uses, and the hull", ply_text(with_point(body, far_point())), box_with_roof()).hull();
}

void add_ply_elements(Rows* rows) {
  const Solid body = box();
  const std::string text = ply_box();
  const std::string points = point_lines(body);
  const std::string faces = text.substr(up_to(text, "end_header\n").size() + 11 + points.size());
  const std::string camera = "element camera 1\nproperty float view_px\nproperty float view_py\n";
  rows->is("fault 3, a camera before the vertices",
           replaced(replaced(text, "element vertex", camera + "element vertex"), "end_header\n", "end_header\n7 8\n"),
           body);
  rows->is("a camera behind the faces", replaced(text, "end_header", camera + "end_header") + "7 8\n", body);
  rows->is("faces before the vertices",
           "ply\nformat ascii 1.0\nelement face 6\nproperty list uchar int vertex_indices\nelement vertex 8\n"
           "property float x\nproperty float y\nproperty float z\nend_header\n" +
               faces + points,
           body);
  rows->is("normals and colours behind the coordinates",
           replaced(up_to(text, "0.5"), "element face", "property float nx\nproperty uchar red\nelement face") +
               with_at_every_line_end(points, " 0.5 255") + faces,
           body);
  rows->is("a property before the coordinates",
           replaced(up_to(text, "0.5"), "property double x", "property int id\nproperty double x") +
               with_at_every_line_start(points, "77 ") + faces,
           body);
  rows->is("a list of each vertex",
           replaced(up_to(text, "0.5"), "element face", "property list uchar float weights\nelement face") +
               with_at_every_line_end(points, " 2 0.5 0.5") + faces,
           body);
  rows->is("coordinates in another order",
           replaced(up_to(text, "0.5"), "x\nproperty double y\nproperty double z",
                    "z\nproperty double x\nproperty double y") +
               point_lines([&] {
                 Solid turned = body;
                 for (Vec3d& p : turned.points) p = {p.z, p.x, p.y};
                 return turned;
               }()) +
               faces,
           body);
  rows->is("properties of faces before and behind the list",
           replaced(replaced(up_to(text, "0.5"), "property list", "property uchar flags\nproperty list"), "end_header",
                    "property list uchar float texcoord\nproperty int part\nend_header") +
               points + with_at_every_line_end(with_at_every_line_start(faces, "1 "), " 2 0.5 0.25 9"),
           body);
  rows->is("edges",
           replaced(text, "end_header", "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header") +
               "0 1\n1 2\n",
           body);
  rows->is("an element without members",
           replaced(text, "element vertex", "element camera 0\nproperty int a\nelement vertex"), body);
  rows->is("points alone and the hull", without_faces(text), body).hull();
}

template <class Coordinate, class Count, class Index>
void add_ply_binary(Rows* rows, const std::string& type, const std::string& lists, const Solid& body) {
  for (const Order order : {Order::little, Order::big}) {
    rows->is(std::string(order == Order::little ? "little" : "big") + " endian, " + type + ", lists of " + lists,
             ply_header(body, format_of(order), type, lists) + ply_data<Coordinate, Count, Index>(body, order), body);
  }
}

void add_ply_binary_forms(Rows* rows) {
  const Solid body = box();
  const Solid whole = whole_wedge();
  add_ply_binary<float, std::uint8_t, std::int32_t>(rows, "float", "uchar int", body);
  add_ply_binary<double, std::uint8_t, std::uint32_t>(rows, "double", "uint8 uint32", body);
  add_ply_binary<float, std::int32_t, std::uint16_t>(rows, "float32", "int ushort", body);
  add_ply_binary<double, std::uint16_t, std::int8_t>(rows, "float64", "ushort char", twelve_prism());
  add_ply_binary<std::int16_t, std::int8_t, std::uint8_t>(rows, "short", "char uchar", whole);
  add_ply_binary<std::uint8_t, std::uint32_t, std::int16_t>(rows, "uchar", "uint short", whole);
  add_ply_binary<std::int32_t, std::uint8_t, std::uint8_t>(rows, "int32", "uint8 uint8", whole);
  for (const Order order : {Order::little, Order::big}) {
    const std::string label = order == Order::little ? ", little endian" : ", big endian";
    const std::string bytes = ply_binary(body, order);
    const std::size_t header = up_to(bytes, "end_header\n").size() + 11;
    rows->is("a header with line ends of DOS" + label, with_crlf(bytes.substr(0, header)) + bytes.substr(header), body);
    rows->is("a header with line ends of old Macs" + label, with_cr(bytes.substr(0, header)) + bytes.substr(header),
             body);
    rows->is("a comment in the header" + label,
             with_line_behind(bytes.substr(0, header), 2, "comment x") + bytes.substr(header), body);
    // A first byte of data that is a line end.
    for (const unsigned first : {0x0AU, 0x0DU, 0x20U}) {
      const std::string name = printed("%.0f", first);
      rows->is((first == 0x0A ? "fault 2, a first byte of data of " : "a first byte of data of ") + name + label,
               replaced(bytes.substr(0, header), "property float x", "property uchar flags\nproperty float x") +
                   [&] {
                     std::string data;
                     for (std::size_t i = 0; i < body.points.size(); ++i) {
                       data += static_cast<char>(first);
                       data += bytes.substr(header + 12 * i, 12);
                     }
                     return data + bytes.substr(header + 12 * body.points.size());
                   }(),
               body);
    }
    rows->is("fault 3, a camera before the vertices" + label,
             replaced(bytes.substr(0, header), "element vertex", "element camera 1\nproperty uchar a\nelement vertex") +
                 "\x07" + bytes.substr(header),
             body);
    rows->is("points alone and the hull" + label,
             without(bytes.substr(0, header), "element face 6\nproperty list uchar int vertex_indices\n") +
                 bytes.substr(header, 12 * body.points.size()),
             body)
        .hull();
  }
}

}  // namespace

std::vector<Row> ply_rows() {
  Rows rows(".ply");
  add_ply_text_forms(&rows);
  add_ply_elements(&rows);
  add_ply_binary_forms(&rows);
  return rows.rows();
}

}  // namespace vex::tests
