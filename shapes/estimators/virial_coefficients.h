// Virial coefficients of hard convex bodies: B2 as it is known, B3 to B8 by Monte Carlo over clusters of overlapping
// bodies (engine/sampling/virial).
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
#include "shapes/body.h"

namespace vex {

/// All of it has a default.
struct VirialSettings {
  int order = 4;  // the last coefficient, 3 to 8

  // When the run of each coefficient ends: whichever comes first; without any at `rel_error` = 1e-3 or `seconds` = 60.
  std::optional<double> rel_error{};       // std_error / |B_n|
  std::optional<double> seconds{};         // of all coefficients: what one leaves of its part is the next ones'
  std::optional<std::uint64_t> samples{};  // clusters of each; as many more as make whole bunches
  std::uint64_t max_trials = StopRule{}.max_trials;  // bunches, which are what the driver counts

  OrientationLaw law{};  // isotropic or aligned: of others a chain of bodies is no power of B2
  std::uint64_t seed = 1;
  int threads = 0;  // 0: one for each core. The result is the same for any number, unless `seconds` ends the run.

  InstructionSet instruction_set = best_instruction_set();
  const std::atomic<int>* interrupt = nullptr;
  /// Of the coefficient of order n.
  std::function<void(int n, const Progress&)> on_progress{};
};

/// Pairs of bodies that are no neighbours of their chain or tree: asked are those by balls and by a search.
struct VirialPairs {
  std::uint64_t n_all = 0, n_by_balls = 0, n_searched = 0;
  std::uint64_t n_undecided = 0;   // neighbours among them
  std::uint64_t n_candidates = 0;  // poses that neighbours were found among

  /// Not asked, because the weight of the cluster was known to be 0.
  std::uint64_t n_skipped() const { return n_all - n_by_balls - n_searched; }
};

struct VirialCoefficient {
  int n = 0;
  double reduced = 0.0;  // B_n / B2^(n-1); NaN where the run was interrupted before its first trial
  double std_error = 0.0;
  double per_volume = 0.0;  // B_n / V^(n-1); NaN where the body is flat, or V or B2 not known
  double per_volume_std_error = 0.0;
  std::uint64_t samples = 0;  // clusters
  VirialPairs pairs;
  RunRecord record;  // of the driver, whose trials are bunches of clusters

  /// Whether B_n is known to be above, or below, 0: three standard errors away.
  bool sign_is_settled() const;
};

struct VirialCoefficients {
  double b2 = 0.0;  // length^3; NaN where it is not known
  double b2_std_error = 0.0;
  double b2_per_volume = 0.0;             // NaN where the body is flat
  std::string b2_reason;                  // why it is not known
  std::vector<VirialCoefficient> higher;  // n = 3 ... order
  bool complete = true;                   // whether stop rules ended all runs
  double seconds = 0.0;

  /// Z = p / (n k T) by the volume fraction, of the series to the last coefficient: no equation of state, but its
  /// beginning. NaN where per_volume is.
  double compressibility_factor(double volume_fraction) const;
};

/// B2 by the formula, or the exact mean of aligned bodies; B3 ... by a run of the driver each.
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
  RunRecord record;
};

/// B_ijk of two bodies, in random orientation, with the B_ij of the formula. The `order` of the settings is not looked
/// at: it is 3.
std::array<MixedVirial, 4> third_virials_of_mixture(const Body& a, const Body& b, const VirialSettings& settings = {});

}  // namespace vex
