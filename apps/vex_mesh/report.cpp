#include "apps/vex_mesh/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/common/estimate_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_mesh/run_identity.h"
#include "shapes/formula.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> backend_names(const MeshRun& run) {
  std::vector<std::string> names = {run.options.settings.backend.name};
  for (const BackendKind& kind : run.options.settings.cross_check) names.push_back(kind.name);
  return names;
}

bool samples_poses(const MeshRun& run) {
  return run.result.estimator != nullptr && run.result.estimator->samples_poses;
}
bool runs_gjk(const MeshRun& run) { return run.result.estimator == nullptr || run.result.estimator->runs_gjk; }
bool has_trials(const MeshRun& run) { return run.result.record.tally.n_trials > 0; }
double relative_error_of(const MeshRun& run) { return run.result.std_error / run.result.value; }

// By how much a trial of this run took longer than it was counted to: costs are counted in nanoseconds of some machine,
// the same everywhere, and the run tells what such a nanosecond is here.
double pace_of(const MeshRun& run) {
  for (const Candidate& candidate : run.result.candidates) {
    if (candidate.estimator != run.result.estimator || run.result.record.tally.n_trials == 0) continue;
    const double counted = candidate.cost.seconds_per_trial * static_cast<double>(run.result.record.tally.n_trials);
    return run.result.record.seconds * run.options.n_threads / counted;
  }
  return 1.0;
}

// What the run's error cost, or would have cost with another estimator; on as many threads.
double seconds_of(const Candidate& candidate, const MeshRun& run) {
  return pace_of(run) * candidate.cost.seconds_to(relative_error_of(run)) / run.options.n_threads;
}

Json pilot_json(const MeshRun& run) {
  Json list = Json::array();
  for (const Candidate& candidate : run.result.candidates) {
    list.push_back({{"estimator", candidate.estimator->name},
                    {"sequence", name_of(candidate.sequence)},
                    {"runs_gjk", candidate.estimator->runs_gjk},
                    {"trials", candidate.cost.n_trials},
                    {"seconds_per_trial", candidate.cost.seconds_per_trial},
                    {"relative_error", number_or_null(candidate.cost.relative_error)},
                    {"slope", candidate.cost.slope},
                    {"seconds_to_this_error", has_trials(run) ? number_or_null(seconds_of(candidate, run)) : Json()}});
  }
  return list;
}

std::string pilot_text(const MeshRun& run) {
  std::string text = "   chosen by a pilot                 rel. error " + short_number(relative_error_of(run), 2);
  for (const Candidate& candidate : run.result.candidates) {
    if (candidate.estimator->name != "hit-or-miss") continue;
    const double error =
        candidate.cost.relative_error_after(run.result.record.seconds * run.options.n_threads / pace_of(run));
    if (std::isfinite(error)) text += "; hit-or-miss would have " + short_number(error, 2) + " after as long";
  }
  for (const bool runs_gjk : {true, false}) {
    if (!(relative_error_of(run) < 1.0)) break;  // no error that a time could be told to
    std::string line;
    for (const Candidate& candidate : run.result.candidates) {
      if (candidate.estimator->runs_gjk != runs_gjk) continue;
      const double seconds = seconds_of(candidate, run);
      if (candidate.estimator == run.result.estimator) continue;  // this one's is known
      line += (line.empty() ? "" : ", ") + std::string(candidate.estimator->name) + " " +
              (std::isfinite(seconds) ? short_number(seconds, 2) + " s" : "unknown");
    }
    if (line.empty()) continue;
    text += (runs_gjk ? "\n   others to this error, about       " : "\n   with the formula's geometry       ") + line;
  }
  return text + "\n";
}

double control_mean(const MeshRun& run) {
  return average_excluded_volume(run.control_bodies.front().shape.measures, run.control_bodies.back().shape.measures);
}

Json control_json(const MeshRun& run) {
  return {{"bodies", {run.control_bodies.front().source, run.control_bodies.back().source}},
          {"excluded_volume", control_mean(run)},
          {"weight", run.result.control_weight}};
}

std::string control_text(const MeshRun& run) {
  const std::string &a = run.control_bodies.front().source, &b = run.control_bodies.back().source;
  return "   control variate                   " + printable(a == b ? a : a + ", " + b) +
         ", <V_ex> = " + short_number(control_mean(run), 10) + " by the formula, weight " +
         short_number(run.result.control_weight, 3) + "\n";
}

