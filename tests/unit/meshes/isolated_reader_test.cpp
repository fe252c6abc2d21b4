#include "meshes/isolated_reader.h"

#include <dirent.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>

#include "meshes/assimp_reader.h"
#include "meshes/convex_mesh.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/reader.h"
#include "refusal.h"
#include "soups.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

std::string file_refusal(const std::filesystem::path& path) {
  return refusal_of([&] { static_cast<void>(load(path)); });
}

std::size_t n_open_files() {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    ++n;
  }
  return n;
}

TEST(IsolatedReader, BringsTheSameSoupAsReadingInThisProcess) {
  const TemporaryFolder folder;
  for (const char* extension : {".gltf", ".glb", ".dae", ".3mf", ".obj", ".stl"}) {
    const auto path = folder.file(std::string("a") + extension,
                                  mesh_bytes(sphere_soup(5, [](const Vec3d& v) { return v; }), extension));
    const AssimpInput input = prepare_for_assimp(path, extension);
    const PolygonSoup isolated = read_by_assimp_isolated(input);
    const PolygonSoup direct = read_by_assimp(input);
    EXPECT_EQ(isolated.corners, direct.corners);
    EXPECT_EQ(isolated.face_sizes, direct.face_sizes);
    EXPECT_EQ(isolated.n_parts, direct.n_parts);
    EXPECT_EQ(isolated.n_ignored_faces, direct.n_ignored_faces);
    EXPECT_EQ(isolated.unit, direct.unit);
    EXPECT_EQ(isolated.unit_metres, direct.unit_metres);
    EXPECT_EQ(isolated.digits.kind, direct.digits.kind);
    EXPECT_EQ(isolated.digits.last_place, direct.digits.last_place);
    EXPECT_GT(isolated.digits.last_place, 0.0);
    ASSERT_EQ(isolated.points.size(), direct.points.size());
    for (std::size_t i = 0; i < direct.points.size(); ++i) {
      EXPECT_EQ(isolated.points[i].x, direct.points[i].x);
      EXPECT_EQ(isolated.points[i].y, direct.points[i].y);
      EXPECT_EQ(isolated.points[i].z, direct.points[i].z);
    }
  }
}

