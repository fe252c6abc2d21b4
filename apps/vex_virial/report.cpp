#include "apps/vex_virial/report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/common/estimate_report.h"
#include "apps/common/numbers.h"
#include "apps/common/processor.h"
#include "apps/common/text.h"
#include "apps/vex_virial/run_identity.h"
#include "shapes/equations_of_state.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

const std::string kNoSeries = "no series of Z: the coefficients below are left out (--only)";

double non_sphericity_of(const VirialRun& run) { return non_sphericity(run.bodies[0].shape.measures); }

std::string with_error_or_dash(double value, double error) {
  if (std::isnan(value)) return "-";
  return std::isfinite(error) ? with_error(value, error) : short_number(value, 4) + "(unknown)";
}

std::string coefficients_text(const VirialRun& run) {
  std::vector<std::vector<std::string>> lines = {
      {"n", "B_n / B2^(n-1)", "B_n / V^(n-1)", "samples", "ended by", "seconds"}};
  std::string unsettled;
  for (const VirialCoefficient& found : run.found.higher) {
    lines.push_back({std::to_string(found.n), with_error_or_dash(found.reduced, found.std_error),
                     with_error_or_dash(found.per_volume, found.per_volume_std_error),
                     short_count(static_cast<double>(found.samples)), std::string(name_of(found.record.stopped_by)),
                     short_number(found.record.seconds, 3)});
    if (!found.sign_is_settled()) unsettled += (unsettled.empty() ? "B" : ", B") + std::to_string(found.n);
  }
  std::string text = table_text(lines);
  if (!unsettled.empty()) {
    text += "NOT SETTLED: the sign of " + unsettled + ", within three standard errors of 0. Give more time.\n";
  }
  return text;
}

std::string pairs_text(const VirialRun& run) {
  VirialPairs sum;
  for (const VirialCoefficient& found : run.found.higher) {
    sum.n_all += found.pairs.n_all;
    sum.n_by_balls += found.pairs.n_by_balls;
    sum.n_searched += found.pairs.n_searched;
    sum.n_undecided += found.pairs.n_undecided;
  }
  const auto number = [](std::uint64_t n) { return short_count(static_cast<double>(n)); };
  std::string text =
      "of " + number(sum.n_all) +
      " pairs of the samples (clusters but for the neighbours that drew them; sides of B3's triangles), " +
      number(sum.n_by_balls) + " were decided by balls, " + number(sum.n_searched) + " by a search, " +
      number(sum.n_skipped()) + " skipped: the cluster had no weight; " +
      plural(sum.n_undecided, "pair is UNDECIDED", "pairs are undecided") + "\n";
  if (sum.n_undecided > 0) text += "What undecided pairs may change is part of the errors.\n";
  return text;
}

std::string series_text(const VirialRun& run) {
  if (std::isnan(run.found.b2_per_volume)) return "";
  if (!run.found.is_series()) return kNoSeries + ".\n";
  const std::vector<EquationOfState> others = equations_of_state(run);
  std::vector<std::vector<std::string>> lines = {{"phi", "Z to B" + std::to_string(run.found.higher.size() + 2)}};
  for (const EquationOfState& other : others) lines[0].push_back(other.name);
  for (const double phi : {0.05, 0.1, 0.2, 0.3, 0.4}) {
    std::vector<std::string> line = {short_number(phi, 3), short_number(run.found.compressibility_factor(phi), 5)};
    for (const EquationOfState& other : others) line.push_back(short_number(other.z(run, phi), 5));
    lines.push_back(line);
  }
  return "Compressibility factor Z = p / (n k T) of the series, which ends too early where phi is large\n" +
         table_text(lines);
}

std::string mixture_text(const VirialRun& run) {
  std::vector<std::vector<std::string>> lines = {{"", "B_ijk", "B_ijk / (B_ij B_jk)", "clusters", "ended by"}};
  for (const MixedVirial& mixed : run.mixed) {
    lines.push_back({"B_" + mixed.name, with_error_or_dash(mixed.value, mixed.std_error),
                     with_error_or_dash(mixed.reduced, mixed.reduced_std_error),
                     short_count(static_cast<double>(mixed.samples)), std::string(name_of(mixed.record.stopped_by))});
  }
  return table_text(lines);
}

RunState state_of(const RunRecord& record) {
  RunState state;
  state.first_trial = record.first_trial;
  state.done = record;
  state.seconds = record.seconds;
  return state;
}

}  // namespace

Json coefficient_json(const VirialCoefficient& found, const std::vector<std::string>& of) {
  const VirialPairs& pairs = found.pairs;
  return {{"n", found.n},
          {"reduced", number_or_null(found.reduced)},
          {"std_error", number_or_null(found.std_error)},
          {"per_volume", number_or_null(found.per_volume)},
          {"per_volume_std_error", number_or_null(found.per_volume_std_error)},
          {"samples", found.samples},
          {"sign_settled", found.sign_is_settled()},
          {"complete", found.record.complete},
          {"stopped_by", name_of(found.record.stopped_by)},
          {"undecided", found.record.tally.n_undecided},
          {"pairs",
           {{"seen", pairs.n_all},
            {"by_balls", pairs.n_by_balls},
            {"searched", pairs.n_searched},
            {"skipped", pairs.n_skipped()},
            {"undecided", pairs.n_undecided}}},
          {"seconds", found.record.seconds},
          {"tally", tally_json(of, state_of(found.record))}};
}

