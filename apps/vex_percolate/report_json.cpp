// The document of --json.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/vex_percolate/realisations_file.h"
#include "apps/vex_percolate/report.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

Json estimated_json(const Estimated& one) {
  return {{"value", number_or_null(one.value)}, {"std_error", number_or_null(one.std_error)}};
}
Json estimated_json(const std::optional<Estimated>& one) { return one ? estimated_json(*one) : Json(nullptr); }

// Where a size has this probability of a wrap.
Json criterion_json(const PercolateRun& run, double probability, double density, double error) {
  Json entry = {{"probability", probability}};
  entry["eta"] = run.is_flat() ? Json(nullptr) : number_or_null(density * run.mean_volume);
  entry["std_error"] = run.is_flat() ? Json(nullptr) : number_or_null(error * run.mean_volume);
  entry["number_density"] = number_or_null(density);
  entry["number_density_std_error"] = number_or_null(error);
  return entry;
}

Json size_json(const PercolateRun& run, std::size_t k) {
  const SizeRun& size = run.sizes[k];
  Json json = {{"size", size.size}, {"box", size.edge}, {"realisations", size.found.size()}};
  json["criteria"] = nullptr;
  if (run.crossing) {
    const Crossing::OfSize& of_size = run.crossing->sizes[k];
    for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
      json["criteria"][std::string(name_of_crossing_criterion(c))] =
          criterion_json(run, run.crossing->probability[c], of_size.density[c], of_size.std_error[c]);
    }
    return json;
  }
  if (k >= run.thresholds.size()) return json;
  const SizedThreshold& threshold = run.thresholds[k];
  json["criteria"] = Json::object();
  for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
    const WrappingCriterion criterion = static_cast<WrappingCriterion>(c);
    json["criteria"][std::string(name_of(criterion))] = criterion_json(
        run, universal_probability(criterion).value, threshold.density[c], std::sqrt(threshold.covariance[c][c]));
  }
  return json;
}

// Errors in units of the threshold that is told: eta, or the number density of flat bodies.
Json fit_json(const PercolateRun& run) {
  if (!run.threshold) return nullptr;
  const Extrapolation& fit = *run.threshold;
  const double unit = run.eta_unit();
  Json json = {
      {"extrapolated", fit.is_extrapolated},
      {"exponent", fit.exponent},
      {"exponent_error", fit.exponent_std_error},
      {"exponent_beforehand", run.crossing ? estimated_json(Estimated{kCorrectionExponent, kCorrectionExponentError})
                                           : estimated_json(Estimated{kSizeExponent, kSizeExponentError})},
      {"scatter_error", fit.scatter_error * unit},
      {"from_offset", fit.offset_error * unit},
      {"from_universal_values", fit.universal_error * unit},
      {"chi_square", fit.chi_square},
      {"degrees_of_freedom", fit.degrees_of_freedom},
      {"p_value", fit.p_value}};
  json["probabilities"] = nullptr;
  if (run.crossing) {
    for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
      json["probabilities"][std::string(name_of_crossing_criterion(c))] =
          estimated_json(Estimated{run.crossing->probability[c], run.crossing->probability_std_error[c]});
    }
  }
  json["without_smallest"] = nullptr;
  if (fit.without_smallest) json["without_smallest"] = *fit.without_smallest * unit;
  return json;
}

// All realisations, in full: what vex_merge adds.
Json tally_of(const PercolateRun& run, const std::vector<std::string>& of) {
  Json lines = Json::array();
  const std::string text = realisations_text(run, of);
  for (std::string_view rest = text; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1)) {
    lines.push_back(rest.substr(0, rest.find('\n')));
  }
  std::size_t fewest = run.sizes.front().found.size();
  for (const SizeRun& size : run.sizes) fewest = std::min(fewest, size.found.size());
  return {{"first_realisation", run.first_realisation()}, {"realisations", fewest}, {"of", of}, {"state", lines}};
}

}  // namespace

void set_found(Json& json, const PercolateRun& run, const std::vector<std::string>& of) {
  const std::optional<CriticalValues> values = critical_values(run);
  json["eta_c"] = values ? estimated_json(values->eta) : Json(nullptr);
  json["phi_c"] = values ? estimated_json(values->phi) : Json(nullptr);
  json["number_density_c"] = values ? estimated_json(values->number_density) : Json(nullptr);
  json["b_c"] = values ? estimated_json(values->b) : Json(nullptr);
  json["sizes"] = Json::array();
  for (std::size_t k = 0; k < run.sizes.size(); ++k) json["sizes"].push_back(size_json(run, k));
  json["extrapolation"] = fit_json(run);
  json.erase("no_threshold_reason");
  if (!run.threshold) json["no_threshold_reason"] = run.no_threshold_reason;
  const PercolationCounts counts = run.counts();
  json["bodies_placed"] = counts.n_bodies;
  // Pairs whose circumscribed balls may meet: seen = skipped + tested (PercolationCounts).
  json["pairs"] = {{"seen", counts.n_seen()},
                   {"skipped", counts.n_skipped()},
                   {"tested", counts.n_tested()},
                   {"undecided", counts.n_undecided}};
  if (run.options.is_part) json["tally"] = tally_of(run, of);
}

std::string report_json(const PercolateRun& run) {
  const PercolateOptions& options = run.options;
  Json json = document_head(run.command, options, run.complete, run.seconds_before + run.seconds);
  json["bodies"] = Json::array();
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    Json body = body_json(run.bodies[k], options.dump_vertices);
    body["fraction"] = options.bodies[k].fraction;
    json["bodies"].push_back(std::move(body));
  }
  json["orientations"] = options.law;
  const std::optional<double> order_parameter = options.orientations.law.order_parameter();
  const bool is_by_law = !options.orientations.uniform_polar_angle;
  json["order_parameter"] = is_by_law && order_parameter ? Json(*order_parameter) : Json(nullptr);
  json["shell"] = options.shell;
  json["backend"] = options.backend_name;
  json["isa"] = name_of(options.instruction_set);
  for (const char* const key : {"eta_c", "phi_c", "number_density_c", "b_c"}) json[key] = nullptr;
  json["excluded_volume"] = nullptr;
  json["excluded_volume_std_error"] = nullptr;
  if (run.excluded_volume.reason.empty()) {
    json["excluded_volume"] = number_or_null(run.excluded_volume.value);
    json["excluded_volume_std_error"] = number_or_null(run.excluded_volume.std_error);
  } else {
    json["excluded_volume_reason"] = run.excluded_volume.reason;
  }
  json["mean_volume"] = run.mean_volume;
  json["size_unit"] = run.extent;
  json["sizes"] = nullptr;
  json["isotropic"] = run.is_isotropic;
  json["threshold_by"] = run.is_isotropic ? "universal-probabilities" : "crossing";
  set_found(json, run, system_lines(run));
  if (!run.stopped_because.empty()) json["stopped_because"] = run.stopped_because;
  return document_text(json);
}

}  // namespace vex
