#include "apps/vex_pair/report.h"

#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "apps/common/body_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

// Disjoint and overlap.
std::pair<std::string, std::string> words_of_verdicts(const QuerySettings& asked) {
  if (asked.query == Query::ray) return {"missed", "hit"};
  if (is_of_motion(asked.query)) return {asked.until < HUGE_VAL ? "do not meet until then" : "never meet", "meet"};
  return {"disjoint", "overlap"};
}

std::string name_of_values(Query query) {
  return is_of_either_sign(query) ? "signed distance" : std::string(name_of_value(query, {}));
}

// What was asked, beside the poses.
void add_query(Json& json, const QuerySettings& asked) {
  json["query"] = name_of(asked.query);
  const Vec3d &o = asked.ray_origin, &v = asked.velocity, &w = asked.angular_velocity_degrees;
  if (asked.until < HUGE_VAL) json["until"] = asked.until;
  if (asked.max_distance < HUGE_VAL) json["max_distance"] = asked.max_distance;
  switch (asked.query) {
    case Query::ray: json["ray"] = {o.x, o.y, o.z, v.x, v.y, v.z}; break;
    case Query::cast: json["cast"] = {v.x, v.y, v.z}; break;
    case Query::time_of_impact: {
      json["toi"] = {v.x, v.y, v.z, w.x, w.y, w.z};
      const Vec3d &v_a = asked.velocity_a, &w_a = asked.angular_velocity_a_degrees;
      if (norm_1(v_a) + norm_1(w_a) > 0.0) json["toi_a"] = {v_a.x, v_a.y, v_a.z, w_a.x, w_a.y, w_a.z};
      break;
    }
    case Query::manifold:
      if (asked.four_at_most) json["four_at_most"] = true;
      [[fallthrough]];
    case Query::overlap: json["margin"] = asked.margin; break;
    case Query::distance:
    case Query::depth:
    case Query::signed_distance: break;
  }
}

}  // namespace

std::string summary_text(const PairRun& run) {
  const Counts& counts = run.found.counts;
  const auto [disjoint, overlap] = words_of_verdicts(run.options.query);
  std::string text = plural(counts.n_rows, "pose", "poses") + ": " + std::to_string(counts.n_disjoint) + " " +
                     disjoint + ", " + std::to_string(counts.n_overlap) + " " + overlap + ", " +
                     std::to_string(counts.n_undecided) + " undecided";
  if (counts.n_refused > 0) text += ", " + std::to_string(counts.n_refused) + " refused";
  std::string by;
  for (std::size_t k = 0; k < counts.decided_by.size(); ++k) {
    if (counts.decided_by[k] == 0) continue;
    by += (by.empty() ? "; decided by " : ", ") + std::string(name_of(static_cast<DecidedBy>(k))) + " " +
          std::to_string(counts.decided_by[k]);
  }
  text += by;
  if (counts.smallest <= counts.largest) {
    text += std::string("; ") + name_of_values(run.options.query.query) + " " + short_number(counts.smallest, 6) +
            " to " + short_number(counts.largest, 6);
  }
  if (run.options.layout.with_certificate) {
    text += "; proven again " + std::to_string(counts.n_reproven) + ", not " + std::to_string(counts.n_not_reproven);
  }
  text += "; " + short_number(run.seconds, 3) + " s";
  if (run.found.interrupted) text += " - interrupted: this is what was done until then";
  return text + "\n";
}

std::string report_json(const PairRun& run) {
  Json json = document_head(run.command, run.options, !run.found.interrupted, run.seconds);
  json["bodies"] = {body_json(run.a, run.options.dump_vertices), body_json(run.b, run.options.dump_vertices)};
  add_query(json, run.options.query);
  if (run.options.pose) {
    json["pose"] = twelve_numbers(*run.options.pose);
  } else {
    json["poses"] = run.options.poses;
  }
  const Counts& counts = run.found.counts;
  json["rows"] = counts.n_rows;
  json["verdicts"] = {
      {"disjoint", counts.n_disjoint}, {"overlap", counts.n_overlap}, {"undecided", counts.n_undecided}};
  json["refused"] = counts.n_refused;
  json["decided_by"] = Json::object();
  for (std::size_t k = 0; k < counts.decided_by.size(); ++k) {
    json["decided_by"][std::string(name_of(static_cast<DecidedBy>(k)))] = counts.decided_by[k];
  }
  if (run.options.layout.with_certificate) {
    json["certificates"] = {{"reproven", counts.n_reproven}, {"not_reproven", counts.n_not_reproven}};
  }
  json["results"] = nullptr;
  if (counts.n_rows > kMostListedRows) {
    json["results_reason"] = "more than " + std::to_string(kMostListedRows) + " rows: --jsonl writes them all";
  } else {
    json["results"] = Json::array();
    std::istringstream rows(run.found.first_rows);
    for (std::string row; std::getline(rows, row);) json["results"].push_back(Json::parse(row));
  }
  return document_text(json);
}

}  // namespace vex
