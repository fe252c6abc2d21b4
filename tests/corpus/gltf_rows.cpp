// .gltf and .glb.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

Solid gltf_moved_box(const Vec3d& by) {
  Solid solid = box();
  for (Vec3d& p : solid.points) p = p + by;
  return solid;
}

void add_gltf_buffers(Rows* rows) {
  const Solid body = box();
  const std::string buffer = gltf_buffer(body);
  rows->is("embedded", gltf_embedded(body), body);
  rows->is("with a buffer beside it", gltf_text(body, {.uri = "body.bin"}), body).with_file("body.bin", buffer);
  rows->is("fault 12, a buffer's name with %20", gltf_text(body, {.uri = "two%20words.bin"}), body)
      .with_file("two words.bin", buffer);
  rows->is("a buffer's name with a blank", gltf_text(body, {.uri = "two words.bin"}), body)
      .with_file("two words.bin", buffer);
  rows->is("a buffer's name with other escapes", gltf_text(body, {.uri = "W%C3%BCrfel%2B1.bin"}), body)
      .with_file("W\xC3\xBCrfel+1.bin", buffer);
  rows->is("a buffer longer than needed", gltf_text(body, {.uri = "body.bin"}), body)
      .with_file("body.bin", buffer + std::string(10, 'x'));
  rows->is("a name with blanks", gltf_embedded(body), body).named("a body of two words.gltf");
  rows->is("line ends of DOS", with_crlf(gltf_embedded(body)), body);
  rows->is("indices of 16 bits", gltf_embedded(body, {.short_indices = true}), body);
  rows->is("words that tell nothing of geometry",
           replaced(gltf_embedded(body), "\"scene\": 0", "\"extras\": {\"a\": [1, null, true]}, \"scene\": 0"), body);
  rows->is("no scene", without(gltf_embedded(body), "\"scene\": 0, "), body);
  rows->is("a prism", gltf_embedded(twelve_prism()), twelve_prism());
  rows->is("inside out", gltf_embedded(inside_out(body)), body).notes_that("inside out");
  rows->is("coplanar vertices", gltf_embedded(cut_box(2)), body).drops(26 - 8);
  rows->is("a point that no face uses, and the hull", gltf_embedded(with_point(body, far_point())), box_with_roof())
      .hull();
}

void add_gltf_nodes(Rows* rows) {
  const Solid body = box();
  const auto with_nodes = [&](const char* nodes) { return gltf_embedded(body, {.nodes = nodes}); };
  rows->is("fault 8, a node far off", with_nodes(R"([{"mesh": 0, "translation": [1000000, 0, -1000000]}])"),
           gltf_moved_box({1e6, 0, -1e6}));
  rows->is("fault 8, a node that no float places", with_nodes(R"([{"mesh": 0, "translation": [16777216, 0, 0]}])"),
           gltf_moved_box({16777216, 0, 0}));
  rows->is("nodes in nodes",
           with_nodes(R"([{"translation": [0.5, 0, 0], "children": [1]}, {"mesh": 0, "translation": [0.5, 2, 0]}])"),
           gltf_moved_box({1, 2, 0}));
  Solid twice = body;
  for (Vec3d& p : twice.points) p = 2.0 * p;
  twice.measures = {8 * body.measures.volume, 4 * body.measures.surface_area,
                    2 * body.measures.integrated_mean_curvature};
  rows->is("a node with a scale", with_nodes(R"([{"mesh": 0, "scale": [2, 2, 2]}])"), twice);
  Solid turned = body;  // a quarter about x: y to z
  for (Vec3d& p : turned.points) p = {p.x, -p.z, p.y};
  rows->is("a node with a matrix", with_nodes(R"([{"mesh": 0, "matrix": [1,0,0,0, 0,0,1,0, 0,-1,0,0, 0,0,0,1]}])"),
           turned);
  rows->is("a node with a turn",
           with_nodes(R"([{"mesh": 0, "rotation": [0.70710678118654752, 0, 0, 0.70710678118654752]}])"), turned)
      .within(1e-5, 1e-5);
  Solid mirrored = body;
  for (Vec3d& p : mirrored.points) p.x = -p.x;
  rows->is("a node that mirrors", with_nodes(R"([{"mesh": 0, "scale": [-1, 1, 1]}])"), mirrored);
  rows->no_body("a mesh shown twice, apart",
                with_nodes(R"([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "translation": [9, 0, 0]}])"));
  rows->no_body("a node of no extent", with_nodes(R"([{"mesh": 0, "scale": [1, 0, 1]}])"));
}

void add_gltf_glb(std::vector<Row>* all) {
  Rows rows(".glb");
  const Solid body = box();
  const std::string bytes = glb(body);
  rows.is("plain", bytes, body);
  rows.is("a prism", glb(twelve_prism()), twelve_prism());
  rows.is(
      "indices of 16 bits",
      glb_of(gltf_text(twelve_prism(), {.short_indices = true}), gltf_buffer(twelve_prism(), {.short_indices = true})),
      twelve_prism());
  rows.is("an extension in capitals", bytes, body).named("BODY.GLB");
  rows.refused("cut within the buffer", without_last(bytes, 50));
  rows.refused("cut within the JSON", bytes.substr(0, 100));
  rows.refused("cut within the heading", bytes.substr(0, 10));
  rows.refused("another first word", replaced(bytes, "glTF", "glTX"));
  rows.refused("fault 12, glTF 1", with_byte(bytes, 4, 1), {"glTF 1"});
  rows.refused("an empty file", "", {"is empty"});
  rows.refused("a STEP file", step_text());
  rows.refused("a .gltf file", gltf_embedded(body));
  all->insert(all->end(), rows.rows().begin(), rows.rows().end());
}

