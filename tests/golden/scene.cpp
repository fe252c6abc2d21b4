#include "tests/golden/scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "apps/common/numbers.h"

namespace vex::golden {
namespace {

std::uint32_t word_at(const std::string& text, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word |= std::uint32_t{static_cast<unsigned char>(text.at(at + k))} << (8 * k);
  return word;
}

std::size_t columns_of(const nlohmann::json& accessor) {
  const std::string type = accessor.at("type");
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
}

std::size_t bytes_of(const nlohmann::json& accessor) { return accessor.at("componentType") == 5123 ? 2 : 4; }

}  // namespace

std::string upright(const std::string& body, double x, double y, double z) {
  std::string row = "\"" + body + "\"";
  for (const double number : {x, y, z, 1.0, 0.0, 0.0, 0.0}) row += "," + shortest_number(number);
  return row + "\n";
}

Finished SceneTest::run_on(const std::string& content, Words words) const {
  write_file("scene.csv", content);
  words.insert(words.begin(), "scene.csv");
  Finished finished = run(words);
  EXPECT_EQ(finished.exit_code, 0) << testing::PrintToString(words) << "\n" << finished.err;
  return finished;
}

std::string SceneTest::rows_of(const std::string& content, Words words) const {
  words.emplace_back("--quiet");
  const Finished finished = run_on(content, words);
  EXPECT_EQ(finished.err, "");
  return finished.out;
}

void SceneTest::expect_refused(const std::string& content, const Words& words, int exit_code,
                               const std::string& part) const {
  SCOPED_TRACE(testing::PrintToString(words) + "\n" + content);
  write_file("scene.csv", content);
  Words all = {"scene.csv", "--json", "result.json", "--save", "saved.csv", "--svg", "stages.svg"};
  all.insert(all.end(), words.begin(), words.end());
  expect_refusal(run(all), exit_code, part, "vex_scene");
  for (const char* name : {"result.json", "saved.csv", "stages.svg"}) {
    EXPECT_FALSE(std::filesystem::exists(folder() / name)) << name;
  }
}

Glb::Glb(const std::string& file) {
  if (file.size() < 20 || file.substr(0, 4) != "glTF" || word_at(file, 4) != 2 || word_at(file, 8) != file.size()) {
    fault = "no head of a binary glTF file of this size";
    return;
  }
  std::size_t at = 12;
  while (at < file.size()) {
    const std::size_t size = word_at(file, at);
    const std::string type = file.substr(at + 4, 4);
    if (size % 4 != 0 || at + 8 + size > file.size()) {
      fault = "a chunk that does not fit";
      return;
    }
    const std::string content = file.substr(at + 8, size);
    if (type == "JSON") document = nlohmann::json::parse(content, nullptr, false);
    if (type == std::string("BIN\0", 4)) numbers = content;
    at += 8 + size;
  }
  fault = document.is_object() ? fault_of_accessors() : "no JSON";
}

std::vector<std::vector<double>> Glb::rows(std::size_t index) const {
  const nlohmann::json& accessor = document.at("accessors").at(index);
  const nlohmann::json& view = document.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const std::size_t n_columns = columns_of(accessor), n_bytes = bytes_of(accessor);
  std::size_t at = view.at("byteOffset");
  std::vector<std::vector<double>> rows(accessor.at("count").get<std::size_t>());
  for (std::vector<double>& row : rows) {
    for (std::size_t k = 0; k < n_columns; ++k, at += n_bytes) {
      if (n_bytes == 2) {
        row.push_back(static_cast<unsigned char>(numbers.at(at)) +
                      256.0 * static_cast<unsigned char>(numbers.at(at + 1)));
      } else if (accessor.at("componentType") == 5125) {
        row.push_back(word_at(numbers, at));
      } else {
        const std::uint32_t bits = word_at(numbers, at);
        float value = 0.0F;
        std::memcpy(&value, &bits, sizeof value);
        row.push_back(value);
      }
    }
  }
  return rows;
}

std::string Glb::fault_of_accessors() const {
  if (!document.contains("accessors")) return "";
  for (std::size_t k = 0; k < document.at("accessors").size(); ++k) {
    const nlohmann::json& accessor = document.at("accessors")[k];
    const nlohmann::json& view = document.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::size_t begin = view.at("byteOffset"), size = view.at("byteLength");
    const std::string name = "accessor " + std::to_string(k) + ": ";
    if (begin % 4 != 0 || begin + size > numbers.size()) return name + "outside of the buffer, or not aligned";
    if (size != accessor.at("count").get<std::size_t>() * columns_of(accessor) * bytes_of(accessor)) {
      return name + "not as large as its part of the buffer";
    }
    const auto all = rows(k);
    for (std::size_t c = 0; c < columns_of(accessor); ++c) {
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (const std::vector<double>& row : all) {
        least = std::min(least, row[c]);
        most = std::max(most, row[c]);
      }
      if (accessor.at("min").at(c) != least || accessor.at("max").at(c) != most)
        return name + "bounds that are not its";
    }
  }
  return "";
}

}  // namespace vex::golden
