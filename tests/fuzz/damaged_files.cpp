// Files of every format that vex reads, damaged: what became of each, how long it took and how much memory.
//
//   vex_damaged_files [FILES_A_FORMAT [SEED]]     (default 300, 1)
//
// Two bodies are written by our own writers, and by assimp's exporters in the formats that those write. A parent that
// crashes ends this program; a file that takes more than ten seconds, or ends otherwise than in a body or an
// InputError, is kept, named and makes it exit with 1.
#include <assimp/scene.h>
#include <sys/resource.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/convex_mesh.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/machine_memory.h"
#include "meshes/reader.h"
#include "soups.h"
#include "temporary_folder.h"
#include "tests/fuzz/mutator.h"

namespace vex::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kMostSeconds = 10.0;

using Seeds = std::map<std::string, std::vector<std::string>>;  // whole files, by extension

std::string xyz_text(const PolygonSoup& soup) {
  std::string text;
  for (const Vec3d& p : soup.points) {
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  return text;
}

std::string vtk_text(const PolygonSoup& soup) {
  std::string text = "# vtk DataFile Version 3.0\nbody\nASCII\nDATASET POLYDATA\nPOINTS " +
                     std::to_string(soup.points.size()) + " double\n" + xyz_text(soup) + "POLYGONS " +
                     std::to_string(soup.face_sizes.size()) + " " +
                     std::to_string(soup.face_sizes.size() + soup.corners.size()) + "\n";
  std::size_t corner = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    text += std::to_string(size);
    for (std::uint32_t k = 0; k < size; ++k) text += " " + std::to_string(soup.corners[corner++]);
    text += "\n";
  }
  return text;
}

