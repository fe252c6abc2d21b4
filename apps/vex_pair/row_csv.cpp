// Rows as CSV: the fields of JSON as columns, a vector as three, and the contacts in one cell behind their number.
#include <algorithm>
#include <tuple>

#include "apps/vex_pair/row_fields.h"

namespace vex {
namespace {

constexpr std::size_t kMostWitnesses = std::tuple_size_v<decltype(OverlapCertificate::witnesses)>;

// The names of the columns, behind others.
class CsvHeader {
 public:
  explicit CsvHeader(std::string& text) : text_(text) {}

  void word(std::string_view name, std::string_view) { column(name); }
  void reason(std::string_view name, std::string_view) { column(name); }
  void number(std::string_view name, double) { column(name); }
  void either(std::string_view name, bool, double) { column(name); }
  void vector(std::string_view name, const std::optional<Vec3d>&) {
    for (const char* coordinate : {"_x", "_y", "_z"}) {
      column(name);
      text_ += coordinate;
    }
  }
  void contacts(std::string_view name, const std::vector<ContactManifold::Contact>&) {
    text_ += ",n_";
    text_ += name;
    column(name);
  }
  void integer(std::string_view name, int) { column(name); }
  void witness_vector(std::size_t k, const char* name, const std::optional<Vec3d>& v) {
    vector("witness_" + std::to_string(k) + "_" + name, v);
  }

 private:
  void column(std::string_view name) {
    text_ += ',';
    text_ += name;
  }

  std::string& text_;
};

// Cells, behind others; empty where there is nothing.
class CsvFields {
 public:
  explicit CsvFields(std::string& text) : text_(text) {}

  void word(std::string_view, std::string_view word) {
    text_ += ',';
    text_ += word;
  }
  void reason(std::string_view name, std::string_view word) { this->word(name, word); }
  void number(std::string_view, double value) {
    text_ += ',';
    append_number(text_, value, "");
  }
  void either(std::string_view name, bool is_it, double value) { number(name, is_it ? value : Answer::kNone); }
  void vector(std::string_view name, const std::optional<Vec3d>& v) {
    for (const double Vec3d::*coordinate : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      number(name, v ? (*v).*coordinate : Answer::kNone);
    }
  }
  // Nine numbers each, between blanks; semicolons between contacts.
  void contacts(std::string_view, const std::vector<ContactManifold::Contact>& contacts) {
    text_ += ',';
    append_integer(text_, contacts.size());
    text_ += ',';
    for (const auto& [a, b, signed_distance, feature_a, feature_b] : contacts) {
      if (text_.back() != ',') text_ += ';';
      for (const double number : {a.x, a.y, a.z, b.x, b.y, b.z, signed_distance}) {
        append_number(text_, number, "");
        text_ += ' ';
      }
      append_integer(text_, feature_a);
      text_ += ' ';
      append_integer(text_, feature_b);
    }
  }
  void integer(std::string_view, int value) {
    text_ += ',';
    append_integer(text_, value);
  }
  void witness_vector(std::size_t, const char* name, const std::optional<Vec3d>& v) { vector(name, v); }

 private:
  std::string& text_;
};

// Header or row. What proves other queries than an overlap has no columns: JSON lines have it.
template <class Writer>
void write_certificate(Writer& writer, Query query, const Answer& answer) {
  if (query != Query::overlap) {
    writer.word("reproven", !answer.check ? "" : answer.check->is_proven ? "true" : "false");
    return;
  }
  const bool is_disjoint = answer.verdict.outcome == Outcome::disjoint;
  const auto where = [](bool is_there, const Vec3d& v) { return is_there ? std::optional(v) : std::nullopt; };
  writer.vector("separating_direction", where(is_disjoint, answer.certificate.separating_dir));
  writer.vector("separating_direction_low", where(is_disjoint, answer.certificate.separating_dir_low));
  for (std::size_t k = 0; k < kMostWitnesses; ++k) {
    const bool is_there = !answer.is_undecided() && k < static_cast<std::size_t>(answer.certificate.n_witnesses);
    for (const NamedVector& named : kWitnessVectors) {
      writer.witness_vector(k, named.name, where(is_there, answer.certificate.witnesses[k].*named.vector));
    }
  }
  std::string_view reproven;
  if (!answer.is_undecided() && answer.check) reproven = answer.check->is_proven ? "true" : "false";
  writer.word("reproven", reproven);
}

// A cell of text, in quotation marks.
void append_quoted(std::string& text, std::string_view cell) {
  text += '"';
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  text += '"';
}

}  // namespace

std::string csv_header(const RowLayout& layout) {
  std::string text = "index";
  CsvHeader header(text);
  write_fields(header, layout.query, {});
  if (layout.with_certificate) write_certificate(header, layout.query, {});
  return text + (layout.with_error ? ",error\n" : "\n");
}

void append_csv_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  append_integer(text, index);
  CsvFields fields(text);
  write_fields(fields, layout.query, answer);
  if (layout.with_certificate) write_certificate(fields, layout.query, answer);
  text += layout.with_error ? ",\n" : "\n";
}

void append_refused_csv_row(std::string& text, const RowLayout& layout, std::uint64_t index, const std::string& error) {
  append_integer(text, index);
  text.append(static_cast<std::size_t>(std::ranges::count(csv_header(layout), ',')), ',');
  append_quoted(text, error);
  text += '\n';
}

}  // namespace vex
