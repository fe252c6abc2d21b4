// The front door: the average excluded volume of two bodies, by Monte Carlo, beside the value that is known.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/sampling/monte_carlo.h"
#include "shapes/body.h"
#include "shapes/estimators/choice.h"
#include "shapes/estimators/estimator.h"

namespace vex {

/// What a run is about to be, as far as its pilot tells.
struct Outlook {
  const Estimator* estimator = nullptr;
  Sequence sequence{};
  /// Until the first of its stop rules ends it, on its threads, beyond what a resumed run took already: right to a
  /// factor of two or three. Infinite where the pilot could not tell.
  double seconds = 0.0;
  bool gives_up = false;  // it reaches `max_trials` before
};

/// All of it has a default: without any setting the run ends at a standard error of 1e-4 of the result.
struct ExcludedVolumeSettings {
  // When the run ends: whichever comes first, but for the last at least one; without any of the three at
  // `rel_error` = 1e-4.
  std::optional<double> rel_error{};  // std_error / value
  std::optional<std::uint64_t> trials{};
  std::optional<double> seconds{};
  std::uint64_t max_trials = StopRule{}.max_trials;  // a run that reaches it is not complete

  OrientationLaw law{};
  std::string estimator{};  // a name of `estimators()`; empty: a pilot chooses, by the seed and the bodies alone
  std::optional<Sequence> sequence{};  // the estimator's usual one
  std::uint64_t seed = 1;
  int threads = 0;  // 0: one for each core. The result is the same for any number.

  /// Simpler bodies, like A and B, whose known mean makes the error of an estimator without poses smaller: none, one
  /// for both, or two. The result then leans on the formula.
  std::vector<Body> control_variate{};
  /// Beside the result the exact average over a law that is not isotropic, where there is one: up to a second.
  bool exact_average = true;

  // Of estimators that sample poses alone; hit-or-miss is taken where one is given and no estimator.
  std::string domain{};  // of hit-or-miss: ball, box, or best, which is the smaller one and what empty means
  BackendKind backend = gjk_backend();
  std::vector<BackendKind> cross_check{};
  bool verify = false;
  bool quick_verdicts = true;

  InstructionSet instruction_set = best_instruction_set();  // that draws and casts; the backend has its own
  const std::atomic<int>* interrupt = nullptr;
  std::function<void(const Progress&)> on_progress{};
  /// Called before the first trial; where no pilot chose one is run for it, of some milliseconds.
  std::function<void(const Outlook&)> on_start{};

  // A run in parts: as of MonteCarloSettings.
  std::uint64_t first_trial = 0;
  const RunState* resume = nullptr;
  std::function<void(const RunState&)> on_state{};
  double seconds_between_states = MonteCarloSettings{}.seconds_between_states;
  Ranks* ranks = nullptr;
};

/// What <V_ex> is known to be, from other means than the run.
struct Reference {
  enum class Kind : std::uint8_t {
    formula,  // V_A + V_B + (M_A S_B + M_B S_A) / 4 pi, for isotropic orientations
    exact,    // the mean of mixed volumes over the law (exact_average.h)
  };
  Kind kind = Kind::formula;
  double value = 0.0;      // length^3
  double std_error = 0.0;  // of `exact`, a bound on rounding included; of the formula 0
  double reduced = 0.0;    // value / sqrt(V_A V_B); NaN where a body is flat
  double b2 = 0.0;         // value / 2
};

constexpr std::string_view name_of(Reference::Kind kind) {
  return kind == Reference::Kind::formula ? "formula" : "exact";
}

/// Values in length^3.
struct ExcludedVolume {
  double value = 0.0;  // NaN where a run was interrupted before its first trial
  double std_error = 0.0;
  Interval95 ci95;
  double reduced = 0.0;  // value / sqrt(V_A V_B); NaN where a body is flat, or its volume not known
  double b2 = 0.0;       // value / 2: the second virial coefficient of hard bodies

  std::optional<Reference> reference;
  std::string reference_reason;  // why there is none
  /// (value - reference) / std_error, and the reason where there is none.
  std::optional<double> z;
  std::string z_reason;

  const Estimator* estimator = nullptr;  // what was run, and with which points; null where nothing was
  Sequence sequence{};
  std::string chosen_because;         // in a sentence
  std::vector<Candidate> candidates;  // what the pilot measured, where it chose
  double control_weight = 0.0;        // of the control variate
  Domain domain;                      // that positions were drawn from, where they were
  bool stratified = false;            // in shells of the domain

  bool complete = true;       // whether a stop rule ended the run
  std::string no_run_reason;  // where the excluded volume is 0 by construction, and nothing was sampled
  RunRecord record;           // counts, sums, times
};

/// The volume that A forbids to B's centre, averaged over the law of their relative orientation.
///
/// Chooses the estimator, runs it, and compares. The same seed, bodies and settings give the same bits on any machine
/// and for any number of threads (`seconds` excepted). Throws UsageError where the settings contradict each other or
/// are not for the bodies, InputError where a volume over- or underflows; exceptions of a backend pass through.
ExcludedVolume excluded_volume(const Body& a, const Body& b, const ExcludedVolumeSettings& settings = {});

/// The estimator that is run: the one asked for; hit-or-miss where a setting is about its poses, radial where there is
/// a control variate. Null where a pilot chooses. Throws UsageError where settings contradict each other, whatever the
/// bodies are.
const Estimator* estimator_asked_for(const ExcludedVolumeSettings& settings);

/// The `z_reason` where every trial hits by construction.
inline constexpr const char* kHitsByConstruction =
    "every trial hits by construction: the domain is the excluded volume itself";

/// Sets value, errors, and the comparison with the reference, from the record and what else the result holds: what
/// `excluded_volume` ends with, for a record that was put together from several. `hits_by_construction`: as of the
/// function of that name, of the domain.
void conclude(const Measures& a, const Measures& b, bool hits_by_construction, ExcludedVolume* result);

/// The formula's side of it, NaN where measures are not known.
Reference formula_reference(const Measures& a, const Measures& b);

}  // namespace vex