Json estimate_json(const MeshRun& run) {
  Json json;
  const bool has_hits = samples_poses(run);
  const bool is_run = run.result.estimator != nullptr;
  json["estimator"] = is_run ? Json(run.result.estimator->name) : Json(nullptr);
  json["sequence"] = is_run ? Json(name_of(run.result.sequence)) : Json(nullptr);
  json["backend"] = runs_gjk(run) ? run.options.settings.backend.name : "none";
  json["orientations"] = run.options.settings.law.name();
  set_tallied(json, run.result);
  if (!run.control_bodies.empty()) json["control_variate"] = control_json(run);
  json["domain"] = has_hits ? Json(name_of(run.result.domain.kind)) : Json(nullptr);
  json["quick_verdicts"] = has_hits && run.options.settings.quick_verdicts && !run.options.settings.backend.is_peer;
  json["isa"] = name_of(run.options.settings.instruction_set);
  return json;
}

std::string decided_by_text(const Tally& tally) {
  std::string text;
  for (const DecidedBy by : kAllDecidedBy) {
    const std::uint64_t n = tally.n_decided_by[static_cast<std::size_t>(by)];
    if (n == 0) continue;
    const char* const name = by == DecidedBy::outer_bound     ? "outer bounds "
                             : by == DecidedBy::inner_bound   ? "inner bounds "
                             : by == DecidedBy::gjk           ? "GJK "
                             : by == DecidedBy::double_double ? "double-double "
                             : by == DecidedBy::exact         ? "exact "
                                                              : "peer ";
    const double percent = 100.0 * static_cast<double>(n) / static_cast<double>(tally.n_trials);
    text += (text.empty() ? "" : ", ") + std::string(name) + short_number(percent, 3) + " %";
  }
  return text;
}

std::string cross_check_text(const MeshRun& run) {
  const std::vector<std::string> names = backend_names(run);
  const FirstOf<Disagreement>& found = run.result.record.disagreements;
  std::string text = "\nCross-check";
  for (const std::string& name : names) text += " " + name;
  if (names.size() == 1) text += " (alone: nothing to compare with)";
  text += ": " + std::to_string(found.n_all) + " of " + std::to_string(run.result.record.tally.n_trials) +
          " poses disputed\n";
  for (std::size_t k = 1; k < names.size(); ++k) {
    if (const std::uint64_t n = run.result.record.comparisons[k - 1].n_undecided; n > 0) {
      text += "   " + names[k] + " gave up on " + std::to_string(n) + "\n";
    }
  }
  for (const std::string& reason : run.left_out) text += "   left out: " + printable(reason) + "\n";
  constexpr std::size_t kShown = 10;
  for (std::size_t j = 0; j < found.kept.size() && j < kShown; ++j) {
    const Disagreement& one = found.kept[j];
    text += "   trial " + std::to_string(one.index) + ":";
    for (std::size_t k = 0; k < names.size(); ++k) text += " " + names[k] + " " + std::string(name_of(one.outcomes[k]));
    text += "\n      r11 ... r33, tx, ty, tz =";
    for (const double value : twelve_numbers(one.a_from_b)) text += " " + hex_number(value);
    text += "\n";
  }
  if (found.n_all > kShown) text += "   ... --json lists the first " + std::to_string(found.kept.size()) + "\n";
  return text;
}

std::string verification_text(const MeshRun& run) {
  const FirstOf<UnprovenTrial>& unproven = run.result.record.unproven;
  std::string text = "\nVerification  " + std::to_string(run.result.record.n_proven_again) +
                     " verdicts proven again, in exact arithmetic; " + std::to_string(unproven.n_all) + " not\n";
  if (run.result.record.tally.n_undecided > 0) {
    text += "   " + std::to_string(run.result.record.tally.n_undecided) + " undecided trials claim nothing\n";
  }
  constexpr std::size_t kShown = 10;
  for (std::size_t j = 0; j < unproven.kept.size() && j < kShown; ++j) {
    const UnprovenTrial& trial = unproven.kept[j];
    text += "   trial " + std::to_string(trial.index) + ", " + std::string(name_of(trial.outcome)) + ": " +
            trial.fault + "\n      r11 ... r33, tx, ty, tz =";
    for (const double value : twelve_numbers(trial.a_from_b)) text += " " + hex_number(value);
    text += "\n";
  }
  return text;
}

// With its error, unless that is beyond the digits shown.
std::string reference_number(double value, double std_error) {
  return std_error > 1e-11 * value ? with_error(value, std_error) : short_number(value, 12);
}

Json reference_json(const Reference& reference) {
  return {{"kind", name_of(reference.kind)},
          {"excluded_volume", number_or_null(reference.value)},
          {"std_error", reference.std_error},
          {"reduced", number_or_null(reference.reduced)},
          {"b2", number_or_null(reference.b2)}};
}

