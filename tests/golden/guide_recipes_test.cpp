// The recipes of docs/guide.md, "Studies": each is run as it stands, and prints what stands below it.
#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/golden/program.h"

namespace vex::golden {
namespace {

struct Recipe {
  std::string commands;
  std::vector<std::string> printed;  // lines that the output has, whatever blanks are in them
};

std::string without_more_blanks(const std::string& text) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

std::vector<Recipe> recipes_of_the_guide() {
  std::ifstream file(std::string(VEX_SOURCE_DIR) + "/docs/guide.md");
  std::vector<Recipe> recipes;
  bool is_study = false, is_command = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) is_study = line.starts_with("## Studies");
    if (!is_study) continue;
    if (line == "```sh") {
      recipes.emplace_back();
      is_command = true;
    } else if (line == "```") {
      is_command = false;
    } else if (is_command) {
      recipes.back().commands += line + "\n";
    } else if (line.starts_with("    ") && !recipes.empty()) {
      recipes.back().printed.push_back(without_more_blanks(line));
    }
  }
  return recipes;
}

using GuideRecipes = ProgramTest;

TEST_F(GuideRecipes, RunAsTheyStand) {
  const std::filesystem::path programs = std::filesystem::path(VEX_SCAN_PROGRAM).parent_path();
  for (const char* mesh : {"cube.obj", "gem.obj", "tetrahedron.obj"}) {
    std::filesystem::copy_file(std::string(VEX_SOURCE_DIR) + "/meshes/data/" + mesh, folder() / mesh);
  }
  const std::vector<Recipe> recipes = recipes_of_the_guide();
  ASSERT_GE(recipes.size(), 23u);
  std::size_t n_printed = 0;
  for (const Recipe& recipe : recipes) {
    SCOPED_TRACE(recipe.commands);
    EXPECT_LE(std::ranges::count(recipe.commands, '\n'), 3);
    const Finished finished = shell("set -e; PATH='" + programs.string() + "':$PATH\n" + recipe.commands);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    const std::string printed = without_more_blanks(finished.out);
    for (const std::string& line : recipe.printed) {
      ++n_printed;
      EXPECT_NE(printed.find(line), std::string::npos) << line << "\nis not in\n" << finished.out;
    }
  }
  EXPECT_GE(n_printed, 7u);
  for (const char* name : {"rods.csv", "angles.svg", "pairs.jsonl", "transition.svg", "gem.html", "order.html",
                           "virials.html", "bidisperse.json", "rods_of_angle.csv", "spheres.svg", "mixed.json"}) {
    EXPECT_GT(std::filesystem::file_size(folder() / name), 200u) << name;
  }
}

}  // namespace
}  // namespace vex::golden
