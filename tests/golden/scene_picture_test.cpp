// vex_scene: random scenes and how they come back, .glb files taken apart, the picture of the stages.
#include <cmath>
#include <map>

#include "tests/golden/pair.h"
#include "tests/golden/sample_files.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class ScenePicture : public SceneTest {
 protected:
  /// The file that this makes, and what it says.
  Glb glb_of(Words words) const {
    words.insert(words.end(), {"--gltf", "scene.glb", "--quiet"});
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    Glb glb(read_file("scene.glb"));
    EXPECT_EQ(glb.fault, "") << testing::PrintToString(words);
    return glb;
  }
};

const json& mesh_of(const Glb& glb, const json& node) {
  return glb.document.at("meshes").at(node.at("mesh").get<std::size_t>());
}

const json& primitive_of(const Glb& glb, const json& node) { return mesh_of(glb, node).at("primitives").at(0); }

const json& material_of(const Glb& glb, const json& node) {
  return glb.document.at("materials").at(primitive_of(glb, node).at("material").get<std::size_t>());
}

using Point = std::array<double, 3>;

// By the quaternion x, y, z, w of the node, and its translation.
Point placed(const json& node, const std::vector<double>& p) {
  const auto q = node.at("rotation").get<std::array<double, 4>>();
  const auto t = node.at("translation").get<Point>();
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {(1 - 2 * (y * y + z * z)) * p[0] + 2 * (x * y - w * z) * p[1] + 2 * (x * z + w * y) * p[2] + t[0],
          2 * (x * y + w * z) * p[0] + (1 - 2 * (x * x + z * z)) * p[1] + 2 * (y * z - w * x) * p[2] + t[1],
          2 * (x * z - w * y) * p[0] + 2 * (y * z + w * x) * p[1] + (1 - 2 * (x * x + y * y)) * p[2] + t[2]};
}

