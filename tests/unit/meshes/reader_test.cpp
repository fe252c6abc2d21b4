#include "meshes/reader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/interruption.h"
#include "meshes/convex_mesh.h"
#include "meshes/data/mesh_writers.h"
#include "refusal.h"
#include "soups.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

std::string refusal_of_file(const std::filesystem::path& path) {
  return refusal_of([&] { static_cast<void>(load(path)); });
}

/// Binary fractions of few digits: every text reader finds the same floats.
PolygonSoup simple_soup() {
  return moved(box_soup({-1, -2, -4}, {1, 2, 4}), [](const Vec3d& p) {
    return Vec3d{p.x + 0.25 * p.y, p.y, p.z + 0.5 * p.x};
  });
}

class EveryFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryFormat, GivesTheSameBodyToTheLastBit) {
  const TemporaryFolder folder;
  const ConvexMesh expected = convex_mesh_from(triangulated(simple_soup()));
  const ConvexMesh mesh =
      load(folder.file(std::string("body") + GetParam(), mesh_bytes(triangulated(simple_soup()), GetParam())));
  EXPECT_EQ(mesh.measures.volume, expected.measures.volume);
  EXPECT_EQ(mesh.measures.surface_area, expected.measures.surface_area);
  EXPECT_EQ(mesh.measures.integrated_mean_curvature, expected.measures.integrated_mean_curvature);
  EXPECT_EQ(mesh.body.inradius(), expected.body.inradius());
  ASSERT_EQ(mesh.polytope().n_vertices(), expected.polytope().n_vertices());
  for (std::size_t i = 0; i < mesh.polytope().n_vertices(); ++i) {
    EXPECT_EQ(norm(mesh.polytope().vertex(i) - expected.polytope().vertex(i)), 0.0);
  }
}

// From the file's bytes, or the process that reads it, on.
TEST_P(EveryFormat, IsReadNoFurtherThanAnInterruption) {
  const TemporaryFolder folder;
  const auto path = folder.file(std::string("body") + GetParam(),
                                mesh_bytes(sphere_soup(20, [](const Vec3d& v) { return v; }), GetParam()));
  int n_asked = 0;
  {
    const Interruption counts([&] {
      ++n_asked;
      return false;
    });
    EXPECT_GT(read_polygon_soup(path).points.size(), 1000u);
  }
  EXPECT_GE(n_asked, 4);
  for (const int n : {0, 1, 2, 3}) {
    int n_left = n;
    const Interruption later([&] { return n_left-- == 0; });
    EXPECT_THROW(static_cast<void>(read_polygon_soup(path)), Interrupted);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a reading process was left behind";
  }
}

INSTANTIATE_TEST_SUITE_P(Reader, EveryFormat,
                         ::testing::Values(".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf", ".OBJ",
                                           ".Stl"),
                         [](const auto& test) { return std::string(test.param + 1) + std::to_string(test.index); });

TEST(Reader, KeepsPolygonsAsPolygons) {
  const TemporaryFolder folder;
  for (const char* extension : {".obj", ".ply", ".off", ".dae"}) {
    const PolygonSoup soup =
        read_polygon_soup(folder.file(std::string("d") + extension, mesh_bytes(dodecahedron_soup(), extension)));
    EXPECT_EQ(soup.face_sizes, std::vector<std::uint32_t>(12, 5)) << extension;
  }
}

TEST(Reader, ReadsTextPlyAndTextStl) {
  const TemporaryFolder folder;
  EXPECT_EQ(load(folder.file("a.ply", ply_text(simple_soup()))).measures.volume, 64.0);
  EXPECT_EQ(load(folder.file("a.stl", stl_text(simple_soup()))).measures.volume, 64.0);
}

TEST(Reader, AppliesNodeTransformsOfAllParents) {
  const TemporaryFolder folder;
  const PolygonSoup box = box_soup({0, 0, 0}, {1, 2, 4});
  // Scale by 2, 1, 0.5, turn by a quarter about x, shift; nested in a node that scales all by 2 and shifts.
  const std::string nodes = R"([{"scale": [2, 2, 2], "translation": [10, 0, 0], "children": [1]},)"
                            R"({"scale": [2, 1, 0.5], "rotation": [0.70710678118654752, 0, 0, 0.70710678118654752],)"
                            R"( "translation": [0, 5, 0], "children": [2]}, {"mesh": 0}])";
  folder.file("b.bin", gltf_buffer(box));
  const ConvexMesh mesh = load(folder.file("b.gltf", gltf_text(box, "b.bin", nodes)), {.convex_tolerance = 1e-6});
  EXPECT_NEAR(mesh.measures.volume, 8.0 * 8.0, 1e-4);
  // x: 10 + 2 (2 x); y: 2 (5 - z / 2); z: 2 y
  EXPECT_NEAR(mesh.body.centre().x, 12.0, 1e-2);
  EXPECT_NEAR(mesh.body.centre().y, 8.0, 1e-2);
  EXPECT_NEAR(mesh.body.centre().z, 2.0, 1e-2);
}

