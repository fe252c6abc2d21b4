// How a file is chosen and told from others: formats by name, packed files, standard input, and what messages say.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/convex_mesh.h"
#include "meshes/data/archives.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/reader.h"
#include "refusal.h"
#include "soups.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

std::string refusal_with_options(const std::filesystem::path& path) {
  return refusal_of([&] { static_cast<void>(load(path)); });
}

PolygonSoup simple_body() { return box_soup({-1, -2, -4}, {1, 2, 4}); }  // V = 64

TEST(ReadOptions, ReadsItsOwnFormatsPackedByGzip) {
  const TemporaryFolder folder;
  for (const char* extension : {".obj", ".stl", ".ply", ".off"}) {
    const std::string packed = gzipped(mesh_bytes(simple_body(), extension));
    EXPECT_EQ(load(folder.file(std::string("a") + extension + ".gz", packed)).measures.volume, 64.0);
    EXPECT_EQ(load(folder.file(std::string("b") + extension + ".Gz", packed)).measures.volume, 64.0);
    EXPECT_TRUE(contains(refusal_with_options(folder.file(std::string("c") + extension, packed)), "packed by gzip"));
    EXPECT_TRUE(contains(refusal_with_options(folder.file(std::string("d") + extension + ".gz", packed.substr(0, 30))),
                         "early"));
  }
  EXPECT_TRUE(
      contains(refusal_with_options(folder.file("a.glb.gz", gzipped(glb(simple_body())))), "cannot be read packed"));
}

TEST(ReadOptions, ReadsAFileAsTheFormatThatIsNamed) {
  const TemporaryFolder folder;
  for (const char* extension : {".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf"}) {
    const auto path = folder.file("a.data", mesh_bytes(simple_body(), extension));
    for (const char* format : {extension, extension + 1}) {
      EXPECT_EQ(load(path, {.format = format}).measures.volume, 64.0) << format;
    }
  }
  const auto path = folder.file("b.data", gzipped(stl_text(simple_body())));
  EXPECT_EQ(load(path, {.format = "STL.gz"}).measures.volume, 64.0);
  EXPECT_THROW(static_cast<void>(read_polygon_soup(path, {.format = "doc"})), UsageError);
  EXPECT_THROW(static_cast<void>(read_polygon_soup(path, {.format = "glb.gz"})), UsageError);
}

