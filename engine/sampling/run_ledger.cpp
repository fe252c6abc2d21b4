#include "engine/sampling/run_ledger.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::uint64_t trial_limit(const MonteCarloSettings& settings) {
  const StopRule& stop = settings.stop;
  const std::uint64_t limit = std::min(stop.trials.value_or(stop.max_trials), stop.max_trials);
  if (settings.sequence != Sequence::sobol) return limit;
  return std::min(limit, TrialPoints::kMostSobolTrials - std::min(TrialPoints::kMostSobolTrials, settings.first_trial));
}

}  // namespace

RunLedger::RunLedger(const MonteCarloSettings& settings, bool certain)
    : settings_(settings),
      certain_(certain),
      is_only_rule_(settings.stop.relative_error && !settings.stop.trials && !settings.stop.seconds),
      limit_(trial_limit(settings)) {
  done_.comparisons.resize(settings.cross_check.size());
  round_end_ = evaluation_after(0);
  if (settings.resume != nullptr) resume(*settings.resume);
}

// Later ones than the number of trials of the settings are none.
std::uint64_t RunLedger::evaluation_after(std::uint64_t n_trials) const {
  return settings_.stop.relative_error ? std::min(limit_, next_evaluation(n_trials, settings_.sequence)) : limit_;
}

void RunLedger::resume(const RunState& state) {
  const auto refuse = [](const std::string& problem, const char* advice) {
    throw InputError("the state to go on from " + problem + " - " + advice);
  };
  const std::uint64_t n_trials = state.done.tally.n_trials;
  if (state.first_trial != settings_.first_trial) {
    refuse("begins with another trial (" + std::to_string(state.first_trial) + ", and this run with " +
               std::to_string(settings_.first_trial) + ")",
           "give the settings of its run");
  }
  const bool has_domain = !settings_.integrand;
  if (state.domain_volume != (has_domain ? settings_.domain.volume : 0.0) ||
      (has_domain && state.domain != settings_.domain.kind)) {
    refuse("is of another sampling domain", "give the bodies and settings of its run");
  }
  if (n_trials == 0) return;
  if (n_trials > limit_) {
    refuse("has more trials than the run may have (" + std::to_string(n_trials) + " of " + std::to_string(limit_) + ")",
           "give as many or more");
  }
  const std::uint64_t n_proven = state.done.n_proven_again + state.done.unproven.n_all;
  if (state.done.comparisons.size() != settings_.cross_check.size() ||
      n_proven != (settings_.verify ? n_trials - state.done.tally.n_undecided : 0)) {
    refuse("was compared with other backends, or verified", "give the settings of its run");
  }
  done_ = state.done;
  next_ = n_brought_ = n_trials;
  while (round_end_ < n_trials) round_end_ = evaluation_after(round_end_);
  if (round_end_ == n_trials) {
    evaluate();
  } else if (n_trials % kClasses != 0 && done_.tally.by_class.classes.size() == kClasses) {
    refuse("ends in the midst of its " + std::to_string(kClasses) + " classes of trials (" + std::to_string(n_trials) +
               " trials)",
           "only a run that ended at a multiple of that can be made longer");
  }
}

// Pieces that wait, of some ten kilobytes each; between any two of them is a block that a rank still works on.
std::size_t RunLedger::most_waiting() const {
  constexpr std::size_t kFew = 4096, kEach = 4;
  return settings_.ranks == nullptr ? kFew
                                    : std::max(kFew, kEach * static_cast<std::size_t>(settings_.ranks->n_ranks()));
}

std::optional<RunLedger::Block> RunLedger::take(std::uint64_t most) {
  if (over_ || waiting_.size() >= most_waiting()) return std::nullopt;  // whoever has the first of them brings it
  block_end_ = std::max(block_end_, round_end_);
  if (next_ == block_end_) {
    if (settings_.ranks == nullptr || block_end_ == limit_) return std::nullopt;
    block_end_ = evaluation_after(block_end_);
  }
  evaluations_.insert(block_end_);
  const std::uint64_t begin = next_;
  next_ += std::min(most, block_end_ - next_);
  return Block{settings_.first_trial + begin, settings_.first_trial + next_};
}

