// Files that are small for what they make a reader keep. It came about that files of 64 MiB were tried on vex 0.1: a
// line of semicolons took 33 times its size, a glTF of {} where accessors stand 40 times and 40 s of a processor, a
// list of empty words 17 times; a document of [[[... took vex_merge 61 times its size, and one of 4 MB whose object had
// 400 000 keys more than a minute. 64 000 points of which each is farther out than the one before took --hull a minute.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/vex_merge/documents.h"
#include "meshes/convex_mesh.h"
#include "refusal.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

std::string repeated(const std::string& text, std::size_t n) {
  std::string all;
  for (std::size_t k = 0; k < n; ++k) all += text;
  return all;
}

class CraftedSizes : public testing::Test {
 protected:
  void expect_mesh_refused(const std::string& name, const std::string& bytes, const std::string& reason) const {
    const std::filesystem::path path = folder_.file(name, bytes);
    const std::string message = refusal_of([&] { static_cast<void>(load(path, {.hull = true})); });
    EXPECT_TRUE(contains(message, reason)) << name;
    EXPECT_TRUE(contains(message, " - ")) << name;
  }
  void expect_document_refused(const std::string& text, const std::string& reason) const {
    const std::filesystem::path path = folder_.file("a.json", text);
    const std::string message = refusal_of([&] { static_cast<void>(read_document(path.string())); });
    EXPECT_TRUE(contains(message, reason));
    EXPECT_TRUE(contains(message, path.string()));
  }

  const TemporaryFolder folder_;
};

constexpr std::size_t kMany = 200'000;

TEST_F(CraftedSizes, OfLinesWithoutAnEndAreRefused) {
  const std::string reason = "a line of more than 10000 fields";
  expect_mesh_refused("a.csv", repeated(";", kMany), reason);
  expect_mesh_refused("b.csv", repeated("0,", kMany), reason);
  expect_mesh_refused("a.txt", repeated("0 ", kMany), reason);
  expect_mesh_refused("b.txt", "0 0 0\n" + repeated("0 ", kMany), "a line of 10001 fields");
}

TEST_F(CraftedSizes, OfLinesOfTenThousandFieldsAreNot) {
  const std::string rest = repeated(" 0.5", 9'997) + "\n";
  const ConvexMesh mesh = load(
      folder_.file("a.xyz", "0.5 0 0" + rest + "1 0 0.5" + rest + "0 1 0" + rest + "0 0 1" + rest), {.hull = true});
  EXPECT_EQ(mesh.report.n_vertices, 4U);
}

TEST_F(CraftedSizes, OfPartsThatMeanNothingAreRefused) {
  const std::string begin = R"({"asset":{"version":"2.0"},)";
  const std::string damaged = "the file is no JSON, or is damaged";
  expect_mesh_refused("accessors.gltf", begin + R"("accessors":[{})" + repeated(",{}", kMany) + "]}", damaged);
  expect_mesh_refused("views.gltf", begin + R"("bufferViews":[{})" + repeated(",{}", kMany) + "]}", damaged);
  // Also where nothing stands behind the list.
  expect_mesh_refused(
      "extensions.gltf",
      begin + R"("extensionsRequired":["KHR_texture_a")" + repeated(R"(,"KHR_texture_a")", kMany) + "]}", damaged);
  expect_mesh_refused("deep.amf", "<amf>" + repeated("<a>", kMany), "elements lie more than 1000 deep");
}

TEST_F(CraftedSizes, OfDocumentsAreRefused) {
  const std::string begin = R"({"seed":1,"estimate":{},"tally":)";
  expect_document_refused(repeated("[", kMany), "more than 64 levels deep");
  expect_document_refused(repeated(R"({"a":)", kMany), "more than 64 levels deep");
  expect_document_refused(begin + "[0" + repeated(",0", std::size_t{1} << 22U) + "]}", "values in so short a text");
  std::string keys = begin + "{";
  for (std::size_t k = 0; k < kMany; ++k) keys += "\"" + std::to_string(k) + "\":0,";
  expect_document_refused(keys + R"("b":0}})", "an object of more than 1000 keys");
  expect_document_refused(begin + "{" + repeated(R"("a":0,)", kMany) + R"("b":0}})",
                          "an object of more than 1000 keys");
}

TEST(PointsThatGrowFromOneToTheNext, HaveTheirHullSoon) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 16'000; ++i) points.push_back({std::pow(1.0005, i), std::pow(1.0007, i), std::pow(1.0011, i)});
  const ConvexMesh mesh = hull_of(points);
  EXPECT_GT(mesh.report.n_vertices, 4U);
  EXPECT_GT(mesh.measures.volume, 0.0);
}

}  // namespace
}  // namespace vex::tests
