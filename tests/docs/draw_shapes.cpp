// Writes the pictures of docs/shapes, or the one of README:
//
//   cmake --build BUILD --target vex_draw_shapes && BUILD/bin/vex_draw_shapes meshes/data docs/shapes
//   BUILD/bin/vex_draw_shapes docs/excluded_volume/physics.svg
#include <exception>
#include <fstream>
#include <iostream>

#include "tests/docs/physics_picture.h"
#include "tests/docs/shape_pictures.h"

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: vex_draw_shapes FOLDER_OF_SAMPLE_MESHES FOLDER_FOR_PICTURES, or FILE.svg\n";
    return 2;
  }
  try {
    if (argc == 2) {
      write(argv[1], vex::physics_picture());
      return 0;
    }
    for (const vex::ShapePicture& picture : vex::shape_pictures(argv[1])) {
      write(std::filesystem::path(argv[2]) / (picture.name + ".svg"), picture.svg);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
