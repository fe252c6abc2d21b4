#include "engine/sampling/monte_carlo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
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
#include "engine/sampling/trial_points.h"
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

// Trials first, first + step, ..., n of them.
struct Trials {
  std::uint64_t first, step;
  std::size_t n;

  std::uint64_t index(std::size_t k) const { return first + k * step; }
  Trials part(std::size_t from, std::size_t most) const { return {index(from), step, std::min(most, n - from)}; }
};

// Those of begin ... end - 1 that are of class k, begin being a multiple of the number of classes.
Trials of_class(std::uint64_t k, std::uint64_t n_classes, std::uint64_t begin, std::uint64_t end) {
  const std::uint64_t first = begin + k;
  return {first, n_classes, first < end ? static_cast<std::size_t>((end - first - 1) / n_classes + 1) : 0};
}

std::optional<Strata> strata_of(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  if (!settings.stratified) return std::nullopt;
  constexpr std::size_t kRadius = 2;  // pose_map.h
  return Strata{kRadius, inner_share(a, b, settings.domain)};
}

TrialPoints points_of_poses(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  return {settings.seed, settings.sequence, 3 + settings.law.dimension(), strata_of(a, b, settings),
          settings.instruction_set};
}

// The tally of no trial.
ClassTally empty_classes(const MonteCarloSettings& settings, std::uint64_t n_classes) {
  ClassTally by_class;
  by_class.kind = settings.sequence == Sequence::sobol ? ClassTally::Kind::scramblings
                  : settings.stratified                ? ClassTally::Kind::strata
                                                       : ClassTally::Kind::one;
  by_class.classes.resize(n_classes);
  return by_class;
}

// One thread's means of answering trials.
class TrialRunner {
 public:
  virtual ~TrialRunner() = default;
  /// `begin` is a multiple of the number of classes.
  virtual BlockRecord run(std::uint64_t begin, std::uint64_t end) = 0;
};

// Values of an integrand.
class AveragingRunner final : public TrialRunner {
 public:
  explicit AveragingRunner(const MonteCarloSettings& settings)
      : settings_(settings),
        integrand_(settings.integrand()),
        points_(settings.seed, settings.sequence, integrand_->dimension(), {}, settings.instruction_set),
        columns_(static_cast<std::size_t>(integrand_->dimension() + 1) * kStride) {}

  BlockRecord run(std::uint64_t begin, std::uint64_t end) override {
    BlockRecord record;
    ClassTally& by_class = record.tally.by_class = empty_classes(settings_, points_.n_classes());
    by_class.unit = integrand_->scale();
    by_class.relative_rounding = integrand_->relative_rounding();
    for (std::uint64_t k = 0; k < points_.n_classes(); ++k) {
      const Trials trials = of_class(k, points_.n_classes(), begin, end);
      for (std::size_t done = 0; done < trials.n; done += kBatch) {
        add(trials.part(done, kBatch), record.tally, by_class.classes[k]);
      }
    }
    return record;
  }

 private:
  static constexpr std::size_t kBatch = 256, kStride = kBatch + TrialPoints::kSpare;

  void add(const Trials& trials, Tally& tally, ClassSums& sums) {
    const std::size_t n = trials.n;
    points_.many(trials.first, n, columns_.data(), kStride);
    const auto dimension = static_cast<std::size_t>(integrand_->dimension());
    for (std::size_t c = 1; c < dimension; ++c) std::copy_n(&columns_[c * kStride], n, &columns_[c * n]);
    const std::span<double> values(values_.data(), n);
    const Doubts doubts = integrand_->evaluate(std::span<const double>(columns_).first(dimension * n), values);
    const double unit = tally.by_class.unit;
    for (double& value : values) {
      value /= unit;
      if (!(std::fabs(value) <= Integrand::kLargestValue)) {
        throw UsageError("values of this estimator are lost to rounding (one is " + std::to_string(value) +
                         " times what the bodies can have) - use hit-or-miss-fitted");
      }
    }
    sums.n += n;
    sums.values.add(values);
    tally.n_trials += n;
    tally.n_undecided += doubts.n_undecided;
    tally.n_decided_by[static_cast<std::size_t>(DecidedBy::gjk)] += n - doubts.n_undecided;
    tally.by_class.half_widths += doubts.half_widths;
  }

  const MonteCarloSettings& settings_;
  std::unique_ptr<Integrand> integrand_;
  TrialPoints points_;
  std::vector<double> columns_;
  std::array<double, kBatch> values_{};
};