TEST(Reader, WeldsSeveralPartsThatAreOneBody) {
  const TemporaryFolder folder;
  // A half box, shown twice: the second time turned half round about z, so the open sides meet at x = 0.
  PolygonSoup half = face_removed(box_soup({0, -1, -1}, {1, 1, 1}), 0);
  const std::string nodes =
      R"([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "matrix": [-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1]}])";
  folder.file("h.bin", gltf_buffer(half));
  const ConvexMesh mesh = load(folder.file("h.gltf", gltf_text(half, "h.bin", nodes)));
  EXPECT_EQ(mesh.report.n_parts, 2U);
  EXPECT_EQ(mesh.measures.volume, 8.0);
  EXPECT_EQ(mesh.report.n_points, 12U);
  EXPECT_EQ(mesh.report.n_vertices, 8U);  // the seam's points lie within edges
  EXPECT_EQ(mesh.report.n_welded_vertices, 4U);
}

TEST(Reader, RefusesWhatIsNotAFile) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(refusal_of_file(folder.path() / "absent.obj"), "No such file"));
  std::filesystem::create_directory(folder.path() / "folder.obj");
  EXPECT_TRUE(contains(refusal_of_file(folder.path() / "folder.obj"), "it is a folder"));
  EXPECT_TRUE(contains(refusal_of_file(folder.file("empty.obj", "")), "is empty (0 bytes)"));
  ASSERT_EQ(::mkfifo((folder.path() / "pipe.obj").c_str(), 0600), 0);
  EXPECT_TRUE(
      contains(refusal_of_file(folder.path() / "pipe.obj"), "a pipe, a device or a socket"));  // and does not wait
  EXPECT_TRUE(contains(refusal_of_file("/dev/zero"), "a pipe, a device or a socket"));
  EXPECT_TRUE(contains(refusal_of_file(""), "No such file"));
}

TEST(Reader, RefusesAnUnknownExtensionAndSaysWhatIsRead) {
  const TemporaryFolder folder;
  for (const char* name : {"body.doc", "body", "body.obj.bak", "body.gz", "body.doc.gz"}) {
    const std::string message = refusal_of_file(folder.file(name, obj_text(simple_soup())));
    EXPECT_TRUE(contains(message, "names no format that is read"));
    EXPECT_TRUE(contains(message, ".obj .stl .ply .off .vtk .msh .xyz .csv .txt"));
    EXPECT_TRUE(contains(message, ".gltf .glb .dae .3mf"));
  }
}

TEST(Reader, RefusesAFileWithoutFaces) {
  const TemporaryFolder folder;
  EXPECT_FALSE(refusal_of_file(folder.file("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")).empty());
  EXPECT_FALSE(refusal_of_file(folder.file("comment.obj", "# nothing\n")).empty());
  EXPECT_FALSE(refusal_of_file(folder.file("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n")).empty());
}

TEST(Reader, ReadsPointsWithoutFacesForAHull) {
  const TemporaryFolder folder;
  const PolygonSoup body = simple_soup();
  PolygonSoup cloud;
  cloud.points = body.points;
  cloud.points.push_back({0.0, 0.25, 0.0});  // inside
  const auto without_face_element = [](std::string ply) {
    const std::size_t begin = ply.find("element face");
    return ply.erase(begin, ply.find("end_header") - begin);
  };
  std::string points_of_obj;
  for (std::size_t i = 1; i <= cloud.points.size(); ++i) {
    points_of_obj += "p " + std::to_string(i) + "\n";
  }
  const ConvexMesh expected = convex_mesh_from(body);
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"text.ply", ply_text(cloud)},
           {"binary.ply", ply_binary(cloud)},
           {"text without face element.ply", without_face_element(ply_text(cloud))},
           {"binary without face element.ply", without_face_element(ply_binary(cloud))},
           {"vertices.obj", obj_text(cloud)},
           {"points.obj", obj_text(cloud) + points_of_obj},
           {"points in one line.obj", obj_text(cloud) + "p 1 2 3 4 5 6 7 8 9\n"},
           {"a.off", off_text(cloud)},
           {"comment.off", "OFF # of\n# 9 points\n" + off_text(cloud).substr(4)}}) {
    const auto path = folder.file(name, bytes);
    const ConvexMesh mesh = load(path, {.hull = true});
    EXPECT_EQ(mesh.measures.volume, 64.0) << name;
    EXPECT_EQ(mesh.report.n_points, 9U) << name;
    EXPECT_EQ(mesh.report.hull_added_volume, std::nullopt) << name;
    ASSERT_EQ(mesh.polytope().n_vertices(), 8U) << name;
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(norm(mesh.polytope().vertex(i) - expected.polytope().vertex(i)), 0.0) << name;
    }
    EXPECT_EQ(norm(mesh.body.centre() - expected.body.centre()), 0.0) << name;
    EXPECT_TRUE(contains(refusal_of_file(path), "--hull")) << name;
  }
}

