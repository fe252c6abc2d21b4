// The pictures of docs/shapes: one of every named body, and two of mesh files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vex {

struct ShapePicture {
  std::string name;  // of the body, and of its file: NAME.svg
  std::string svg;
};

/// `meshes`: the folder of the sample meshes. A named body that is missing here makes the test of the pictures fail.
std::vector<ShapePicture> shape_pictures(const std::filesystem::path& meshes);

}  // namespace vex
