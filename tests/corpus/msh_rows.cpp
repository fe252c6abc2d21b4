// .msh: Gmsh's, of versions 2.2 and 4.1.
#include <limits>

#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

// Version 2.2, lines: $MeshFormat, 2.2 0 8, $EndMeshFormat, $Nodes, 8, eight nodes "1 0.5 -1 2" from line 6 on,
// $EndNodes, $Elements, 12, twelve triangles "1 2 2 0 1 1 2 4" from line 17 on, $EndElements.
std::string box22() { return msh22_text(box()); }
// Version 4.1, lines: $MeshFormat, 4.1 0 8, $EndMeshFormat, $Nodes, 1 8 1 8, 2 1 0 8, eight tags from line 7 on, eight
// points from line 15 on, $EndNodes, $Elements, 1 12 1 12, 2 1 2 12, twelve triangles "1 1 2 4" from line 27 on.
std::string box41() { return msh41_text(box()); }

/// The box's twelve triangles as six elements of four corners.
std::string quads22() {
  std::string text = up_to(box22(), "$Elements") + "$Elements\n6\n";
  int tag = 0;
  for (const Face& face : box().faces) {
    text += std::to_string(++tag) + " 3 2 0 1";
    for (const std::uint32_t corner : face) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

void add_msh_legal(Rows* rows) {
  const Solid body = box();
  rows->is("2.2, plain", box22(), body);
  rows->is("2.2, line ends of DOS", with_crlf(box22()), body);
  rows->is("2.2, no final newline", without_final_newline(box22()), body);
  rows->is("2.2, four corners", quads22(), body);
  rows->is("2.2, names of groups",
           replaced(box22(), "$Nodes", "$PhysicalNames\n1\n2 1 \"a skin\"\n$EndPhysicalNames\n$Nodes"), body);
  rows->is("2.2, comments", replaced(box22(), "$Nodes", "$Comments\nmade by hand\n$EndComments\n$Nodes"), body);
  rows->is("2.2, data of nodes behind", box22() + "$NodeData\n1\n\"a\"\n1\n0.0\n3\n0\n1\n1\n1 0.5\n$EndNodeData\n",
           body);
  rows->is("2.2, three tags", replaced_all(box22(), " 2 2 0 1 ", " 2 3 0 1 0 "), body);
  rows->is("2.2, no tags", replaced_all(box22(), " 2 2 0 1 ", " 2 0 "), body);
  rows->is("2.2, numbers of nodes with gaps",
           replaced_all(replaced(replaced_all(box22(), " 8", " 800"), "\n8 1.5", "\n800 1.5"), "2.2 0 800", "2.2 0 8"),
           body);
  rows->is("2.2, points and lines beside triangles",
           replaced(box22(), "$Elements\n12\n", "$Elements\n14\n98 15 2 0 1 1\n99 1 2 0 1 1 2\n"), body);
  rows->is("2.2, exponents and signs", msh22_text(body, as_printed("%+.2e")), body);
  rows->is("2.2, inside out", msh22_text(inside_out(body)), body).notes_that("inside out");
  rows->is("2.2, a prism", msh22_text(twelve_prism()), twelve_prism());
  rows->is("2.2, a node that no element uses, and the hull", msh22_text(with_point(body, far_point())), box_with_roof())
      .hull();
  rows->is("4.1, plain", box41(), body);
  rows->is("4.1, line ends of DOS", with_crlf(box41()), body);
  rows->is("4.1, entities before the nodes",
           replaced(box41(), "$Nodes", "$Entities\n0 0 1 0\n1 0.5 -1 2 1.5 1 5 0 0\n$EndEntities\n$Nodes"), body);
  rows->is("4.1, an empty block of nodes", replaced(box41(), "1 8 1 8\n", "2 8 1 8\n0 1 0 0\n"), body);
  const std::string nodes = up_to(box41(), "$Elements");
  rows->is("4.1, numbers of nodes with gaps",
           replaced(replaced(nodes, "1 8 1 8", "1 8 1 800"), "\n8\n", "\n800\n") +
               replaced_all(box41().substr(nodes.size()), " 8", " 800"),
           body);
  rows->is("4.1, a prism", msh41_text(twelve_prism()), twelve_prism());
  rows->is("4.1, a node that no element uses, and the hull", msh41_text(with_point(body, far_point())), box_with_roof())
      .hull();
}

void add_msh_text_refusals(Rows* rows) {
  for (const char* token : {"1.0D+01", "1x", "0x1", "1,5", "nan", "inf", "1e400"}) {
    const std::string number = token;
    rows->refused("2.2, the coordinate " + number, with_line(box22(), 8, "3 " + number + " 1 2"), {token, "line 8"});
    rows->refused("4.1, the coordinate " + number, with_line(box41(), 17, number + " 1 2"), {token, "line 17"});
  }
  rows->refused("2.2, more nodes announced than there are", with_line(box22(), 5, "9"));
  rows->refused("2.2, fewer nodes announced than there are", with_line(box22(), 5, "7"));
  rows->refused("2.2, more nodes than any memory holds", with_line(box22(), 5, "4000000000000"));
  rows->refused("2.2, more elements announced than there are", with_line(box22(), 16, "13"));
  rows->refused("2.2, fewer elements announced than there are", with_line(box22(), 16, "11"));
  rows->refused("2.2, a node that is not there", with_line(box22(), 18, "2 2 2 0 1 1 4 99"), {"99"});
  rows->refused("2.2, a byte-order mark", with_bom(box22()));
  rows->refused("2.2, node 0", with_line(box22(), 18, "2 2 2 0 1 1 4 0"), {"0", "line 18"});
  rows->refused("2.2, a node twice", with_line(box22(), 8, "2 0.5 1 2"), {"2"});
  rows->refused("2.2, a missing node of an element", with_line(box22(), 18, "2 2 2 0 1 1 4"), {"line 18"});
  rows->refused("2.2, an element of no kind", with_line(box22(), 18, "2 777 2 0 1 1 4 3"), {"777"});
  rows->refused("2.2, curved triangles", with_line(box22(), 18, "2 9 2 0 1 1 4 3 1 4 3"), {"line 18"});
  rows->refused("2.2, cut within the nodes", up_to(box22(), "8 1.5 1 5"));
  rows->no_body("2.2, cut behind the nodes", up_to(box22(), "$Elements"));
  rows->refused("2.2, cut within the elements", up_to_last(box22(), "12 2 2"));
  rows->refused("2.2, cut before the end of the elements", up_to(box22(), "$EndElements"));
  rows->refused("4.1, more nodes announced than there are", with_line(box41(), 6, "2 1 0 9"));
  rows->refused("4.1, sums that do not hold", with_line(box41(), 5, "1 9 1 9"));
  rows->refused("4.1, fewer elements announced than there are", with_line(box41(), 26, "2 1 2 11"));
  rows->refused("4.1, a node that is not there", with_line(box41(), 28, "2 1 4 99"), {"99"});
  rows->refused("4.1, a node twice", with_line(box41(), 8, "1"));
  rows->refused("4.1, cut within the nodes", up_to(box41(), "1.5 1 5"));
  rows->refused("4.1, cut within the elements", up_to_last(box41(), "12 "));
  rows->refused("no format", box22().substr(up_to(box22(), "$Nodes").size()));
  rows->refused("version 1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n0\n$ENDELM\n");
  rows->refused("version 3", replaced(box22(), "2.2 0 8", "3 0 8"), {"3"});
  rows->refused("a version of the future", replaced(box41(), "4.1 0 8", "5.0 0 8"), {"5.0"});
  rows->refused("fault 12, a mesh of Medit", medit_text(), {"Medit"});
  rows->refused("fault 12, a mesh of Medit by its own extension", medit_text(), {"Medit"}).named("body.mesh");
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("a STEP file", step_text());
  rows->refused("a folder", "").as_folder();
}

void add_msh_binary_refusals(Rows* rows) {
  for (const Order order : {Order::little, Order::big}) {
    const std::string label = order == Order::little ? ", little endian" : ", big endian";
    std::string nan;
    put(std::numeric_limits<double>::quiet_NaN(), order, &nan);
    for (const auto& [version, bytes] : {std::pair{std::string("2.2"), msh22_binary(box(), order)},
                                         std::pair{std::string("4.1"), msh41_binary(box(), order)}}) {
      const std::string name = version + " binary";
      const std::size_t one = up_to(bytes, "8\n").size() + 2;  // the number that tells the byte order
      const std::size_t nodes_end = up_to(bytes, "\n$EndNodes").size();
      rows->refused(name + ", NaN" + label, std::string(bytes).replace(nodes_end - 8, 8, nan));
      rows->refused(name + ", a byte order of no kind" + label, with_byte(bytes, one + 1, 7));
      std::string other;
      put(std::int32_t{1}, order == Order::little ? Order::big : Order::little, &other);
      rows->refused(name + ", the other byte order" + label, std::string(bytes).replace(one, 4, other));
      rows->refused(name + ", cut within the nodes" + label, bytes.substr(0, nodes_end - 30));
      rows->refused(name + ", cut within the elements" + label,
                    up_to(bytes, "\n$EndElements").substr(0, bytes.size() - 40));
      rows->refused(name + ", and text announced" + label, replaced(bytes, version + " 1 8", version + " 0 8"));
    }
  }
  rows->refused("text, and binary announced", replaced(box22(), "2.2 0 8", "2.2 1 8"));
}

}  // namespace

std::vector<Row> msh_rows() {
  Rows rows(".msh");
  add_msh_legal(&rows);
  add_msh_text_refusals(&rows);
  add_msh_binary_refusals(&rows);
  return rows.rows();
}

}  // namespace vex::tests
