// The rows of vex_paper: what is computed for each, and how.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/vex_paper/options.h"
#include "apps/vex_paper/paper.h"
#include "engine/sampling/monte_carlo.h"

namespace vex {

/// One pair of bodies under one law, as a user of vex_mesh would ask for it.
struct Case {
  int number = 0;  // its own, so that every row has a seed of its own
  std::string label;
  std::optional<double> aspect_ratio{};
  std::string a, b;
  bool unit_volume = false;
  std::string orientations = "isotropic";
  /// Fitted, but where that would be the excluded volume itself: a row must be able to fail.
  Domain::Kind domain = Domain::Kind::fitted;
  bool quick_verdicts = true;
  std::optional<paper::Printed> printed{};
  std::string remark{};
};

std::vector<Case> table_one();
std::vector<Case> table_two();
std::vector<Case> cases_of_the_text();

/// What every run of the program shares.
struct Sampling {
  std::uint64_t seed = 1, n_trials = 1;
  int n_threads = 1;
  const std::atomic<int>* interrupt = nullptr;
  std::function<void(const Progress&)> on_progress{};

  static constexpr std::uint64_t kLargestSeed = ~std::uint64_t{0} / 1000 - 1;
  /// Of a case: row 7 under seed 1 is a run of vex_mesh with seed 1007.
  std::uint64_t seed_of(const Case& of) const { return 1000 * seed + static_cast<std::uint64_t>(of.number); }
};

/// A case against its exact value.
struct Row {
  Case what;
  std::string command;       // the same run by vex_mesh
  double exact = 0.0;        // the formula, or, for laws for which it does not hold, exact_average
  double exact_error = 0.0;  // of the latter
  RunRecord record{};
  VolumeEstimate found{};

  /// Signed, in standard errors of both together.
  double z() const;
  /// Trials that a relative standard error of 10^-3 takes: what the row costs.
  double trials_for_a_thousandth() const;
};

/// Nothing where the run was interrupted before its first trial.
std::optional<Row> measure(const Case& what, const Sampling& sampling);

/// A wrong overlap test of boxes in a row of Table I.
struct WrongValue {
  std::string name;
  double excluded_volume = 0.0,
         std_error = 0.0;  // the exact value minus the deficit: the exact test is the control variate
  double deficit = 0.0;    // with the same error; negative where the test invents overlaps
};

struct ErratumRow {
  Case what;
  double exact = 0.0;
  RunRecord record{};
  VolumeEstimate found{};          // by the exact test on the same trials
  std::vector<WrongValue> values;  // of the one-sided test first

  /// The exact test against the exact value, in standard errors: whether the deficits can be trusted.
  double z_of_exact_test() const { return (found.excluded_volume - exact) / found.std_error; }

  /// The one-sided test's value against the paper's, in standard errors of both together. Only where the paper has one.
  double z() const;
};

std::vector<Case> erratum_cases();
/// Cubes at fixed relative orientations: which of them show that the test is wrong.
std::vector<Case> erratum_orientations();
/// The same bodies at other aspect ratios, of which the paper says nothing.
std::vector<Case> curve_cases();
std::optional<ErratumRow> measure_erratum(const Case& what, const Sampling& sampling);

/// Sum of z^2 over the rows, and the probability that it is as large or larger by chance.
struct ChiSquared {
  double value = 0.0, p = 1.0;
};
ChiSquared chi_squared(const std::vector<ErratumRow>& rows);

/// One specialised test beside the engine on the same poses.
struct RefereeRow {
  Case what;
  std::string test;
  std::uint64_t n_poses = 0, n_engine_undecided = 0, n_test_undecided = 0;
  std::uint64_t n_disagreements = 0;
  std::uint64_t n_engine_right = 0, n_test_right = 0;  // of those that exact arithmetic judged: the first 1000 of a run
  std::uint64_t n_not_judged() const { return n_disagreements - n_engine_right - n_test_right; }
  double seconds = 0.0;
  bool complete = false;
};

std::vector<Case> referee_cases();
/// The specialised tests: boxes, ellipsoids, capsules and spheres; boxes by their edges.
std::vector<BackendKind> specialised_tests();
/// A row for each of the tests that takes the pair. No quick verdict is put before the engine: it answers every pose.
std::vector<RefereeRow> measure_referees(const Case& what, const Sampling& sampling,
                                         const std::vector<BackendKind>& tests = specialised_tests(),
                                         const BackendKind& engine = gjk_backend());

}  // namespace vex
