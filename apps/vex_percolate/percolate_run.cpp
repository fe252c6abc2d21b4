#include "apps/vex_percolate/percolate_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "apps/common/backends.h"
#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/percolation/isotropy.h"
#include "engine/sampling/ranks.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/estimators/excluded_volume.h"
#include "shapes/formula.h"

namespace vex {
namespace {

// No cube is filled with more bodies: they would not fit into the memory of usual machines.
constexpr double kMostBodies = 5e7;
// Of B = n <V_ex> at any threshold, by the law; bodies of equal size have less than 3.
constexpr double kLargestB = 60.0, kUsualB = 3.0;
// What is spent on <V_ex>, in nanoseconds: to know about how many bodies there will be, and for B_c; and the share of
// what an isotropic law has below which it is 0.
constexpr double kRoughCost = 2e6, kFullCost = 5e8, kNoShare = 1e-9;

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

// Of two bodies turned by a law that is not isotropic; what is spent on it is counted, not measured, so that the result
// hangs on no clock: about so many nanoseconds of one core.
Estimated excluded_volume_by_law(const Body& a, const Body& b, const PercolateOptions& options, double cost) {
  const auto has_normals = [](const Body& body) {
    return body.normals.area && body.normals.mean_curvature && body.measures.are_known();
  };
  if (has_normals(a) && has_normals(b)) {
    ExactAverageSettings exact;
    exact.largest_cost = cost;
    exact.interrupt = &interrupting_signal();
    const ExactAverage average = exact_average(a, b, options.orientations.law, exact);
    return {average.excluded_volume, average.error};
  }
  constexpr double kTrialCost = 1000.0;
  ExcludedVolumeSettings settings;
  settings.law = options.orientations.law;
  settings.seed = options.seed;
  settings.threads = options.n_threads;
  settings.estimator = "hit-or-miss";
  settings.trials = static_cast<std::uint64_t>(std::fmax(cost / kTrialCost, 1e4));
  settings.exact_average = false;
  settings.interrupt = &interrupting_signal();
  const ExcludedVolume found = excluded_volume(a, b, settings);
  return {found.value, found.complete ? found.std_error : HUGE_VAL};
}

MeanExcludedVolume mean_excluded_volume(const PercolateRun& run, double cost) {
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
  const double n = static_cast<double>(run.connecting.size()), cost_of_pair = 2.0 * cost / (n * (n + 1.0));
  double variance = 0.0;
  for (std::size_t i = 0; i < run.connecting.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const Estimated found = excluded_volume_by_law(run.connecting[i], run.connecting[j], options, cost_of_pair);
      const double weight = shares[i] * shares[j] * (i == j ? 1.0 : 2.0);
      mean.value += weight * found.value;
      variance += weight * found.std_error * weight * found.std_error;
    }
  }
  mean.std_error = std::sqrt(variance);
  if (!std::isfinite(mean.value) || !std::isfinite(variance)) mean.reason = "interrupted before <V_ex> was known";
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
  run.is_isotropic = is_isotropic(placements);
  if (!run.is_isotropic && options.sizes.size() < 2) {
    throw UsageError("orientations " + options.law + " are not isotropic, and one size says nothing of the threshold" +
                     " then (" + shortest_number(options.sizes.front()) + " for --sizes) - give two or more");
  }
  const double of_isotropic = isotropic_excluded_volume(run.connecting, shares);
  if (!(of_isotropic > 0.0))
    throw InputError("bodies that never overlap (needles have no width) - give others, or --shell");
  const MeanExcludedVolume by_law = mean_excluded_volume(run, kRoughCost);
  const double forbidden = by_law.reason.empty() ? by_law.value : of_isotropic;
  if (!(forbidden > kNoShare * of_isotropic)) {
    throw InputError("bodies that never overlap with orientations " + options.law +
                     " (flat ones in parallel planes) - give others, another law, or --shell");
  }
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
    system.at_once = best_at_once(system);
    run.sizes.push_back({options.sizes[k], edge, std::move(system), {}, {}});
  }
}

void find_crossing_of(PercolateRun& run) {
  std::vector<SizedRealisations> sizes;
  for (const SizeRun& size : run.sizes) sizes.push_back({size.size, size.volume(), size.found});
  try {
    run.crossing = find_crossing(sizes);
    run.threshold = run.crossing->threshold;
  } catch (const UsageError& error) {
    run.no_threshold_reason = error.what();
  }
}

// The number of realisations of each size at which the n-th round after it ends: the same in a run that goes on from
// another one, wherever that ended.
std::uint64_t end_of_round(std::uint64_t fewest) {
  constexpr std::uint64_t kRound = 64;
  std::uint64_t end = kRound;
  while (end <= fewest) end += std::max(kRound, end / 8);
  return end;
}

// Whether all sizes have as many realisations as at the end of a round. Whether the error is reached is asked there
// alone: a run that was killed within a round and goes on would else end where one run does not.
bool is_end_of_round(const PercolateRun& run) {
  const std::size_t n = run.sizes.front().found.size();
  return n > 0 && end_of_round(n - 1) == n &&
         std::ranges::all_of(run.sizes, [n](const SizeRun& size) { return size.found.size() == n; });
}

