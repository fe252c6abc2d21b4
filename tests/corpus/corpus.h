// The corpus: files that this project writes, and what becomes of each. A row is a file; the table of all is one test.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshes/convex_mesh.h"
#include "solids.h"

namespace vex::tests {

struct Row {
  // --- the file, and how it is loaded
  std::string name;  // "obj: line ends of DOS"
  std::string file;  // its name; the extension tells the format
  std::string bytes;
  std::vector<std::pair<std::string, std::string>> beside = {};  // more files of its folder: names and bytes
  bool is_folder = false;
  bool from_standard_input = false;
  MeshOptions options = {};

  // --- the answer: a body,
  std::optional<Solid> body = std::nullopt;
  double coordinate_tolerance = 0.0;                      // of each vertex, a length; 0: bit for bit
  double measures_tolerance = 1e-12;                      // of V, S and M, relative
  std::vector<std::string> notes = {};                    // parts of what the report notes
  std::optional<CoordinateDigits> digits = std::nullopt;  // kind and number; the last place where it is not 0
  std::optional<std::string> unit = std::nullopt;
  std::optional<std::size_t> n_dropped = std::nullopt;

  // or a refusal, when there is none. Of the file: it names the file. Of what the file holds: it may leave that to the
  // programs.
  bool names_the_file = false;
  std::vector<std::string> fragments = {};  // parts of the message

  // --- set one after another, where a row is made
  Row& hull() { return options.hull = true, *this; }
  Row& read_as(const char* format) { return options.format = format, *this; }
  Row& converted_to(const char* unit_wanted) { return options.unit = unit_wanted, *this; }
  Row& welded_within(double fraction) { return options.weld = fraction, *this; }
  Row& convex_within(double fraction) { return options.convex_tolerance = fraction, *this; }
  Row& named(const char* file_name) { return file = file_name, *this; }
  Row& with_file(const std::string& file_name, const std::string& its_bytes) {
    return beside.emplace_back(file_name, its_bytes), *this;
  }
  Row& from_stdin() { return from_standard_input = true, *this; }
  Row& as_folder() { return is_folder = true, *this; }
  Row& within(double length, double relative) {
    return coordinate_tolerance = length, measures_tolerance = relative, *this;
  }
  Row& notes_that(const char* part) { return notes.emplace_back(part), *this; }
  Row& has_digits(CoordinateDigits::Kind kind, int n = 0, double last_place = 0.0) {
    return digits = CoordinateDigits{kind, n, last_place}, *this;
  }
  Row& has_unit(const char* name_of_it) { return unit = name_of_it, *this; }
  Row& drops(std::size_t n_vertices) { return n_dropped = n_vertices, *this; }
};

/// Rows of files of one format.
class Rows {
 public:
  /// `extension`: ".obj". `label`: what begins the rows' names; else the extension.
  explicit Rows(std::string extension, std::string label = "");

  /// Loads as `solid`.
  Row& is(const std::string& name, const std::string& bytes, const Solid& solid);
  /// The file is refused, with its name and all `fragments` in the message.
  Row& refused(const std::string& name, const std::string& bytes, std::vector<std::string> fragments = {});
  /// The file is read, and what it holds is refused.
  Row& no_body(const std::string& name, const std::string& bytes, std::vector<std::string> fragments = {});

  const std::vector<Row>& rows() const { return rows_; }

 private:
  Row& added(const std::string& name, const std::string& bytes);

  std::string extension_;
  std::string label_;
  std::vector<Row> rows_;
};

std::vector<Row> obj_rows();
std::vector<Row> obj_refusals();
std::vector<Row> off_rows();
std::vector<Row> ply_rows();
std::vector<Row> ply_refusals();
std::vector<Row> stl_rows();
std::vector<Row> point_rows();
std::vector<Row> vtk_rows();
std::vector<Row> msh_rows();
std::vector<Row> gltf_rows();
std::vector<Row> dae_and_3mf_rows();
std::vector<Row> rarer_rows();
std::vector<Row> gz_rows();
std::vector<Row> rounding_rows();
std::vector<Row> standard_input_rows();
std::vector<Row> every_format_rows();

/// All of them.
const std::vector<Row>& corpus();

}  // namespace vex::tests
