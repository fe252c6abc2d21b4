// Which trials of a run are given out, which have come home, and whether they are enough.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "engine/sampling/monte_carlo.h"

namespace vex {

/// Trials are given out in blocks, in their order, and come home in any. What counts is at every moment a run without a
/// gap, trials first ... n - 1: blocks behind a gap wait until it is closed. So what came home can be saved as it is,
/// and stop rules, which look at fixed numbers of trials, see the same records whoever answered them, and when. Not
/// guarded: one thread at a time.
class RunLedger {
 public:
  struct Block {
    std::uint64_t begin, end;
  };

  /// `certain`: every trial hits by construction. Of a resumed run, which is evaluated at once where the state ends at
  /// an evaluation: whoever saved it may not have come to it. Throws InputError where the state to go on from is not
  /// one of these settings. The settings must outlive it.
  RunLedger(const MonteCarloSettings& settings, bool certain);

  /// The next trials that nobody has, up to `most` of them: none where the run is over, or where all trials up to the
  /// next evaluation are given out; with other ranks trials behind it are given out, too, so that nobody waits for the
  /// slowest, unless very many blocks wait for one. No block goes beyond an evaluation.
  std::optional<Block> take(std::uint64_t most);
  /// Counts a block that was taken, and evaluates where it closes a round. Returns whether it did.
  bool bring(const Block& block, BlockRecord&& record);

  bool is_over() const { return over_; }
  void stop(StopReason reason);
  /// Whether any trial was given out, or came with the state.
  bool has_begun() const { return next_ > 0; }

  /// Whether the run was ended by its time, and blocks that were given out are still to come.
  bool awaits_others() const { return over_ && stopped_by_ == StopReason::seconds && n_brought_ < next_; }

  const Tally& tally() const { return done_.tally; }
  RunState state(double seconds) const;
  /// Empties it.
  RunRecord take_record(double seconds);

 private:
  // Over by something else than its trials: those that were given out still count.
  bool is_cut_off() const {
    return over_ && (stopped_by_ == StopReason::interrupted || stopped_by_ == StopReason::seconds);
  }
  void resume(const RunState& state);
  std::size_t most_waiting() const;
  std::uint64_t evaluation_after(std::uint64_t n_trials) const;
  void evaluate();
  bool rounding_is_most() const;

  const MonteCarloSettings& settings_;
  const bool certain_;
  const bool is_only_rule_;  // the relative error: where it cannot be reached, nothing else ends the run
  const std::uint64_t limit_;
  // Numbers of trials, counted from the run's first one.
  std::uint64_t next_ = 0;       // given out
  std::uint64_t n_brought_ = 0;  // come home, waiting or not
  std::uint64_t block_end_ = 0;  // the evaluation that no block goes beyond now: round_end_, or a later one
  std::uint64_t round_end_ = 0;  // where the stop rule is looked at next
  BlockRecord done_;
  // Behind a gap, by where they begin; neighbours are one, unless an evaluation lies between them.
  struct Waiting {
    std::uint64_t end;
    BlockRecord record;
  };
  std::map<std::uint64_t, Waiting> waiting_;
  std::set<std::uint64_t> evaluations_;  // that blocks ended at, or will
  bool over_ = false;
  StopReason stopped_by_ = StopReason::interrupted;
};

}  // namespace vex
