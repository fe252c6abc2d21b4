#include "meshes/data/archives.h"
#include "writers.h"

namespace vex::tests {
namespace {

std::string point(const Vec3d& p, const Number& number, const char* separator = " ") {
  return number(p.x) + separator + number(p.y) + separator + number(p.z);
}

/// "PREFIX [size] a b c" for each face.
std::string face_lines(const Solid& solid, const std::string& prefix, bool with_size, std::uint32_t first) {
  std::string lines;
  for (const Face& face : solid.faces) {
    std::string line = prefix + (with_size ? std::to_string(face.size()) : "");
    for (const std::uint32_t corner : face) line += (line.empty() ? "" : " ") + std::to_string(corner + first);
    lines += line + "\n";
  }
  return lines;
}

std::size_t n_corners(const Solid& solid) {
  std::size_t n = 0;
  for (const Face& face : solid.faces) n += face.size();
  return n;
}

std::string vtk_heading(const Solid& solid, const char* version) {
  return std::string("# vtk DataFile Version ") + version + "\na body\nASCII\nDATASET POLYDATA\nPOINTS " +
         std::to_string(solid.points.size()) + " double\n";
}

}  // namespace

Number as_printed(const char* format) {
  return [format](double value) { return printed(format, value); };
}

std::string point_lines(const Solid& solid, const char* prefix, const Number& number) {
  std::string lines;
  for (const Vec3d& p : solid.points) lines += prefix + point(p, number) + "\n";
  return lines;
}

std::string obj_text(const Solid& solid, const Number& number) {
  return point_lines(solid, "v ", number) + face_lines(solid, "f", false, 1);
}

std::string off_text(const Solid& solid, const Number& number) {
  return "OFF\n" + std::to_string(solid.points.size()) + " " + std::to_string(solid.faces.size()) + " 0\n" +
         point_lines(solid, "", number) + face_lines(solid, "", true, 0);
}

std::string ply_header(const Solid& solid, const std::string& format, const std::string& type,
                       const std::string& lists) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(solid.points.size()) + "\nproperty " +
         type + " x\nproperty " + type + " y\nproperty " + type + " z\nelement face " +
         std::to_string(solid.faces.size()) + "\nproperty list " + lists + " vertex_indices\nend_header\n";
}

std::string ply_text(const Solid& solid, const Number& number) {
  return ply_header(solid, "ascii", "double") + point_lines(solid, "", number) + face_lines(solid, "", true, 0);
}

std::string stl_text(const Solid& solid, const Number& number) {
  std::string text = "solid body\n";
  for (const Face& face : triangulated(solid).faces) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::uint32_t corner : face) text += "      vertex " + point(solid.points[corner], number) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid body\n";
}

std::string csv_text(const Solid& solid, const char* separator) {
  std::string text;
  for (const Vec3d& p : solid.points) text += point(p, shortest, separator) + "\n";
  return text;
}

std::string vtk_text(const Solid& solid, const Number& number) {
  return vtk_heading(solid, "3.0") + point_lines(solid, "", number) + "POLYGONS " + std::to_string(solid.faces.size()) +
         " " + std::to_string(n_corners(solid) + solid.faces.size()) + "\n" + face_lines(solid, "", true, 0);
}

std::string vtk51_text(const Solid& solid) {
  std::string offsets = "0";
  std::size_t end = 0;
  for (const Face& face : solid.faces) offsets += " " + std::to_string(end += face.size());
  return vtk_heading(solid, "5.1") + point_lines(solid) + "POLYGONS " + std::to_string(solid.faces.size() + 1) + " " +
         std::to_string(end) + "\nOFFSETS vtktypeint64\n" + offsets + "\nCONNECTIVITY vtktypeint64\n" +
         face_lines(solid, "", false, 0);
}