constexpr const char* kNoReduced = "none: a flat body has no volume";

std::string reference_text(const MeshRun& run) {
  const std::optional<Reference>& reference = run.result.reference;
  std::string text = "\nFormula  V_A + V_B + (M_A S_B + M_B S_A)/4pi, random orientations\n";
  if (!run.result.reference_reason.empty()) text += "   none: " + run.result.reference_reason + "\n";
  if (!reference) return text;
  const bool is_formula = reference->kind == Reference::Kind::formula;
  if (!is_formula) {
    text += run.options.settings.law.dimension() == 0 ? "Exact value  at this one orientation"
                                                      : "Exact average  over these orientations";
    text += run.result.no_run_reason.empty() ? ", from mixed volumes\n" : "\n";
  }
  const auto number = [&](double value) {
    return reference_number(value,
                            reference->std_error > 0.0 ? reference->std_error * (value / reference->value) : 0.0);
  };
  text += std::string("   <V_ex>, ") + (is_formula ? "formula" : "exact  ") + "                   " +
          number(reference->value) + "\n";
  text += "   <V_ex> / sqrt(V_A V_B)            " +
          (std::isnan(reference->reduced) ? kNoReduced : number(reference->reduced)) + "\n";
  return text + "   B2 = <V_ex>/2                     " + number(reference->b2) + "\n";
}

// Of laws that are about an axis; 0 and 1 of isotropic and aligned ones go without saying.
std::string order_text(const OrientationLaw& law) {
  const std::optional<std::array<double, 2>> each = law.order_parameters();
  if (!each || law == OrientationLaw::isotropic() || law == OrientationLaw::aligned()) return "";
  std::string text = "   order parameter S                 " + short_number((*each)[0], 8);
  if (!law.order_parameter()) text += " of A, " + short_number((*each)[1], 8) + " of B";
  return text + "\n";
}

// What z says.
std::string verdict_on(const MeshRun& run) {
  const Tally& tally = run.result.record.tally;
  const double undecided = static_cast<double>(tally.n_undecided) / static_cast<double>(tally.n_trials);
  const double half_width = tally.by_class.kind == ClassTally::Kind::none
                                ? 0.5 * undecided * mean_sampling_volume(tally, run.result.domain)
                                : half_width_of_undecided(tally);
  if (half_width > 0.5 * run.result.std_error) {
    return "nothing is compared, for " + short_number(100.0 * undecided, 3) +
           " % of the trials are undecided, and that is most of the error";
  }
  std::string text = std::fabs(*run.result.z) <= run.options.max_z
                         ? "they agree"
                         : "THEY DISAGREE (more than --max-z " + short_number(run.options.max_z) + ")";
  const std::uint64_t fewest = std::min(tally.n_hits, tally.n_misses());
  if (samples_poses(run) && fewest < kMinHitsAndMisses) {
    text += ", but " + std::to_string(fewest) + (tally.n_hits == fewest ? " hit" : " miss") +
            (fewest == 1              ? " says"
             : tally.n_hits == fewest ? "s say"
                                      : "es say") +
            " little";
  }
  return text;
}

}  // namespace

std::string report_json(const MeshRun& run) {
  Json json = document_head(run.command, run.options, run.result.record.complete, run.result.record.seconds);
  json["bodies"] = {body_json(run.a, run.options.dump_vertices), body_json(run.b, run.options.dump_vertices)};
  const std::optional<Reference>& reference = run.result.reference;
  const bool is_formula = reference && reference->kind == Reference::Kind::formula;
  json["formula"] = nullptr;
  if (is_formula) {
    json["formula"] = {{"excluded_volume", number_or_null(reference->value)},
                       {"reduced", number_or_null(reference->reduced)},
                       {"b2", number_or_null(reference->b2)}};
  } else {
    json["formula_reason"] = run.result.reference_reason;
    json["exact_average"] = nullptr;
    if (reference) json["exact_average"] = {{"excluded_volume", reference->value}, {"error", reference->std_error}};
  }
  json["reference"] = reference ? reference_json(*reference) : Json(nullptr);
  if (!reference) json["reference_reason"] = run.result.reference_reason;
  const std::optional<double> order_parameter = run.options.settings.law.order_parameter();
  json["order_parameter"] = order_parameter ? Json(*order_parameter) : Json(nullptr);
  if (const std::optional<std::array<double, 2>> each = run.options.settings.law.order_parameters()) {
    json["order_parameters"] = *each;
  }
  json["estimate"] = estimate_json(run);
  if (!run.result.candidates.empty()) json["pilot"] = pilot_json(run);
  set_comparison(json, run.result);
  if (has_trials(run)) json["tally"] = tally_json(trials_identity(run), run.result);
  if (run.options.settings.verify) json["verification"] = verification_json(run.result.record);
  if (run.options.is_cross_check) {
    json["n_disagreements"] = run.result.record.disagreements.n_all;
    json["disagreements"] = disagreements_json(run.result.record, backend_names(run));
    json["cross_check"] = backend_names(run);
    json["cross_check_left_out"] = run.left_out;
  }
  return document_text(json);
}

