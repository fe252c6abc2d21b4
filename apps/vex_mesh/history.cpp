#include "apps/vex_mesh/history.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

constexpr std::size_t kMostMoments = 128, kEnoughMoments = 12;
constexpr std::uint64_t kFewestTrials = 2 * kClasses;

bool is_known(const HistoryPoint& point) {
  return point.value > 0.0 && std::isfinite(point.value) && std::isfinite(point.std_error) && point.std_error > 0.0;
}

}  // namespace

// Every moment at first; where there are too many, every other one is forgotten, and as many trials more pass between
// those that follow.
void History::add(const Progress& progress) {
  const std::uint64_t n = progress.tally.n_trials;
  if (n < next_ || n == 0) return;
  tallies_.push_back(progress.tally);
  if (tallies_.size() < kMostMoments) {
    next_ = n + 1 + (next_ > 0 ? (n - tallies_.front().n_trials) / kMostMoments : 0);
    return;
  }
  for (std::size_t k = 0; k < tallies_.size() / 2; ++k) tallies_[k] = tallies_[2 * k];
  tallies_.resize(tallies_.size() / 2);
}

std::vector<HistoryPoint> history_of(const ExcludedVolume& result, const History& seen, const Body& a, const Body& b,
                                     const ExcludedVolumeSettings& settings) {
  std::vector<HistoryPoint> points;
  const std::uint64_t n_all = result.record.tally.n_trials;
  if (seen.tallies().size() >= kEnoughMoments) {
    for (const Tally& tally : seen.tallies()) {
      if (tally.n_trials >= n_all) break;
      const VolumeEstimate estimate = volume_estimate(tally, result.domain);
      points.push_back({tally.n_trials, estimate.excluded_volume, estimate.std_error});
    }
  } else if (result.estimator != nullptr) {
    ExcludedVolumeSettings again = settings;
    again.estimator = result.estimator->name;
    again.sequence = result.sequence;
    again.rel_error.reset();
    again.seconds.reset();
    again.cross_check.clear();
    again.verify = false;
    again.exact_average = false;
    again.interrupt = nullptr;
    again.on_progress = {};
    again.on_start = {};
    again.on_state = {};
    again.resume = nullptr;
    again.ranks = nullptr;
    for (std::uint64_t n = n_all / 2; n >= kFewestTrials; n /= 2) {
      again.trials = n - n % kClasses;
      const ExcludedVolume part = excluded_volume(a, b, again);
      points.push_back({part.record.tally.n_trials, part.value, part.std_error});
    }
    std::ranges::reverse(points);
  }
  points.push_back({n_all, result.value, result.std_error});
  std::erase_if(points, [](const HistoryPoint& point) { return !is_known(point); });
  return points;
}

}  // namespace vex
