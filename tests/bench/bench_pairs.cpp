#include "tests/bench/bench_pairs.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "apps/common/numbers.h"
#include "engine/numeric/expect.h"
#include "shapes/any_shape.h"
#include "tests/bench/best_peers.h"
#include "tests/referees/polytopes.h"

namespace vex {

std::vector<BenchPair> bench_pairs() {
  // More poses than a branch predictor remembers; of the slowest query as many as some seconds allow.
  constexpr std::size_t kMany = std::size_t{1} << 17, kFewer = std::size_t{1} << 15;
  return {{"cube", parse_shape("box:1,1,1").body, kMany, 10.0, 20.0},
          {"ellipsoid 4:1:1", parse_shape("ellipsoid:4,1,1").body, kMany, 10.0, 20.0},
          {"capsule L = 1, R = .25", parse_shape("capsule:1,0.25").body, kMany, 10.0, 20.0},
          {"plate 1e-6:1:1", parse_shape("box:1e-6,1,1").body, kMany, 10.0, 10.0},
          {"hull of 100 points, 3:2:1", test_point_hull(100, {3, 2, 1}, 1).body, kMany, 8.0, 20.0},
          {"hull of 10 000 points, 3:2:1", test_point_hull(10000, {3, 2, 1}, 1).body, kFewer, 8.0, 20.0}};
}

MonteCarloSettings trial_settings(const ConvexBody& body, std::uint64_t seed, std::size_t n, InstructionSet set) {
  MonteCarloSettings settings;
  settings.seed = seed;
  settings.domain = ball_domain(body, body);
  settings.stop.trials = n;
  settings.instruction_set = set;
  settings.backend = gjk_backend(set);
  return settings;
}

std::vector<Pose> stored_poses(const ConvexBody& body, std::uint64_t seed, std::size_t n) {
  const MonteCarloSettings settings = trial_settings(body, seed, n);
  std::vector<Pose> poses;
  poses.reserve(n);
  for (std::size_t k = 0; k < n; ++k) poses.push_back(Pose::unchecked(trial_pose(body, body, settings, k)));
  return poses;
}

Contender trial_contender(std::string name, const ConvexBody& body, const MonteCarloSettings& settings) {
  return {std::move(name), static_cast<std::size_t>(settings.stop.trials.value()), [&body, settings] {
            const RunRecord record = run_monte_carlo(body, body, settings);
            if (!record.complete) throw std::runtime_error("a run that is timed ended early");
          }};
}

StoredQuery::StoredQuery(const BackendKind& kind, const ConvexBody& body, const std::vector<Pose>& poses)
    : name_(kind.name), poses_(poses), backend_(kind.make(body, body)), verdicts_(poses.size()) {
  if (auto* const prepared = dynamic_cast<PreparedBackend*>(backend_.get())) prepared->prepare(poses_);
}

void StoredQuery::answer(std::size_t n) {
  constexpr std::size_t kAtOnce = PacketOverlap::kMostTrials;
  for (std::size_t first = 0; first < n; first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, n - first);
    backend_->decide({&poses_[first], count}, {&verdicts_[first], count});
  }
}

Contender StoredQuery::contender(std::size_t n) {
  VEX_EXPECT(n <= poses_.size());
  return {name_, n, [this, n] { answer(n); }};
}

std::size_t StoredQuery::n_answered_in(double seconds) {
  const std::size_t all = poses_.size(), least = std::min<std::size_t>(64, all);
  answer(least);  // fills caches
  for (std::size_t n = least;; n = std::min(4 * n, all)) {
    const double start = processor_ns();
    answer(n);
    const double taken = processor_ns() - start;
    if (taken < 1e6 && n < all) continue;  // too short to go by
    const double affordable = 1e9 * seconds / taken * static_cast<double>(n);
    if (affordable >= static_cast<double>(all)) return all;
    return std::max(least, std::bit_floor(static_cast<std::size_t>(affordable)));
  }
}

std::string Differences::text() const {
  std::string text = n_missed + n_invented == 0 ? "0" : std::to_string(n_missed) + " + " + std::to_string(n_invented);
  if (n_given_up > 0) text += " (" + std::to_string(n_given_up) + ")";
  return text;
}

nlohmann::ordered_json Differences::json() const {
  return {{"compared", n_compared}, {"missed", n_missed}, {"invented", n_invented}, {"given_up", n_given_up}};
}

Differences differences(const std::vector<Verdict>& proven, const std::vector<Verdict>& other, std::size_t n) {
  Differences found;
  for (std::size_t k = 0; k < n; ++k) {
    if (other[k].outcome == Outcome::undecided) {
      ++found.n_given_up;
    } else if (proven[k].outcome != Outcome::undecided) {
      ++found.n_compared;
      if (other[k].outcome != proven[k].outcome) {
        ++(proven[k].outcome == Outcome::overlap ? found.n_missed : found.n_invented);
      }
    }
  }
  return found;
}

std::size_t n_hits(const std::vector<Verdict>& verdicts) {
  return static_cast<std::size_t>(
      std::ranges::count_if(verdicts, [](const Verdict& verdict) { return verdict.outcome == Outcome::overlap; }));
}

std::string timing_text(const Timing& timing) {
  return three_digits(timing.median()) + " (" + fixed_number(0, 100.0 * timing.spread()) + " %)";
}

}  // namespace vex
