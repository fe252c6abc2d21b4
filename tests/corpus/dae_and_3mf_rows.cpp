// .dae and .3mf: files of XML, that state their unit.
#include "corpus.h"
#include "meshes/data/archives.h"
#include "writers.h"

namespace vex::tests {
namespace {

Solid scaled_box(double factor) {
  Solid solid = box();
  for (Vec3d& p : solid.points) p = factor * p;
  solid.measures.volume *= factor * factor * factor;
  solid.measures.surface_area *= factor * factor;
  solid.measures.integrated_mean_curvature *= factor;
  return solid;
}

Solid scene_moved_box(const Vec3d& by) {
  Solid solid = box();
  for (Vec3d& p : solid.points) p = p + by;
  return solid;
}

std::string dae_with_unit(const char* name, const char* metres) {
  return replaced(dae_text(box()), "<up_axis>",
                  std::string("<unit name=\"") + name + "\" meter=\"" + metres + "\"/><up_axis>");
}
std::string dae_with_node(const std::string& transform) {
  return replaced(dae_text(box()), "<instance_geometry", transform + "<instance_geometry");
}

void add_scene_dae(Rows* rows) {
  const Solid body = box();
  const std::string text = dae_text(body);
  rows->is("plain", text, body);
  rows->is("fault 7, centimetres stay as they stand", dae_with_unit("centimeter", "0.01"), body).has_unit("cm");
  rows->is("millimetres stay as they stand", dae_with_unit("millimeter", "0.001"), body).has_unit("mm");
  rows->is("inches stay as they stand", dae_with_unit("inch", "0.0254"), body).has_unit("in");
  rows->is("metres", dae_with_unit("meter", "1"), body).has_unit("m");
  rows->is("centimetres converted to millimetres", dae_with_unit("centimeter", "0.01"), scaled_box(10))
      .converted_to("mm")
      .has_unit("mm")
      .within(1e-14, 1e-12);
  rows->is("metres converted to millimetres", dae_with_unit("meter", "1"), scaled_box(1000))
      .converted_to("mm")
      .has_unit("mm")
      .within(1e-11, 1e-12);
  rows->is("centimetres converted to centimetres", dae_with_unit("centimeter", "0.01"), body)
      .converted_to("cm")
      .has_unit("cm");
  rows->is("another axis upward is not turned", replaced(text, "Z_UP", "Y_UP"), body);
  rows->is("line ends of DOS", with_crlf(text), body);
  rows->is(
      "comments",
      replaced(text, "<library_geometries>", "<!-- <unit name=\"inch\" meter=\"0.0254\"/> --><library_geometries>"),
      body);
  rows->is("a polygon of twelve corners", dae_text(twelve_prism()), twelve_prism());
  rows->is("a node that moves", dae_with_node("<translate>1 2 4</translate>"), scene_moved_box({1, 2, 4}));
  rows->is("fault 8, a node far off", dae_with_node("<translate>1000000 0 0</translate>"),
           scene_moved_box({1e6, 0, 0}));
  rows->is("a node that scales", dae_with_node("<scale>2 2 2</scale>"), scaled_box(2));
  rows->is("a node with a matrix", dae_with_node("<matrix>1 0 0 1 0 1 0 2 0 0 1 4 0 0 0 1</matrix>"),
           scene_moved_box({1, 2, 4}));
  rows->is("inside out", dae_text(inside_out(body)), body).notes_that("inside out");
  rows->is("coplanar vertices", dae_text(cut_box(2)), body).drops(26 - 8);
  rows->no_body("a unit that does not exist", text, {"furlong"}).converted_to("furlong");
  for (const char* token : {"half", "1x", "0x1", "1.0D+01", "0,5"}) {
    rows->refused(std::string("the coordinate ") + token, replaced(text, "0.5 -1 2", token + std::string(" -1 2")));
  }
  for (const char* token : {"nan", "1e400"}) {
    rows->no_body(std::string("the coordinate ") + token, replaced(text, "0.5 -1 2", token + std::string(" -1 2")));
  }
  rows->no_body("a matrix that divides", dae_with_node("<matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 2</matrix>"),
                {"last row 0, 0, 0, 2"});
  rows->refused("a scale of four numbers", dae_with_node("<scale>2 2 2 9</scale>"), {"4 numbers", "expected 3"});
  rows->refused("a matrix of seventeen numbers", dae_with_node("<matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1 5</matrix>"),
                {"17 numbers", "expected 16"});
  const std::string absent = "what a node shows is not in the file";
  rows->refused("a geometry that is not there", dae_with_node("<instance_geometry url=\"#nope\"/>"), {absent, "#nope"});
  rows->refused("a node that is not there", dae_with_node("<instance_node url=\"#nope\"/>"), {absent});
  rows->refused("a node of another file", dae_with_node("<instance_node url=\"other.dae#n\"/>"), {absent});
  const auto library = [&](const std::string& nodes) {
    return replaced(dae_with_node("<instance_node url=\"#in\"/>"), "<library_geometries>",
                    "<library_nodes>" + nodes + "</library_nodes><library_geometries>");
  };
  rows->refused("a node within a node of a library", library("<node id=\"out\"><node id=\"in\"/></node>"), {absent});
  rows->refused("a node of that name", library("<node id=\"out\" name=\"in\"/>"), {absent});
  rows->refused("two nodes of one id", library("<node id=\"in\"/><node id=\"in\"/>"), {absent});
  for (const char* turn : {"0 0 2 90", "1 1 0 30", "0.577 0.577 0.577 30"}) {
    rows->refused("an axis of another length, " + std::string(turn),
                  dae_with_node("<rotate>" + std::string(turn) + "</rotate>"), {"not of length 1", "<rotate>"});
  }
  rows->refused("two geometries of one id",
                replaced(text, "<library_geometries>", "<library_geometries><geometry id=\"g\"/>"),
                {"two geometries have the same id"});
  rows->refused("a missing coordinate", replaced(text, "0.5 -1 2", "0.5 -1"));
  rows->refused("cut within the points", up_to(text, "</float_array>"));
  rows->refused("cut within the corners", up_to(text, "</p></polylist>"));
  rows->refused("an index beyond the points", replaced(text, "<p>0 ", "<p>99 "));
  rows->refused("no points", replaced(text, "source=\"#p\"", "source=\"#q\""));
  rows->refused("no XML", "Dear reader,\nthis is no mesh.\n");
  rows->refused("an empty file", "", {"is empty"});
  rows->refused("a page of the web", html_text(), {"web page"});
  rows->refused("a STEP file", step_text(), {"STEP"});
}

void add_scene_3mf(std::vector<Row>* all) {
  Rows rows(".3mf");
  const Solid body = box();
  const std::string model = threemf_model(body);
  const std::string item = "<item objectid=\"1\"/>";
  const std::pair<std::string, std::string> picture{"Metadata/thumbnail.png",
                                                    "\x89PNG\r\n\x1A\n" + std::string(200, 'x')};
  rows.is("plain", threemf(body), body).has_unit("mm");
  rows.is("fault 5, with a thumbnail", threemf_of(model, false, {picture}), body);
  rows.is("fault 5, with a thumbnail, deflated", threemf_of(model, true, {picture}), body);
  rows.is("deflated", threemf_of(model, true), body);
  rows.is("fault 7, inches", threemf_of(replaced(model, "millimeter", "inch")), body).has_unit("in");
  rows.is("metres converted to millimetres", threemf_of(replaced(model, "millimeter", "meter")), scaled_box(1000))
      .converted_to("mm")
      .has_unit("mm")
      .within(1e-11, 1e-12);
  rows.is("no unit said is millimetres", threemf_of(replaced(model, " unit=\"millimeter\"", "")), body).has_unit("mm");
  rows.is("line ends of DOS", threemf_of(with_crlf(model)), body);
  rows.is("a prism", threemf(twelve_prism()), twelve_prism());
  rows.is("inside out", threemf(inside_out(body)), body).notes_that("inside out");
  rows.is("an item that moves",
          threemf_of(replaced(model, item, "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1 2 4\"/>")),
          scene_moved_box({1, 2, 4}));
  rows.is("a component that moves",
          threemf_of(replaced(replaced(model, "</resources>",
                                       "<object id=\"2\" type=\"model\"><components><component objectid=\"1\" "
                                       "transform=\"1 0 0 0 1 0 0 0 1 1 2 4\"/></components></object></resources>"),
                              item, "<item objectid=\"2\"/>")),
          scene_moved_box({1, 2, 4}));
  rows.refused("no archive", "Dear reader,\nthis is no mesh.\n");
  rows.refused("cut", without_last(threemf(body), 300));
  rows.refused("an archive without a model", zipped({{"readme.txt", "nothing"}}));
  rows.no_body("a model cut short", threemf_of(up_to(model, "</vertices>")));
  rows.no_body("an index beyond the points", threemf_of(replaced(model, "v1=\"0\"", "v1=\"99\"")));
  for (const char* token : {"half", "1x", "0x1", "1.0D+01", "0,5"}) {
    rows.refused(std::string("the coordinate ") + token,
                 threemf_of(replaced(model, "x=\"0.5\"", "x=\"" + std::string(token) + "\"")));
  }
  for (const char* token : {"nan", "1e400"}) {
    rows.no_body(std::string("the coordinate ") + token,
                 threemf_of(replaced(model, "x=\"0.5\"", "x=\"" + std::string(token) + "\"")));
  }
  rows.refused("an empty coordinate", threemf_of(replaced(model, "x=\"0.5\"", "x=\"\"")));
  rows.refused("no x", threemf_of(without(model, "x=\"0.5\" ")));
  rows.no_body("an index that is no number", threemf_of(replaced(model, "v1=\"0\"", "v1=\"0x\"")));
  rows.refused("an empty file", "", {"is empty"});
  rows.refused("a STEP file", step_text());
  all->insert(all->end(), rows.rows().begin(), rows.rows().end());
}

}  // namespace

std::vector<Row> dae_and_3mf_rows() {
  Rows dae(".dae");
  add_scene_dae(&dae);
  std::vector<Row> all = dae.rows();
  add_scene_3mf(&all);
  return all;
}

}  // namespace vex::tests
