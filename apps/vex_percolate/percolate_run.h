// A run of vex_percolate: what is placed, what was found, and what follows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_percolate/options.h"
#include "engine/sampling/percolation/crossing.h"

namespace vex {

/// One size of the periodic cube.
struct SizeRun {
  double size;                              // in extents of the largest body
  double edge = 0.0;                        // of the cube
  std::optional<PercolationSystem> system;  // none of a run that was put together from documents
  std::vector<WrappingNumbers> found;       // of realisations PercolateRun::first_realisation(), ...
  PercolationCounts counts;

  std::uint32_t most_bodies() const { return system ? system->most_bodies : 1u << 30; }
  double volume() const { return edge * edge * edge; }
};

/// A value with its standard error.
struct Estimated {
  double value, std_error;
};

/// The mean over the bodies' parts and over the law of orientations.
struct MeanExcludedVolume {
  double value = 0.0, std_error = 0.0;
  std::string reason;  // why it is not known; empty where it is
};

struct PercolateRun {
  std::string command;
  PercolateOptions options;
  std::vector<LoadedBody> bodies;
  std::vector<Body> connecting;  // the bodies with their shells
  double extent = 0.0;           // of the largest of these: twice its circumradius
  double mean_volume = 0.0;      // of the bodies without shells
  bool is_isotropic = true;      // the law and the bodies: else the threshold is where sizes cross
  MeanExcludedVolume excluded_volume;
  std::vector<SizeRun> sizes;

  bool complete = true;         // false: interrupted
  std::string stopped_because;  // where the error that was asked for cannot be reached
  double seconds = 0.0;
  double seconds_before = 0.0;  // of the runs that it goes on from

  // Once each size has kFewestRealisations.
  std::vector<SizedThreshold> thresholds;  // number densities; of isotropic systems
  std::optional<Crossing> crossing;        // of others
  std::optional<Extrapolation> threshold;  // of all
  std::string no_threshold_reason;

  std::uint32_t first_realisation() const { return options.first_realisation; }
  bool is_flat() const { return mean_volume == 0.0; }
  /// eta, or of flat bodies the number density itself.
  double eta_unit() const { return is_flat() ? 1.0 : mean_volume; }
  PercolationCounts counts() const;
};

/// Loads the bodies, and makes the systems of all sizes. Throws UsageError or InputError.
PercolateRun prepare(const PercolateOptions& options, const std::string& command);

/// What follows from the realisations: thresholds, once there are enough.
void find_thresholds(PercolateRun& run);

/// How much of the run is done, 0 to 1, in the realisations and the time so far: the largest share over its stop rules.
/// 0 where it is to reach an error that is not known yet.
double share_done(const PercolateRun& run);

/// Finds the mean excluded volume, then makes realisations until a stop rule or an interrupt ends the run. `on_round`
/// is called after each round, with the thresholds known so far; `on_realisations` after each realisation, by any
/// thread, one at a time: the realisations and the time are those so far. With
/// `ranks` other processes take part; on one that does not lead nothing is found.
void percolate(PercolateRun& run, const std::function<void()>& on_round, const std::function<void()>& on_realisations,
               Ranks* ranks = nullptr);

}  // namespace vex
