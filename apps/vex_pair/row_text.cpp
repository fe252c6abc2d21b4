#include "apps/vex_pair/row_text.h"

#include <cmath>

#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_pair/row_fields.h"

namespace vex {
namespace {

void append_screen(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  append_integer(text, index);
  text += ' ';
  text += name_of(answer.verdict.outcome);
  text += ' ';
  text += answer.is_undecided() ? name_of(answer.verdict.reason) : name_of(answer.verdict.by);
  if (std::isfinite(answer.value)) {
    text += ' ';
    text += name_of_value(layout.query, answer);
    text += ' ' + short_number(answer.value);
  }
  if (answer.ray_hit != Answer::RayHit::nothing) {
    text += " hit ";
    text += name_of(answer.ray_hit);
  }
  if (layout.query == Query::manifold) text += " contacts " + std::to_string(answer.contacts.size());
  if (layout.with_certificate && answer.check) text += answer.check->is_proven ? " reproven" : " not_reproven";
  text += '\n';
}

}  // namespace

std::string row_header(const RowLayout& layout) {
  return layout.format == RowLayout::Format::csv ? csv_header(layout) : std::string();
}

void append_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  switch (layout.format) {
    case RowLayout::Format::screen: return append_screen(text, layout, index, answer);
    case RowLayout::Format::jsonl: return append_json_row(text, layout, index, answer);
    case RowLayout::Format::csv: return append_csv_row(text, layout, index, answer);
  }
}

void append_refused_row(std::string& text, const RowLayout& layout, std::uint64_t index, std::string_view problem) {
  const std::string error = printable(problem);
  switch (layout.format) {
    case RowLayout::Format::screen: text += std::to_string(index) + " error " + error + "\n"; return;
    case RowLayout::Format::jsonl: return append_refused_json_row(text, index, error);
    case RowLayout::Format::csv: return append_refused_csv_row(text, layout, index, error);
  }
}

}  // namespace vex
