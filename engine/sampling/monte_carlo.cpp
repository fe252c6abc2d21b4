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
#include "engine/query/packets/quick_verdict.h"
#include "engine/sampling/poses/pose_map.h"
#include "engine/sampling/trial_runner.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

template <class T>
void keep_first(FirstOf<T>& list) {
  std::sort(list.kept.begin(), list.kept.end(), [](const T& x, const T& y) { return x.index < y.index; });
  if (list.kept.size() > FirstOf<T>::kKept) list.kept.resize(FirstOf<T>::kKept);
}

template <class T>
void append(FirstOf<T>& list, FirstOf<T>&& more) {
  list.n_all += more.n_all;
  list.kept.insert(list.kept.end(), std::make_move_iterator(more.kept.begin()),
                   std::make_move_iterator(more.kept.end()));
  if (list.kept.size() > 2 * FirstOf<T>::kKept) keep_first(list);
  more = {};
}

// The run as the threads share it. Threads take blocks of consecutive trials up to the next evaluation; every block
// taken is finished, so the finished trials are always 0 ... n - 1. The thread that finishes the last block evaluates.
class Run {
 public:
  Run(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings)
      : a_(a),
        b_(b),
        settings_(settings),
        certain_(!settings.integrand && hits_by_construction(a, b, settings.law, settings.domain)),
        grain_(settings.sequence == Sequence::sobol || settings.stratified ? kClasses : 1),
        is_only_rule_(settings.stop.relative_error && !settings.stop.trials && !settings.stop.seconds) {
    if (settings.quick_verdicts && !settings.backend.is_peer && !settings.integrand)
      quick_.emplace(a, b, kDrawnRotationError);
    if (settings.integrand) {
      first_integrand_ = settings.integrand();
      if (first_integrand_ == nullptr) throw UsageError("a run's integrand is none - give one");
      reference_ = reference_value(*first_integrand_);
    }
    record_.comparisons.resize(settings.cross_check.size());
    set_next_evaluation();
  }

  RunRecord go() {
    std::vector<std::jthread> threads;
    try {
      start_threads(threads, settings_.n_threads, [this](int) { work(false); });
      const bool has_threads = !threads.empty();
      note_threads(settings_.n_threads, has_threads ? static_cast<int>(threads.size()) : 1);
      if (has_threads) {
        wait_and_report();
      } else {
        work(true);
      }
    } catch (...) {
      fail(std::current_exception());  // of on_progress; the threads must be told before they are joined
    }
    threads.clear();
    if (failure_) std::rethrow_exception(failure_);
    record_.seconds = seconds_since(start_);
    keep_first(record_.undecided);
    keep_first(record_.disagreements);
    keep_first(record_.unproven);
    return std::move(record_);
  }

 private:
  static constexpr double kBlockSeconds = 0.01;  // an interrupt is answered within a block or two
  static constexpr auto kProgressInterval = std::chrono::milliseconds(100);

  std::uint64_t trial_limit() const {
    std::uint64_t limit =
        std::min(settings_.stop.trials.value_or(settings_.stop.max_trials), settings_.stop.max_trials);
    if (settings_.sequence == Sequence::sobol) limit = std::min(limit, TrialPoints::kMostSobolTrials);
    return limit;
  }

  void set_next_evaluation() {
    const std::uint64_t limit = trial_limit();
    round_end_ =
        settings_.stop.relative_error ? std::min(limit, next_evaluation(round_end_, settings_.sequence)) : limit;
  }

  bool interrupted() const { return settings_.interrupt != nullptr && settings_.interrupt->load() != 0; }

  // Called with the lock held. Whether another block may be taken now; if the run is over, says why.
  bool may_take_block() {
    if (stopped_) return false;
    if (interrupted()) {
      stop(StopReason::interrupted);
    } else if (settings_.stop.seconds && seconds_since(start_) >= *settings_.stop.seconds && next_ > 0) {
      stop(StopReason::seconds);
    }
    return !stopped_ && next_ < round_end_;
  }

  void stop(StopReason reason) {
    stopped_ = true;
    record_.stopped_by = reason;
    record_.complete =
        reason == StopReason::trials || reason == StopReason::relative_error || reason == StopReason::seconds;
    changed_.notify_all();
    ended_.notify_all();
  }

  // Whether the error asked for is below the integrand's own rounding, and all else is nearly so.
  bool rounding_is_most() const {
    const VolumeEstimate estimate = volume_estimate(record_.tally, settings_.domain);
    const double rounding = record_.tally.by_class.rounding_of(estimate.excluded_volume);
    return rounding > *settings_.stop.relative_error * std::fabs(estimate.excluded_volume) &&
           estimate.std_error <= 2.0 * rounding;
  }

