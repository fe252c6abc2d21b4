// Answers as rows of text: for eyes, as JSON lines, and as CSV.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/vex_pair/answer.h"

namespace vex {

/// What a row holds.
struct RowLayout {
  enum class Format { screen, jsonl, csv };
  Format format = Format::screen;
  bool with_certificate = false;
  bool with_error = false;  // a column for it in CSV: bad rows do not end the run
  Query query = Query::overlap;

  /// The same rows as a document has them.
  RowLayout of_json() const { return {Format::jsonl, with_certificate, false, query}; }
};

/// Of CSV, with its end of line; nothing for the other formats.
std::string row_header(const RowLayout& layout);

/// The row of the pose with this index, with its end of line. Numbers read back as the same doubles.
void append_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer);

/// The row of a pose that was refused.
void append_refused_row(std::string& text, const RowLayout& layout, std::uint64_t index, std::string_view problem);

}  // namespace vex
