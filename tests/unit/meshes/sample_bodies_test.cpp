#include "meshes/data/sample_bodies.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "meshes/convex_mesh.h"

namespace vex::tests {
namespace {

const std::filesystem::path kFolder = VEX_SAMPLE_BODIES;

ConvexMesh sample(const std::string& name) { return load(kFolder / name, {.convex_tolerance = 0.0}); }

double reduced_volume(const Measures& m) {
  return 2.0 * (1.0 + m.integrated_mean_curvature * m.surface_area / (4.0 * std::numbers::pi * m.volume));
}

TEST(SampleBodies, AreWhatTheirProgramWritesByteForByte) {
  for (const auto& [name, bytes] : sample_body_files()) {
    std::ifstream file(kFolder / name, std::ios::binary);
    std::ostringstream stored;
    stored << file.rdbuf();
    EXPECT_TRUE(stored.str() == bytes) << name;
  }
}

TEST(SampleBodies, AreConvexWithoutAnyTolerance) {
  for (const auto& [name, bytes] : sample_body_files()) {
    EXPECT_NO_THROW(static_cast<void>(sample(name))) << name;
  }
}

TEST(SampleBodies, GiveTheKnownExcludedVolumes) {
  EXPECT_NEAR(reduced_volume(sample("tetrahedron.obj").measures), 15.407431604, 1e-9);
  EXPECT_NEAR(reduced_volume(sample("cube.obj").measures), 11.0, 1e-12);
  EXPECT_NEAR(reduced_volume(sample("octahedron.obj").measures), 10.637976081, 1e-9);
  EXPECT_NEAR(reduced_volume(sample("dodecahedron.obj").measures), 9.121016679, 2e-9);
  EXPECT_NEAR(reduced_volume(sample("icosahedron.obj").measures), 8.915264469, 2e-9);
}

TEST(SampleBodies, KeepTheirPolygons) {
  EXPECT_EQ(sample("cube.obj").report.n_faces, 6U);
  EXPECT_EQ(sample("dodecahedron.obj").report.n_faces, 12U);
  EXPECT_EQ(sample("gem.obj").report.n_faces, 25U);
  EXPECT_EQ(sample("pebble.obj").report.n_vertices, 300U);
}

TEST(SampleBodies, TheIcosahedronIsTheSameBodyInEveryFormat) {
  const ConvexMesh obj = sample("icosahedron.obj");
  for (const char* name : {"icosahedron.stl", "icosahedron.ply", "icosahedron.off", "icosahedron.gltf"}) {
    const ConvexMesh other = sample(name);
    EXPECT_EQ(other.measures.volume, obj.measures.volume) << name;
    EXPECT_EQ(other.measures.surface_area, obj.measures.surface_area) << name;
    EXPECT_EQ(other.measures.integrated_mean_curvature, obj.measures.integrated_mean_curvature) << name;
    EXPECT_EQ(other.body.inradius(), obj.body.inradius()) << name;
    EXPECT_EQ(other.body.circumradius(), obj.body.circumradius()) << name;
    EXPECT_EQ(norm(other.body.centre() - obj.body.centre()), 0.0) << name;
    ASSERT_EQ(other.polytope().n_vertices(), obj.polytope().n_vertices()) << name;
    for (std::size_t i = 0; i < obj.polytope().n_vertices(); ++i) {
      EXPECT_EQ(norm(other.polytope().vertex(i) - obj.polytope().vertex(i)), 0.0) << name << " vertex " << i;
    }
  }
}

}  // namespace
}  // namespace vex::tests
