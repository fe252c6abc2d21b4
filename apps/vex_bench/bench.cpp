#include "apps/vex_bench/bench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/peers/peers.h"
#include "apps/referees/specialised_backend.h"
#include "engine/numeric/errors.h"
#include "meshes/convex_mesh.h"
#include "meshes/nearest_float.h"
#include "shapes/formula.h"

namespace vex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Contender {
  const Estimator* estimator;
  Sequence sequence;
  BackendKind backend;
  bool is_library = false;
};

std::vector<Contender> contenders(const Body& body) {
  const BackendKind gjk = gjk_backend();
  std::vector<Contender> all, without_gjk;
  for (const Estimator* const one : estimators()) {
    if (!one->runs_gjk) {
      without_gjk.push_back({one, one->usual_sequence, gjk});
      continue;
    }
    for (const Sequence sequence : {Sequence::sobol, Sequence::random}) all.push_back({one, sequence, gjk});
  }
  const Estimator* const hit_or_miss = &estimator_named("hit-or-miss");
  for (const BackendKind& peer : peer_backends()) {
    if (peer.takes(body, body)) all.push_back({hit_or_miss, Sequence::random, peer, true});
  }
  if (const BackendKind special = specialised_backend(); special.takes(body, body)) {
    all.push_back({hit_or_miss, Sequence::random, special});
  }
  all.insert(all.end(), without_gjk.begin(), without_gjk.end());
  std::erase_if(all, [&body](const Contender& one) { return one.estimator->why_not(body, body, {}).has_value(); });
  return all;
}

// Points of a spiral on the ellipsoid 3:2:1 and their convex hull.
Body hull_of_100_points() {
  constexpr int n = 100;
  constexpr double kGoldenTurn = 0.38196601125010515;
  std::vector<Vec3d> points;
  for (int k = 0; k < n; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / n, across = std::sqrt(1.0 - z * z);
    const double azimuth = 2.0 * std::numbers::pi * kGoldenTurn * k;
    points.push_back({nearest_float(3.0 * across * std::cos(azimuth)), nearest_float(2.0 * across * std::sin(azimuth)),
                      nearest_float(z)});
  }
  return hull_of(points);
}

double relative_slope(const Rung& from, const Rung& to) {
  return std::log(to.relative_error / from.relative_error) / std::log(to.seconds / from.seconds);
}

}  // namespace

std::string ErrorCurve::name() const {
  std::string text(estimator->name);
  if (sequence == Sequence::sobol) text += ", Sobol'";
  return backend == gjk_backend().name ? text : text + ", " + backend;
}

