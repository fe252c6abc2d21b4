// The cells of a line of CSV (RFC 4180): separated by commas, and in quotation marks where they hold some.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vex {

class CsvCells {
 public:
  explicit CsvCells(std::string_view line) : rest_(line) {}

  /// The next cell without blanks around it, and without its quotation marks, of which two within a cell are one; none
  /// at the end of the line. Good until the next call. Throws InputError where a quotation mark has no end on its line,
  /// or where something stands beside a cell in quotation marks.
  std::optional<std::string_view> next();

 private:
  std::string_view quoted_cell();

  std::optional<std::string_view> rest_;
  std::string cell_;  // where two marks became one
};

/// As a cell: in quotation marks where it needs them.
std::string csv_cell(std::string_view text);

}  // namespace vex
