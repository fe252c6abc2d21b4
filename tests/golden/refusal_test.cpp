// Input that is refused: exit code 3, one line, no output file.
#include <sys/stat.h>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

class Refusal : public ProgramTest {
 protected:
  void expect_refused(const std::string& body, const std::string& part_of_message) const {
    SCOPED_TRACE(body);
    expect_refusal(run({body, "--trials", "100", "--json", "result.json"}), 3, part_of_message);
    expect_refusal(run({"box:1,1,1", body, "--trials", "100", "--json", "-"}), 3, part_of_message);
    EXPECT_NE(run({"box:1,1,1", body}).err.find(body), std::string::npos) << "which of the two bodies is it?";
    EXPECT_FALSE(std::filesystem::exists(folder() / "result.json"));
  }
  void expect_mesh_refused(const std::string& obj, const std::string& part_of_message) const {
    write_file("mesh.obj", obj);
    expect_refused("mesh.obj", part_of_message);
    EXPECT_EQ(files(), std::vector<std::string>{"mesh.obj"});
  }
  /// The cube with one line in the place of another.
  static std::string cube_with(const std::string& old_line, const std::string& new_line) {
    std::string text = cube_obj();
    return text.replace(text.find(old_line + "\n"), old_line.size() + 1, new_line);
  }
};

TEST_F(Refusal, AFileThatCannotBeRead) {
  expect_refused("missing.obj", "missing.obj");
  expect_refused("no/such/folder/body.stl", "No such file");
  expect_refused(folder().string(), "folder");
  std::filesystem::create_directory(folder() / "folder.obj");
  expect_refused("folder.obj", "folder");
  ASSERT_EQ(mkfifo(path("pipe.obj").c_str(), 0600), 0);
  expect_refused("pipe.obj", "pipe");
  expect_refused("/dev/zero", "device");
  write_file("cube.unknown", cube_obj());
  expect_refused("cube.unknown", ".unknown");
  write_file("cube", cube_obj());
  expect_refused("cube", "cube");
  std::filesystem::create_symlink("loop.obj", folder() / "loop.obj");
  expect_refused("loop.obj", "loop.obj");
  expect_refused(std::string(100000, 'x') + ".obj", "name too long");
  write_file("secret.obj", cube_obj());
  chmod(path("secret.obj").c_str(), 0);
  expect_refusal(shell(kWithoutOverride + "\"$VEX\" secret.obj"), 3, "Permission denied");
}

TEST_F(Refusal, AFileThatHoldsNoMesh) {
  std::string garbage;
  for (int k = 0; k < 5000; ++k) garbage += static_cast<char>((k * 7919 + k / 3) % 256);
  for (const char* extension : {".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf"}) {
    const std::string name = std::string("body") + extension;
    write_file(name, "");
    expect_refused(name, "empty");
    write_file(name, garbage);
    expect_refused(name, name);
    write_file(name, "no mesh at all\n");
    expect_refused(name, "");
  }
}

TEST_F(Refusal, ASurfaceThatBoundsNoConvexBody) {
  expect_mesh_refused(cube_with("f 4 1 5 8", ""), "not closed");
  expect_mesh_refused(cube_with("f 4 1 5 8", "f 8 5 1 4\n"), "oriented");
  expect_mesh_refused(cube_obj() + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n",
                      "not one body");
  // The top pressed in: a pyramid's tip below the face.
  expect_mesh_refused(cube_with("f 5 6 7 8", "v 0.5 0.5 0.8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n"), "not convex");
  expect_mesh_refused("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1\n", "no volume");
  expect_mesh_refused("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "not closed");
}

TEST_F(Refusal, TheHullIsNamedAsTheOtherWay) {
  write_file("mesh.obj", cube_with("f 4 1 5 8", ""));
  const Finished finished = run({"mesh.obj"});
  expect_refusal(finished, 3, "--hull");
}

TEST_F(Refusal, ACoordinateThatIsNotFinite) {
  for (const char* word : {"nan", "inf", "-inf", "1e400", "1e39", "-1e300"}) {
    SCOPED_TRACE(word);
    write_file("mesh.obj", cube_with("v 1 1 1", std::string("v 1 1 ") + word + "\n"));
    expect_refusal(run({"mesh.obj", "--trials", "100", "--json", "result.json"}), 3, "");
    EXPECT_EQ(files(), std::vector<std::string>{"mesh.obj"});
  }
}

TEST_F(Refusal, AMeshWithoutExtent) {
  expect_mesh_refused("v 1 1 1\nv 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n", "");
  std::string tiny = cube_obj();
  for (std::size_t at = 0; (at = tiny.find(" 1", at)) != std::string::npos && at < tiny.find('f'); at += 2) {
    tiny.replace(at, 2, " 1e-60");
  }
  expect_mesh_refused(tiny, "");
}

TEST_F(Refusal, ASizeWithoutMeaning) {
  for (const char* body :
       {"sphere:0",      "sphere:-1",      "sphere:inf",     "sphere:-inf",     "sphere:nan",        "sphere:1e400",
        "sphere:1e-400", "sphere:-0",      "sphere:1e60",    "sphere:1e-60",    "sphere:1e308",      "box:1,1,0",
        "box:1,-1,1",    "box:1e60,1,1",   "box:1,1,1e-60",  "ellipsoid:1,2,0", "ellipsoid:1,2,inf", "capsule:0,1",
        "capsule:1,0",   "capsule:1,-0.5", "capsule:1e200,1"}) {
    expect_refused(body, body);
  }
}

TEST_F(Refusal, AnExistingOutputIsLeftAlone) {
  write_file("result.json", "kept");
  expect_refusal(run({"missing.obj", "--json", "result.json"}), 3, "missing.obj");
  expect_refusal(run({"box:1,1,1", "--json", "result.json", "--isa", "mmx"}), 2, "--isa");
  EXPECT_EQ(read_file("result.json"), "kept");
  EXPECT_EQ(files(), std::vector<std::string>{"result.json"});
}

TEST_F(Refusal, QuietDoesNotSilenceErrors) { expect_refusal(run({"missing.obj", "--quiet"}), 3, "missing.obj"); }

}  // namespace
}  // namespace vex::golden