// Hit or miss: its own backends and buffers, filled a batch at a time.
class PoseRunner final : public TrialRunner {
 public:
  /// `quick` of the pair, or none.
  PoseRunner(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings, const QuickVerdict* quick)
      : a_(a),
        b_(b),
        settings_(settings),
        points_(points_of_poses(a, b, settings)),
        sampler_(a, b, points_, settings.law, settings.domain),
        is_fitted_(settings.domain.kind == Domain::Kind::fitted),
        quick_(quick),
        recipe_{settings.seed, &settings.law, &settings.domain, b.centre(), quick, nullptr, nullptr},
        backend_(settings.backend.make(a, b)) {
    // Whoever asks for each trial's pose and verdict gets them one by one.
    if (settings.cross_check.empty() && !settings.verify) draw_poses_ = pose_kernel(settings.instruction_set);
    if (is_fitted_ && draw_poses_ != nullptr) recipe_.fitted = &fitted_.emplace(a, b, *sampler_.fitted());
    if (points_.n_classes() > 1) {
      columns_of_points_.resize((kPoseDimension + 1) * PoseColumns::kStride);
      recipe_.points = columns_of_points_.data();
      share_within_ = settings.stratified ? inner_share(a, b, settings.domain) : 0.0;
    }
    for (const BackendKind& kind : settings.cross_check) checks_.push_back(kind.make(a, b));
    checked_verdicts_.resize(checks_.size());
    shares_.fill(1.0);
  }

  BlockRecord run(std::uint64_t begin, std::uint64_t end) override {
    BlockRecord record;
    record.comparisons.resize(checks_.size());
    const std::uint64_t n_classes = points_.n_classes();
    if (n_classes == 1) {
      answer({begin, 1, static_cast<std::size_t>(end - begin)}, record);
      return record;
    }
    ClassTally by_class = empty_classes(settings_, n_classes);
    by_class.are_hits = true;
    by_class.offset = share_within_ * settings_.domain.volume;
    by_class.unit = settings_.domain.volume - by_class.offset;
    Tally tally;
    for (std::uint64_t k = 0; k < n_classes; ++k) {
      record.tally = {};
      answer(of_class(k, n_classes, begin, end), record);
      const Tally& done = record.tally;
      ClassSums& sums = by_class.classes[k];
      sums.n = done.n_trials;
      if (is_fitted_) {
        sums.values = done.hits;
        sums.undecided = done.undecided;
      } else {
        const auto n_hits = static_cast<double>(done.n_hits), n_undecided = static_cast<double>(done.n_undecided);
        sums.values = {of_one(n_hits), of_one(n_hits)};
        sums.undecided = {of_one(n_undecided), of_one(n_undecided)};
      }
      tally += done;
    }
    tally.by_class = std::move(by_class);
    record.tally = std::move(tally);
    return record;
  }

 private:
  static constexpr std::size_t kBatch = PoseColumns::kMostTrials;  // poses held at once: within the nearest caches

  static FixedPointSum of_one(double x) {
    FixedPointSum sum;
    sum.add(x);
    return sum;
  }

  void answer(const Trials& trials, BlockRecord& record) {
    for (std::size_t done = 0; done < trials.n; done += kBatch) {
      const Trials batch = trials.part(done, kBatch);
      if (draw_poses_ != nullptr) {
        run_columns(batch, record);
      } else {
        run_batch(batch, record);
      }
    }
  }