/// Standard input is a pipe that holds `bytes`, as long as this lives; 60 kB at most, which a pipe takes.
class StandardInput {
 public:
  explicit StandardInput(const std::string& bytes) : before_(::dup(STDIN_FILENO)) {
    int ends[2] = {-1, -1};
    EXPECT_EQ(::pipe(ends), 0);
    EXPECT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    ::close(ends[1]);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;
  ~StandardInput() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

TEST(ReadOptions, ReadsStandardInputAsTheFormatThatIsNamed) {
  for (const char* extension : {".obj", ".stl", ".ply", ".off"}) {
    const std::string bytes = mesh_bytes(simple_body(), extension);
    const StandardInput input(bytes);
    EXPECT_EQ(load("-", {.format = extension}).measures.volume, 64.0) << extension;
  }
  const StandardInput packed(gzipped(off_text(simple_body())));
  EXPECT_EQ(load("-", {.format = "off.gz"}).measures.volume, 64.0);
}

TEST(ReadOptions, RefusesStandardInputOfNoFormatOrOneOfAssimps) {
  const StandardInput input("");
  EXPECT_THROW(static_cast<void>(read_polygon_soup("-")), UsageError);
  EXPECT_THROW(static_cast<void>(read_polygon_soup("-", {.format = "gltf"})), UsageError);
  EXPECT_TRUE(contains(refusal_of([] { static_cast<void>(read_polygon_soup("-", {.format = "stl"})); }), "is empty"));
}

TEST(ReadOptions, SaysWhatAFileIsThatIsNotWhatItsNameSays) {
  const TemporaryFolder folder;
  struct Case {
    const char* name;
    std::string bytes;
    const char* expected;
  };
  const std::string page = "<!DOCTYPE html><html><body>Not found</body></html>\n";
  for (const Case& c : std::vector<Case>{
           {"a.ply", stl_text(simple_body()), "it is STL as text, not .ply"},
           {"a.stl", ply_text(simple_body()), "it is a PLY mesh, not .stl"},
           {"b.stl", obj_text(simple_body()), "it is a Wavefront OBJ mesh, not .stl"},
           {"a.obj", page, "it is a web page"},
           {"a.glb", page, "it is a web page"},
           {"b.obj", threemf(simple_body()), "it is a zip archive, not .obj"},
           {"a.txt", off_text(simple_body()), "it is an OFF mesh, not .txt"},
           {"b.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n", "Git LFS"},
           {"c.glb", ply_text(simple_body()), "it is a PLY mesh, not .glb"},
           {"c.obj", "ISO-10303-21;\nHEADER;\n", "it is STEP"},
           {"c.stl", std::string(72, ' ') + "S      1\n", "it is IGES"},
           {"a.step", "ISO-10303-21;\n", "STEP, which holds CAD bodies"},
           {"a.STP", "ISO-10303-21;\n", "STEP, which holds CAD bodies"},
           {"a.igs", "x", "IGES, which holds CAD bodies"},
           {"a.mesh", "MeshVersionFormatted 2\nDimension 3\n", "it is a Medit mesh"},
           {"a.usdz", "PK", "USD"},
           {"a.blend", "BLENDER-v306" + std::string(300, 'x'), "convert it to .obj, .off, .ply or .stl"},
           {"d.stl", std::string(1000, '\0'), "nothing but zero bytes"}}) {
    const std::string message = refusal_of([&] { static_cast<void>(read_polygon_soup(folder.file(c.name, c.bytes))); });
    EXPECT_TRUE(contains(message, c.expected)) << c.name;
    EXPECT_TRUE(contains(message, c.name));
    EXPECT_NE(message.find(" - "), std::string::npos) << message;
    EXPECT_EQ(message.find(" - "), message.rfind(" - ")) << message;
  }
}

TEST(ReadOptions, KnowsFormatsOfMeshesFromThoseOfPoints) {
  for (const char* name : {"a.obj", "a.OFF", "a.ply", "a.stl", "a.vtk", "a.msh", "a.ply.gz", "a.STL.GZ", "a.gltf",
                           "a.glb", "a.dae", "a.3mf", "a.fbx"}) {
    EXPECT_TRUE(names_a_mesh_format(name)) << name;
  }
  for (const char* name : {"a.csv", "a.txt", "a.xyz", "a.csv.gz", "a.glb.gz", "a.gz", "a", "a.svg", "a.html", ".obj"}) {
    EXPECT_FALSE(names_a_mesh_format(name)) << name;
  }
}

TEST(ReadOptions, ListsTheFilesThatItWouldOpen) {
  const TemporaryFolder folder;
  using Paths = std::vector<std::filesystem::path>;
  const auto obj = folder.file("a.obj", "mtllib a.mtl\n" + obj_text(simple_body()));
  folder.file("a.mtl", "newmtl a\n");
  EXPECT_EQ(files_read_with(obj), Paths{obj});
  const auto bin = folder.file("a b.bin", gltf_buffer(simple_body()));
  folder.file("outside.txt", "x");
  const auto gltf = folder.file("a.gltf", gltf_text(simple_body(), "./a%20b.bin"));
  EXPECT_EQ(files_read_with(gltf), (Paths{gltf, bin}));
  const auto other = folder.file("a.data", gltf_text(simple_body(), "a b.bin"));
  EXPECT_EQ(files_read_with(other, "gltf"), (Paths{other, bin}));
  EXPECT_EQ(files_read_with(other), Paths{other});
  for (const char* uri : {"../a b.bin", "/etc/passwd", "outside.txt", "absent.bin", "%2e%2e/x/a b.bin"}) {
    const auto path = folder.file("b.gltf", gltf_text(simple_body(), uri));
    EXPECT_EQ(files_read_with(path), Paths{path}) << uri;
  }
  EXPECT_EQ(files_read_with("-", "gltf"), Paths{});
  EXPECT_EQ(files_read_with("absent.gltf"), Paths{"absent.gltf"});
}

}  // namespace
}  // namespace vex::tests
