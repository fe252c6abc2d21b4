#include "apps/vex_percolate/percolate_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/common/backends.h"
#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "shapes/estimators/excluded_volume.h"
#include "shapes/formula.h"

namespace vex {
namespace {

// No cube is filled with more bodies: they would not fit into the memory of usual machines.
constexpr double kMostBodies = 5e7;
// Of B = n <V_ex> at any threshold; bodies of equal size have less than 3.
constexpr double kLargestB = 60.0, kUsualB = 3.0;

std::vector<double> shares_of(const PercolateOptions& options) {
  double sum = 0.0;
  for (const BodyFraction& body : options.bodies) sum += body.fraction;
  std::vector<double> shares;
  for (const BodyFraction& body : options.bodies) shares.push_back(body.fraction / sum);
  return shares;
}

double isotropic_excluded_volume(const std::vector<Body>& bodies, const std::vector<double>& shares) {
  double mean = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = 0; j < bodies.size(); ++j) {
      mean += shares[i] * shares[j] * average_excluded_volume(bodies[i].measures, bodies[j].measures);
    }
  }
  return mean;
}

MeanExcludedVolume mean_excluded_volume(const PercolateRun& run) {
  const PercolateOptions& options = run.options;
  MeanExcludedVolume mean;
  const std::vector<double> shares = shares_of(options);
  if (options.orientations.uniform_polar_angle) {
    mean.reason = "the law uniform-angle has no excluded volume here";
    return mean;
  }
  if (options.orientations.law.kind() == OrientationLaw::Kind::isotropic) {
    mean.value = isotropic_excluded_volume(run.connecting, shares);
    return mean;
  }
  double variance = 0.0;
  for (std::size_t i = 0; i < run.connecting.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      ExcludedVolumeSettings settings;
      settings.law = options.orientations.law;
      settings.seed = options.seed;
      settings.threads = options.n_threads;
      settings.rel_error = 1e-5;
      settings.seconds = 5.0;
      settings.interrupt = &interrupting_signal();
      const ExcludedVolume found = excluded_volume(run.connecting[i], run.connecting[j], settings);
      const double value = found.reference ? found.reference->value : found.value;
      const double error = found.reference ? found.reference->std_error : found.std_error;
      const double weight = shares[i] * shares[j] * (i == j ? 1.0 : 2.0);
      mean.value += weight * value;
      variance += weight * error * weight * error;
    }
  }
  mean.std_error = std::sqrt(variance);
  if (!std::isfinite(mean.value)) mean.reason = "interrupted before it was known";
  return mean;
}

void require_backend(const PercolateRun& run) {
  const PercolateOptions& options = run.options;
  if (!options.backend) return;
  const auto named = [&](std::size_t k) {
    return NamedBody{&run.connecting[k].body, run.bodies[k].source, run.connecting[k].kind};
  };
  for (std::size_t i = 0; i < run.bodies.size(); ++i) {
    for (std::size_t j = 0; j < run.bodies.size(); ++j) {
      const std::string reason = why_left_out(*options.backend, named(i), named(j));
      if (!reason.empty()) throw UsageError(reason + " - use another --backend");
    }
  }
}

void make_systems(PercolateRun& run) {
  const PercolateOptions& options = run.options;
  std::vector<BodyPart> parts;
  const std::vector<double> shares = shares_of(options);
  for (std::size_t k = 0; k < run.connecting.size(); ++k) parts.push_back({run.connecting[k].body, shares[k]});
  const Placements placements(parts, options.orientations, options.seed);
  const double forbidden = isotropic_excluded_volume(run.connecting, shares);
  if (!(forbidden > 0.0))
    throw InputError("bodies that never overlap (needles have no width) - give others, or --shell");
  for (std::size_t k = 0; k < options.sizes.size(); ++k) {
    const double edge = options.sizes[k] * run.extent;
    const double a_b = edge * edge * edge / forbidden;  // bodies where B = 1
    if (!(kUsualB * a_b <= kMostBodies)) {
      throw InputError("a cube of " + shortest_number(options.sizes[k]) + " extents holds " +
                       short_count(kUsualB * a_b) + " bodies at the threshold (--sizes) - give a smaller one");
    }
    PercolationSystem system{placements, edge, static_cast<std::uint32_t>(k), options.instruction_set, options.backend};
    system.most_bodies = static_cast<std::uint32_t>(std::fmin(1e9, 1000.0 + kLargestB * a_b));
    system.usual_bodies = static_cast<std::uint32_t>(kUsualB * a_b);
    run.sizes.push_back({options.sizes[k], std::move(system), {}, {}});
  }
}

