#include "apps/vex_pair/pose_text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr std::array<std::string_view, 12> kMatrixColumns = {"r11", "r12", "r13", "r21", "r22", "r23",
                                                             "r31", "r32", "r33", "tx",  "ty",  "tz"};
constexpr std::array<std::string_view, 7> kQuaternionColumns = {"tx", "ty", "tz", "qw", "qx", "qy", "qz"};

std::span<const std::string_view> columns_of(PoseFormat format) {
  if (format == PoseFormat::matrix) return kMatrixColumns;
  return kQuaternionColumns;
}

// Takes the text up to the next comma off the line; none where nothing is left.
class Cells {
 public:
  explicit Cells(std::string_view line) : rest_(line) {}

  std::optional<std::string_view> next() {
    if (!rest_) return std::nullopt;
    const std::size_t comma = rest_->find(',');
    const std::string_view cell = without_blanks(rest_->substr(0, comma));
    if (comma == std::string_view::npos) {
      rest_.reset();
    } else {
      rest_->remove_prefix(comma + 1);
    }
    return cell;
  }

 private:
  std::optional<std::string_view> rest_;
};

std::size_t number_of_cells(std::string_view line) {
  return static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
}

}  // namespace

PoseFormat format_of_header(std::string_view line) {
  const std::string advice = std::string(" - the first line is ") + kHeaders;
  const std::string_view first = *Cells(line).next();
  if (is_a_number(first)) {
    throw InputError("the header is missing (a row of numbers, " + in_quotation_marks(line) + ")" + advice);
  }
  const PoseFormat format = first == kMatrixColumns.front() ? PoseFormat::matrix : PoseFormat::quaternion;
  Cells cells(line);
  for (const std::string_view expected : columns_of(format)) {
    const std::optional<std::string_view> cell = cells.next();
    if (cell != expected) {
      throw InputError("not a header of poses (" + (cell ? in_quotation_marks(*cell) : "nothing") + " where " +
                       std::string(expected) + " is expected)" + advice);
    }
  }
  if (const std::optional<std::string_view> more = cells.next()) {
    throw InputError("not a header of poses (a further column " + in_quotation_marks(*more) + ")" + advice);
  }
  return format;
}

Transformd pose_of_row(std::string_view line, PoseFormat format) {
  const std::span<const std::string_view> columns = columns_of(format);
  if (without_blanks(line).empty()) {
    throw InputError("an empty row (it has no numbers) - remove it");
  }
  if (const std::size_t n = number_of_cells(line); n != columns.size()) {
    throw InputError("wrong number of columns (" + std::to_string(n) + ") - the header has " +
                     std::to_string(columns.size()));
  }
  std::array<double, 12> numbers{};
  Cells cells(line);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    numbers[k] = cell_number(*cells.next(), columns[k]);
  }
  if (format == PoseFormat::matrix) return pose_of_matrix(numbers);
  return pose_of_quaternion({numbers[3], numbers[4], numbers[5], numbers[6]}, {numbers[0], numbers[1], numbers[2]});
}

}  // namespace vex
