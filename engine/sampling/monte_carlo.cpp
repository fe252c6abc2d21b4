#include "engine/sampling/monte_carlo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/query/overlap.h"
#include "engine/sampling/poses/pose_map.h"
#include "engine/sampling/rank_worker.h"
#include "engine/sampling/run_ledger.h"
#include "engine/sampling/run_state_text.h"
#include "engine/sampling/runner_factory.h"
#include "engine/sampling/trial_runner.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The run as the threads share it. Threads take blocks of consecutive trials up to the next evaluation, and finish
// every block that they took.
class Run {
 public:
  /// `certain`: every trial hits by construction.
  Run(RunnerFactory& factory, const MonteCarloSettings& settings, bool certain)
      : factory_(factory),
        settings_(settings),
        ledger_(settings, certain),
        seconds_before_(settings.resume != nullptr ? settings.resume->seconds : 0.0) {
    if (settings.resume != nullptr) require_state_of_this_run(*settings.resume);
    if (settings.ranks != nullptr) settings.ranks->begin();
  }

  RunRecord go() {
    std::vector<std::jthread> threads;
    try {
      start_threads(threads, settings_.n_threads, [this](int) { work(false); });
      const bool has_threads = !threads.empty();
      note_threads(settings_.n_threads, has_threads ? static_cast<int>(threads.size()) : 1);
      if (!has_threads) work(true);
      wait_and_report();
    } catch (...) {
      fail(std::current_exception());  // of on_progress; the threads must be told before they are joined
    }
    threads.clear();
    if (settings_.ranks != nullptr) settings_.ranks->end();
    // Also of a run that fails: what came home is right.
    if (settings_.on_state) settings_.on_state(ledger_.state(seconds()));
    if (failure_) std::rethrow_exception(failure_);
    return ledger_.take_record(seconds());
  }

 private:
  static constexpr double kBlockSeconds = 0.01;  // an interrupt is answered within a block or two
  static constexpr auto kProgressInterval = std::chrono::milliseconds(100);
  static constexpr auto kMessageInterval = std::chrono::milliseconds(1);

  double seconds() const { return seconds_before_ + seconds_since(start_); }

  bool interrupted() const { return settings_.interrupt != nullptr && settings_.interrupt->load() != 0; }

  // Values that are counted from another offset, or in another unit, would add up to nothing.
  void require_state_of_this_run(const RunState& state) {
    if (state.done.tally.n_trials == 0) return;
    const BlockRecord none = factory_.make()->run(state.end(), state.end());
    if (none.tally.by_class.is_like(state.done.tally.by_class)) return;
    throw InputError(
        "the state to go on from is of another estimator, or of other bodies - give the settings of its run");
  }

  // Called with the lock held. The next trials, if any may be taken now.
  std::optional<RunLedger::Block> take_block(std::uint64_t most) {
    if (interrupted()) {
      stop(StopReason::interrupted);
    } else if (settings_.stop.seconds && seconds() >= *settings_.stop.seconds && ledger_.has_begun()) {
      stop(StopReason::seconds);
    }
    return ledger_.take(most);
  }

  // Called with the lock held.
  void bring(const RunLedger::Block& block, BlockRecord&& done) {
    const bool evaluated = ledger_.bring(block, std::move(done));
    // With other ranks a thread may also wait until fewer blocks stand behind a gap.
    if (evaluated || settings_.ranks != nullptr) changed_.notify_all();
    if (ledger_.is_over()) ended_.notify_all();
  }

  // What other ranks sent: blocks are theirs, and come home here.
  void serve_ranks() {
    settings_.ranks->serve({[this](std::uint64_t most) -> std::optional<Ranks::Block> {
                              const std::lock_guard lock(mutex_);
                              if (ledger_.is_over()) return std::nullopt;
                              const std::optional<RunLedger::Block> block =
                                  take_block(std::max(most, factory_.grain()) / factory_.grain() * factory_.grain());
                              if (!block) return std::nullopt;
                              return Ranks::Block{block->begin, block->end};
                            },
                            [this](std::string_view done) {
                              RunState state = read_run_state(done);
                              if (state.domain_volume != (settings_.integrand ? 0.0 : settings_.domain.volume)) {
                                throw InputError(
                                    "another rank samples another domain - give all ranks the same bodies");
                              }
                              const std::lock_guard lock(mutex_);
                              bring({state.first_trial, state.end()}, std::move(state.done));
                            }});
  }

  void stop(StopReason reason) {
    ledger_.stop(reason);
    changed_.notify_all();
    ended_.notify_all();
  }

