#include "tests/docs/shape_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "shapes/any_shape.h"

namespace vex {
namespace {

const std::filesystem::path kRoot = VEX_SOURCE_DIR;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

const std::vector<ShapePicture>& pictures() {
  static const std::vector<ShapePicture> all = shape_pictures(kRoot / "meshes/data");
  return all;
}

TEST(ShapePictures, AreTheBodiesAsTheEngineSeesThem) {
  for (const ShapePicture& picture : pictures()) {
    // Not EXPECT_EQ: it would print both files.
    EXPECT_TRUE(picture.svg == text_of(kRoot / "docs/shapes" / (picture.name + ".svg")))
        << picture.name << ".svg differs - if the body was meant to change, draw it again with vex_draw_shapes";
    EXPECT_LT(picture.svg.size(), 40'000u) << picture.name;
  }
}

TEST(ShapePictures, NoneIsLeftOver) {
  std::size_t n_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "docs/shapes")) {
    if (entry.path().extension() == ".svg") ++n_files;
  }
  EXPECT_EQ(n_files, pictures().size());
}

TEST(ShapePictures, EveryNamedBodyHasOne) {
  for (const NamedShape& shape : named_shapes()) {
    const auto has_name = [&](const ShapePicture& picture) { return picture.name == shape.name; };
    EXPECT_TRUE(std::ranges::any_of(pictures(), has_name)) << shape.name << " - add it to shape_pictures.cpp";
  }
}

TEST(ShapesPage, HasASectionWithPictureForEveryNamedBody) {
  const std::string page = text_of(kRoot / "docs/shapes.md");
  for (const NamedShape& shape : named_shapes()) {
    const std::string name(shape.name);
    const std::string heading = "\n## " + name + "\n";
    const std::size_t start = page.find(heading);
    ASSERT_NE(start, std::string::npos) << "docs/shapes.md has no section of " << name;
    const std::size_t end = page.find("\n## ", start + 1);
    const std::string section = page.substr(start, end == std::string::npos ? end : end - start);
    EXPECT_NE(section.find("(shapes/" + name + ".svg)"), std::string::npos) << name << ": no picture";
    EXPECT_NE(section.find("`" + name + ":" + std::string(shape.parameters) + "`"), std::string::npos)
        << name << ": does not say how it is written";
  }
}

}  // namespace
}  // namespace vex