  // Poses by a kernel; what the quick verdict decides is only counted.
  void run_columns(const Trials& trials, BlockRecord& record) {
    if (fitted_) fitted_->look_for_tables();
    if (recipe_.points != nullptr) {
      points_.many(trials.first, trials.n, columns_of_points_.data(), PoseColumns::kStride);
    }
    draw_poses_(recipe_, trials.first, trials.n, columns_);
    record.tally.add(DecidedBy::outer_bound, columns_.n_disjoint, 0);
    record.tally.add(DecidedBy::inner_bound, 0, columns_.n_overlap);
    const std::size_t n_open = columns_.n_open;
    backend_->decide_table({columns_.poses[0], PoseColumns::kStride, n_open}, {verdicts_.data(), n_open});
    const std::uint64_t n_undecided_before = record.tally.n_undecided;
    record.tally.add(std::span<const Verdict>(verdicts_).first(n_open));
    if (fitted_) add_shares(record.tally);
    if (record.tally.n_undecided == n_undecided_before) return;
    for (std::size_t k = 0; k < n_open; ++k) note_undecided(trials.index(columns_.row[k]), verdicts_[k], record);
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

  void run_batch(const Trials& trials, BlockRecord& record) {
    decide_one_by_one(trials);
    for (std::size_t k = 0; k < trials.n; ++k) {
      if (is_fitted_) {
        record.tally.add(verdicts_[k], shares_[k]);
      } else {
        record.tally.add(verdicts_[k]);
      }
      note_undecided(trials.index(k), verdicts_[k], record);
    }
    if (!checks_.empty()) cross_check(trials, record);
    if (settings_.verify) verify(trials, record);
  }

  static void note_undecided(std::uint64_t index, const Verdict& verdict, BlockRecord& record) {
    if (verdict.outcome != Outcome::undecided) return;
    ++record.undecided.n_all;
    record.undecided.kept.push_back({index, verdict.reason});
  }

  void decide_one_by_one(const Trials& trials) {
    std::size_t n_open = 0;
    for (std::size_t k = 0; k < trials.n; ++k) {
      const PosedTrial trial = sampler_(trials.index(k));
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

  void verify(const Trials& trials, BlockRecord& record) {
    for (std::size_t k = 0; k < trials.n; ++k) {
      const Outcome outcome = verdicts_[k].outcome;
      if (outcome == Outcome::undecided) continue;
      CertificateCheck check = prove_again(a_, b_, poses_[k], outcome);
      if (check.is_proven) {
        ++record.n_proven_again;
        continue;
      }
      ++record.unproven.n_all;
      if (record.unproven.kept.size() == FirstOf<UnprovenTrial>::kKept) continue;
      record.unproven.kept.push_back({trials.index(k), poses_[k], outcome, std::move(check.fault)});
    }
  }

  void cross_check(const Trials& trials, BlockRecord& record) {
    const std::size_t n = trials.n;
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
      Disagreement found{trials.index(k), poses_[k], {verdicts_[k].outcome}};
      for (const auto& verdicts : checked_verdicts_) found.outcomes.push_back(verdicts[k].outcome);
      record.disagreements.kept.push_back(std::move(found));
    }
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const MonteCarloSettings& settings_;
  TrialPoints points_;
  std::vector<double> columns_of_points_;  // unless a kernel draws them itself
  double share_within_ = 0.0;              // of the domain: hits without a trial
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
        certain_(!settings.integrand && hits_by_construction(a, b, settings.law, settings.domain)),
        grain_(settings.sequence == Sequence::sobol || settings.stratified ? kClasses : 1),
        is_only_rule_(settings.stop.relative_error && !settings.stop.trials && !settings.stop.seconds) {
    if (settings.quick_verdicts && !settings.backend.is_peer && !settings.integrand)
      quick_.emplace(a, b, kDrawnRotationError);
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

  // Called with the lock held, when all trials up to round_end_ are done.
  void evaluate() {
    if (settings_.stop.relative_error &&
        reaches(*settings_.stop.relative_error, record_.tally, settings_.domain, certain_)) {
      stop(StopReason::relative_error);
    } else if (is_only_rule_ && is_out_of_reach(*settings_.stop.relative_error, record_.tally, settings_.domain)) {
      stop(StopReason::undecided);
    } else if (is_only_rule_ && record_.tally.by_class.relative_rounding > *settings_.stop.relative_error) {
      stop(StopReason::rounding);
    } else if (round_end_ == trial_limit()) {
      const bool as_asked = settings_.stop.trials && *settings_.stop.trials <= trial_limit();
      stop(as_asked ? StopReason::trials : StopReason::max_trials);
    } else {
      set_next_evaluation();
      changed_.notify_all();
    }
  }

  std::unique_ptr<TrialRunner> make_runner() const {
    if (settings_.integrand) return std::make_unique<AveragingRunner>(settings_);
    return std::make_unique<PoseRunner>(a_, b_, settings_, quick_ ? &*quick_ : nullptr);
  }

  void work() {
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
  const std::uint64_t grain_;  // blocks begin at multiples of it
  const bool is_only_rule_;    // the relative error: where it cannot be reached, nothing else ends the run
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

RunRecord run_monte_carlo(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  VEX_EXPECT(settings.n_threads >= 1);
  VEX_EXPECT(settings.integrand || settings.domain.volume > 0.0);
  VEX_EXPECT(!settings.stratified || (settings.domain.kind == Domain::Kind::ball && !settings.integrand));
  VEX_EXPECT(settings.stop.max_trials >= 1 && settings.stop.trials.value_or(1) >= 1);
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
    if (overlap(a, b, pose).outcome != Outcome::overlap) return false;
  }
  return true;
}

}  // namespace vex
