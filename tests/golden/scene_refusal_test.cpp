// vex_scene: what it refuses, with which exit code, and what it says.
#include "tests/golden/sample_files.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

class SceneRefusal : public SceneTest {};

const std::string kGood = upright("box:1,1,1", 0, 0, 0);

TEST_F(SceneRefusal, AHeaderThatIsNone) {
  expect_refused("", {}, 3, "the scene is empty (scene.csv)");
  expect_refused("\n", {}, 3, "scene.csv, line 1: not a header of scenes (\"\" where body is expected)");
  expect_refused("sphere:1,0,0,0,1,0,0,0\n", {}, 3, "scene.csv, line 1: the header is missing");
  expect_refused("body,x,y,z,qx,qy,qz,qw\n", {}, 3, "line 1: not a header of scenes (\"qx\" where qw is expected)");
  expect_refused("body,x,y,z\n", {}, 3, "(nothing where qw is expected)");
  expect_refused("body,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32\n", {}, 3, "(nothing where r33 is expected)");
  expect_refused("body,x,y,z,qw,qx,qy,qz,colour\n", {}, 3, "(a further column \"colour\")");
  expect_refusal(run({"missing.csv"}), 3, "the scene cannot be read (missing.csv: No such file", "vex_scene");
  expect_refusal(run({"."}), 3, "Is a directory", "vex_scene");
}

TEST_F(SceneRefusal, ARowThatIsNone) {
  const auto refused = [this](const std::string& row, const std::string& part) {
    expect_refused(kSceneHeader + kGood + row + "\n" + kGood, {}, 3, "scene.csv, line 3: " + part);
  };
  refused("sphere:1,0,0,0,1,0,0", "wrong number of columns (7) - the header has 8");
  refused("box:1,1,1,0,0,0,1,0,0,0", "wrong number of columns (10)");
  refused("sphere:1,0,0,0,1,0,0,0,", "wrong number of columns (9)");
  refused("sphere:1,0,zero,0,1,0,0,0", "not a number (\"zero\" for y)");
  refused("sphere:1,0,,0,1,0,0,0", "not a number (\"\" for y)");
  refused("sphere:1,0,0,0,1,0,0,nan", "not finite (\"nan\" for qz)");
  refused("sphere:1,1e999,0,0,1,0,0,0", "out of the range of doubles (\"1e999\" for x)");
  refused("sphere:1,0,0,0,0,0,0,0", "a quaternion of length 0");
  refused(",0,0,0,1,0,0,0", "no body (an empty cell)");
  refused("\"box:1,1,1,0,0,0,1,0,0,0", "a quotation mark without its end");
  refused("\"box:1,1,1\" ,0,0,0,1,0,0,0,0", "wrong number of columns (9)");
  refused("\"box:1,1,1\"5,0,0,0,1,0,0,0", "something beside a cell in quotation marks");
  refused(std::string("sphere:1\0,0,0,0,1,0,0,0", 24), "a zero byte");
  refused("sphere:1," + std::string(70000, '0') + ",0,0,1,0,0,0", "too long");
  expect_refused(kSceneHeader + kGood + "\n" + kGood, {}, 3, "line 4: an empty row (line 3)");
  expect_refused("body,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33\nsphere:1,0,0,0,1,0,0,0,1,0,0,0,-1\n", {}, 3,
                 "line 2: a reflection is no pose");
  expect_refused("body,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33\nsphere:1,0,0,0,1,0,0,0,1,0,0,0,1.00001\n", {}, 3,
                 "line 2: ");
  expect_refused("body,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33\nsphere:1,0,0,0,1,0,0,0,1,0,0,0,1.0000003\n", {}, 3,
                 "line 2: ");
}