void find_thresholds(PercolateRun& run) {
  run.thresholds.clear();
  run.threshold.reset();
  for (const SizeRun& size : run.sizes) {
    if (size.found.size() < 2) return;
    run.thresholds.push_back(sized_threshold(size_threshold(size.found), size.size, size.volume()));
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      if (!(run.thresholds.back().covariance[c][c] > 0.0)) return;
    }
  }
  run.threshold = extrapolate(run.thresholds);
}

// Whether the error that was asked for is reached, or cannot be.
bool is_exact_enough(PercolateRun& run) {
  constexpr std::size_t kFewest = 200;
  const double goal = *run.options.std_error;
  for (const SizeRun& size : run.sizes) {
    if (size.found.size() < kFewest) return false;
  }
  if (!run.threshold) return false;
  const Extrapolation& threshold = *run.threshold;
  const double unit = run.eta_unit();
  if (threshold.std_error * unit <= goal) return true;
  const double rest = std::hypot(threshold.offset_error, threshold.universal_error) * unit;
  if (rest < goal || threshold.scatter_error * unit > 0.25 * goal) return false;
  run.stopped_because = "the extrapolation alone is uncertain by " + short_number(rest, 2) +
                        ": larger sizes are needed for --std-error " + short_number(goal, 3);
  return true;
}

}  // namespace

PercolationCounts PercolateRun::counts() const {
  PercolationCounts sum;
  for (const SizeRun& size : sizes) sum += size.counts;
  return sum;
}

PercolateRun prepare(const PercolateOptions& options, const std::string& command) {
  PercolateRun run;
  run.command = command;
  run.options = options;
  const std::vector<double> shares = shares_of(options);
  for (std::size_t k = 0; k < options.bodies.size(); ++k) {
    run.bodies.push_back(load_body(options.bodies[k].text, options.body_options));
    const LoadedBody& body = run.bodies.back();
    run.connecting.push_back(options.shell > 0.0 ? rounded(body.shape, 0.5 * options.shell, body.source) : body.shape);
    run.extent = std::fmax(run.extent, 2.0 * run.connecting.back().body.circumradius());
    run.mean_volume += shares[k] * body.shape.measures.volume;
  }
  require_one_unit(run.bodies, options.body_options);
  if (options.dump_vertices) require_vertices_to_list(run.bodies);
  if (options.std_error && run.is_flat()) {
    throw UsageError("eta of flat bodies is 0 (--std-error) - use --realisations or --seconds");
  }
  require_backend(run);
  make_systems(run);
  return run;
}

void percolate(PercolateRun& run, const std::function<void()>& on_round) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const PercolateOptions& options = run.options;
  const auto seconds = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const auto is_late = [&] { return options.seconds && seconds() >= *options.seconds; };
  const StopQuestion stop = [&] { return interrupting_signal().load() != 0 || is_late(); };
  const std::uint64_t most = options.realisations.value_or(kMostRealisations);
  constexpr std::uint64_t kRound = 64;
  find_thresholds(run);
  while (!stop()) {
    std::uint64_t fewest = most;
    for (const SizeRun& size : run.sizes) fewest = std::min<std::uint64_t>(fewest, size.found.size());
    if (fewest >= most || (options.std_error && is_exact_enough(run))) break;
    const std::uint64_t goal = std::min(most, fewest + std::max(kRound, fewest / 8));
    for (SizeRun& size : run.sizes) {
      if (size.found.size() >= goal) continue;
      const std::uint32_t first = static_cast<std::uint32_t>(size.found.size());
      const std::vector<WrappingNumbers> more = run_realisations(
          size.system, first, static_cast<std::uint32_t>(goal) - first, options.n_threads, size.counts, stop);
      size.found.insert(size.found.end(), more.begin(), more.end());
    }
    find_thresholds(run);
    run.seconds = seconds();
    on_round();
  }
  run.complete = interrupting_signal().load() == 0;
  run.seconds = seconds();
  run.excluded_volume = mean_excluded_volume(run);
}

}  // namespace vex
