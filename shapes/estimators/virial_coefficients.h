// Virial coefficients of hard convex bodies: B2 as it is known, B3 to B8 by Monte Carlo over clusters of overlapping
// bodies (engine/sampling/virial); B3 over triangles whose place is integrated, where that is better.
//
// p / kT = n + B2 n^2 + B3 n^3 + ..., n being the number of bodies a volume. B_n / B2^(n-1) is measured without B2.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/virial/virial_pairs.h"
#include "shapes/body.h"

namespace vex {

/// All of it has a default.
struct VirialSettings {
  int order = 4;        // the last coefficient, 3 to 8
  int first_order = 3;  // the first one: the same as `order` for one coefficient alone, of which there is no series

  // When the run of each coefficient ends: whichever comes first; without any at `rel_error` = 1e-3 or `seconds` = 60.
  std::optional<double> rel_error{};       // std_error / |B_n|
  std::optional<double> seconds{};         // of all coefficients: what one leaves of its part is the next ones'
  std::optional<std::uint64_t> samples{};  // clusters of each; as many more as make whole bunches
  std::optional<std::uint64_t> trials{};   // the same in bunches of clusters, or of as many triangles
  std::uint64_t max_trials = StopRule{}.max_trials;  // bunches

  /// Of each body on its own: not `fixed`, `angle` and `each`, which are about two bodies. One that is neither
  /// isotropic nor aligned needs B2, and so the bodies' measures on normals.
  OrientationLaw law{};
  std::uint64_t seed = 1;
  int threads = 0;  // 0: one for each core. The result is the same for any number, unless `seconds` ends the run.

  InstructionSet instruction_set = best_instruction_set();
  const std::atomic<int>* interrupt = nullptr;
  /// Of the coefficient of order n.
  std::function<void(int n, const Progress&)> on_progress{};

  /// Bunches first_trial, first_trial + 1, ... of each coefficient: with `trials` alone.
  std::uint64_t first_trial = 0;
  /// Of a run with the same body and settings, the states of the coefficients that it came to, in their order: it goes
  /// on from there and ends as one run without a break does, the bits of every coefficient the same.
  std::vector<RunState> resume{};
  /// Given the same as far as the run came, every so many seconds, and at the end of each coefficient.
  std::function<void(const std::vector<RunState>&)> on_state{};
  double seconds_between_states = 5.0;
  /// Other processes that take part (MonteCarloSettings::ranks). On one that does not lead nothing is found.
  Ranks* ranks = nullptr;
};

struct VirialCoefficient {
  int n = 0;
  double reduced = 0.0;  // B_n / B2^(n-1); NaN where the run was interrupted before its first trial
  double std_error = 0.0;
  double per_volume = 0.0;  // B_n / V^(n-1); NaN where the body is flat, or V or B2 not known
  double per_volume_std_error = 0.0;
  std::uint64_t samples = 0;  // clusters
  VirialPairs pairs;
  RunRecord record;  // of the driver, whose trials are bunches of clusters, or single triangles

  /// As many triangles are what settings call a trial, so that all coefficients have one range of trials.
  static constexpr std::uint64_t kTrianglesOfBunch = 256;

  /// Sets all but n from the record; B2 in units of V, its relative error.
  void conclude(double b2_per_volume, double b2_relative_error);

  /// Whether B_n is known to be above, or below, 0: three standard errors away.
  bool sign_is_settled() const;
};

struct VirialCoefficients {
  double b2 = 0.0;  // length^3; NaN where it is not known
  double b2_std_error = 0.0;
  double b2_per_volume = 0.0;             // NaN where the body is flat
  std::string b2_reason;                  // why it is not known
  std::vector<VirialCoefficient> higher;  // n = first_order ... order
  bool complete = true;                   // whether stop rules ended all runs
  double seconds = 0.0;

  double b2_relative_error() const { return b2 > 0.0 ? b2_std_error / b2 : 0.0; }

  /// Whether none is left out from B3 on.
  bool is_series() const;
  /// Z = p / (n k T) by the volume fraction, of the series to the last coefficient: no equation of state, but its
  /// beginning. NaN where per_volume is, or where there is no series.
  double compressibility_factor(double volume_fraction) const;
};

/// B2 by the formula, or the exact mean over the law; B3 ... by a run of the driver each.
///
/// The same seed, body and settings give the same bits on any machine and for any number of threads (`seconds`
/// excepted). Throws UsageError where the settings are none, InputError for a body that never overlaps itself (a
/// needle; aligned plates), as of which there are no ratios.
VirialCoefficients virial_coefficients(const Body& body, const VirialSettings& settings = {});

/// One third virial coefficient of a mixture of A and B: of three bodies, some of each.
struct MixedVirial {
  std::string name;    // AAA, AAB, ABB, BBB
  double value = 0.0;  // length^6
  double std_error = 0.0;
  double reduced = 0.0;  // divided by B_ij B_jk, i, j, k being the letters of the name
  double reduced_std_error = 0.0;
  std::uint64_t samples = 0;
  VirialPairs pairs;
  RunRecord record;

  double b2_product = 0.0, b2_relative_error = 0.0;  // B_ij B_jk, length^6

  /// Sets all but the name and these two from the record.
  void conclude();
};

/// B_ijk of two bodies, all by one law, with the B_ij known for it. The orders of the settings are not looked at: it is
/// 3.
std::array<MixedVirial, 4> third_virials_of_mixture(const Body& a, const Body& b, const VirialSettings& settings = {});

}  // namespace vex