void add_gltf_refusals(Rows* rows) {
  const Solid body = box();
  const std::string text = gltf_embedded(body);
  rows->refused("fault 12, glTF 1",
                "{\"asset\": {\"version\": \"1.0\"}, \"scene\": \"s\", \"scenes\": {\"s\": {\"nodes\": [\"n\"]}}, "
                "\"nodes\": {\"n\": {\"meshes\": [\"m\"]}}, \"meshes\": {\"m\": {\"primitives\": []}}}\n",
                {"glTF 1"});
  rows->refused("a byte-order mark, which JSON has not", with_bom(text));
  rows->refused("cut within the JSON", up_to(text, "\"bufferViews\""));
  rows->refused("cut within the buffer", text.substr(0, text.size() - 200));
  rows->refused("the buffer is missing", gltf_text(body, {.uri = "body.bin"}), {"body.bin"});
  rows->refused("the buffer is too short", gltf_text(body, {.uri = "body.bin"}))
      .with_file("body.bin", gltf_buffer(body).substr(0, 100));
  rows->refused("the buffer is a folder higher", gltf_text(body, {.uri = "../body.bin"}));
  rows->refused("more points announced than there are", replaced(text, "\"count\": 8", "\"count\": 80000"));
  rows->refused("more corners announced than there are", replaced(text, "\"count\": 36", "\"count\": 36000"));
  // assimp would take the bytes for floats, of 16-bit positions and of pairs, and for what is no index.
  const std::string no_floats = "positions are no 32-bit floats in threes";
  rows->refused("positions of 16 bits", replaced(text, "\"componentType\": 5126", "\"componentType\": 5123"),
                {no_floats, "POSITION, accessor '0'"});
  rows->refused("positions in pairs", replaced(text, "\"VEC3\"", "\"VEC2\""), {no_floats});
  rows->refused("indices that are floats", replaced(text, "\"componentType\": 5125", "\"componentType\": 5126"),
                {no_floats, "indices, accessor '1'"});
  rows->refused("positions of an accessor that is not there", replaced(text, "\"POSITION\": 0", "\"POSITION\": 7"),
                {no_floats, "POSITION, accessor '7'"});
  // Escapes in names are what they mean.
  rows->refused("positions of 16 bits behind an escape",
                replaced(replaced(text, "\"componentType\": 5126", "\"componentType\": 5123"), "\"POSITION\"",
                         "\"\\u0050OSITION\""),
                {no_floats});
  rows->is("a name with an escape", replaced(text, "\"POSITION\"", "\"\\u0050OSITION\""), body);
  rows->refused("positions that begin within a number",
                replaced(text, "\"componentType\": 5126", "\"byteOffset\": 2, \"componentType\": 5126"), {"POSITION"});
  rows->refused("positions that end beyond their part of the buffer",
                replaced(text, "\"componentType\": 5126", "\"byteOffset\": 4, \"componentType\": 5126"), {"POSITION"});
  rows->refused("a rotation that stretches",
                gltf_embedded(body, {.nodes = R"([{"mesh": 0, "rotation": [0.5, 0, 0, 0]}])"}), {"length is not 1"});
  // assimp passes over a list of another length.
  const auto refused_node = [&](const char* name, const char* member, const char* fragment) {
    rows->refused(name, gltf_embedded(body, {.nodes = "[{\"mesh\": 0, " + std::string(member) + "}]"}), {fragment});
  };
  refused_node("a scale of two numbers", "\"scale\": [2, 2]", "scale that is not 3 numbers");
  refused_node("a scale of four numbers", "\"scale\": [2, 2, 2, 2]", "scale that is not 3 numbers");
  refused_node("a scale that is one number", "\"scale\": 2", "scale that is not 3 numbers");
  refused_node("a scale of words", R"("scale": ["2", 2, 2])", "scale that is not 3 numbers");
  refused_node("a rotation of three numbers", "\"rotation\": [0, 0, 1]", "rotation that is not 4 numbers");
  refused_node("a quaternion in four digits", "\"rotation\": [0, 0, 0.7071, 0.7071]", "length is not 1");
  refused_node("a matrix of four numbers", "\"matrix\": [2, 0, 0, 0]", "matrix that is not 16 numbers");
  refused_node("a matrix and a scale", "\"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], \"scale\": [2, 2, 2]",
               "a matrix and parts of one");
  rows->no_body("a matrix that divides",
                gltf_embedded(body, {.nodes = R"([{"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2]}])"}),
                {"last row 0, 0, 0, 2"});
  Solid wrong = body;
  wrong.faces[2][1] = 8;
  rows->no_body("an index beyond the points", gltf_embedded(wrong));
  Solid not_finite = body;
  not_finite.points[3].y = std::nan("");
  std::string json = gltf_text(body, {.uri = "body.bin"});
  rows->no_body("NaN", json).with_file("body.bin", gltf_buffer(not_finite));
  rows->refused("no meshes", "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": []}]}\n").names_the_file =
      false;
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("braces only", "{}");
  rows->refused("a STEP file", step_text());
  rows->refused("a page of the web", html_text());
  rows->refused("a folder", "").as_folder();
}

}  // namespace

std::vector<Row> gltf_rows() {
  Rows rows(".gltf");
  add_gltf_buffers(&rows);
  add_gltf_nodes(&rows);
  add_gltf_refusals(&rows);
  std::vector<Row> all = rows.rows();
  add_gltf_glb(&all);
  return all;
}

}  // namespace vex::tests