TEST_F(ScenePicture, ARandomSceneIsOfItsSeedAndComesBack) {
  const auto rows = [this](const std::string& seed, const std::string& name, const char* threads) {
    const Finished finished = run({"--random", "500,capsule:2,0.5,0.4", "--seed", seed, "--save", name, "--threads",
                                   threads, "--json", "result.json", "--quiet"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished.out;
  };
  const std::string pairs = rows("1", "a.csv", "1");
  EXPECT_GT(lines_of(pairs).size(), 200u);
  const json box = json::parse(read_file("result.json")).at("box");
  const double volume = M_PI * 0.25 * 2.0 + 4.0 / 3.0 * M_PI * 0.125;
  EXPECT_NEAR(std::pow(box.at(0).get<double>(), 3), 500 * volume / 0.4, 1e-9 * 500 * volume);
  EXPECT_EQ(rows("1", "b.csv", "4"), pairs);
  EXPECT_EQ(read_file("b.csv"), read_file("a.csv"));
  EXPECT_NE(rows("2", "b.csv", "1"), pairs);
  EXPECT_EQ(lines_of(read_file("a.csv")).size(), 501u);

  const std::string edge = box.at(0).dump(), edges = edge + "," + edge + "," + edge;
  const Finished again = run({"a.csv", "--box", edges, "--quiet", "--save", "c.csv"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, pairs);
  EXPECT_EQ(read_file("c.csv"), read_file("a.csv")) << "bit for bit";
  const Finished said = run({"--random", "500,capsule:2,0.5,0.4"});
  EXPECT_NE(said.err.find("in a periodic box " + edges), std::string::npos) << said.err;
}

TEST_F(ScenePicture, SavingKeepsTextsWithCommasAndQuaternionsRotations) {
  write_file("odd \"name\", yes.obj", cube_obj());
  write_file("scene.csv",
             kSceneHeader + "\"odd \"\"name\"\", yes.obj\",0.1,0.2,0.3,1,2,3,4\ncube,1e-300,7,-0,3,1,0,0\n");
  const Words words = {"scene.csv", "--body",  "cube=box:1,2,3", "--save",     "saved.csv",
                       "--quiet",   "--query", "within",         "--distance", "100"};
  const Finished finished = run(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  const Finished again = run({"saved.csv", "--quiet", "--query", "within", "--distance", "100", "--save", "again.csv"});
  EXPECT_EQ(again.out, finished.out) << again.err;
  EXPECT_EQ(read_file("again.csv"), read_file("saved.csv"));
}

TEST_F(ScenePicture, VerticesAreOnTheBodies) {
  // Each kind of body where the file puts it: all points of its mesh are in it, and those of a cube its corners.
  const std::vector<std::string> bodies = {
      "box:1,2,3", "sphere:0.5", "cylinder:2,0.5", "cone:1,0.5",       "hemisphere:1",   "capsule:2,0.5",
      "disc:0.5",  "plate:1,2",  "needle:2",       "ellipsoid:1,2,.5", "frustum:1,1,.5", "rounded:.25,box:1,1,1"};
  std::string scene = kSceneHeader;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    scene += "\"" + bodies[k] + "\"," + std::to_string(10 * k) + ",1,2,1,2,3," + std::to_string(k) + "\n";
  }
  write_file("scene.csv", scene);
  const Glb glb = glb_of({"scene.csv"});
  ASSERT_EQ(glb.document.at("nodes").size(), bodies.size() + 1);
  std::string poses = "tx,ty,tz,qw,qx,qy,qz\n";
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const json& node = glb.document.at("nodes").at(k);
    SCOPED_TRACE(bodies[k]);
    EXPECT_EQ(mesh_of(glb, node).at("name"), bodies[k]);
    const json& attributes = primitive_of(glb, node).at("attributes");
    const auto points = glb.rows(attributes.at("POSITION"));
    const auto indices = glb.rows(primitive_of(glb, node).at("indices"));
    for (const std::vector<double>& index : indices) EXPECT_LT(index.at(0), points.size());
    const bool is_line = bodies[k] == "needle:2";
    EXPECT_EQ(attributes.contains("NORMAL"), !is_line);
    EXPECT_EQ(primitive_of(glb, node).value("mode", 4), is_line ? 1 : 4);
    if (bodies[k] == "disc:0.5" || bodies[k] == "plate:1,2") {
      EXPECT_EQ(material_of(glb, node).at("doubleSided"), json(true));
    }
    if (k == 0) {
      EXPECT_EQ(points.size(), 24u) << "three normals a corner";
    }
    // A small ball about each point, as placed in the picture, meets the body as placed in the file.
    std::string balls =
        kSceneHeader + "\"" + bodies[k] + "\"," + std::to_string(10 * k) + ",1,2,1,2,3," + std::to_string(k) + "\n";
    for (const std::vector<double>& p : points) {
      const Point place = placed(node, p);
      balls += upright("sphere:2e-5", place[0], place[1], place[2]);
    }
    std::size_t n_meeting = 0;
    for (const std::string& row : lines_of(rows_of(balls, {}))) n_meeting += row.rfind("0,", 0) == 0 ? 1u : 0u;
    EXPECT_EQ(n_meeting, points.size());
    write_file("scene.csv", scene);
  }
}

TEST_F(ScenePicture, SurfacesAreClosedAndFaceOutwards) {
  // By the divergence theorem the triangles enclose the volume, a little less where the body is curved.
  for (const auto& [body, volume, least] : std::initializer_list<std::tuple<const char*, double, double>>{
           {"box:1,2,3", 6.0, 1 - 1e-6},
           {"sphere:1", 4.0 / 3.0 * M_PI, 0.98},
           {"cylinder:2,1", 2.0 * M_PI, 0.99},
           {"cone:3,1", M_PI, 0.99},
           {"hemisphere:1", 2.0 / 3.0 * M_PI, 0.98},
           {"rounded:1,box:2,2,2", 8.0 + 24.0 + 6.0 * M_PI + 4.0 / 3.0 * M_PI, 0.985},
           {"icosahedron:1", 2.18169499, 1 - 1e-6}}) {
    write_file("scene.csv", kSceneHeader + upright(body, 0, 0, 0));
    const Glb glb = glb_of({"scene.csv"});
    const json& primitive = primitive_of(glb, glb.document.at("nodes").at(0));
    const auto points = glb.rows(primitive.at("attributes").at("POSITION"));
    const auto normals = glb.rows(primitive.at("attributes").at("NORMAL"));
    const auto indices = glb.rows(primitive.at("indices"));
    double enclosed = 0.0;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      const auto corner = [&](std::size_t k) { return points.at(static_cast<std::size_t>(indices[t + k][0])); };
      const auto a = corner(0), b = corner(1), c = corner(2);
      enclosed += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) /
                  6.0;
    }
    EXPECT_LE(enclosed, volume * (1 + 1e-6)) << body;
    EXPECT_GE(enclosed, volume * least) << body;
    for (std::size_t k = 0; k < normals.size(); ++k) {
      EXPECT_NEAR(std::hypot(normals[k][0], normals[k][1], normals[k][2]), 1.0, 1e-6);
      EXPECT_GE(points[k][0] * normals[k][0] + points[k][1] * normals[k][1] + points[k][2] * normals[k][2], 0.0)
          << body;
    }
  }
}

