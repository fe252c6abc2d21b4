// What vex_depletion says: a table on the screen, JSON, CSV.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/common/append_number.h"
#include "apps/common/body_report.h"
#include "apps/common/estimate_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_depletion/depletion_run.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(double value, double error) {
  if (std::isnan(value)) return "-";
  return error > 0.0 ? with_error(value, error) : short_number(value, 10);
}

}  // namespace

std::string report_text(const DepletionRun& run) {
  const DepletionOptions& options = run.options;
  const bool is_mean = options.law.has_value();
  std::string text = body_text(run.a, "A", options.dump_vertices);
  text += are_copies(run.a, run.b) ? "B  the same body\n" : body_text(run.b, "B", options.dump_vertices);
  text += "\nOverlap of the depletion shells, of balls of radius " + short_number(options.settings.ball_radius);
  if (is_mean) {
    text += "; means over all directions and " + options.law->name() +
            " orientations at which the bodies do not overlap, and the share of these";
  }
  text += "\n";
  std::vector<std::vector<std::string>> lines(1);
  lines[0] = {"distance", is_mean ? "free share" : "angle", "overlap volume"};
  const bool has_exact = !run.cases.empty() && !std::isnan(run.cases.front().exact);
  if (has_exact) lines[0].insert(lines[0].end(), {"exact", "z"});
  if (options.fraction) lines[0].emplace_back(is_mean ? "mean potential / kT" : "potential / kT");
  for (const DepletionCase& one : run.cases) {
    std::vector<std::string> line = {one.distance, is_mean ? shown(one.free_share, one.free_share_error) : one.angle};
    std::string volume = shown(one.overlap_volume, one.std_error);
    if (!one.complete) volume += " incomplete";
    line.push_back(volume);
    if (has_exact) {
      line.push_back(std::isnan(one.exact) ? "-" : short_number(one.exact, 10));
      line.push_back(std::isnan(one.z) ? "-" : short_number(one.z, 3));
    }
    if (options.fraction) {
      line.push_back(one.bodies == Outcome::overlap     ? "infinite: they overlap"
                     : one.bodies == Outcome::undecided ? "undecided: they touch"
                                                        : shown(run.potential(one), run.potential_error(one)));
    } else if (one.bodies != Outcome::disjoint) {
      line[2] += one.bodies == Outcome::overlap ? ", but the bodies overlap" : ", but the bodies touch";
    }
    lines.push_back(std::move(line));
  }
  text += table_text(lines, 2);
  std::set<std::string> reasons;
  for (const DepletionCase& one : run.cases) {
    if (!one.complete) reasons.insert(why_incomplete(one.stopped_by));
  }
  for (const std::string& reason : reasons) text += "NOT COMPLETE - " + reason + "\n";
  if (!run.complete && reasons.empty()) text += "NOT COMPLETE - interrupted between two cases\n";
  return text + short_number(run.seconds, 3) + " s on " +
         plural(static_cast<std::uint64_t>(options.n_threads), "thread", "threads") + "\n";
}

std::string report_json(const DepletionRun& run) {
  const DepletionOptions& options = run.options;
  Json json = document_head(run.command, options, run.complete, run.seconds);
  json["bodies"] = {body_json(run.a, options.dump_vertices), body_json(run.b, options.dump_vertices)};
  json["depletant"] = {{"radius", options.settings.ball_radius},
                       {"volume_fraction", number_or_null(options.fraction)},
                       {"number_density", number_or_null(options.number_density())}};
  json["orientations"] = options.law ? Json(options.law->name()) : Json(nullptr);
  json["direction"] = nullptr;
  if (!options.law) json["direction"] = {options.direction.x, options.direction.y, options.direction.z};
  json["rows"] = Json::array();
  for (const DepletionCase& one : run.cases) {
    Json row = {{"distance", parse_number(one.distance, "--distance")}};
    row["angle"] = one.angle.empty() ? Json(nullptr) : Json(parse_number(one.angle, "--angle"));
    row["bodies"] = options.law ? Json(nullptr) : Json(name_of(one.bodies));
    row["free_share"] = number_or_null(one.free_share);
    row["free_share_std_error"] = number_or_null(one.free_share_error);
    row["overlap_volume"] = number_or_null(one.overlap_volume);
    row["std_error"] = number_or_null(one.std_error);
    row["exact"] = number_or_null(one.exact);
    row["z"] = number_or_null(one.z);
    row["potential"] = number_or_null(run.potential(one));
    row["potential_std_error"] = number_or_null(run.potential_error(one));
    row["trials"] = one.trials;
    row["undecided"] = one.undecided;
    row["complete"] = one.complete;
    row["stopped_by"] = name_of(one.stopped_by);
    row["seed"] = one.seed;
    row["seconds"] = one.seconds;
    json["rows"].push_back(std::move(row));
  }
  return document_text(json);
}

std::string csv_text(const DepletionRun& run) {
  std::string text =
      "distance,angle,bodies,free_share,free_share_std_error,overlap_volume,std_error,exact,z,potential,"
      "potential_std_error,trials\n";
  for (const DepletionCase& one : run.cases) {
    text += one.distance + "," + one.angle + "," + (run.options.law ? "" : std::string(name_of(one.bodies)));
    for (const double number : {one.free_share, one.free_share_error, one.overlap_volume, one.std_error, one.exact,
                                one.z, run.potential(one), run.potential_error(one)}) {
      text += ",";
      append_number(text, number, "");
    }
    text += "," + std::to_string(one.trials) + "\n";
  }
  return text;
}

}  // namespace vex