TEST(IsolatedReader, LeavesNeitherProcessesNorOpenFilesBehind) {
  const TemporaryFolder folder;
  const auto good = folder.file("a.glb", glb(icosahedron_soup()));
  const auto bad = folder.file("b.x3d", std::string(500, 'x'));
  const std::size_t n_before = n_open_files();
  for (int i = 0; i < 20; ++i) {
    EXPECT_NO_THROW(static_cast<void>(load(good)));
    EXPECT_THROW(static_cast<void>(load(bad)), InputError);
  }
  EXPECT_EQ(n_open_files(), n_before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(IsolatedReader, WorksWhereTheCallerIgnoresItsChildren) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.glb", glb(icosahedron_soup()));
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_NO_THROW(static_cast<void>(load(path)));
  EXPECT_FALSE(file_refusal(folder.file("b.x3d", std::string(500, 'x'))).empty());
  std::signal(SIGCHLD, before);
}

TEST(IsolatedReader, IsNotDisturbedByASignalThatTheCallerHandles) {
  static volatile std::sig_atomic_t n_alarms = 0;
  const TemporaryFolder folder;
  const auto path = folder.file("a.dae", dae_text(sphere_soup(60, [](const Vec3d& v) { return v; })));
  struct sigaction action {};
  struct sigaction before {};
  action.sa_handler = [](int) { n_alarms = n_alarms + 1; };  // and no SA_RESTART
  ASSERT_EQ(::sigaction(SIGALRM, &action, &before), 0);
  ::ualarm(1000, 1000);
  const PolygonSoup soup = read_by_assimp_isolated(prepare_for_assimp(path, ".dae"));
  ::ualarm(0, 0);
  ::sigaction(SIGALRM, &before, nullptr);
  EXPECT_EQ(soup.face_sizes.size(), 20U * 60U * 60U);
  EXPECT_GT(n_alarms, 0);
}

TEST(IsolatedReader, RefusesBrokenFilesQuickly) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const std::string stl = stl_binary(icosahedron_soup());
  EXPECT_FALSE(file_refusal(folder.file("cut.stl", stl.substr(0, stl.size() / 2))).empty());
  EXPECT_FALSE(file_refusal(folder.file("text.stl", "this is no mesh\n")).empty());
  std::string ply = ply_binary(icosahedron_soup());
  const auto announce = [&ply](const std::string& what, const std::string& number) {
    std::string changed = ply;
    const std::size_t at = changed.find(what) + what.size();
    changed.replace(at, changed.find('\n', at) - at, number);
    return changed;
  };
  EXPECT_FALSE(file_refusal(folder.file("a.ply", announce("element vertex ", "4000000000"))).empty());
  EXPECT_FALSE(file_refusal(folder.file("b.ply", announce("element face ", "4000000000"))).empty());
  EXPECT_FALSE(file_refusal(folder.file("c.ply", announce("element vertex ", "-1"))).empty());
  EXPECT_FALSE(file_refusal(folder.file("d.off", "OFF\n4000000000 4000000000 0\n0 0 0\n")).empty());
  EXPECT_FALSE(file_refusal(folder.file("e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n")).empty());
  for (const char* faces :
       {"f 1 2 99\n", "f -1 -2 -99\n", "f 0 0 0\n", "f 99999999999999999999 1 2\n", "f a b c\n", "f\n"}) {
    EXPECT_FALSE(
        file_refusal(folder.file("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + std::string(faces))).empty());
  }
  for (const char* extension : {".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf"}) {
    EXPECT_FALSE(file_refusal(folder.file(std::string("zeros") + extension, std::string(10000, '\0'))).empty());
    EXPECT_FALSE(file_refusal(folder.file(std::string("noise") + extension, std::string(10000, '\xA7'))).empty());
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(IsolatedReader, RefusesNodesThatContainThemselves) {
  const TemporaryFolder folder;
  folder.file("b.bin", gltf_buffer(icosahedron_soup()));
  const std::string loop = R"([{"children": [1]}, {"children": [0], "mesh": 0}])";
  EXPECT_FALSE(file_refusal(folder.file("loop.gltf", gltf_text(icosahedron_soup(), "b.bin", loop))).empty());
  // Each node shows the next one twice: 2^40 bodies.
  std::string doubling = "[";
  for (int i = 0; i < 40; ++i) {
    const std::string next = std::to_string(i + 1);
    doubling += "{\"children\": [" + next + ", " + next + "]}, ";
  }
  doubling += "{\"mesh\": 0}]";
  EXPECT_FALSE(file_refusal(folder.file("many.gltf", gltf_text(icosahedron_soup(), "b.bin", doubling))).empty());
}

TEST(IsolatedReader, DoesNotCallAFileDamagedThatMakesAssimpCrash) {
  // Nodes nested too deep for a reader that calls itself, in a valid file.
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_STACK, &before), 0);
  struct rlimit usual = before;
  usual.rlim_cur = std::min<rlim_t>(before.rlim_cur, rlim_t{1} << 23U);
  ASSERT_EQ(::setrlimit(RLIMIT_STACK, &usual), 0);
  const TemporaryFolder folder;
  const int n_nodes = 200'000;
  std::string nodes = "[";
  for (int i = 1; i < n_nodes; ++i) nodes += "{\"children\": [" + std::to_string(i) + "]}, ";
  nodes += "{\"mesh\": 0}]";
  folder.file("b.bin", gltf_buffer(icosahedron_soup()));
  const std::string message = file_refusal(folder.file("deep.gltf", gltf_text(icosahedron_soup(), "b.bin", nodes)));
  ::setrlimit(RLIMIT_STACK, &before);
  EXPECT_TRUE(contains(message, "deep.gltf failed (assimp crashed with signal "));
  EXPECT_TRUE(contains(message, ") - the file may be damaged, or hold something that assimp cannot read: convert it"));
}

}  // namespace
}  // namespace vex::tests