std::string msh22_text(const Solid& solid, const Number& number) {
  const Solid body = triangulated(solid);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(body.points.size()) + "\n";
  std::uint32_t tag = 0;
  for (const Vec3d& p : body.points) text += std::to_string(++tag) + " " + point(p, number) + "\n";
  text += "$EndNodes\n$Elements\n" + std::to_string(body.faces.size()) + "\n";
  tag = 0;
  for (const Face& face : body.faces) {  // number, kind, two tags
    text += std::to_string(++tag) + " 2 2 0 1";
    for (const std::uint32_t corner : face) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

std::string msh41_text(const Solid& solid, const Number& number) {
  const Solid body = triangulated(solid);
  const std::string n_points = std::to_string(body.points.size());
  const std::string n_faces = std::to_string(body.faces.size());
  std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " + n_points + " 1 " + n_points + "\n2 1 0 " + n_points + "\n";
  for (std::size_t i = 1; i <= body.points.size(); ++i) text += std::to_string(i) + "\n";
  text += point_lines(body, "", number) + "$EndNodes\n$Elements\n1 " + n_faces + " 1 " + n_faces + "\n2 1 2 " +
          n_faces + "\n";
  std::uint32_t tag = 0;
  for (const Face& face : body.faces) {
    text += std::to_string(++tag);
    for (const std::uint32_t corner : face) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

std::string dae_text(const Solid& solid, const Number& number) {
  std::string sizes;
  std::string corners;
  for (const Face& face : solid.faces) {
    sizes += std::to_string(face.size()) + " ";
    for (const std::uint32_t corner : face) corners += std::to_string(corner) + " ";
  }
  const std::string n_points = std::to_string(solid.points.size());
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
         "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n<asset>"
         "<up_axis>Z_UP</up_axis></asset>\n<library_geometries><geometry id=\"g\"><mesh>\n<source id=\"p\">"
         "<float_array id=\"a\" count=\"" +
         std::to_string(3 * solid.points.size()) + "\">\n" + point_lines(solid, "", number) +
         "</float_array><technique_common><accessor source=\"#a\" count=\"" + n_points +
         "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n<polylist count=\"" +
         std::to_string(solid.faces.size()) + "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\n<vcount>" +
         sizes + "</vcount>\n<p>" + corners +
         "</p></polylist></mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id=\"s\">"
         "<node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>\n"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

std::string threemf_model(const Solid& solid, const Number& number) {
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources><object id=\"1\" "
      "type=\"model\"><mesh><vertices>\n";
  for (const Vec3d& p : solid.points) {
    xml += "<vertex x=\"" + number(p.x) + "\" y=\"" + number(p.y) + "\" z=\"" + number(p.z) + "\"/>\n";
  }
  xml += "</vertices><triangles>\n";
  for (const Face& face : triangulated(solid).faces) {
    xml += "<triangle v1=\"" + std::to_string(face[0]) + "\" v2=\"" + std::to_string(face[1]) + "\" v3=\"" +
           std::to_string(face[2]) + "\"/>\n";
  }
  return xml + "</triangles></mesh></object></resources>\n<build><item objectid=\"1\"/></build></model>\n";
}

std::string threemf_of(const std::string& model, bool deflated,
                       const std::vector<std::pair<std::string, std::string>>& extra) {
  const std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const std::string package = "http://schemas.openxmlformats.org/package/2006/";
  std::vector<std::pair<std::string, std::string>> files{
      {"[Content_Types].xml",
       xml + "<Types xmlns=\"" + package +
           "content-types\"><Default Extension=\"rels\" "
           "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"model\" "
           "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/><Default Extension=\"png\" "
           "ContentType=\"image/png\"/></Types>\n"},
      {"_rels/.rels", xml + "<Relationships xmlns=\"" + package +
                          "relationships\"><Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
                          "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>" +
                          (extra.empty() ? ""
                                         : "<Relationship Target=\"/" + extra.front().first + "\" Id=\"rel1\" Type=\"" +
                                               package + "relationships/metadata/thumbnail\"/>") +
                          "</Relationships>\n"},
      {"3D/3dmodel.model", model}};
  files.insert(files.end(), extra.begin(), extra.end());
  return zipped(files, deflated);
}

std::string threemf(const Solid& solid) { return threemf_of(threemf_model(solid)); }

}  // namespace vex::tests
