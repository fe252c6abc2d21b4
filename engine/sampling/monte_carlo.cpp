#include "engine/sampling/monte_carlo.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/query/overlap.h"
#include "engine/sampling/pose_columns.h"
#include "engine/sampling/pose_map.h"
#include "engine/scene/quick_verdict.h"

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

// What one thread brings home from a block of consecutive trials.
struct BlockRecord {
  Tally tally;
  FirstOf<UndecidedTrial> undecided;
  FirstOf<Disagreement> disagreements;
  std::vector<Comparison> comparisons;
  std::uint64_t n_proven_again = 0;
  FirstOf<UnprovenTrial> unproven;
};

// One thread's means of answering trials: its own backends and buffers, filled a batch at a time.
class TrialRunner {
 public:
  /// `quick` of the pair, or none.
  TrialRunner(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings, const QuickVerdict* quick)
      : a_(a),
        b_(b),
        settings_(settings),
        sampler_(a, b, settings.seed, settings.law, settings.domain),
        is_fitted_(settings.domain.kind == Domain::Kind::fitted),
        quick_(quick),
        recipe_{settings.seed, &settings.law, &settings.domain, b.centre(), quick, nullptr},
        backend_(settings.backend.make(a, b)) {
    // Whoever asks for each trial's pose and verdict gets them one by one.
    if (settings.cross_check.empty() && !settings.verify) draw_poses_ = pose_kernel(settings.instruction_set);
    if (is_fitted_ && draw_poses_ != nullptr) recipe_.fitted = &fitted_.emplace(a, b, *sampler_.fitted());
    for (const BackendKind& kind : settings.cross_check) checks_.push_back(kind.make(a, b));
    checked_verdicts_.resize(checks_.size());
    shares_.fill(1.0);
  }

