#include "apps/vex_pair/row_text.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "apps/common/text.h"

namespace vex {
namespace {

// Of CSV, in the order of append_csv.
constexpr const char* kColumns = "index,verdict,decided_by,undecided_reason,lower,upper,iterations";
constexpr std::size_t kMostWitnesses = std::tuple_size_v<decltype(OverlapCertificate::witnesses)>;

// The vectors of a witness, under the names they have in JSON and in CSV.
struct NamedVector {
  const char* name;
  Vec3d Witness::*vector;
};
constexpr NamedVector kWitnessVectors[] = {{"direction", &Witness::dir},     {"direction_low", &Witness::dir_low},
                                           {"direction_b", &Witness::dir_b}, {"direction_b_low", &Witness::dir_b_low},
                                           {"point_a", &Witness::point_a},   {"point_b", &Witness::point_b}};

template <class Integer>
void append_integer(std::string& text, Integer value) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// The shortest text that reads back as the same double; `none` where it is not finite.
void append_number(std::string& text, double value, std::string_view none) {
  if (!std::isfinite(value)) {
    text += none;
    return;
  }
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

bool is_undecided(const Answer& answer) { return answer.verdict.outcome == Outcome::undecided; }

// --- JSON

void append_vector_json(std::string& text, std::string_view name, const Vec3d& v) {
  text += '"';
  text += name;
  text += "\":[";
  append_number(text, v.x, "null");
  text += ',';
  append_number(text, v.y, "null");
  text += ',';
  append_number(text, v.z, "null");
  text += ']';
}

void append_witnesses_json(std::string& text, const OverlapCertificate& certificate) {
  text += "\"witnesses\":[";
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    text += k == 0 ? "{" : ",{";
    for (const NamedVector& named : kWitnessVectors) {
      if (&named != kWitnessVectors) text += ',';
      append_vector_json(text, named.name, certificate.witnesses[static_cast<std::size_t>(k)].*named.vector);
    }
    text += '}';
  }
  text += ']';
}

void append_certificate_json(std::string& text, const Answer& answer) {
  text += ",\"certificate\":";
  if (is_undecided(answer)) {
    text += "null,\"reproven\":null";
    return;
  }
  const OverlapCertificate& certificate = answer.certificate;
  text += '{';
  const bool is_disjoint = answer.verdict.outcome == Outcome::disjoint;
  if (is_disjoint) {
    append_vector_json(text, "separating_direction", certificate.separating_dir);
    text += ',';
    append_vector_json(text, "separating_direction_low", certificate.separating_dir_low);
  }
  // Of disjoint bodies only where they, and not the direction, are the proof.
  if (!is_disjoint || certificate.n_witnesses > 0) {
    if (is_disjoint) text += ',';
    append_witnesses_json(text, certificate);
  }
  text += '}';
  if (!answer.check) return;
  text += answer.check->is_proven ? ",\"reproven\":true" : ",\"reproven\":false,\"not_reproven_reason\":";
  if (!answer.check->is_proven) text += nlohmann::json(answer.check->fault).dump();
}

void append_jsonl(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  text += "{\"index\":";
  append_integer(text, index);
  text += ",\"verdict\":\"";
  text += name_of(answer.verdict.outcome);
  const bool undecided = is_undecided(answer);
  if (undecided) {
    text += "\",\"decided_by\":null,\"undecided_reason\":\"";
    text += name_of(answer.verdict.reason);
    text += "\",\"lower\":";
    append_number(text, answer.certificate.gap_lower, "null");
    text += ",\"upper\":";
    append_number(text, answer.certificate.gap_upper, "null");
  } else {
    text += "\",\"decided_by\":\"";
    text += name_of(answer.verdict.by);
    text += "\",\"lower\":null,\"upper\":null";
  }
  text += ",\"iterations\":";
  append_integer(text, answer.certificate.n_support_calls);
  if (layout.with_certificate) append_certificate_json(text, answer);
  text += "}\n";
}

// --- CSV

void append_vector_header(std::string& text, const std::string& name) {
  for (const char* coordinate : {"_x", "_y", "_z"}) text += "," + name + coordinate;
}

// Empty cells where there is none.
void append_vector_csv(std::string& text, const Vec3d* v) {
  for (const double Vec3d::*coordinate : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    text += ',';
    if (v != nullptr) append_number(text, v->*coordinate, "");
  }
}

// A cell of text, in quotation marks.
void append_quoted(std::string& text, std::string_view cell) {
  text += '"';
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  text += '"';
}

void append_certificate_csv(std::string& text, const Answer* answer) {
  const bool proven = answer != nullptr && !is_undecided(*answer);
  const bool is_disjoint = proven && answer->verdict.outcome == Outcome::disjoint;
  append_vector_csv(text, is_disjoint ? &answer->certificate.separating_dir : nullptr);
  append_vector_csv(text, is_disjoint ? &answer->certificate.separating_dir_low : nullptr);
  for (std::size_t k = 0; k < kMostWitnesses; ++k) {
    const bool is_there = proven && k < static_cast<std::size_t>(answer->certificate.n_witnesses);
    for (const NamedVector& named : kWitnessVectors) {
      append_vector_csv(text, is_there ? &(answer->certificate.witnesses[k].*named.vector) : nullptr);
    }
  }
  text += ',';
  if (proven && answer->check) text += answer->check->is_proven ? "true" : "false";
}

void append_csv(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  append_integer(text, index);
  text += ',';
  text += name_of(answer.verdict.outcome);
  if (is_undecided(answer)) {
    text += ",,";
    text += name_of(answer.verdict.reason);
    text += ',';
    append_number(text, answer.certificate.gap_lower, "");
    text += ',';
    append_number(text, answer.certificate.gap_upper, "");
  } else {
    text += ',';
    text += name_of(answer.verdict.by);
    text += ",,,";
  }
  text += ',';
  append_integer(text, answer.certificate.n_support_calls);
  if (layout.with_certificate) append_certificate_csv(text, &answer);
  text += layout.with_error ? ",\n" : "\n";
}

// --- screen

void append_screen(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  append_integer(text, index);
  text += ' ';
  text += name_of(answer.verdict.outcome);
  text += ' ';
  text += is_undecided(answer) ? name_of(answer.verdict.reason) : name_of(answer.verdict.by);
  if (layout.with_certificate && answer.check) text += answer.check->is_proven ? " reproven" : " not_reproven";
  text += '\n';
}

}  // namespace

std::string row_header(const RowLayout& layout) {
  if (layout.format != RowLayout::Format::csv) return "";
  std::string text = kColumns;
  if (layout.with_certificate) {
    append_vector_header(text, "separating_direction");
    append_vector_header(text, "separating_direction_low");
    for (std::size_t k = 0; k < kMostWitnesses; ++k) {
      for (const NamedVector& named : kWitnessVectors) {
        append_vector_header(text, "witness_" + std::to_string(k) + "_" + named.name);
      }
    }
    text += ",reproven";
  }
  return text + (layout.with_error ? ",error\n" : "\n");
}

void append_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  switch (layout.format) {
    case RowLayout::Format::screen: return append_screen(text, layout, index, answer);
    case RowLayout::Format::jsonl: return append_jsonl(text, layout, index, answer);
    case RowLayout::Format::csv: return append_csv(text, layout, index, answer);
  }
}

void append_refused_row(std::string& text, const RowLayout& layout, std::uint64_t index, std::string_view problem) {
  const std::string error = printable(problem);
  switch (layout.format) {
    case RowLayout::Format::screen: text += std::to_string(index) + " error " + error + "\n"; return;
    case RowLayout::Format::jsonl: {
      const nlohmann::ordered_json row = {{"index", index}, {"error", error}};
      text += row.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
      return;
    }
    case RowLayout::Format::csv:
      text += std::to_string(index) + ",,,,,,";
      if (layout.with_certificate) append_certificate_csv(text, nullptr);
      text += ',';
      append_quoted(text, error);
      text += '\n';
  }
}

}  // namespace vex
