// The same bodies, and the same that are none, in every format.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {

std::vector<Row> every_format_rows() {
  std::vector<Row> all;
  for (const Writer& writer : writers()) {
    Rows rows(std::string(writer.extension), std::string(writer.name) + " like every format");
    const auto is = [&](const char* name, const Solid& solid) { rows.is(name, writer.bytes(solid), solid); };
    const auto none = [&](const char* name, const Solid& solid, const char* why) {
      rows.no_body(name, writer.bytes(solid), {why});
    };
    is("a box", box());
    is("a tetrahedron", tetrahedron());
    is("an octahedron", octahedron());
    is("a wedge", wedge());
    is("a prism over five corners", five_prism());
    is("a box of triangles", triangulated(box()));
    is("a box inside out", inside_out(box()));
    none("a hole", with_hole(triangulated(box())), "not closed");
    none("a flipped face", with_flipped_face(triangulated(box())), "oriented");
    none("two boxes", two_boxes(), "not one body");
    none("a torus", torus(), "sphere");
    none("a dent", dented_box(0.0078125), "not convex");
    none("a flat box", flat_box(), "");
    rows.is("a hole and the hull", writer.bytes(with_hole(triangulated(octahedron()))), octahedron()).hull();
    rows.is("a dent and the hull", writer.bytes(dented_box(0.5)), box()).hull();
    rows.no_body("a flat box and the hull", writer.bytes(flat_box()), {"plane"}).hull();
    all.insert(all.end(), rows.rows().begin(), rows.rows().end());
  }
  return all;
}

}  // namespace vex::tests