std::string report_text(const MeshRun& run) {
  std::string text = body_text(run.a, "A", run.options.dump_vertices);
  text += are_copies(run.a, run.b) ? "B  the same body\n" : body_text(run.b, "B", run.options.dump_vertices);

  text += reference_text(run);
  text += order_text(run.options.settings.law);

  if (!run.result.no_run_reason.empty()) return text + "\nMonte Carlo  no run: " + run.result.no_run_reason + "\n";

  const Tally& tally = run.result.record.tally;
  const bool has_hits = samples_poses(run);
  text += "\nMonte Carlo  " + std::string(run.result.estimator->name) +
          (run.result.sequence == Sequence::sobol ? ", Sobol' points, " : ", ") + run.options.settings.law.name() +
          " orientations, ";
  if (has_hits) {
    text += std::string(run.result.stratified ? "shells" : name_of(run.result.domain.kind)) +
            (run.result.stratified                            ? " of volume "
             : run.result.domain.kind != Domain::Kind::fitted ? " domain of volume "
                                                              : " domains of mean volume ") +
            short_number(sampling_volume(run.result), 6) + ", ";
  }
  text += (runs_gjk(run) ? run.options.settings.backend.name : "no GJK") + ", seed " +
          std::to_string(run.options.seed) + "\n";
  if (has_trials(run)) {
    const double error = run.result.std_error;
    text += "   <V_ex>, Monte Carlo               " + with_error(run.result.value, error);
    text += std::isfinite(error) ? "   95 %: " + short_number(run.result.ci95.lower, 8) + " ... " +
                                       short_number(run.result.ci95.upper, 8) + "\n"
                                 : "   (fewer than 32 trials: no error is known)\n";
    if (run.result.value > 0.0) {
      if (!std::isnan(run.result.reduced)) {
        text += "   <V_ex> / sqrt(V_A V_B)            " +
                with_error(run.result.reduced, error * (run.result.reduced / run.result.value)) + "\n";
      }
      text += "   B2 = <V_ex>/2                     " + with_error(run.result.b2, 0.5 * error) + "\n";
    }
    text += has_hits ? "   hits / trials                     " + std::to_string(tally.n_hits) + " / "
                     : "   values                            ";
    text += std::to_string(tally.n_trials);
    if (tally.n_undecided > 0) text += ", undecided " + std::to_string(tally.n_undecided);
    text += "\n";
    if (has_hits && tally.n_undecided < tally.n_trials)
      text += "   decided by                        " + decided_by_text(tally) + "\n";
  }
  text += "   " + short_number(run.result.record.seconds, 3) + " s on " + std::to_string(run.options.n_threads) +
          (run.options.n_threads == 1 ? " thread, " : " threads, ") +
          short_count(static_cast<double>(tally.n_trials) / run.result.record.seconds) +
          (has_hits ? " trials/s" : " values/s");
  if (run.result.record.stopped_by == StopReason::interrupted)
    text += " - interrupted: this is what was done until then";
  if (run.result.record.stopped_by == StopReason::undecided) {
    text += " - incomplete: undecided trials alone keep the error above what was asked for";
  }
  if (run.result.record.stopped_by == StopReason::rounding) {
    text += " - incomplete: rounding alone keeps the error above what was asked for";
  }
  if (run.result.record.stopped_by == StopReason::in_vain) {
    text += " - incomplete: more than --max-trials would be needed";
  }
  if (run.result.record.stopped_by == StopReason::max_trials) text += " - incomplete: --max-trials was reached first";
  text += "\n";
  if (!run.control_bodies.empty()) text += control_text(run);
  if (has_trials(run) && !run.result.candidates.empty()) text += pilot_text(run);
  if (run.options.is_cross_check) text += cross_check_text(run);
  if (run.options.settings.verify) text += verification_text(run);

  if (run.result.z) {
    text += "\nz = " + short_number(*run.result.z, 3) + " standard errors between Monte Carlo and " +
            (run.result.reference->kind == Reference::Kind::formula ? "formula: " : "exact average: ");
    text += verdict_on(run) + "\n";
  } else {
    text += "\nz: none - " + run.result.z_reason + "\n";
  }
  return text;
}

}  // namespace vex