Json mixed_json(const MixedVirial& mixed, const std::vector<std::string>& of) {
  return {{"bodies", mixed.name},
          {"value", number_or_null(mixed.value)},
          {"std_error", number_or_null(mixed.std_error)},
          {"reduced", number_or_null(mixed.reduced)},
          {"reduced_std_error", number_or_null(mixed.reduced_std_error)},
          {"b2_product", number_or_null(mixed.b2_product)},
          {"b2_relative_error", number_or_null(mixed.b2_relative_error)},
          {"samples", mixed.samples},
          {"complete", mixed.record.complete},
          {"stopped_by", name_of(mixed.record.stopped_by)},
          {"undecided", mixed.record.tally.n_undecided},
          {"seconds", mixed.record.seconds},
          {"tally", tally_json(of, state_of(mixed.record))}};
}

namespace {

Json compressibility_json(const VirialRun& run) {
  Json rows = Json::array();
  if (std::isnan(run.found.b2_per_volume) || !run.found.is_series()) return rows;
  for (int k = 1; k <= 8; ++k) {
    const double phi = 0.05 * k;
    Json row = {{"phi", phi}, {"series", number_or_null(run.found.compressibility_factor(phi))}};
    for (const EquationOfState& other : equations_of_state(run)) row[other.name] = number_or_null(other.z(run, phi));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<EquationOfState> equations_of_state(const VirialRun& run) {
  if (std::isnan(run.found.b2_per_volume)) return {};
  std::vector<EquationOfState> all = {
      {"Parsons-Lee", [](const VirialRun& of, double phi) { return parsons_lee(of.found.b2_per_volume, phi); }}};
  if (run.options.settings.law.kind() != OrientationLaw::Kind::isotropic) return all;
  all.push_back({"Nezbeda", [](const VirialRun& of, double phi) { return nezbeda(non_sphericity_of(of), phi); }});
  all.push_back({"Boublik", [](const VirialRun& of, double phi) { return boublik(non_sphericity_of(of), phi); }});
  return all;
}

std::string b2_text(const VirialCoefficients& found, double in_unit) {
  constexpr double kAsGoodAsExact = 1e-11;
  const double error = found.b2_relative_error();
  return error > kAsGoodAsExact ? with_error(in_unit, error * in_unit) : short_number(in_unit, 12);
}

std::string report_text(const VirialRun& run) {
  const VirialOptions& options = run.options;
  std::string text;
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    text += body_text(run.bodies[k], k == 0 ? "A" : "B", options.dump_vertices);
  }
  text += "orientations " + options.settings.law.name() + "; seed " + std::to_string(options.seed) + "\n\n";
  if (options.is_mixture()) {
    text += mixture_text(run);
  } else {
    if (run.found.b2_reason.empty()) {
      text += "B2 = " + b2_text(run.found, run.found.b2);
      if (!std::isnan(run.found.b2_per_volume)) text += ", B2 / V = " + b2_text(run.found, run.found.b2_per_volume);
      text += "\n";
    } else {
      text += "B2 is not known: " + run.found.b2_reason + "\n";
    }
    text += coefficients_text(run) + pairs_text(run);
    if (const std::string series = series_text(run); !series.empty()) text += "\n" + series;
  }
  if (!run.complete) text += "NOT COMPLETE: a run was interrupted, or given up before the error that was asked for.\n";
  return text + short_number(run.seconds, 3) + " s on " +
         plural(static_cast<std::uint64_t>(options.n_threads), "thread", "threads") + " (" + processor() + ")\n";
}

std::string report_json(const VirialRun& run) {
  const VirialOptions& options = run.options;
  Json json = document_head(run.command, options, run.complete, run.seconds);
  json["bodies"] = Json::array();
  for (const LoadedBody& body : run.bodies) json["bodies"].push_back(body_json(body, options.dump_vertices));
  json["orientations"] = options.settings.law.name();
  json["isa"] = name_of(options.settings.instruction_set);
  const std::vector<std::string> of = trials_identity(run);
  if (options.is_mixture()) {
    json["mixture"] = Json::array();
    for (const MixedVirial& mixed : run.mixed) json["mixture"].push_back(mixed_json(mixed, of));
    return document_text(json);
  }
  json["b2"] = number_or_null(run.found.b2);
  json["b2_std_error"] = number_or_null(run.found.b2_std_error);
  json["b2_per_volume"] = number_or_null(run.found.b2_per_volume);
  if (!run.found.b2_reason.empty()) json["b2_reason"] = run.found.b2_reason;
  json["coefficients"] = Json::array();
  for (const VirialCoefficient& found : run.found.higher) json["coefficients"].push_back(coefficient_json(found, of));
  json["compressibility"] = compressibility_json(run);
  if (!run.found.is_series()) json["compressibility_reason"] = kNoSeries;
  return document_text(json);
}

}  // namespace vex
