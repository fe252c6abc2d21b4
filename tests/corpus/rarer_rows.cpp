// .x3d, .nff and .ifc: what assimp reads besides, and what it would make polyhedra of.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

std::string x3d_of(const std::string& scene) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<X3D profile=\"Interchange\" version=\"3.3\"><Scene>" + scene +
         "</Scene></X3D>\n";
}

std::string x3d_shape(const Solid& solid) {
  std::string text = "<Shape><IndexedFaceSet coordIndex=\"";
  for (const Face& face : solid.faces) {
    for (const std::uint32_t corner : face) text += std::to_string(corner) + " ";
    text += "-1 ";
  }
  return text + "\"><Coordinate point=\"" + point_lines(solid) + "\"/></IndexedFaceSet></Shape>";
}

std::string nff_text(const Solid& solid) {
  std::string text;
  for (const Face& face : solid.faces) {
    text += "p " + std::to_string(face.size()) + "\n";
    for (const std::uint32_t corner : face) {
      const Vec3d& p = solid.points[corner];
      text += shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
    }
  }
  return text;
}

void add_x3d(std::vector<Row>* all) {
  Rows rows(".x3d");
  const Solid body = box();
  const std::string shape = x3d_shape(body), text = x3d_of(shape);
  rows.is("plain", text, body);
  rows.is("commas behind numbers", replaced(text, "0.5 -1 2", "0.5, -1, 2,"), body);
  const std::string curved = "a curved body";
  rows.refused("a ball", x3d_of("<Shape><Sphere radius=\"1\"/></Shape>"), {curved, "Sphere"});
  rows.refused("a cylinder", x3d_of("<Shape><Cylinder radius=\"1\" height=\"2\"/></Shape>"), {curved}).hull();
  rows.refused("a cone", x3d_of("<Shape><Cone bottomRadius=\"1\" height=\"2\"/></Shape>"), {curved}).hull();
  rows.refused("a prototype", x3d_of(shape + "<ProtoInstance name=\"k\"/>"), {"parts that are not read"});
  rows.refused("levels of detail", x3d_of(shape + "<LOD>" + shape + "</LOD>"), {"parts that are not read"});
  rows.refused("patches", x3d_of(shape + "<Shape><NurbsPatchSurface/></Shape>"), {"parts that are not read"});
  for (const char* node : {"Anchor", "CADPart", "Billboard"}) {
    const std::string name = node;
    rows.refused("a part in " + name, x3d_of(shape + "<" + name + ">" + shape + "</" + name + ">"),
                 {"parts that are not read", node});
  }
  rows.refused("quadrangles", x3d_of(shape + "<Shape><QuadSet/></Shape>"), {"parts that are not read"});
  rows.refused("a unit", replaced(text, "<Scene>", "<unit category=\"length\" conversionFactor=\"0.01\"/><Scene>"),
               {"states a unit"});
  const auto turned = [&](const char* rotation) {
    return x3d_of("<Transform rotation=\"" + std::string(rotation) + "\">" + shape + "</Transform>");
  };
  rows.refused("an axis of two lengths", turned("0 0 2 0.7"), {"not of length 1", "rotation of <Transform>"});
  rows.refused("an axis in three digits", turned("0.577 0.577 0.577 1"), {"not of length 1"});
  rows.is("no turn", turned("0 0 0 0"), body);
  for (const char* token : {"half", "0.5x", "0x1", "5.0D-01", "0,5", "nan"}) {
    rows.refused(std::string("the coordinate ") + token, replaced(text, "0.5 -1 2", token + std::string(" -1 2")),
                 {"is not a decimal number", "point of <Coordinate>"});
  }
  rows.refused("a scale that is no number", x3d_of("<Transform scale=\"2,2,2\">" + shape + "</Transform>"),
               {"scale of <Transform>"});
  all->insert(all->end(), rows.rows().begin(), rows.rows().end());
}

void add_nff(std::vector<Row>* all) {
  Rows rows(".nff");
  const Solid body = box();
  rows.is("plain", nff_text(body), body);
  const std::string curved = "a curved body";
  rows.refused("a ball", "s 0 0 0 1\n", {curved, "line 1"});
  rows.refused("a ball behind a body", nff_text(body) + "  s 0 0 0 1\n", {curved}).hull();
  rows.refused("a cylinder", "c\n0 0 0 1\n0 0 2 1\n", {curved}).hull();
  all->insert(all->end(), rows.rows().begin(), rows.rows().end());
}

void add_ifc(std::vector<Row>* all) {
  Rows rows(".ifc");
  rows.refused("a circle", "ISO-10303-21;\nDATA;\n#1=IFCCIRCLEPROFILEDEF(.AREA.,$,#2,1.);\nENDSEC;\n",
               {"a curved body"});
  all->insert(all->end(), rows.rows().begin(), rows.rows().end());
}

}  // namespace

std::vector<Row> rarer_rows() {
  std::vector<Row> all;
  add_x3d(&all);
  add_nff(&all);
  add_ifc(&all);
  return all;
}

}  // namespace vex::tests
