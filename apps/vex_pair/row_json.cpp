// Rows as JSON lines.
#include <nlohmann/json.hpp>

#include "apps/vex_pair/row_fields.h"

namespace vex {
namespace {

void append_vector(std::string& text, const Vec3d& v) {
  text += '[';
  append_number(text, v.x, "null");
  text += ',';
  append_number(text, v.y, "null");
  text += ',';
  append_number(text, v.z, "null");
  text += ']';
}

// Members of an object that has been opened, behind others.
class JsonFields {
 public:
  explicit JsonFields(std::string& text) : text_(text) {}

  void word(std::string_view name, std::string_view word) {
    key(name);
    if (word.empty()) {
      text_ += "null";
      return;
    }
    text_ += '"';
    text_ += word;
    text_ += '"';
  }
  void reason(std::string_view name, std::string_view word) {
    if (!word.empty()) this->word(name, word);
  }
  void number(std::string_view name, double value) {
    key(name);
    append_number(text_, value, "null");
  }
  void either(std::string_view name, bool is_it, double value) {
    if (is_it) number(name, value);
  }
  void vector(std::string_view name, const std::optional<Vec3d>& v) {
    key(name);
    v ? append_vector(text_, *v) : void(text_ += "null");
  }
  void contacts(std::string_view name, const std::vector<ContactManifold::Contact>& contacts) {
    key(name);
    text_ += '[';
    for (const ContactManifold::Contact& contact : contacts) {
      text_ += &contact == contacts.data() ? "{\"point_a\":" : ",{\"point_a\":";
      append_vector(text_, contact.point_a);
      vector("point_b", contact.point_b);
      number("distance", contact.signed_distance);
      number("signed_distance", contact.signed_distance);  // the same, as it was called first
      feature("feature_a", contact.feature_a);
      feature("feature_b", contact.feature_b);
      text_ += '}';
    }
    text_ += ']';
  }
  void integer(std::string_view name, int value) {
    key(name);
    append_integer(text_, value);
  }

 private:
  void feature(std::string_view name, FeatureId value) {
    key(name);
    append_integer(text_, value);
  }
  void key(std::string_view name) {
    text_ += ",\"";
    text_ += name;
    text_ += "\":";
  }

  std::string& text_;
};

void append_named_vector(std::string& text, std::string_view name, const Vec3d& v) {
  text += '"';
  text += name;
  text += "\":";
  append_vector(text, v);
}

void append_witnesses(std::string& text, const OverlapCertificate& certificate) {
  text += "\"witnesses\":[";
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    text += k == 0 ? "{" : ",{";
    for (const NamedVector& named : kWitnessVectors) {
      if (&named != kWitnessVectors) text += ',';
      append_named_vector(text, named.name, certificate.witnesses[static_cast<std::size_t>(k)].*named.vector);
    }
    text += '}';
  }
  text += ']';
}

void append_check(std::string& text, const Answer& answer) {
  if (!answer.check) return;
  text += answer.check->is_proven ? ",\"reproven\":true" : ",\"reproven\":false,\"not_reproven_reason\":";
  if (!answer.check->is_proven) text += nlohmann::json(answer.check->fault).dump();
}

void append_certificate(std::string& text, Query query, const Answer& answer) {
  text += ",\"certificate\":";
  if (query != Query::overlap) {
    text += certificate_json(answer.query_certificate).dump();
    append_check(text, answer);
    return;
  }
  if (answer.is_undecided()) {
    text += "null,\"reproven\":null";
    return;
  }
  const OverlapCertificate& certificate = answer.certificate;
  text += '{';
  const bool is_disjoint = answer.verdict.outcome == Outcome::disjoint;
  if (is_disjoint) {
    append_named_vector(text, "separating_direction", certificate.separating_dir);
    text += ',';
    append_named_vector(text, "separating_direction_low", certificate.separating_dir_low);
  }
  // Of disjoint bodies only where they, and not the direction, are the proof.
  if (!is_disjoint || certificate.n_witnesses > 0) {
    if (is_disjoint) text += ',';
    append_witnesses(text, certificate);
  }
  text += '}';
  append_check(text, answer);
}

}  // namespace

void append_json_row(std::string& text, const RowLayout& layout, std::uint64_t index, const Answer& answer) {
  text += "{\"index\":";
  append_integer(text, index);
  JsonFields fields(text);
  write_fields(fields, layout.query, answer);
  if (layout.with_certificate) append_certificate(text, layout.query, answer);
  text += "}\n";
}

void append_refused_json_row(std::string& text, std::uint64_t index, const std::string& error) {
  const nlohmann::ordered_json row = {{"index", index}, {"error", error}};
  text += row.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace vex
