#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "engine/sampling/poses/pose_columns.h"
#include "engine/sampling/poses/pose_map.h"
#include "engine/sampling/trial_runner.h"

namespace vex {
namespace {

std::optional<Strata> strata_of(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  if (!settings.stratified) return std::nullopt;
  constexpr std::size_t kRadius = 2;  // pose_map.h
  return Strata{kRadius, inner_share(a, b, settings.domain)};
}

// Its own backends and buffers, filled a batch at a time.
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
      answer(trials_of_class(k, n_classes, begin, end), record);
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

  // A set that holds A - B at one orientation is no larger than the domain, by more than rounding, unless a body
  // reaches farther than it claims, or not as far as its own centre; then no mean of hits is its excluded volume.
  static void bound(std::span<double> shares) {
    bool are_shares = true;
    for (double& share : shares) {
      are_shares = are_shares && share >= 0.0 && share <= 1.0 + 0x1p-20;
      share = std::min(1.0, share);
    }
    if (!are_shares) {
      throw InputError(
          "a body's support mapping reaches farther than its circumradius, or not around its centre - ask "
          "vex::validate what is wrong with it");
    }
  }

  // Poses by a kernel; what the quick verdict decides is only counted.
  void run_columns(const Trials& trials, BlockRecord& record) {
    if (recipe_.points != nullptr) {
      points_.many(trials.first, trials.n, columns_of_points_.data(), PoseColumns::kStride);
    }
    draw_poses_(recipe_, trials.first, trials.n, columns_);
    if (fitted_) {
      bound({columns_.share, columns_.n_open});
      bound({columns_.share_disjoint, columns_.n_disjoint});
      bound({columns_.share_overlap, columns_.n_overlap});
    }
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
      poses_[k] = Pose::unchecked(trial.a_from_b);
      shares_[k] = trial.domain_share;
      bound({&shares_[k], 1});
      if (quick_ != nullptr) {
        const QuickVerdict::Answer<double> quick = (*quick_)(trial.a_from_b, trial.position);
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
      record.unproven.kept.push_back({trials.index(k), poses_[k].a_from_b(), outcome, std::move(check.fault)});
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
      Disagreement found{trials.index(k), poses_[k].a_from_b(), {verdicts_[k].outcome}};
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
  std::array<Pose, kBatch> poses_, open_poses_;
  std::array<double, kBatch> shares_{};
  std::array<Verdict, kBatch> verdicts_, open_verdicts_;
  std::vector<std::array<Verdict, kBatch>> checked_verdicts_;  // of each of checks_
  std::array<std::size_t, kBatch> open_{};
};

}  // namespace

TrialPoints points_of_poses(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  return {settings.seed, settings.sequence, 3 + settings.law.dimension(), strata_of(a, b, settings),
          settings.instruction_set};
}

std::unique_ptr<TrialRunner> make_pose_runner(const ConvexBody& a, const ConvexBody& b,
                                              const MonteCarloSettings& settings, const QuickVerdict* quick) {
  return std::make_unique<PoseRunner>(a, b, settings, quick);
}

}  // namespace vex
