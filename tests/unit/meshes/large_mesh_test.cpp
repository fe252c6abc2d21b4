// A million triangles: what is linear stays linear. Times are a benchmark's matter; a wall far above them only catches
// what would be quadratic.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "meshes/convex_mesh.h"
#include "meshes/data/mesh_writers.h"
#include "soups.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr int kCuts = 50;  // 50 000 triangles
#else
constexpr int kCuts = 224;  // 1 003 520 triangles
#endif

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

long peak_mebibytes(int who) {
  struct rusage usage {};
  ::getrusage(who, &usage);
  return usage.ru_maxrss / 1024;
}

TEST(LargeMesh, OfAMillionTrianglesIsReadCheckedAndMeasured) {
  const TemporaryFolder folder;
  const PolygonSoup soup = sphere_soup(kCuts, [](const Vec3d& v) { return Vec3d{3 * v.x, 2 * v.y, 1.5 * v.z}; });
  for (const char* extension : {".ply", ".stl"}) {
    const auto path = folder.file(std::string("large") + extension, mesh_bytes(soup, extension));
    const Stopwatch watch;
    const ConvexMesh mesh = load(path);
    std::printf("%s: %zu triangles in %.2f s; peak %ld MiB here, %ld MiB in the reader\n", extension,
                mesh.report.n_triangles, watch.seconds(), peak_mebibytes(RUSAGE_SELF), peak_mebibytes(RUSAGE_CHILDREN));
    EXPECT_EQ(mesh.report.n_triangles, soup.face_sizes.size());
    EXPECT_FALSE(mesh.report.hull_used);
    EXPECT_NEAR(mesh.measures.volume, 4.0 / 3.0 * 3.14159265358979 * 9.0, 0.1);
  }
}

TEST(LargeMesh, OfHalfAMillionVerticesThatNeedsItsHullIsMeasured) {
  const PolygonSoup soup = capsule_soup(3 * kCuts, 2 * kCuts - 48);
  const Stopwatch watch;
  const ConvexMesh mesh = convex_mesh_from(soup);
  std::printf("capsule: %zu vertices in %.2f s; peak %ld MiB\n", mesh.report.n_vertices, watch.seconds(),
              peak_mebibytes(RUSAGE_SELF));
  EXPECT_TRUE(mesh.report.hull_used);
  EXPECT_NEAR(mesh.measures.integrated_mean_curvature, 6.0 * 3.14159265358979, 0.01);
}

TEST(LargeMesh, OfAMillionPointsHasItsHullTaken) {
  const int n = 20 * kCuts * kCuts;  // 1 003 520
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto direction = [&] {
    const Vec3d p{normal(random), normal(random), normal(random)};
    return (1.0 / norm(p)) * p;
  };
  const TemporaryFolder folder;
  for (const std::string kind : {"ball", "cube", "sphere"}) {
    std::vector<Vec3d> points;
    for (int i = 0; i < n; ++i) {
      points.push_back(kind == "ball"   ? std::cbrt(0.5 * (uniform(random) + 1.0)) * direction()
                       : kind == "cube" ? Vec3d{uniform(random), uniform(random), uniform(random)}
                                        : direction());
    }
    const auto path = folder.file(kind + ".ply", ply_binary(soup_of(points, {})));
    points = {};
    const Stopwatch watch;
    const ConvexMesh mesh = load(path, {.hull = true});
    std::printf("%s: hull of %zu points has %zu vertices, in %.2f s; peak %ld MiB\n", kind.c_str(),
                mesh.report.n_points, mesh.report.n_vertices, watch.seconds(), peak_mebibytes(RUSAGE_SELF));
    EXPECT_NEAR(mesh.measures.volume, kind == "cube" ? 8.0 : 4.0 / 3.0 * 3.14159265358979, 0.1);
  }
}

TEST(LargeMesh, WithAVertexThatEveryFaceSharesIsMeasured) {
  const PolygonSoup soup = revolution_soup(10 * kCuts * kCuts, {{1.0, 0.0}}, -1.0, 1.0);
  const Stopwatch watch;
  const ConvexMesh mesh = convex_mesh_from(soup);
  std::printf("double cone: %zu triangles in %.2f s\n", mesh.report.n_faces, watch.seconds());
  EXPECT_NEAR(mesh.measures.volume, 2.0 / 3.0 * 3.14159265358979, 1e-3);
}

}  // namespace
}  // namespace vex::tests
