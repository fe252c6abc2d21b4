#include "tests/golden/pair.h"

#include <random>
#include <sstream>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "engine/numeric/quaternion.h"

namespace vex::golden {

using nlohmann::json;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<json> objects_of(const std::string& text) {
  std::vector<json> objects;
  for (const std::string& line : lines_of(text)) objects.push_back(json::parse(line));
  return objects;
}

std::vector<std::array<double, 7>> random_poses(std::size_t n) {
  std::mt19937_64 random(20020710);
  std::uniform_real_distribution<double> position(-1.4, 1.4);
  std::normal_distribution<double> component;
  std::vector<std::array<double, 7>> poses(n);
  for (std::array<double, 7>& pose : poses) {
    for (std::size_t k = 0; k < 7; ++k) pose[k] = k < 3 ? position(random) : component(random);
  }
  return poses;
}

std::string quaternion_file(const std::vector<std::array<double, 7>>& poses) {
  std::string text = kQuaternionHeader;
  for (const std::array<double, 7>& pose : poses) {
    for (std::size_t k = 0; k < 7; ++k) text += (k == 0 ? "" : ",") + shortest_number(pose[k]);
    text += '\n';
  }
  return text;
}

std::string matrix_file(const std::vector<std::array<double, 7>>& poses) {
  std::string text = kMatrixHeader;
  for (const auto& [tx, ty, tz, w, x, y, z] : poses) {
    Transformd pose = rotation_from_quaternion(w, x, y, z);
    pose.translation = {tx, ty, tz};
    std::string row;
    for (const double number : twelve_numbers(pose)) row += (row.empty() ? "" : ",") + hex_number(number);
    text += row + '\n';
  }
  return text;
}

Finished Pair::cubes(Words words) const {
  words.insert(words.begin(), {"box:1,1,1", "box:1,1,1"});
  return run(words);
}

void Pair::expect_wrong(const Words& words, int exit_code, const std::string& part) const {
  SCOPED_TRACE(testing::PrintToString(words));
  expect_refusal(cubes(words), exit_code, part, "vex_pair");
}

std::function<bool(pid_t)> Pair::has_answered() const {
  return [out = folder().string() + ".out"](pid_t) {
    std::error_code error;
    return std::filesystem::file_size(out, error) > 0 && !error;
  };
}

}  // namespace vex::golden
