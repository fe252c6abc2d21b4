// "-": what comes through standard input, told its format.
#include "corpus.h"
#include "meshes/data/archives.h"
#include "writers.h"

namespace vex::tests {

std::vector<Row> standard_input_rows() {
  Rows rows(".obj", "standard input");
  const Solid body = five_prism();
  rows.is("obj", obj_text(body), body).from_stdin().read_as(".obj");
  rows.is("off", off_text(body), body).from_stdin().read_as(".off");
  rows.is("ply, binary", ply_binary(body, Order::big), body).from_stdin().read_as(".ply");
  rows.is("stl, binary", stl_binary(body), body).from_stdin().read_as(".stl");
  rows.is("vtk, binary", vtk_binary(body), body).from_stdin().read_as(".vtk");
  rows.is("msh, binary", msh41_binary(body, Order::little), body).from_stdin().read_as(".msh");
  rows.is("points", csv_text(body), body).from_stdin().read_as(".csv").hull();
  rows.is("gzipped", gzipped(obj_text(body)), body).from_stdin().read_as(".obj.gz");
  rows.no_body("a wrong number", replaced(obj_text(box()), "v 0.5 1 2", "v 1x 1 2"), {"'1x'", "line 3"})
      .from_stdin()
      .read_as(".obj");
  rows.no_body("nothing", "").from_stdin().read_as(".obj");
  rows.no_body("no format told", obj_text(body), {"format"}).from_stdin();
  rows.no_body("a format of others", glb(body)).from_stdin().read_as(".glb");
  return rows.rows();
}

}  // namespace vex::tests
