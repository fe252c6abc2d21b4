// The cases of vex_depletion: every distance with every angle, or with a mean over orientations.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_depletion/options.h"

namespace vex {

/// Volumes in length^3, energies in kT; NaN where there is no such number.
struct DepletionCase {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string distance, angle;  // as they were given; no angle of a mean
  std::uint64_t seed = 0;
  Outcome bodies = Outcome::disjoint;                   // of a pose: whether the bodies themselves overlap
  double free_share = kNone, free_share_error = kNone;  // of a mean: the share of orientations where they do not
  double overlap_volume = kNone, std_error = kNone;  // of a pose; of a mean over those orientations where they do not
  double exact = kNone;                              // of two balls
  double z = kNone;
  std::uint64_t trials = 0, undecided = 0;
  bool complete = true;
  StopReason stopped_by = StopReason::trials;  // why it ended; of a mean's two runs the one that is incomplete
  double seconds = 0.0;
};

struct DepletionRun {
  std::string command;
  DepletionOptions options;
  LoadedBody a, b;
  std::vector<DepletionCase> cases{};
  bool complete = true;
  double seconds = 0.0;

  /// -n V_overlap, or -n times its mean; NaN without --fraction, and where the bodies overlap, which costs no end.
  double potential(const DepletionCase& one) const;
  double potential_error(const DepletionCase& one) const;
};

/// Runs the cases until an interrupt.
void run_cases(DepletionRun& run);

std::string report_text(const DepletionRun& run);
std::string report_json(const DepletionRun& run);
std::string csv_text(const DepletionRun& run);
std::string picture_of(const DepletionRun& run);

}  // namespace vex
