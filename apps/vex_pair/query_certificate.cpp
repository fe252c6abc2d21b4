#include "apps/vex_pair/query_certificate.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/common/text.h"
#include "apps/vex_pair/row_fields.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

// No 0 has a sign, and what is infinite is null.
Json number_json(double x) { return std::isfinite(x) ? Json(x + 0.0) : Json(nullptr); }
Json vector_json(const Vec3d& v) { return {number_json(v.x), number_json(v.y), number_json(v.z)}; }

Json direction_json(const ExactVector& dir) {
  Json parts = Json::array();
  for (const ExactVector::Part& part : dir.parts) {
    Json one = vector_json(part.value);
    one.push_back(part.exponent);
    parts.push_back(std::move(one));
  }
  return parts;
}

Json witness_json(const Witness& witness) {
  Json json;
  for (const NamedVector& named : kWitnessVectors) json[named.name] = vector_json(witness.*named.vector);
  return json;
}

template <class Witnesses>
Json witnesses_json(const Witnesses& witnesses) {
  Json json = Json::array();
  for (const Witness& witness : witnesses) json.push_back(witness_json(witness));
  return json;
}

Json overlap_json(const OverlapCertificate& certificate) {
  Json json;
  json["separating_direction"] = vector_json(certificate.separating_dir);
  json["separating_direction_low"] = vector_json(certificate.separating_dir_low);
  const std::size_t n = static_cast<std::size_t>(certificate.n_witnesses);
  json["witnesses"] = witnesses_json(std::span(certificate.witnesses).first(n));
  return json;
}

Json hull_json(const WitnessHull& hull) {
  Json json;
  json["witnesses"] = witnesses_json(hull.witnesses);
  Json& faces = json["faces"] = Json::array();
  for (const auto& [i, j, k] : hull.faces) faces.push_back(Json::array({i, j, k}));
  return json;
}

Json json_of(std::monostate) { return nullptr; }

Json json_of(const SeparationCertificate& certificate) {
  Json json;
  json["sign"] = overlap_json(certificate.sign);
  json["lower"] = direction_json(certificate.dir);
  json["upper"] = hull_json(certificate.hull);
  json["near_a"] = witnesses_json(certificate.near_a);
  json["near_b"] = witnesses_json(certificate.near_b);
  return json;
}

Json json_of(const ManifoldCertificate& certificate) {
  Json json = json_of(certificate.separation);
  json["contacts"] = Json::array();
  for (const ManifoldCertificate::Contact& contact : certificate.contacts) {
    json["contacts"].push_back(
        {{"near_a", witnesses_json(contact.near_a)}, {"near_b", witnesses_json(contact.near_b)}});
  }
  return json;
}

Json json_of(const ContactCertificate& certificate) {
  Json json;
  json["apart"] = Json::array();
  for (const ContactCertificate::Apart& apart : certificate.apart) {
    json["apart"].push_back(
        {{"from", number_json(apart.from)}, {"to", number_json(apart.to)}, {"direction", direction_json(apart.dir)}});
  }
  json["at_start"] = overlap_json(certificate.at_start);
  json["contact"] = hull_json(certificate.hull);
  for (std::size_t k = 0; k < certificate.times.size(); ++k) {
    json["contact"]["witnesses"][k]["time"] = number_json(certificate.times[k]);
  }
  json["near_a"] = witnesses_json(certificate.near_a);
  json["near_b"] = witnesses_json(certificate.near_b);
  return json;
}

Json json_of(const RayCertificate& certificate) {
  Json json;
  json["a"] = json_of(certificate.of_a);
  json["b"] = json_of(certificate.of_b);
  return json;
}

std::string summary_of(std::monostate) { return "nothing"; }

std::string summary_of(const WitnessHull& hull) {
  std::string text = plural(hull.witnesses.size(), "point", "points") + " of A - B";
  if (!hull.faces.empty()) text += " with " + plural(hull.faces.size(), "face", "faces");
  return text;
}

std::string summary_of(const SeparationCertificate& certificate) {
  std::string text = certificate.dir.is_any() ? "a direction" : "";
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!certificate.hull.witnesses.empty()) add(summary_of(certificate.hull));
  if (certificate.sign.n_witnesses > 0 || norm_1(certificate.sign.separating_dir) > 0.0) add("what proves the verdict");
  return text;
}

std::string summary_of(const ManifoldCertificate& certificate) {
  return summary_of(certificate.separation) + "; " + plural(certificate.contacts.size(), "contact", "contacts");
}

std::string summary_of(const ContactCertificate& certificate) {
  std::string text = plural(certificate.apart.size(), "direction", "directions");
  if (!certificate.hull.witnesses.empty()) text += ", " + summary_of(certificate.hull);
  const OverlapCertificate& at_start = certificate.at_start;
  if (at_start.n_witnesses > 0 || norm_1(at_start.separating_dir) > 0.0)
    text += ", what proves the verdict at the start";
  return text;
}

std::string summary_of(const RayCertificate& certificate) {
  return "of A " + summary_of(certificate.of_a) + "; of B " + summary_of(certificate.of_b);
}

}  // namespace

Json certificate_json(const QueryCertificate& certificate) {
  return std::visit([](const auto& one) { return json_of(one); }, certificate);
}

std::string certificate_summary(const QueryCertificate& certificate) {
  return std::visit([](const auto& one) { return summary_of(one); }, certificate);
}

}  // namespace vex
