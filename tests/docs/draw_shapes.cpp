// Writes the pictures of docs/shapes:
//
//   cmake --build BUILD --target vex_draw_shapes && BUILD/bin/vex_draw_shapes meshes/data docs/shapes
#include <exception>
#include <fstream>
#include <iostream>

#include "tests/docs/shape_pictures.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: vex_draw_shapes FOLDER_OF_SAMPLE_MESHES FOLDER_FOR_PICTURES\n";
    return 2;
  }
  try {
    for (const vex::ShapePicture& picture : vex::shape_pictures(argv[1])) {
      std::ofstream file(std::filesystem::path(argv[2]) / (picture.name + ".svg"), std::ios::binary);
      file << picture.svg;
      if (!file.flush()) throw std::runtime_error("cannot write " + picture.name + ".svg");
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
