// Writes the bodies of meshes/data into the folder named on the command line, or the current one.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "meshes/data/sample_bodies.h"

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
  for (const auto& [name, bytes] : vex::sample_body_files()) {
    std::ofstream file(folder / name, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) {
      std::fprintf(stderr, "cannot write %s\n", (folder / name).c_str());
      return 1;
    }
    std::printf("%s\n", (folder / name).c_str());
  }
  return 0;
}
