// Mutated mesh files: whatever is in a file, loading it ends in a body or an InputError, and soon.
//
// Deterministic and bounded, so that it is a test and not a campaign: VEX_FUZZ_FILES=100000 in the environment makes it
// one, VEX_FUZZ_SEED another. A file that fails is kept and named.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/convex_mesh.h"
#include "meshes/data/mesh_writers.h"
#include "mutator.h"
#include "soups.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kFiles = 80;  // there a reader that takes memory until its limit takes long
#else
constexpr std::uint64_t kFiles = 300;
#endif

class MeshFileFuzz : public ::testing::TestWithParam<const char*> {};

TEST_P(MeshFileFuzz, EndsInABodyOrAnInputErrorWithinTime) {
  const std::string extension = GetParam();
  const TemporaryFolder folder;
  Mutator mutator(from_environment("VEX_FUZZ_SEED", 1) * 1000003 + std::hash<std::string>{}(extension));
  const std::uint64_t n_files = from_environment("VEX_FUZZ_FILES", kFiles);
  const std::vector<PolygonSoup> soups{icosahedron_soup(), box_soup({-1, -1, -1}, {1, 2, 3}), capsule_soup(8, 3)};
  std::size_t n_bodies = 0;
  std::size_t n_refused = 0;
  for (std::uint64_t i = 0; i < n_files; ++i) {
    const std::string bytes = mutator.mutated(mesh_bytes(soups[i % soups.size()], extension));
    const auto path = folder.file("fuzz" + extension, bytes);
    const auto start = std::chrono::steady_clock::now();
    bool fine = true;
    try {
      MeshOptions options;
      options.hull = i % 2 == 0;  // a moved point leaves few surfaces convex, but a hull is a body all the same
      const ConvexMesh mesh = load(path, options);
      ++n_bodies;
      fine = mesh.measures.volume > 0.0 && std::isfinite(mesh.measures.volume) && mesh.measures.surface_area > 0.0 &&
             mesh.measures.integrated_mean_curvature > 0.0 && mesh.body.inradius() >= 0.0 &&
             mesh.body.circumradius() > 0.0;
    } catch (const InputError& error) {
      ++n_refused;
      fine = std::string(error.what()).find(" - ") != std::string::npos;  // problem - what to do
    } catch (const std::exception& error) {
      fine = false;
      ADD_FAILURE() << error.what();
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (!fine || taken.count() > 30.0) {
      const auto kept = std::filesystem::temp_directory_path() / ("vex-fuzz-" + std::to_string(i) + extension);
      std::filesystem::copy_file(path, kept, std::filesystem::copy_options::overwrite_existing);
      ADD_FAILURE() << "file " << i << " kept as " << kept << ", " << taken.count() << " s";
    }
  }
  std::printf("%s: %zu bodies, %zu refused\n", extension.c_str(), n_bodies, n_refused);
  EXPECT_GT(n_refused, n_files / 10);  // or the mutations are no test
  EXPECT_GT(n_bodies, 0U);
}

INSTANTIATE_TEST_SUITE_P(AllFormats, MeshFileFuzz,
                         ::testing::Values(".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf"),
                         [](const auto& test) { return std::string(test.param + 1); });

}  // namespace
}  // namespace vex::tests
