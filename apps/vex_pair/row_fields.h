// What a row holds, in its order: told once, to whatever writes rows.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "apps/common/append_number.h"
#include "apps/vex_pair/row_text.h"

namespace vex {

/// The vectors of a witness, under the names they have in JSON and in CSV.
struct NamedVector {
  const char* name;
  Vec3d Witness::*vector;
};
inline constexpr NamedVector kWitnessVectors[] = {
    {"direction", &Witness::dir},     {"direction_low", &Witness::dir_low},
    {"direction_b", &Witness::dir_b}, {"direction_b_low", &Witness::dir_b_low},
    {"point_a", &Witness::point_a},   {"point_b", &Witness::point_b}};

/// A row without its index and its certificate. `writer` takes the fields one by one:
///   word(name, text)                an empty text is none
///   reason(name, text)              a field only where there is one, but a column always
///   number(name, value)             none where it is not finite
///   either(name, is_it, value)      a field only where this is it, but a column always
///   vector(name, optional vector), contacts(name, contacts), integer(name, value)
template <class Writer>
void write_fields(Writer& writer, Query query, const Answer& answer) {
  const bool undecided = answer.is_undecided();
  writer.word("verdict", name_of(answer.verdict.outcome));
  writer.word("decided_by", undecided ? std::string_view() : name_of(answer.verdict.by));
  writer.reason("undecided_reason", undecided ? name_of(answer.verdict.reason) : std::string_view());
  if (is_of_either_sign(query)) {
    const bool is_depth = answer.verdict.outcome == Outcome::overlap;
    writer.either("distance", !is_depth, answer.value);
    writer.either("depth", is_depth, answer.value);
    writer.number("signed_distance", answer.signed_distance.value_or(Answer::kNone));
  } else if (query != Query::overlap) {
    writer.number(name_of_value(query, answer), answer.value);
  }
  writer.number("lower", answer.lower);
  writer.number("upper", answer.upper);
  if (query != Query::overlap && !is_of_motion(query)) writer.reason("bounds", answer.is_rough ? "rough" : "");
  if (query == Query::ray) writer.word("hit", name_of(answer.ray_hit));
  if (query != Query::overlap) {
    writer.vector("normal", answer.normal);
    writer.vector("point_a", answer.point_a);
    writer.vector("point_b", answer.point_b);
  }
  if (query == Query::manifold) writer.contacts("contacts", answer.contacts);
  writer.integer("iterations", answer.n_support_calls);
}

void append_json_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer);
void append_refused_json_row(std::string& text, std::uint64_t index, const std::string& error);

std::string csv_header(const RowLayout& layout);
void append_csv_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer);
void append_refused_csv_row(std::string& text, const RowLayout& layout, std::uint64_t index, const std::string& error);

}  // namespace vex