  BlockRecord run(std::uint64_t begin, std::uint64_t end) {
    BlockRecord record;
    record.comparisons.resize(checks_.size());
    for (std::uint64_t first = begin; first < end; first += kBatch) {
      const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, end - first));
      if (draw_poses_ != nullptr) {
        run_columns(first, n, record);
      } else {
        run_batch(first, n, record);
      }
    }
    return record;
  }

 private:
  static constexpr std::size_t kBatch = PoseColumns::kMostTrials;  // poses held at once: within the nearest caches

  // Poses by a kernel; what the quick verdict decides is only counted.
  void run_columns(std::uint64_t first, std::size_t n, BlockRecord& record) {
    if (fitted_) fitted_->look_for_tables();
    draw_poses_(recipe_, first, n, columns_);
    record.tally.add(DecidedBy::outer_bound, columns_.n_disjoint, 0);
    record.tally.add(DecidedBy::inner_bound, 0, columns_.n_overlap);
    const std::size_t n_open = columns_.n_open;
    backend_->decide_table({columns_.poses[0], PoseColumns::kStride, n_open}, {verdicts_.data(), n_open});
    record.tally.add(std::span<const Verdict>(verdicts_).first(n_open));
    if (fitted_) add_shares(record.tally);
    if (record.tally.n_undecided == record.undecided.n_all) return;
    for (std::size_t k = 0; k < n_open; ++k) note_undecided(first + columns_.row[k], verdicts_[k], record);
  }

  void add_shares(Tally& tally) {
    const std::span<const double> open(columns_.share, columns_.n_open);
    const std::span<const double> overlap(columns_.share_overlap, columns_.n_overlap);
    tally.all.add(open);
    tally.all.add(overlap);
    tally.all.add({columns_.share_disjoint, columns_.n_disjoint});
    std::size_t n_hits = 0, n_undecided = 0;
    for (std::size_t k = 0; k < open.size(); ++k) {
      shares_[n_hits] = open[k];
      n_hits += verdicts_[k].outcome == Outcome::overlap ? 1u : 0u;
      n_undecided += verdicts_[k].outcome == Outcome::undecided ? 1u : 0u;
    }
    tally.hits.add(std::span<const double>(shares_).first(n_hits));
    tally.hits.add(overlap);
    if (n_undecided == 0) return;
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (verdicts_[k].outcome == Outcome::undecided) tally.undecided.add(open[k]);
    }
  }

  void run_batch(std::uint64_t first, std::size_t n, BlockRecord& record) {
    decide_one_by_one(first, n);
    for (std::size_t k = 0; k < n; ++k) {
      if (is_fitted_) {
        record.tally.add(verdicts_[k], shares_[k]);
      } else {
        record.tally.add(verdicts_[k]);
      }
      note_undecided(first + k, verdicts_[k], record);
    }
    if (!checks_.empty()) cross_check(first, n, record);
    if (settings_.verify) verify(first, n, record);
  }

  static void note_undecided(std::uint64_t index, const Verdict& verdict, BlockRecord& record) {
    if (verdict.outcome != Outcome::undecided) return;
    ++record.undecided.n_all;
    record.undecided.kept.push_back({index, verdict.reason});
  }

  void decide_one_by_one(std::uint64_t first, std::size_t n) {
    std::size_t n_open = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const PosedTrial trial = sampler_(first + k);
      poses_[k] = trial.a_from_b;
      shares_[k] = trial.domain_share;
      if (quick_ != nullptr) {
        const QuickVerdict::Answer<double> quick = (*quick_)(poses_[k], trial.position);
        if (quick.disjoint) {
          verdicts_[k] = Verdict::disjoint(DecidedBy::outer_bound);
          continue;
        }
        if (quick.overlap) {
          verdicts_[k] = Verdict::overlap(DecidedBy::inner_bound);
          continue;
        }
      }
      open_[n_open] = k;
      open_poses_[n_open] = poses_[k];
      ++n_open;
    }
    backend_->decide({open_poses_.data(), n_open}, {open_verdicts_.data(), n_open});
    for (std::size_t j = 0; j < n_open; ++j) verdicts_[open_[j]] = open_verdicts_[j];
  }

  void verify(std::uint64_t first, std::size_t n, BlockRecord& record) {
    for (std::size_t k = 0; k < n; ++k) {
      const Outcome outcome = verdicts_[k].outcome;
      if (outcome == Outcome::undecided) continue;
      CertificateCheck check = prove_again(a_, b_, poses_[k], outcome);
      if (check.is_proven) {
        ++record.n_proven_again;
        continue;
      }
      ++record.unproven.n_all;
      if (record.unproven.kept.size() == FirstOf<UnprovenTrial>::kKept) continue;
      record.unproven.kept.push_back({first + k, poses_[k], outcome, std::move(check.fault)});
    }
  }

  void cross_check(std::uint64_t first, std::size_t n, BlockRecord& record) {
    for (std::size_t c = 0; c < checks_.size(); ++c) {
      checks_[c]->decide({poses_.data(), n}, {checked_verdicts_[c].data(), n});
      for (std::size_t k = 0; k < n; ++k) record.comparisons[c].add(verdicts_[k], checked_verdicts_[c][k], shares_[k]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const auto says = [&](Outcome outcome) {
        return verdicts_[k].outcome == outcome || std::ranges::any_of(checked_verdicts_, [&](const auto& verdicts) {
                 return verdicts[k].outcome == outcome;
               });
      };
      if (!says(Outcome::disjoint) || !says(Outcome::overlap)) continue;
      ++record.disagreements.n_all;
      if (record.disagreements.kept.size() == FirstOf<Disagreement>::kKept) continue;
      Disagreement found{first + k, poses_[k], {verdicts_[k].outcome}};
      for (const auto& verdicts : checked_verdicts_) found.outcomes.push_back(verdicts[k].outcome);
      record.disagreements.kept.push_back(std::move(found));
    }
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const MonteCarloSettings& settings_;
  PoseSampler sampler_;
  bool is_fitted_;
  const QuickVerdict* quick_;
  std::optional<FittedRecipe> fitted_;  // where a kernel draws from such a domain
  PoseRecipe recipe_;
  DrawPoses draw_poses_ = nullptr;
  PoseColumns columns_;
  std::unique_ptr<OverlapBackend> backend_;
  std::vector<std::unique_ptr<OverlapBackend>> checks_;
  std::array<Transformd, kBatch> poses_, open_poses_;
  std::array<double, kBatch> shares_{};
  std::array<Verdict, kBatch> verdicts_, open_verdicts_;
  std::vector<std::array<Verdict, kBatch>> checked_verdicts_;  // of each of checks_
  std::array<std::size_t, kBatch> open_{};
};

// The run as the threads share it. Threads take blocks of consecutive trials up to the next evaluation; every block
// taken is finished, so the finished trials are always 0 ... n - 1. The thread that finishes the last block evaluates.
class Run {
 public:
  Run(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings)
      : a_(a),
        b_(b),
        settings_(settings),
        certain_(hits_by_construction(a, b, settings.law, settings.domain)),
        is_only_rule_(settings.stop.relative_error && !settings.stop.trials && !settings.stop.seconds) {
    if (settings.quick_verdicts && !settings.backend.is_peer) quick_.emplace(a, b, kDrawnRotationError);
    record_.comparisons.resize(settings.cross_check.size());
    set_next_evaluation();
  }

  RunRecord go() {
    std::vector<std::jthread> threads;
    try {
      threads.reserve(static_cast<std::size_t>(settings_.n_threads));
      for (int k = 0; k < settings_.n_threads; ++k) threads.emplace_back([this] { work(); });
      wait_and_report();
    } catch (const std::system_error&) {
      fail(std::make_exception_ptr(UsageError("this system starts no more than " + std::to_string(threads.size()) +
                                              " threads (" + std::to_string(settings_.n_threads) +
                                              " asked for) - use fewer threads")));
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
    return std::min(settings_.stop.trials.value_or(settings_.stop.max_trials), settings_.stop.max_trials);
  }

  void set_next_evaluation() {
    const std::uint64_t limit = trial_limit();
    round_end_ = settings_.stop.relative_error ? std::min(limit, next_evaluation(round_end_)) : limit;
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

  // Called with the lock held, when all trials up to round_end_ are done.
  void evaluate() {
    if (settings_.stop.relative_error &&
        reaches(*settings_.stop.relative_error, record_.tally, settings_.domain, certain_)) {
      stop(StopReason::relative_error);
    } else if (is_only_rule_ && is_out_of_reach(*settings_.stop.relative_error, record_.tally, settings_.domain)) {
      stop(StopReason::undecided);
    } else if (round_end_ == trial_limit()) {
      const bool as_asked = settings_.stop.trials && *settings_.stop.trials <= settings_.stop.max_trials;
      stop(as_asked ? StopReason::trials : StopReason::max_trials);
    } else {
      set_next_evaluation();
      changed_.notify_all();
    }
  }

  void work() {
    try {
      TrialRunner runner(a_, b_, settings_, quick_ ? &*quick_ : nullptr);
      std::uint64_t block = 16;
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
        BlockRecord done = runner.run(begin, end);
        const double block_seconds = seconds_since(block_start);
        // The size of a block decides nothing but the waiting: aim at kBlockSeconds, at most doubling.
        if (end - begin == block && block_seconds < 0.5 * kBlockSeconds) block *= 2;
        if (block_seconds > kBlockSeconds && block > 1) block /= 2;
        lock.lock();
        take_home(std::move(done));
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
      if (settings_.on_progress) {
        Progress progress{record_.tally, std::numeric_limits<double>::infinity(), seconds_since(start_)};
        if (record_.tally.n_trials > 0) {
          progress.relative_error = volume_estimate(record_.tally, settings_.domain).relative_error();
        }
        lock.unlock();
        settings_.on_progress(progress);
        lock.lock();
      }
    }
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const MonteCarloSettings& settings_;
  std::optional<QuickVerdict> quick_;  // where the run uses it
  const bool certain_;
  const bool is_only_rule_;  // the relative error: where it cannot be reached, nothing else ends the run
  const Clock::time_point start_ = Clock::now();

  std::mutex mutex_;                 // guards all below; taken once a block, not once a trial
  std::condition_variable changed_;  // for threads that wait for the next round
  std::condition_variable ended_;    // for the caller, which would only be disturbed by every round
  std::uint64_t next_ = 0;           // the first trial that no thread has taken
  std::uint64_t round_end_ = 0;      // where the stop rule is looked at next
  bool stopped_ = false;
  std::exception_ptr failure_;
  RunRecord record_;
};

}  // namespace

RunRecord run_hit_or_miss(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  VEX_EXPECT(settings.n_threads >= 1);
  VEX_EXPECT(settings.domain.volume > 0.0);
  VEX_EXPECT(settings.stop.max_trials >= 1 && settings.stop.trials.value_or(1) >= 1);
  return Run(a, b, settings).go();
}

Transformd trial_pose(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings,
                      std::uint64_t index) {
  return PoseSampler(a, b, settings.seed, settings.law, settings.domain)(index).a_from_b;
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
    if (overlap(a, b, pose).outcome != Outcome::overlap) return false;
  }
  return true;
}

}  // namespace vex
