#include "apps/common/csv_cells.h"

#include "apps/common/pose_numbers.h"
#include "engine/numeric/errors.h"

namespace vex {

std::optional<std::string_view> CsvCells::next() {
  if (!rest_) return std::nullopt;
  const std::size_t first = rest_->find_first_not_of(" \t");
  if (first != std::string_view::npos && (*rest_)[first] == '"') {
    rest_->remove_prefix(first);
    return quoted_cell();
  }
  const std::size_t comma = rest_->find(',');
  const std::string_view cell = without_blanks(rest_->substr(0, comma));
  if (comma == std::string_view::npos) {
    rest_.reset();
  } else {
    rest_->remove_prefix(comma + 1);
  }
  return cell;
}

std::string_view CsvCells::quoted_cell() {
  const std::string_view text = *rest_;
  std::size_t end = text.find('"', 1);
  bool has_marks_within = false;
  while (end != std::string_view::npos && end + 1 < text.size() && text[end + 1] == '"') {
    has_marks_within = true;
    end = text.find('"', end + 2);
  }
  if (end == std::string_view::npos) {
    throw InputError("a quotation mark without its end (" + in_quotation_marks(text) + ") - end it on the same line");
  }
  const std::size_t comma = text.find(',', end);
  if (const std::string_view more = without_blanks(text.substr(end + 1, comma - end - 1)); !more.empty()) {
    throw InputError("something beside a cell in quotation marks (" + in_quotation_marks(more) +
                     ") - put the whole cell in them, and write a mark within it twice");
  }
  if (comma == std::string_view::npos) {
    rest_.reset();
  } else {
    rest_->remove_prefix(comma + 1);
  }
  const std::string_view cell = text.substr(1, end - 1);
  if (!has_marks_within) return cell;
  cell_.clear();
  for (std::size_t k = 0; k < cell.size(); ++k) {
    cell_ += cell[k];
    if (cell[k] == '"') ++k;
  }
  return cell_;
}

std::string csv_cell(std::string_view text) {
  const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos && without_blanks(text) == text;
  if (is_plain) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

}  // namespace vex
