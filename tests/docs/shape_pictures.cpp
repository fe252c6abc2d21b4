#include "tests/docs/shape_pictures.h"

#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"
#include "tests/docs/outline.h"
#include "tests/docs/picture.h"
#include "tests/docs/sampled_hull.h"

namespace vex {
namespace {

Vec3d across(double right, double up) { return right * picture_right() + up * picture_up(); }

// The edge of the outline that lies farthest in a direction of the picture, labelled on its outer side.
Dimension outer_edge(const ConvexBody& body, const std::string& label, double right, double up) {
  const Vec3d dir = across(right, up), view = picture_view();
  Dimension found;
  double farthest = -1.0;
  for (const HullEdge& edge : sampled_hull(body).edges) {
    const bool is_outline = (dot(edge.unit_left, view) > 0.0) != (dot(edge.unit_right, view) > 0.0);
    const Vec3d middle = 0.5 * (edge.from + edge.to);
    if (!is_outline || dot(middle, dir) <= farthest) continue;
    farthest = dot(middle, dir);
    const Vec3d along = edge.to - edge.from;
    Vec3d out = normalised(cross(along, view));
    if (dot(out, middle) < 0.0) out = -out;
    const double x = dot(out, picture_right()), y = -dot(out, picture_up());
    found = {edge.from, edge.to, label, {8 * x, 8 * y}, {10 * x, 10 * y}};
  }
  return found;
}

Subject named(const std::string& text, std::vector<Dimension> dimensions) {
  return {text, parse_shape(text).body, std::move(dimensions)};
}

Subject regular(const std::string& text, double right, double up) {
  Subject subject = named(text, {});
  subject.dimensions = {outer_edge(subject.body, "E", right, up)};
  return subject;
}

Subject mesh(const std::filesystem::path& path) { return {path.filename().string(), ConvexBody(load(path).body)}; }

// The height beside the body, between the planes of its ends.
Dimension height_beside(double height, double radius) {
  const Vec3d left = across(-radius, 0.0);
  return {left + Vec3d{0, 0, -0.5 * height}, left + Vec3d{0, 0, 0.5 * height}, "H", {-26, 0}, {-10, 0}};
}

Subject prism() {
  Subject subject = named("prism:6,0.8,1.5", {height_beside(1.5, 0.8)});
  subject.dimensions.push_back(outer_edge(subject.body, "A", 0.3, -1));
  return subject;
}

Subject antiprism() {
  Subject subject = named("antiprism:5,0.9,1.1", {height_beside(1.1, 0.8)});
  subject.dimensions.push_back(outer_edge(subject.body, "A", 0.3, -1));
  return subject;
}

Subject pyramid() {
  Subject subject = named("pyramid:5,1.1,1.6", {height_beside(1.6, 0.95)});
  subject.dimensions.push_back(outer_edge(subject.body, "A", 0.3, -1));
  return subject;
}

Subject rounded_box() {
  Subject subject = named("rounded:0.25,box:1.6,1.4,1.1", {});
  subject.core = parse_shape("box:1.6,1.4,1.1").body;
  const Vec3d left = across(-1.0, 0.0);
  subject.dimensions = {{subject.core->support(left), subject.body.support(left), "r", {}, {0, -11}}};
  return subject;
}

}  // namespace

std::vector<ShapePicture> shape_pictures(const std::filesystem::path& meshes) {
  const Vec3d left = across(-1.0, 0.0), right = across(1.0, 0.0);
  std::vector<ShapePicture> pictures;
  const auto add = [&](const std::string& name, const Subject& subject) { pictures.push_back({name, draw(subject)}); };
  add("sphere", named("sphere:1", {{{}, normalised(across(-1.0, 0.6)), "R", {}, {8, -8}}}));
  add("box", named("box:1.8,1.4,1", {{{-0.9, 0.7, -0.5}, {0.9, 0.7, -0.5}, "A", {6, 7}, {9, 7}},
                                     {{0.9, -0.7, -0.5}, {0.9, 0.7, -0.5}, "B", {-3, 9}, {-3, 10}},
                                     {{0.9, -0.7, -0.5}, {0.9, -0.7, 0.5}, "C", {-9, 0}, {-10, 0}}}));
  add("ellipsoid", named("ellipsoid:1.2,1.6,0.8", {{{}, {1.2, 0, 0}, "A", {}, {-7, -8}},
                                                   {{}, {0, 1.6, 0}, "B", {}, {2, -11}},
                                                   {{}, {0, 0, 0.8}, "C", {}, {-11, 0}}}));
  add("capsule",
      named("capsule:1.6,0.5", {{0.5 * left + Vec3d{0, 0, -0.8}, 0.5 * left + Vec3d{0, 0, 0.8}, "L", {-7, 0}, {-10, 0}},
                                {{0, 0, 0.8}, 0.5 * right + Vec3d{0, 0, 0.8}, "R", {}, {2, -10}}}));
  add("cylinder", named("cylinder:1.6,0.7",
                        {{0.7 * left + Vec3d{0, 0, -0.8}, 0.7 * left + Vec3d{0, 0, 0.8}, "L", {-7, 0}, {-10, 0}},
                         {{0, 0, 0.8}, {0, 0.7, 0.8}, "R", {}, {4, -9}}}));
  add("cone",
      named("cone:1.8,0.9", {{0.9 * left + Vec3d{0, 0, -0.9}, 0.9 * left + Vec3d{0, 0, 0.9}, "H", {-26, 0}, {-10, 0}},
                             {{0, 0, -0.9}, {0, 0.9, -0.9}, "R", {}, {1, -10}}}));
  add("frustum",
      named("frustum:1.4,1,0.6", {{left + Vec3d{0, 0, -0.7}, left + Vec3d{0, 0, 0.7}, "H", {-20, 0}, {-10, 0}},
                                  {{0, 0, -0.7}, {0, 1, -0.7}, "R1", {}, {1, -10}},
                                  {{0, 0, 0.7}, {0, 0.6, 0.7}, "R2", {}, {4, -10}}}));
  add("hemisphere", named("hemisphere:1", {{{}, {0, -1, 0}, "R", {}, {0, -9}}}));
  add("lens",
      named("lens:1,0.9", {{{}, {0, -1, 0}, "R", {}, {0, -9}},
                           {1.1 * left + Vec3d{0, 0, -0.45}, 1.1 * left + Vec3d{0, 0, 0.45}, "H", {}, {-10, 0}}}));
  add("cut-sphere", named("cut-sphere:1,0.4,0.7", {{{}, {0, -1, 0}, "R", {}, {0, -9}},
                                                   {1.12 * left, 1.12 * left + Vec3d{0, 0, -0.4}, "B", {}, {-10, 0}},
                                                   {1.12 * left, 1.12 * left + Vec3d{0, 0, 0.7}, "T", {}, {-10, 0}}}));
  add("spindle",
      named("spindle:2.2,0.6", {{0.75 * left + Vec3d{0, 0, -1.1}, 0.75 * left + Vec3d{0, 0, 1.1}, "L", {}, {-10, 0}},
                                {{}, {0, 0.6, 0}, "R", {}, {-2, -10}}}));
  add("egg", named("egg:0.8,0.7,1.3", {{1.2 * left, 1.2 * left + Vec3d{0, 0, -0.7}, "B", {}, {-10, 0}},
                                       {1.2 * left, 1.2 * left + Vec3d{0, 0, 1.3}, "T", {}, {-10, 0}},
                                       {{}, {0, 0.8, 0}, "R", {}, {-2, -10}}}));
  add("superball", named("superball:2,1", {{{}, {0, 0, 1}, "R", {}, {-10, 0}}}));
  add("superellipsoid", named("superellipsoid:1,1.3,0.8,3,0.75", {{{}, {1, 0, 0}, "A", {}, {-7, -8}},
                                                                  {{}, {0, 1.3, 0}, "B", {}, {2, -11}},
                                                                  {{}, {0, 0, 0.8}, "C", {}, {-11, 0}}}));
  add("disc", named("disc:1", {{{}, {0, -1, 0}, "R", {}, {0, -9}}}));
  add("plate", named("plate:1.8,1.4", {{{-0.9, -0.7, 0}, {0.9, -0.7, 0}, "A", {-4, -7}, {-6, -9}},
                                       {{-0.9, -0.7, 0}, {-0.9, 0.7, 0}, "B", {2, -8}, {3, -10}}}));
  add("needle", named("needle:2", {{{0, 0, -1}, {0, 0, 1}, "L", {-32, 0}, {-10, 0}}}));
  add("tetrahedron", regular("tetrahedron:1", 0, -1));
  add("octahedron", regular("octahedron:1", -1, 1));
  add("dodecahedron", regular("dodecahedron:1", -1, 1));
  add("icosahedron", regular("icosahedron:1", -1, 1));
  add("prism", prism());
  add("antiprism", antiprism());
  add("pyramid", pyramid());
  for (const char* const name :
       {"truncated-tetrahedron", "cuboctahedron", "truncated-cube", "truncated-octahedron", "rhombicuboctahedron",
        "truncated-cuboctahedron", "snub-cube", "icosidodecahedron", "truncated-dodecahedron", "truncated-icosahedron",
        "rhombicosidodecahedron", "truncated-icosidodecahedron", "snub-dodecahedron"}) {
    add(name, regular(std::string(name) + ":1", -1, 1));
  }
  add("rounded", rounded_box());
  add("gem", mesh(meshes / "gem.obj"));
  add("pebble", mesh(meshes / "pebble.obj"));
  return pictures;
}

}  // namespace vex
