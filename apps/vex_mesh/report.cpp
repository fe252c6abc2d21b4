// What vex_mesh says on the screen.
#include "apps/vex_mesh/report.h"

#include <algorithm>
#include <cmath>

#include "apps/common/body_report.h"
#include "apps/common/estimate_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_mesh/run_facts.h"

namespace vex {
namespace {

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

std::string control_text(const MeshRun& run) {
  const std::string &a = run.control_bodies.front().source, &b = run.control_bodies.back().source;
  return "   control variate                   " + printable(a == b ? a : a + ", " + b) +
         ", <V_ex> = " + short_number(control_mean(run), 10) + " by the formula, weight " +
         short_number(run.result.control_weight, 3) + "\n";
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
  const std::string why = why_incomplete(run.result.record.stopped_by);
  if (!why.empty()) text += " - " + why;
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