TEST(Reader, DeliversPointsThatNoFaceUses) {
  const TemporaryFolder folder;
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.points.push_back({0.5, 0.5, 4.0});
  for (const char* extension : {".ply", ".off", ".obj"}) {
    const auto path = folder.file(std::string("a") + extension, mesh_bytes(soup, extension));
    EXPECT_EQ(load(path, {.hull = true}).measures.volume, 2.0) << extension;
    EXPECT_EQ(load(path).measures.volume, 1.0) << extension;
  }
}

TEST_P(EveryFormat, GivesTheSameHullOfSomethingThatIsNotConvex) {
  const TemporaryFolder folder;
  const PolygonSoup soup = triangulated(moved(face_removed(torus_soup(8), 3), [](const Vec3d& p) {
    return Vec3d{std::round(64 * p.x) / 64, std::round(64 * p.y) / 64, std::round(64 * p.z) / 64};  // few digits
  }));
  const ConvexMesh expected = convex_mesh_from(soup, {.hull = true});
  const ConvexMesh mesh =
      load(folder.file(std::string("body") + GetParam(), mesh_bytes(soup, GetParam())), {.hull = true});
  ASSERT_EQ(mesh.polytope().n_vertices(), expected.polytope().n_vertices());
  for (std::size_t i = 0; i < mesh.polytope().n_vertices(); ++i) {
    EXPECT_EQ(norm(mesh.polytope().vertex(i) - expected.polytope().vertex(i)), 0.0);
  }
  EXPECT_EQ(mesh.measures.volume, expected.measures.volume);
  EXPECT_EQ(mesh.measures.surface_area, expected.measures.surface_area);
  EXPECT_EQ(mesh.measures.integrated_mean_curvature, expected.measures.integrated_mean_curvature);
  EXPECT_EQ(norm(mesh.body.centre() - expected.body.centre()), 0.0);
}

TEST(Reader, ReadsTextStlInUpperCase) {
  const TemporaryFolder folder;
  std::string upper = stl_text(simple_soup());
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  EXPECT_EQ(load(folder.file("a.stl", upper)).measures.volume, 64.0);
  EXPECT_EQ(load(folder.file("b.STL", "\n  " + upper)).measures.volume, 64.0);
  std::string mixed = stl_text(simple_soup());
  mixed.replace(0, 5, "Solid");
  EXPECT_EQ(load(folder.file("c.stl", mixed)).measures.volume, 64.0);
  // Binary whose heading begins like the text's.
  std::string binary = stl_binary(simple_soup());
  binary.replace(0, 10, "SOLID ABC ");
  EXPECT_EQ(load(folder.file("d.stl", binary)).measures.volume, 64.0);
  binary.replace(0, 10, "solid abc ");
  EXPECT_EQ(load(folder.file("e.stl", binary)).measures.volume, 64.0);
}

TEST(Reader, IgnoresPointsAndLinesBesideFacesWithANote) {
  const TemporaryFolder folder;
  const ConvexMesh mesh = load(folder.file("a.obj", obj_text(simple_soup()) + "l 1 2\nl 3 4\n"));
  EXPECT_EQ(mesh.measures.volume, 64.0);
  ASSERT_EQ(mesh.report.notes.size(), 1U);
  EXPECT_TRUE(contains(mesh.report.notes[0], "points or lines of the file were ignored"));
}

