#include "apps/vex_scene/scene_file.h"

#include <array>
#include <optional>
#include <span>

#include "apps/common/append_number.h"
#include "apps/common/csv_cells.h"
#include "apps/common/line_reader.h"
#include "apps/common/pose_numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr std::array<std::string_view, 8> kQuaternionColumns = {"body", "x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr std::array<std::string_view, 13> kMatrixColumns = {"body", "x",   "y",   "z",   "r11", "r12", "r13",
                                                             "r21",  "r22", "r23", "r31", "r32", "r33"};
using Columns = std::span<const std::string_view>;

Columns columns_of_header(std::string_view line) {
  const std::string advice = std::string(" - the first line is ") + kSceneHeaders;
  std::vector<std::string> found;
  try {
    CsvCells cells(line);
    while (const std::optional<std::string_view> cell = cells.next()) found.emplace_back(*cell);
  } catch (const InputError&) {
    throw InputError("not a header of scenes (" + in_quotation_marks(line) + ")" + advice);
  }
  if (found.size() > 1 && is_a_number(found[1])) {
    throw InputError("the header is missing (a row with numbers, " + in_quotation_marks(line) + ")" + advice);
  }
  const bool is_matrix = found.size() > 4 && found[4] == kMatrixColumns[4];
  const Columns columns = is_matrix ? Columns(kMatrixColumns) : Columns(kQuaternionColumns);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k < found.size() && found[k] == columns[k]) continue;
    throw InputError("not a header of scenes (" + (k < found.size() ? in_quotation_marks(found[k]) : "nothing") +
                     " where " + std::string(columns[k]) + " is expected)" + advice);
  }
  if (found.size() > columns.size()) {
    throw InputError("not a header of scenes (a further column " + in_quotation_marks(found[columns.size()]) + ")" +
                     advice);
  }
  return columns;
}

// Rows of one file.
class Rows {
 public:
  using Names = std::map<std::string, std::string, std::less<>>;

  Rows(Columns columns, const Names& named, SceneInput& scene) : columns_(columns), named_(named), scene_(scene) {}

  void read(std::string_view line, std::uint64_t number) {
    CsvCells cells(line);
    const std::string_view body = *cells.next();
    if (body.empty()) throw InputError("no body (an empty cell) - give a body's text, or a name");
    const std::uint32_t shape = shape_of(body, number);
    std::size_t n_cells = 1;
    std::string problem;  // of a number; that there are too few or too many explains it better
    for (; const std::optional<std::string_view> cell = cells.next(); ++n_cells) {
      if (n_cells >= columns_.size() || !problem.empty()) continue;
      try {
        numbers_[n_cells] = cell_number(*cell, columns_[n_cells]);
      } catch (const InputError& error) {
        problem = error.what();
      }
    }
    if (n_cells != columns_.size()) {
      throw InputError("wrong number of columns (" + std::to_string(n_cells) + ") - the header has " +
                       std::to_string(columns_.size()) + "; a body's text that has commas stands in quotation marks");
    }
    if (!problem.empty()) throw InputError(problem);
    scene_.add(shape, pose());
  }

 private:
  // Rows that follow each other mostly have the same body.
  std::uint32_t shape_of(std::string_view body, std::uint64_t number) {
    if (body == last_body_) return last_shape_;
    const auto named = named_.find(body);
    last_shape_ = scene_.shape_of_text(named == named_.end() ? body : std::string_view(named->second), number);
    last_body_ = body;
    return last_shape_;
  }

  Transformd pose() const {
    const auto& n = numbers_;
    const Vec3d translation{n[1], n[2], n[3]};
    if (columns_.size() == kQuaternionColumns.size()) return pose_of_quaternion({n[4], n[5], n[6], n[7]}, translation);
    return pose_of_matrix({n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[1], n[2], n[3]});
  }

  Columns columns_;
  const Names& named_;
  SceneInput& scene_;
  std::array<double, kMatrixColumns.size()> numbers_{};
  std::string last_body_;  // no body at first: no text of one is empty
  std::uint32_t last_shape_ = 0;
};

}  // namespace

SceneInput read_scene_file(const std::string& path, const std::map<std::string, std::string, std::less<>>& named,
                           std::atomic<std::uint64_t>* n_lines) {
  LineReader file(path, "the scene");
  SceneInput scene(file.name());
  for (const auto& [name, text] : named) scene.shape_of_text(text, 0);
  std::string_view line;
  if (!file.next(line)) {
    throw InputError("the scene is empty (" + file.name() + ") - its first line is " + kSceneHeaders);
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.substr(0, kByteOrderMark.size()) == kByteOrderMark) line.remove_prefix(kByteOrderMark.size());
  std::uint64_t empty_line = 0;
  try {
    Rows rows(columns_of_header(line), named, scene);
    while (file.next(line)) {
      if (n_lines != nullptr) n_lines->store(file.number(), std::memory_order_relaxed);
      if (without_blanks(line).empty()) {
        if (empty_line == 0) empty_line = file.number();
      } else if (empty_line != 0) {
        throw InputError("an empty row (line " + std::to_string(empty_line) + ") before this one - remove it");
      } else {
        rows.read(line, file.number());
      }
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(file.name() + ", line ")) throw;
    throw InputError(file.name() + ", line " + std::to_string(file.number()) + ": " + error.what());
  }
  scene.open_line = file.open_line();
  return scene;
}

std::string scene_file_text(const SceneInput& scene) {
  std::string text;
  for (const std::string_view column : kMatrixColumns) {
    if (!text.empty()) text += ',';
    text += column;
  }
  text += '\n';
  std::vector<std::string> cells;
  for (const SceneInput::Shape& shape : scene.shapes()) cells.push_back(csv_cell(shape.text));
  for (std::size_t k = 0; k < scene.n_bodies(); ++k) {
    text += cells[scene.shapes_of_bodies[k]];
    const Transformd& pose = scene.poses[k];
    for (const Vec3d& v : {pose.translation, pose.row_x, pose.row_y, pose.row_z}) {
      for (const double coordinate : {v.x, v.y, v.z}) {
        text += ',';
        append_number(text, coordinate, "");
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace vex
