// The command line of vex_depletion.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/common_options.h"
#include "apps/common/orientation_options.h"
#include "shapes/estimators/depletion.h"

namespace vex {

/// The words of the command line, as they stand.
struct DepletionCommandLine : CommonWords, BodyWords, OrientationWords {
  std::string a, b;
  std::string depletant, fraction, distance, angle, direction, rotation;
  std::string rel_error, trials, seconds, max_trials;
  std::string csv, plot;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, DepletionCommandLine& words);

/// What the words mean.
struct DepletionOptions : CommonOptions {
  std::string a, b;
  BodyOptions body_options;
  bool dump_vertices = false;
  DepletionSettings settings;                  // but for the seed, which each case has of its own
  std::optional<double> fraction;              // of the reservoir's volume that the balls take
  std::vector<std::string> distances;          // decimals
  std::vector<std::string> angles;             // degrees, decimals; of one pose a distance
  Vec3d direction{1.0, 0.0, 0.0};              // from A to B, of length one; of poses
  std::array<double, 4> rotation{1, 0, 0, 0};  // of B before it is turned by the angle
  std::optional<OrientationLaw> law;           // the mean over it, instead of poses
  std::string csv, plot;

  /// Balls in a unit of volume of the reservoir; of no fraction nothing.
  std::optional<double> number_density() const;
};

/// Throws UsageError where a word means nothing.
DepletionOptions interpret(const DepletionCommandLine& words);

}  // namespace vex