TEST_F(SceneRefusal, FilesOfDifferentUnits) {
  write_file("metres.gltf", tetrahedron_gltf("body.bin"));
  write_file("body.bin", tetrahedron_buffer());
  write_file("centimetres.dae", tetrahedron_dae("centimeter", "0.01"));
  write_file("scene.csv", kSceneHeader + upright("metres.gltf", 0, 0, 0) + upright("centimetres.dae", 0, 0, 0));
  expect_refusal(run({"scene.csv"}), 3, "two files of different units (metres.gltf in m, centimetres.dae in cm)",
                 "vex_scene");
  EXPECT_EQ(run({"scene.csv", "--unit", "cm"}).exit_code, 0);
}

TEST_F(SceneRefusal, ABodyThatIsNone) {
  const auto refused = [this](const std::string& body, const Words& words, const std::string& part) {
    expect_refused(kSceneHeader + kGood + upright(body, 5, 0, 0) + upright(body, 0, 5, 0), words, 3,
                   "scene.csv, line 3: " + part);
  };
  refused("missing.stl", {}, "");
  refused("box:1,1", {}, "wrong number of sizes");
  refused("spher:1", {}, "");
  refused("sphere:0", {}, "");
  refused("sphere", {}, "a body without its sizes");
  refused("rounded:1", {}, "");
  refused("-", {}, "standard input is no body of a file");
  refused("cub", {"--body", "cube=box:1,1,1"}, "");
  expect_refused(kSceneHeader + upright("cub", 5, 0, 0), {"--body", "cube=box:1,1,1"}, 3, "did you mean cube");
  expect_refused(kSceneHeader + kGood, {"--body", "cube=box:1,1"}, 2, "wrong number of sizes");
  write_file("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  refused("open.off", {}, "");
  refused("open.off", {"--hull"}, "");
}

TEST_F(SceneRefusal, WordsThatMeanNothing) {
  const std::string scene = kSceneHeader + kGood;
  expect_refused(scene, {"--query", "pair"}, 2, "not a choice (\"pair\" for --query) - there are pairs, within");
  expect_refused(scene, {"--query", "within"}, 2, "not given (--query within) - add --distance D");
  expect_refused(scene, {"--distance", "1"}, 2,
                 "a distance goes with --query within or clusters (--distance with --query pairs)");
  expect_refused(scene, {"--query", "within", "--distance", "-1"}, 2, "a distance below 0");
  expect_refused(scene, {"--query", "within", "--distance", "inf"}, 3, "not finite");
  expect_refused(scene, {"--box", "1,1"}, 2, "wrong number of numbers (2 for --box)");
  expect_refused(scene, {"--box", "1,1,1,0"}, 2, "wrong number of numbers (4 for --box)");
  expect_refused(scene, {"--box", "1,1,one"}, 2, "not a number (\"one\" for --box)");
  expect_refused(scene, {"--box", "5,5,0"}, 3, "an edge of a periodic box is 0");
  expect_refused(scene, {"--box", "5,5,5,1000,0,0"}, 3, "a tilt of a periodic box is 1000");
  expect_refused(scene, {"--broad-phase", "hash"}, 2, "not a choice (\"hash\" for --broad-phase)");
  expect_refused(scene, {"--isa", "neon"}, 2, "not a choice (\"neon\" for --isa)");
  expect_refused(scene, {"--boxx", "5,5,5"}, 2, "did you mean --box?");
  expect_refused(scene, {"--body", "cube"}, 2, "not a name and a body");
  expect_refused(scene, {"--body", "=box:1,1,1"}, 2, "not a name and a body");
  expect_refused(scene, {"--body", "a=sphere:1", "--body", "a=sphere:2"}, 2, "a name is given twice (a for --body)");
  expect_refused(scene, {"--threads", "0"}, 2, "--threads");
  expect_refused(scene, {"--unit", "mm"}, 2, "no body is a mesh file");
  expect_refused(scene, {"--csv", "--jsonl"}, 2, "two forms of the same rows");
  expect_refused(scene, {"--query", "counts", "--csv"}, 2, "counts have no rows");
  expect_refused(kSceneHeader + upright("sphere:1", 0, 0, 0), {"--dump-vertices"}, 2, "not a polytope");
  expect_refusal(run({}), 2, "no scene is given", "vex_scene");
  expect_refusal(run({"scene.csv", "--random", "10,sphere:1,0.1"}), 2, "two scenes", "vex_scene");
  expect_refusal(run({"scene.csv", "--json", "-", "--jsonl"}), 2, "standard output is asked for twice", "vex_scene");
  expect_refusal(run({"scene.csv", "--dump-vertices"}), 2, "no place for a body's vertices", "vex_scene");
  expect_refusal(run({"scene.csv", "other.csv"}), 2, "not understood (other.csv)", "vex_scene");
  expect_refusal(run({"-", "--body", "a=-", "--format", "stl"}), 3, "", "vex_scene");
}

TEST_F(SceneRefusal, ARandomSceneThatIsNone) {
  const auto refused = [this](const std::string& words, int exit_code, const std::string& part,
                              const Words& more = {}) {
    Words all = {"--random", words, "--save", "saved.csv"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refusal(run(all), exit_code, part, "vex_scene");
    EXPECT_TRUE(files().empty());
  };
  refused("100", 2, "not a random scene");
  refused("100,sphere:1", 2, "not a random scene");
  refused("0,sphere:1,0.1", 2, "not positive (\"0\" for N of --random)");
  refused("many,sphere:1,0.1", 2, "not a count (\"many\" for N of --random)");
  refused("10,sphere:1,0", 2, "not positive (\"0\" for ETA of --random)");
  refused("10,disc:1,0.1", 3, "a flat body fills no share of space");
  refused("10,needle:1,0.1", 3, "a flat body");
  refused("10,spher:1,0.1", 2, "");
  refused("1e18,sphere:1,0.1", 3, "more bodies than this machine holds");
  refused("10,sphere:1,0.1", 2, "a random scene makes its own box", {"--box", "9,9,9"});
  refused("1,box:1000,0.01,0.01,0.5", 3, "");
}

TEST_F(SceneRefusal, ABodyLargerThanTheBoxAllows) {
  expect_refused(kSceneHeader + kGood + upright("box:100,0.1,0.1", 0, 0, 0), {"--box", "2,2,2"}, 3,
                 "scene.csv, line 3: ");
}

TEST_F(SceneRefusal, AnOutputThatWouldCostAnInput) {
  const std::string scene = kSceneHeader + "cube.dat,0,0,0,1,0,0,0\n";
  write_file("scene.csv", scene);
  write_file("cube.dat", cube_obj());
  for (const char* option : {"--json", "--save", "--svg"}) {
    expect_refusal(run({"scene.csv", option, "scene.csv"}), 2, "is an input", "vex_scene");
    expect_refusal(run({"scene.csv", "--format", "obj", option, "cube.dat"}), 2, "is an input", "vex_scene");
    expect_refusal(run({"scene.csv", option, "cube.obj"}), 2, "extension of a mesh", "vex_scene");
  }
  expect_refusal(run({"scene.csv", "--gltf", "scene.gltf"}), 2, "let it end in .glb", "vex_scene");
  expect_refusal(run({"scene.csv", "--gltf", "-"}), 2, "let it end in .glb", "vex_scene");
  expect_refusal(run({"scene.csv", "--svg", "a", "--json", "a"}), 2, "one file for two outputs", "vex_scene");
  write_file("body.glb", "not read before the outputs are looked at");
  write_file("scene.csv", kSceneHeader + "body.glb,0,0,0,1,0,0,0\n");
  expect_refusal(run({"scene.csv", "--gltf", "body.glb"}), 2, "is an input", "vex_scene");
  expect_refusal(shell("\"$VEX\" scene.csv >> scene.csv"), 2, "standard output goes into an input", "vex_scene");
}

}  // namespace
}  // namespace vex::golden