  /// `reports`: it is the calling thread's work, because the system gives no other; it does what that does as well.
  void work(bool reports) {
    try {
      const std::unique_ptr<TrialRunner> runner = factory_.make();
      const std::uint64_t grain = factory_.grain();
      std::uint64_t most = 16 * grain;
      std::unique_lock lock(mutex_);
      while (true) {
        const std::optional<RunLedger::Block> block = take_block(most);
        if (!block) {
          if (ledger_.is_over()) return;
          if (reports) {
            changed_.wait_for(lock, wait_);
            report(lock);
          } else {
            changed_.wait(lock);
          }
          continue;
        }
        lock.unlock();
        const Clock::time_point block_start = Clock::now();
        BlockRecord done = runner->run(block->begin, block->end);
        const double block_seconds = seconds_since(block_start);
        // The size of a block decides nothing but the waiting: aim at kBlockSeconds, at most doubling.
        if (block->end - block->begin == most && block_seconds < 0.5 * kBlockSeconds) most *= 2;
        if (block_seconds > kBlockSeconds && most > grain) most /= 2;
        lock.lock();
        bring(*block, std::move(done));
        if (reports) report(lock);
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  void fail(const std::exception_ptr& failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = failure;
    stop(StopReason::interrupted);
  }

  void report_progress(std::unique_lock<std::mutex>& lock) {
    const Tally& tally = ledger_.tally();
    Progress progress{tally, std::numeric_limits<double>::infinity(), seconds(), settings_.stop};
    if (tally.n_trials > 0) progress.relative_error = volume_estimate(tally, settings_.domain).relative_error();
    lock.unlock();
    settings_.on_progress(progress);
    lock.lock();
  }

  void wait_and_report() {
    std::unique_lock lock(mutex_);
    // A run that time ends counts what others still work on.
    while (!ledger_.is_over() || ledger_.awaits_others()) {
      ended_.wait_for(lock, wait_);
      report(lock);
    }
  }

  // What the calling thread does between waits.
  void report(std::unique_lock<std::mutex>& lock) {
    if (settings_.ranks != nullptr) {
      lock.unlock();
      serve_ranks();
      lock.lock();
    }
    if (ledger_.is_over()) return;
    if (interrupted()) stop(StopReason::interrupted);
    if (settings_.on_progress && Clock::now() >= next_progress_) {
      report_progress(lock);
      next_progress_ = Clock::now() + kProgressInterval;
    }
    if (settings_.on_state && seconds_since(start_) >= next_state_) {
      const RunState state = ledger_.state(seconds());
      lock.unlock();
      settings_.on_state(state);
      lock.lock();
      next_state_ = seconds_since(start_) + settings_.seconds_between_states;
    }
  }

  RunnerFactory& factory_;
  const MonteCarloSettings& settings_;
  const Clock::time_point start_ = Clock::now();

  std::mutex mutex_;                 // guards all below; taken once a block, not once a trial
  std::condition_variable changed_;  // for threads that wait for the next round
  std::condition_variable ended_;    // for the caller, which would only be disturbed by every round
  RunLedger ledger_;
  const double seconds_before_;  // of the run that it goes on from
  // Of the calling thread.
  const std::chrono::milliseconds wait_ = settings_.ranks != nullptr ? kMessageInterval : kProgressInterval;
  Clock::time_point next_progress_ = start_ + kProgressInterval;
  double next_state_ = settings_.seconds_between_states;  // from the start
  std::exception_ptr failure_;
};

}  // namespace

namespace {

/// Whether the volume is that of the domain. Whether the domain holds all of A - B, only its maker knows.
bool is_good(const Domain& domain) {
  if (!(domain.volume > 0.0 && std::isfinite(domain.volume) && is_finite(domain.middle))) return false;
  if (domain.kind == Domain::Kind::fitted) return true;
  const Vec3d& h = domain.half_extent;
  const double volume = domain.kind == Domain::Kind::ball
                            ? 4.0 / 3.0 * std::numbers::pi * (domain.radius * domain.radius * domain.radius)
                            : 8.0 * (h.x * h.y * h.z);
  return std::fabs(domain.volume - volume) <= 1e-9 * domain.volume && domain.radius >= 0.0 && h.x >= 0.0 && h.y >= 0.0;
}

}  // namespace

void require_threads_and_stop_rule(const MonteCarloSettings& settings) {
  if (settings.n_threads < 1) throw UsageError("a run has no threads - give one at least");
  if (settings.n_threads > kMostThreads) {
    throw UsageError("too many threads (" + std::to_string(settings.n_threads) + ") - at most " +
                     std::to_string(kMostThreads));
  }
  if (settings.stop.max_trials < 1 || settings.stop.trials.value_or(1) < 1) {
    throw UsageError("a run has no trials - give one at least");
  }
  const StopRule& stop = settings.stop;
  if (stop.relative_error && !(*stop.relative_error > 0.0 && std::isfinite(*stop.relative_error))) {
    throw UsageError("a relative error is not positive and finite - give one such as 1e-3");
  }
  if (stop.seconds && !(*stop.seconds >= 0.0 && std::isfinite(*stop.seconds))) {
    throw UsageError("a run's seconds are negative or not finite - give a time");
  }
  if (settings.first_trial == 0) return;
  if (!stop.trials || stop.relative_error || stop.seconds) {
    throw UsageError("a range of trials without its number of trials, or with another stop rule (first trial " +
                     std::to_string(settings.first_trial) +
                     ") - give trials alone: when an error is reached is a matter of all trials");
  }
  constexpr std::uint64_t kLast = std::uint64_t{1} << 62;
  if (settings.first_trial > kLast || *stop.trials > kLast) {
    throw UsageError("trials of too large numbers (from " + std::to_string(settings.first_trial) +
                     " on) - give numbers below 2^62");
  }
}

namespace {

/// Each class must have its share of every range: its trials are every kClasses-th one, and an error is told from means
/// of equal numbers of them.
void require_whole_classes(const MonteCarloSettings& settings) {
  const bool is_sobol = settings.sequence == Sequence::sobol;
  if (!is_sobol && !settings.stratified) return;
  if (settings.first_trial % kClasses != 0) {
    throw UsageError("a range of " + std::string(is_sobol ? "Sobol' points" : "strata") +
                     " begins in the midst of its classes (first trial " + std::to_string(settings.first_trial) +
                     ") - begin at a multiple of " + std::to_string(kClasses) + ": trial i is of class i mod " +
                     std::to_string(kClasses));
  }
  if (is_sobol && settings.first_trial >= TrialPoints::kMostSobolTrials) {
    throw UsageError("a range of Sobol' points behind the last one (first trial " +
                     std::to_string(settings.first_trial) + ") - there are 2^37");
  }
}

}  // namespace

RunRecord run_monte_carlo(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  require_threads_and_stop_rule(settings);
  if (!settings.integrand && !is_good(settings.domain)) {
    throw UsageError("a run has no domain to sample, or one whose volume is not its own - give best_domain(a, b)");
  }
  if (!settings.integrand && !settings.backend.make) throw UsageError("a run has no backend - give gjk_backend()");
  for (const BackendKind& backend : settings.cross_check) {
    if (!backend.make) throw UsageError("a backend to compare with is none - give one that is");
  }
  if (settings.stratified && (settings.domain.kind != Domain::Kind::ball || settings.integrand)) {
    throw UsageError("strata are of hit-or-miss in a ball - give a ball as the domain and no integrand");
  }
  require_whole_classes(settings);
  RunnerFactory factory(a, b, settings);
  if (settings.ranks != nullptr && !settings.ranks->leads()) {
    work_for_leader(factory, settings);
    return {};
  }
  return Run(factory, settings, !settings.integrand && hits_by_construction(a, b, settings.law, settings.domain)).go();
}

double inner_share(const ConvexBody& a, const ConvexBody& b, const Domain& domain) {
  VEX_EXPECT(domain.kind == Domain::Kind::ball);
  constexpr double kALittleLess = 1.0 - 0x1p-40;  // than what rounding of positions and of roots is
  const double ratio = (a.inradius() + b.inradius()) / domain.radius;
  return kALittleLess * (ratio * ratio * ratio);
}

Transformd trial_pose(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings,
                      std::uint64_t index) {
  return PoseSampler(a, b, points_of_poses(a, b, settings), settings.law, settings.domain)(index).a_from_b;
}

bool hits_by_construction(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law, const Domain& domain) {
  if (domain.kind == Domain::Kind::ball) return is_ball(a) && is_ball(b);
  if (domain.kind != Domain::Kind::fitted || law.dimension() > 0) return false;
  // A - B is convex: it is all of the parallelepiped if the eight corners are in it, drawn in by a part in 2^30.
  constexpr double kNearlyNothing = 0x1p-30;
  const std::array<double, OrientationLaw::kMaxDimension> any_point{};
  Transformd pose = law.rotation(std::span<const double>(any_point));
  const Parallelepiped set = FittedDomain(a, b).at(pose);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto end = [corner](unsigned k) { return (corner >> k & 1u) != 0 ? 1.0 - kNearlyNothing : kNearlyNothing; };
    pose.translation = set.position(end(0), end(1), end(2));
    if (overlap(a, b, Pose::unchecked(pose)).outcome != Outcome::overlap) return false;
  }
  return true;
}

}  // namespace vex