// Of the error that was asked for: where the scatter of realisations is no more than this share of it and the
// extrapolation alone exceeds it, more realisations are of no use.
constexpr double kEnoughScatter = 0.25;

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
  if (rest < goal || threshold.scatter_error * unit > kEnoughScatter * goal) return false;
  run.stopped_because = "the extrapolation alone is uncertain by " + short_number(rest, 2) +
                        ": larger sizes are needed for --std-error " + short_number(goal, 3);
  return true;
}

}  // namespace

void find_thresholds(PercolateRun& run) {
  run.thresholds.clear();
  run.threshold.reset();
  run.crossing.reset();
  run.no_threshold_reason.clear();
  std::size_t fewest = kMostRealisations;
  for (const SizeRun& size : run.sizes) fewest = std::min(fewest, size.found.size());
  if (fewest < kFewestRealisations) {
    run.no_threshold_reason = "it takes " + std::to_string(kFewestRealisations) +
                              " realisations of each size or more, and of one there are " + std::to_string(fewest);
  }
  if (!run.is_isotropic) {
    if (fewest >= kFewestRealisations) find_crossing_of(run);
    return;
  }
  for (const SizeRun& size : run.sizes) {
    if (size.found.size() < kFewestRealisations) return;
    run.thresholds.push_back(sized_threshold(size_threshold(size.found), size.size, size.volume()));
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      if (run.thresholds.back().covariance[c][c] > 0.0) continue;
      run.no_threshold_reason = "realisations of a size do not scatter, and their errors are unknown";
      return;
    }
  }
  run.threshold = extrapolate(run.thresholds);
}

double share_done(const PercolateRun& run) {
  const PercolateOptions& options = run.options;
  double share = options.seconds ? (run.seconds_before + run.seconds) / *options.seconds : 0.0;
  if (options.realisations) {
    // A realisation costs what its bodies cost.
    double done = 0.0, all = 0.0;
    for (const SizeRun& size : run.sizes) {
      done += static_cast<double>(size.found.size()) * size.volume();
      all += static_cast<double>(*options.realisations) * size.volume();
    }
    share = std::fmax(share, done / all);
  }
  if (options.std_error) {
    if (!run.threshold) return 0.0;
    // What the scatter of realisations may be, which falls with their square root: is_exact_enough.
    const double unit = run.eta_unit(), goal = *options.std_error,
                 rest = std::hypot(run.threshold->offset_error, run.threshold->universal_error) * unit,
                 scatter = rest < goal ? std::sqrt(goal * goal - rest * rest) : kEnoughScatter * goal;
    share = std::fmax(share, std::pow(scatter / (run.threshold->scatter_error * unit), 2.0));
  }
  return std::fmin(share, 1.0);
}

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

void percolate(PercolateRun& run, const std::function<void()>& on_round, const std::function<void()>& on_realisations,
               Ranks* ranks) {
  if (ranks != nullptr) {
    if (!ranks->leads()) {
      std::vector<const PercolationSystem*> systems;
      for (const SizeRun& size : run.sizes) systems.push_back(&*size.system);
      make_realisations_for_leader(systems, run.options.n_threads, *ranks);
      return;
    }
    ranks->begin();
  }
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const PercolateOptions& options = run.options;
  const auto seconds = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  // The time of the runs that it goes on from counts.
  const auto is_late = [&] { return options.seconds && run.seconds_before + seconds() >= *options.seconds; };
  std::atomic<std::uint64_t> n_finished{0};
  const StopQuestion stop = [&] {
    answer_if_asked([&] {
      return plural(n_finished.load(), "realisation", "realisations") + " of all sizes, " +
             fixed_number(0, run.seconds_before + seconds()) + " s";
    });
    return interrupting_signal().load() != 0 || is_late();
  };
  const std::uint64_t most = options.realisations.value_or(kMostRealisations);
  // A twentieth of the time that is asked for, where it is short.
  constexpr double kShare = 0.05, kNanoseconds = 1e9;
  run.excluded_volume =
      mean_excluded_volume(run, std::fmin(kFullCost, kShare * kNanoseconds * options.seconds.value_or(HUGE_VAL)));
  find_thresholds(run);
  while (!stop()) {
    std::uint64_t fewest = most;
    for (const SizeRun& size : run.sizes) fewest = std::min<std::uint64_t>(fewest, size.found.size());
    if (fewest >= most || (options.std_error && is_end_of_round(run) && is_exact_enough(run))) break;
    const std::uint64_t goal = std::min(most, end_of_round(fewest));
    for (SizeRun& size : run.sizes) {
      if (size.found.size() >= goal) continue;
      const std::uint32_t n_found = static_cast<std::uint32_t>(size.found.size());
      const OnRealisations take = [&](std::span<const WrappingNumbers> finished, const PercolationCounts& counts) {
        size.found.insert(size.found.end(), finished.begin(), finished.end());
        size.counts += counts;
        n_finished += finished.size();
        run.seconds = seconds();
        on_realisations();
      };
      run_realisations(*size.system, run.first_realisation() + n_found, static_cast<std::uint32_t>(goal) - n_found,
                       options.n_threads, take, stop, ranks);
    }
    find_thresholds(run);
    run.seconds = seconds();
    on_round();
  }
  if (ranks != nullptr) ranks->end();
  run.complete = interrupting_signal().load() == 0;
  run.seconds = seconds();
}

}  // namespace vex