TEST(Reader, ReadsCoordinatesWithoutALeadingZero) {
  // Readers were found that drop the vertices of an .obj file that hold a word like ".5".
  const TemporaryFolder folder;
  const std::string faces_of_obj = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  for (const char* vertices :
       {"v 0 0 0\nv .5 0 0\nv 0 .5 0\nv 0 0 .5\n", "v 0 0 0\nv +.5 0 0\nv 0\t.5 0\r\nv 0 0 .50\n",
        "v -.0 0 0\nv .5 0. 0\nv 0 5.e-1 0\nv 0 0  .5e0\n"}) {
    // The vertex that no face uses would hide a dropped one.
    const std::string text = std::string(vertices) + "v 9 9 9\n" + faces_of_obj;
    EXPECT_NEAR(load(folder.file("tetrahedron.obj", text)).measures.volume, 0.125 / 6, 1e-15) << vertices;
  }
  const std::string rows = "0 0 0\n.5 0 0\n0 .5 0\n0 0 .5\n", faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  EXPECT_NEAR(load(folder.file("a.off", "OFF\n4 4 6\n" + rows + faces)).measures.volume, 0.125 / 6, 1e-15);
  EXPECT_NEAR(load(folder.file("a.ply",
                               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                               "float y\nproperty float z\nelement face 4\nproperty list uchar int "
                               "vertex_indices\nend_header\n" +
                                   rows + faces))
                  .measures.volume,
              0.125 / 6, 1e-15);
}

TEST(Reader, RefusesCoordinatesThatAreNotFinite) {
  const TemporaryFolder folder;
  for (const char* bad : {"nan", "inf", "-inf", "1e400"}) {
    std::string text = obj_text(simple_soup());
    text.replace(text.find("v ") + 2, text.find(' ', 2) - 2, bad);
    EXPECT_TRUE(contains(refusal_of_file(folder.file("bad.obj", text)), bad)) << bad;
  }
  PolygonSoup soup = simple_soup();
  soup.points[3].z = std::nan("");
  EXPECT_TRUE(contains(refusal_of_file(folder.file("bad.ply", ply_binary(soup))), "vertex 3"));
  // Transforms that take finite floats beyond all doubles.
  soup = simple_soup();
  folder.file("b.bin", gltf_buffer(soup));
  std::string nodes = "[";
  for (int i = 1; i < 10; ++i) nodes += R"({"scale": [1e38, 1e38, 1e38], "children": [)" + std::to_string(i) + "]}, ";
  EXPECT_TRUE(contains(refusal_of_file(folder.file("b.gltf", gltf_text(soup, "b.bin", nodes + R"({"mesh": 0}])"))),
                       "not finite"));
}

TEST(Reader, NeverOpensWhatAMeshNamesBesideItsGeometry) {
  const TemporaryFolder folder;
  // A pipe that nobody writes to: opening it would wait for ever.
  ASSERT_EQ(::mkfifo((folder.path() / "a.mtl").c_str(), 0600), 0);
  const auto path = folder.file("a.obj", "mtllib a.mtl\nusemtl red\n" + obj_text(simple_soup()));
  EXPECT_EQ(load(path).measures.volume, 64.0);
}

TEST(Reader, RefusesAGltfWhoseBufferIsMissingOrOutsideItsFolder) {
  const TemporaryFolder folder;
  EXPECT_FALSE(refusal_of_file(folder.file("a.gltf", gltf_text(simple_soup(), "missing.bin"))).empty());
  std::filesystem::create_directory(folder.path() / "inner");
  folder.file("outside.bin", gltf_buffer(simple_soup()));
  EXPECT_FALSE(refusal_of_file(folder.file("inner/a.gltf", gltf_text(simple_soup(), "../outside.bin"))).empty());
  folder.file("a.dat", gltf_buffer(simple_soup()));
  EXPECT_FALSE(refusal_of_file(folder.file("a.gltf", gltf_text(simple_soup(), "a.dat"))).empty());
}

TEST(Reader, ReadsInThisProcessWhenAskedTo) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.stl", stl_binary(simple_soup()));
  EXPECT_EQ(load(path, {.isolated_reader = false}).measures.volume, 64.0);
}

TEST(Reader, TurnsABodyThatIsInsideOutAndSaysSo) {
  const TemporaryFolder folder;
  const ConvexMesh mesh = load(folder.file("a.off", off_text(turned(simple_soup()))));
  EXPECT_EQ(mesh.measures.volume, 64.0);
  ASSERT_EQ(mesh.report.notes.size(), 1U);
  EXPECT_TRUE(contains(mesh.report.notes[0], "inside out"));
}

}  // namespace
}  // namespace vex::tests