bool RunLedger::bring(const Block& block, BlockRecord&& record) {
  n_brought_ += block.end - block.begin;
  const auto at =
      waiting_
          .emplace(block.begin - settings_.first_trial, Waiting{block.end - settings_.first_trial, std::move(record)})
          .first;
  const auto join = [this](auto before, auto after) {
    if (before->second.end != after->first || evaluations_.contains(after->first)) return;
    before->second.record += std::move(after->second.record);
    before->second.end = after->second.end;
    waiting_.erase(after);
  };
  if (const auto after = std::next(at); after != waiting_.end()) join(at, after);
  if (at != waiting_.begin()) join(std::prev(at), at);
  bool evaluated = false;
  // Also behind the end of a run that was interrupted: what was done counts. But nothing beyond an evaluation that
  // nobody made.
  while (!over_ || (is_cut_off() && done_.tally.n_trials < round_end_)) {
    const auto next = waiting_.find(done_.tally.n_trials);
    if (next == waiting_.end()) break;
    done_ += std::move(next->second.record);
    waiting_.erase(next);
    if (over_ || done_.tally.n_trials != round_end_) continue;
    evaluate();
    evaluated = true;
  }
  return evaluated;
}

void RunLedger::stop(StopReason reason) {
  if (over_) return;
  over_ = true;
  stopped_by_ = reason;
}

// Whether the error asked for is below the integrand's own rounding, and all else is nearly so.
bool RunLedger::rounding_is_most() const {
  const VolumeEstimate estimate = volume_estimate(done_.tally, settings_.domain);
  const double rounding = done_.tally.by_class.rounding_of(estimate.excluded_volume);
  return rounding > *settings_.stop.relative_error * std::fabs(estimate.excluded_volume) &&
         estimate.std_error <= 2.0 * rounding;
}

// When all trials up to round_end_ are done.
void RunLedger::evaluate() {
  const Tally& tally = done_.tally;
  const Domain& domain = settings_.domain;
  const StopRule& stop_rule = settings_.stop;
  if (stop_rule.relative_error && reaches(*stop_rule.relative_error, tally, domain, certain_)) {
    stop(StopReason::relative_error);
  } else if (is_only_rule_ && is_out_of_reach(*stop_rule.relative_error, tally, domain)) {
    stop(StopReason::undecided);
  } else if (is_only_rule_ && rounding_is_most()) {
    stop(StopReason::rounding);
  } else if (is_only_rule_ && is_in_vain(*stop_rule.relative_error, tally, domain, stop_rule.max_trials)) {
    stop(StopReason::in_vain);
  } else if (round_end_ == limit_) {
    const bool as_asked = stop_rule.trials && *stop_rule.trials <= limit_;
    stop(as_asked ? StopReason::trials : StopReason::max_trials);
  } else {
    evaluations_.erase(evaluations_.begin(), evaluations_.upper_bound(round_end_));
    round_end_ = evaluation_after(round_end_);
  }
}

RunState RunLedger::state(double seconds) const {
  const bool has_domain = !settings_.integrand;
  RunState state{settings_.first_trial, done_, has_domain ? settings_.domain.kind : Domain::Kind::ball,
                 has_domain ? settings_.domain.volume : 0.0, seconds};
  state.done.keep_first();
  return state;
}

RunRecord RunLedger::take_record(double seconds) {
  RunRecord record;
  static_cast<BlockRecord&>(record) = std::move(done_);
  record.keep_first();
  record.first_trial = settings_.first_trial;
  record.stopped_by = stopped_by_;
  record.complete = stopped_by_ == StopReason::trials || stopped_by_ == StopReason::relative_error ||
                    stopped_by_ == StopReason::seconds;
  record.seconds = seconds;
  return record;
}

}  // namespace vex