TEST_F(ScenePicture, TheLargestClusterStandsOut) {
  write_file("scene.csv", kSceneHeader + upright("sphere:1", 0, 0, 0) + upright("sphere:1", 1, 0, 0) +
                              upright("sphere:1", 4, 0, 0) + upright("sphere:1", 4, 1, 0) +
                              upright("sphere:1", 4, 2, 0) + upright("sphere:1", 0, 0, 7));
  const auto colours = [this](const Words& words) {
    Words all = {"scene.csv"};
    all.insert(all.end(), words.begin(), words.end());
    const Glb glb = glb_of(all);
    std::map<std::string, std::string> by_name;
    for (const json& node : glb.document.at("nodes")) {
      if (node.contains("mesh")) by_name[node.at("name")] = material_of(glb, node).at("name");
    }
    return by_name;
  };
  auto found = colours({"--query", "clusters"});
  for (const char* body : {"body 2", "body 3", "body 4"}) EXPECT_EQ(found[body], "stands out");
  EXPECT_EQ(found["body 0"], found["body 1"]);
  EXPECT_EQ(found["body 0"].rfind("cluster", 0), 0u);
  EXPECT_EQ(found["body 5"], "single");
  found = colours({"--box", "20,20,20"});
  for (const char* body : {"body 0", "body 1", "body 2", "body 3", "body 4"}) EXPECT_EQ(found[body], "stands out");
  EXPECT_EQ(found["body 5"], "body");
  EXPECT_EQ(found["box"], "box");
}

TEST_F(ScenePicture, ABodyIsShownInTheBox) {
  write_file("scene.csv", kSceneHeader + upright("sphere:1", 23, -19, 0.5));
  const Glb glb = glb_of({"scene.csv", "--box", "10,10,10"});
  EXPECT_EQ(glb.document.at("nodes").at(0).at("translation"), (json{3.0, 1.0, 0.5}));
  const json& box = glb.document.at("nodes").at(1);
  EXPECT_EQ(primitive_of(glb, box).at("mode"), 1);
  for (const std::vector<double>& corner : glb.rows(primitive_of(glb, box).at("attributes").at("POSITION"))) {
    for (const double coordinate : corner) EXPECT_EQ(std::fabs(coordinate), 5.0);
  }
}

TEST_F(ScenePicture, ManyBodiesAreInstances) {
  const Glb glb = glb_of({"--random", "10001,box:1,1,1,0.01", "--query", "any"});
  EXPECT_EQ(glb.document.at("extensionsRequired"), (json{"EXT_mesh_gpu_instancing"}));
  std::size_t n = 0;
  for (const json& node : glb.document.at("nodes")) {
    if (!node.contains("extensions")) continue;
    const json& attributes = node.at("extensions").at("EXT_mesh_gpu_instancing").at("attributes");
    const auto rotations = glb.rows(attributes.at("ROTATION"));
    EXPECT_EQ(glb.rows(attributes.at("TRANSLATION")).size(), rotations.size());
    for (const auto& q : rotations) {
      ASSERT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-6);
    }
    n += rotations.size();
  }
  EXPECT_EQ(n, 10001u);
  EXPECT_FALSE(glb_of({"--random", "10000,box:1,1,1,0.01", "--query", "any"}).document.contains("extensionsRequired"));
}

TEST_F(ScenePicture, WhatThirtyTwoBitsDoNotHoldIsRefused) {
  const auto refused = [this](const std::string& scene) {
    write_file("scene.csv", scene);
    const Finished finished = run({"scene.csv", "--quiet", "--gltf", "scene.glb"});
    EXPECT_EQ(finished.exit_code, 3);
    EXPECT_NE(finished.err.find("out of the range of glTF's 32-bit numbers"), std::string::npos) << finished.err;
    EXPECT_EQ(files(), std::vector<std::string>{"scene.csv"});
  };
  refused(kSceneHeader + upright("sphere:1e50", 0, 0, 0));
  refused(kSceneHeader + upright("sphere:1e-50", 0, 0, 0));
  refused(kSceneHeader + upright("sphere:1", 1e40, 0, 0));
}

TEST_F(ScenePicture, ThePictureOfTheStages) {
  EXPECT_EQ(run({"--random", "1000,box:1,1,1,0.3", "--svg", "stages.svg", "--json", "result.json"}).exit_code, 0);
  const std::string svg = read_file("stages.svg");
  EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  for (const json& stage : json::parse(read_file("result.json")).at("stages")) {
    const bool is_there = svg.find(">" + stage.at("name").get<std::string>() + "</text>") != std::string::npos;
    EXPECT_EQ(is_there, stage.at("seen") > 0) << stage;
  }
}

}  // namespace
}  // namespace vex::golden