  // Called with the lock held, when all trials up to round_end_ are done.
  void evaluate() {
    if (settings_.stop.relative_error &&
        reaches(*settings_.stop.relative_error, record_.tally, settings_.domain, certain_)) {
      stop(StopReason::relative_error);
    } else if (is_only_rule_ && is_out_of_reach(*settings_.stop.relative_error, record_.tally, settings_.domain)) {
      stop(StopReason::undecided);
    } else if (is_only_rule_ && rounding_is_most()) {
      stop(StopReason::rounding);
    } else if (is_only_rule_ &&
               is_in_vain(*settings_.stop.relative_error, record_.tally, settings_.domain, settings_.stop.max_trials)) {
      stop(StopReason::in_vain);
    } else if (round_end_ == trial_limit()) {
      const bool as_asked = settings_.stop.trials && *settings_.stop.trials <= trial_limit();
      stop(as_asked ? StopReason::trials : StopReason::max_trials);
    } else {
      set_next_evaluation();
      changed_.notify_all();
    }
  }

  std::unique_ptr<TrialRunner> make_runner() {
    if (settings_.integrand) {
      std::unique_ptr<Integrand> integrand;
      {
        const std::lock_guard lock(mutex_);
        integrand = std::move(first_integrand_);
      }
      if (integrand == nullptr) integrand = settings_.integrand();
      return make_averaging_runner(settings_, std::move(integrand), reference_);
    }
    return make_pose_runner(a_, b_, settings_, quick_ ? &*quick_ : nullptr);
  }

  /// `reports`: it is the calling thread's work, because the system gives no other; it tells the progress as well.
  void work(bool reports) {
    try {
      const std::unique_ptr<TrialRunner> runner = make_runner();
      std::uint64_t block = 16 * grain_;
      std::unique_lock lock(mutex_);
      while (true) {
        if (!may_take_block()) {
          if (stopped_) return;
          changed_.wait(lock);
          continue;
        }
        const std::uint64_t begin = next_;
        const std::uint64_t end = std::min(round_end_, begin + block);
        next_ = end;
        lock.unlock();
        const Clock::time_point block_start = Clock::now();
        BlockRecord done = runner->run(begin, end);
        const double block_seconds = seconds_since(block_start);
        // The size of a block decides nothing but the waiting: aim at kBlockSeconds, at most doubling.
        if (end - begin == block && block_seconds < 0.5 * kBlockSeconds) block *= 2;
        if (block_seconds > kBlockSeconds && block > grain_) block /= 2;
        lock.lock();
        take_home(std::move(done));
        if (reports && !stopped_ && Clock::now() >= next_report_) report(lock);
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

  // Called with the lock held.
  void take_home(BlockRecord&& done) {
    record_.tally += done.tally;
    append(record_.undecided, std::move(done.undecided));
    append(record_.disagreements, std::move(done.disagreements));
    append(record_.unproven, std::move(done.unproven));
    record_.n_proven_again += done.n_proven_again;
    for (std::size_t c = 0; c < done.comparisons.size(); ++c) record_.comparisons[c] += done.comparisons[c];
    if (!stopped_ && record_.tally.n_trials == round_end_) evaluate();
  }

  void wait_and_report() {
    std::unique_lock lock(mutex_);
    while (!stopped_) {
      ended_.wait_for(lock, kProgressInterval);
      if (stopped_) break;
      if (interrupted()) stop(StopReason::interrupted);
      report(lock);
    }
  }

  void report(std::unique_lock<std::mutex>& lock) {
    next_report_ = Clock::now() + kProgressInterval;
    if (!settings_.on_progress) return;
    Progress progress{record_.tally, std::numeric_limits<double>::infinity(), seconds_since(start_), settings_.stop};
    if (record_.tally.n_trials > 0) {
      progress.relative_error = volume_estimate(record_.tally, settings_.domain).relative_error();
    }
    lock.unlock();
    settings_.on_progress(progress);
    lock.lock();
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const MonteCarloSettings& settings_;
  std::optional<QuickVerdict> quick_;  // where the run uses it
  const bool certain_;
  const std::uint64_t grain_;  // blocks begin at multiples of it
  const bool is_only_rule_;    // the relative error: where it cannot be reached, nothing else ends the run
  const Clock::time_point start_ = Clock::now();
  double reference_ = 0.0;  // of an integrand: made once, before the threads

  std::mutex mutex_;                            // guards all below; taken once a block, not once a trial
  std::unique_ptr<Integrand> first_integrand_;  // which the reference is of: for the thread that comes first
  std::condition_variable changed_;             // for threads that wait for the next round
  std::condition_variable ended_;               // for the caller, which would only be disturbed by every round
  std::uint64_t next_ = 0;                      // the first trial that no thread has taken
  std::uint64_t round_end_ = 0;                 // where the stop rule is looked at next
  Clock::time_point next_report_ = start_ + kProgressInterval;
  bool stopped_ = false;
  std::exception_ptr failure_;
  RunRecord record_;
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
}

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
  return Run(a, b, settings).go();
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