std::optional<double> ErrorCurve::slope() const {
  constexpr std::uint64_t kLeast = 1000;
  double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (const Rung& rung : rungs) {
    if (rung.n_trials < kLeast || !(rung.relative_error > 0.0) || !std::isfinite(rung.relative_error)) continue;
    const double x = std::log(static_cast<double>(rung.n_trials)), y = std::log(rung.relative_error);
    ++n, sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
  }
  if (n < 3.0) return std::nullopt;
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

double ErrorCurve::figure_of_merit() const {
  if (rungs.empty()) return 0.0;
  const Rung& last = rungs.back();
  return 1.0 / (last.relative_error * last.relative_error * last.seconds);
}

TimeToError ErrorCurve::time_to(double wanted) const {
  const Rung* before = nullptr;
  for (const Rung& rung : rungs) {
    if (rung.relative_error <= wanted) {
      if (before == nullptr) return {rung.seconds, false};
      const double steepness = relative_slope(*before, rung);
      if (!(steepness < 0.0)) return {rung.seconds, false};
      return {before->seconds * std::pow(wanted / before->relative_error, 1.0 / steepness), false};
    }
    if (std::isfinite(rung.relative_error)) before = &rung;
  }
  if (before == nullptr) return {kInfinity, true};
  const double steepness = sequence == Sequence::random ? -0.5 : std::clamp(slope().value_or(-0.5), -1.5, -0.5);
  return {before->seconds * std::pow(wanted / before->relative_error, 1.0 / steepness), true};
}

std::vector<BenchBody> standard_bodies() {
  std::vector<BenchBody> bodies;
  for (const auto& [name, source] : {std::pair{"cube", "box:1,1,1"},
                                     {"plate .01", "box:0.01,1,1"},
                                     {"needle 64", "box:64,1,1"},
                                     {"ellipsoid 4:1:1", "ellipsoid:4,1,1"},
                                     {"capsule", "capsule:1,0.25"}}) {
    bodies.push_back({name, source, parse_shape(source)});
  }
  bodies.push_back({"hull of 100 points", "", hull_of_100_points()});
  return bodies;
}

BodyCurves measure(const BenchBody& body, const BenchSettings& bench) {
  constexpr std::uint64_t kFirst = 64 * kClasses, kGrowth = 4;
  constexpr int kMostRuns = 8;
  const ConvexBody& shape = body.shape.body;
  BodyCurves found{body, average_excluded_volume(body.shape.measures, body.shape.measures)};
  const auto is_interrupted = [&bench] { return bench.interrupt != nullptr && bench.interrupt->load() != 0; };
  for (const Contender& one : contenders(body.shape)) {
    if (is_interrupted()) break;
    ErrorCurve curve{one.estimator, one.sequence, one.backend.name, one.is_library};
    if (bench.on_curve) bench.on_curve(body.name + ", " + curve.name());
    MonteCarloSettings settings;
    settings.n_threads = bench.n_threads;
    settings.sequence = one.sequence;
    settings.backend = one.backend;
    settings.interrupt = bench.interrupt;
    settings.on_progress = bench.on_progress;
    set_estimator(settings, *one.estimator, body.shape, body.shape);
    double spent = 0.0;
    settings.stop.trials = kFirst;
    settings.seed = bench.seed;
    run_monte_carlo(shape, shape, settings);  // makes tables, and wakes the machine
    for (std::uint64_t n = kFirst; !is_interrupted(); n *= kGrowth) {
      Rung rung;
      rung.n_trials = n;
      settings.stop.trials = n;
      double squares = 0.0, true_squares = 0.0;
      for (int k = 0; k < kMostRuns; ++k) {
        // A run longer than the rest of the time is not begun; the first of a length at twice that.
        const double expected = rung.n_runs > 0       ? rung.seconds / rung.n_runs
                                : curve.rungs.empty() ? 0.0
                                                      : static_cast<double>(kGrowth) * curve.rungs.back().seconds;
        if (spent + (rung.n_runs > 0 ? 1.0 : 0.5) * expected > bench.seconds) break;
        settings.seed = bench.seed + static_cast<std::uint64_t>(k);
        const RunRecord record = run_monte_carlo(shape, shape, settings);
        if (!record.complete) break;
        const VolumeEstimate estimate = volume_estimate(record.tally, settings.domain);
        const double error = estimate.excluded_volume > 0.0 ? estimate.relative_error() : kInfinity;
        const double off = estimate.excluded_volume / found.exact - 1.0;
        squares += error * error;
        true_squares += off * off;
        rung.largest_z =
            std::max(rung.largest_z, std::fabs(estimate.excluded_volume - found.exact) / estimate.std_error);
        rung.seconds += record.seconds;
        spent += record.seconds;
        ++rung.n_runs;
      }
      if (rung.n_runs == 0) break;
      rung.seconds /= rung.n_runs;
      rung.relative_error = std::sqrt(squares / rung.n_runs);
      rung.true_relative_error = std::sqrt(true_squares / rung.n_runs);
      curve.rungs.push_back(rung);
      if (rung.relative_error <= bench.least_error) break;
    }
    if (!curve.rungs.empty()) found.curves.push_back(std::move(curve));
  }
  return found;
}

}  // namespace vex