std::string gmsh_text(const PolygonSoup& triangles) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(triangles.points.size()) + "\n";
  for (std::size_t i = 0; i < triangles.points.size(); ++i) {
    const Vec3d& p = triangles.points[i];
    text += std::to_string(i + 1) + " " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
            "\n";
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(triangles.face_sizes.size()) + "\n";
  for (std::size_t t = 0; t < triangles.face_sizes.size(); ++t) {
    text += std::to_string(t + 1) + " 2 2 0 1";
    for (std::size_t k = 0; k < 3; ++k) text += " " + std::to_string(triangles.corners[3 * t + k] + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

/// Each format that assimp writes and vex reads by it, of a body.
void add_exported(const PolygonSoup& soup, Seeds* seeds) {
  Assimp::Importer importer;
  const std::string obj = obj_text(soup);
  const aiScene* const scene = importer.ReadFileFromMemory(obj.data(), obj.size(), 0, "obj");
  Assimp::Exporter exporter;
  for (std::size_t k = 0; scene != nullptr && k < exporter.GetExportFormatCount(); ++k) {
    const aiExportFormatDesc* const format = exporter.GetExportFormatDescription(k);
    const std::string extension = "." + std::string(format->fileExtension);
    if (!names_a_mesh_format("a" + extension)) continue;
    const aiExportDataBlob* const blob = exporter.ExportToBlob(scene, format->id, 0);
    if (blob == nullptr || blob->data == nullptr) continue;
    (*seeds)[extension].emplace_back(static_cast<const char*>(blob->data), blob->size);
  }
}

Seeds seeds() {
  Seeds seeds;
  for (const PolygonSoup& soup : {icosahedron_soup(), capsule_soup(8, 3)}) {
    for (const char* extension : {".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".dae", ".3mf"}) {
      seeds[extension].push_back(mesh_bytes(soup, extension));
    }
    seeds[".stl"].push_back(stl_text(soup));
    seeds[".ply"].push_back(ply_text(soup));
    for (const char* extension : {".xyz", ".csv", ".txt"}) seeds[extension].push_back(xyz_text(soup));
    seeds[".vtk"].push_back(vtk_text(soup));
    seeds[".msh"].push_back(gmsh_text(triangulated(soup)));
    add_exported(triangulated(soup), &seeds);
  }
  return seeds;
}

struct Outcomes {
  std::size_t n_bodies = 0, n_refused = 0, n_crashed = 0, n_over_limits = 0;
  std::size_t n_wrong = 0;  // what must not be
  double slowest = 0.0;
};

/// What becomes of one file; "" or why it must not be.
std::string try_file(const fs::path& path, bool hull, Outcomes* outcomes) {
  std::string wrong;
  const auto start = std::chrono::steady_clock::now();
  try {
    static_cast<void>(load(path, {.hull = hull}));
    ++outcomes->n_bodies;
  } catch (const InputError& error) {
    const std::string message = error.what();
    const auto says = [&message](const char* text) { return message.find(text) != std::string::npos; };
    if (says("assimp crashed with signal")) {
      ++outcomes->n_crashed;
    } else if (says("of processor time)") || says("MiB of memory)") || says("it took more than")) {
      ++outcomes->n_over_limits;
    } else {
      ++outcomes->n_refused;
    }
    if (!says(" - ")) wrong = "no advice: " + message;
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcomes->slowest = std::max(outcomes->slowest, seconds);
  if (seconds > kMostSeconds + 1.0) wrong = "it took " + std::to_string(seconds) + " s";
  return wrong;
}

double peak_mib(int who) {
  struct rusage usage {};
  ::getrusage(who, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

int campaign(std::size_t n_files, std::uint64_t seed) {
  const TemporaryFolder folder;
  Outcomes all;
  std::size_t n_formats = 0;
  std::printf("%-10s %7s %7s %7s %7s %7s %9s\n", "format", "files", "bodies", "refused", "crashed", "limits",
              "slowest");
  for (const auto& [extension, files] : seeds()) {
    Outcomes outcomes;
    Mutator mutator(seed * 1000003 + std::hash<std::string>{}(extension));
    for (std::size_t i = 0; i < n_files; ++i) {
      const fs::path path = folder.file("damaged" + extension, mutator.mutated(files[i % files.size()]));
      const std::string wrong = try_file(path, i % 2 == 0, &outcomes);
      if (wrong.empty()) continue;
      ++outcomes.n_wrong;
      const fs::path kept = fs::temp_directory_path() / ("vex-damaged-" + std::to_string(i) + extension);
      fs::copy_file(path, kept, fs::copy_options::overwrite_existing);
      std::printf("WRONG: %s: %s\n", kept.c_str(), wrong.c_str());
    }
    std::printf("%-10s %7zu %7zu %7zu %7zu %7zu %8.2fs\n", extension.c_str(), n_files, outcomes.n_bodies,
                outcomes.n_refused, outcomes.n_crashed, outcomes.n_over_limits, outcomes.slowest);
    std::fflush(stdout);
    ++n_formats;
    all.n_bodies += outcomes.n_bodies;
    all.n_refused += outcomes.n_refused;
    all.n_crashed += outcomes.n_crashed;
    all.n_over_limits += outcomes.n_over_limits;
    all.n_wrong += outcomes.n_wrong;
    all.slowest = std::max(all.slowest, outcomes.slowest);
  }
  std::printf(
      "%zu files of %zu formats: %zu bodies, %zu refused, %zu with a crash of the reader's process, %zu at its "
      "limits; %zu wrong\nslowest %.2f s; peak memory of this process %.0f MiB, of a reader's %.0f MiB\n",
      n_files * n_formats, n_formats, all.n_bodies, all.n_refused, all.n_crashed, all.n_over_limits, all.n_wrong,
      all.slowest, peak_mib(RUSAGE_SELF), peak_mib(RUSAGE_CHILDREN));
  return all.n_wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace vex::tests

int main(int argc, char** argv) {
  const auto number = [&](int k, std::uint64_t otherwise) {
    return argc > k ? std::strtoull(argv[k], nullptr, 10) : otherwise;
  };
  return vex::tests::campaign(number(1, 300), number(2, 1));
}
