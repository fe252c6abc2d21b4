#include "engine/query/separation_of_many.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/query/overlap_backend.h"
#include "engine/query/packets/nearest_guess.h"
#include "engine/query/packets/packet_pair.h"
#include "engine/query/search/separation_search.h"
#include "engine/query/separation_from_guess.h"

namespace vex {
namespace {

// What the query of one pose says where it has nothing to tell but the verdict.
Separation nothing_but_verdict(const Verdict& verdict) {
  Separation found;
  found.verdict = verdict;
  (verdict.outcome == Outcome::overlap ? found.upper : found.lower) = 0.0;
  return found;
}

}  // namespace

// Of the poses that are apart, one after the other.
class ManySeparations::Guesses {
 public:
  // None of a pair that packets do not take, or whose distances need no search.
  static std::unique_ptr<Guesses> make(const ConvexBody& a, const ConvexBody& b, const SeparationSettings& settings) {
    if (is_known_without_search(a, b)) return nullptr;
    std::unique_ptr<PacketPair> pair = PacketPair::make(a, b);
    if (pair == nullptr) return nullptr;
    const Transformd at_rest;
    const SeparationQuery query{a, b, at_rest, SeparationGoal::distance, settings};
    // A little nearer than the search that begins there wants to be: it is to have nothing left to do.
    const NearestGoal goal{0.75 * query.searched_gap(), query.circumradii(),
                           pair->are_polytopes() && a.rolling_radius() == 0.0 && b.rolling_radius() == 0.0,
                           settings.max_distance + a.ball_radius() + b.ball_radius()};
    return std::unique_ptr<Guesses>(new Guesses(std::move(pair), goal));
  }

  // Of the poses first ... last - 1, not more than kMostPoses.
  void look_at(const PoseTable& poses, std::size_t first, std::size_t last, std::span<const Verdict> verdicts) {
    std::size_t n = 0;
    for (std::size_t k = first; k < last; ++k) {
      if (verdicts[k].outcome == Outcome::disjoint) set_pose(columns_.data(), kStride, n++, poses.pose(k));
    }
    if (n > 0) guess_(pair_->forms(), goal_, {columns_.data(), kStride, n}, found_);
    next_ = 0;
  }
  NearestGuess next() { return found_.of(next_++); }

 private:
  static constexpr std::size_t kStride = NearestGuesses::kStride;

  Guesses(std::unique_ptr<PacketPair> pair, const NearestGoal& goal)
      : pair_(std::move(pair)), goal_(goal), guess_(nearest_guesser(best_instruction_set())) {}

  std::unique_ptr<PacketPair> pair_;
  NearestGoal goal_;
  GuessNearest guess_;
  std::size_t next_ = 0;
  std::array<double, kPoseColumns * kStride> columns_{};
  NearestGuesses found_;
};

ManySeparations::ManySeparations(const ConvexBody& a, const ConvexBody& b, SeparationGoal goal,
                                 const SeparationSettings& settings)
    : a_(a), b_(b), goal_(goal), settings_(settings) {
  require_usable(settings);
  // Of a body without an exact form a distance may prove less, or more, than `overlap` does.
  if (!a.exact_form().has_value() || !b.exact_form().has_value()) return;
  if (goal != SeparationGoal::depth) guesses_ = Guesses::make(a, b, settings);
  if (goal != SeparationGoal::signed_distance || guesses_ != nullptr) backend_ = gjk_backend().make(a, b);
}

ManySeparations::~ManySeparations() = default;

void ManySeparations::answer(const PoseTable& poses, std::span<Separation> out) {
  std::array<Verdict, kMostPoses> verdicts{};
  if (backend_ != nullptr) backend_->decide_table(poses, std::span(verdicts).first(poses.n));
  for (std::size_t k = 0; k < poses.n; ++k) {
    if (guesses_ != nullptr && k % NearestGuesses::kMostPoses == 0) {
      guesses_->look_at(poses, k, std::min(poses.n, k + NearestGuesses::kMostPoses), verdicts);
    }
    const Outcome outcome = verdicts[k].outcome;
    if ((goal_ == SeparationGoal::distance && outcome == Outcome::overlap) ||
        (goal_ == SeparationGoal::depth && outcome == Outcome::disjoint)) {
      out[k] = nothing_but_verdict(verdicts[k]);
      continue;
    }
    const Pose pose = Pose::unchecked(poses.pose(k));
    NearestGuess guess;
    if (guesses_ != nullptr && outcome == Outcome::disjoint) guess = guesses_->next();
    switch (goal_) {
      case SeparationGoal::signed_distance: out[k] = signed_distance(a_, b_, pose, settings_, guess); break;
      case SeparationGoal::distance: out[k] = distance(a_, b_, pose, settings_, guess); break;
      case SeparationGoal::depth: out[k] = penetration_depth(a_, b_, pose, settings_); break;
    }
  }
}

}  // namespace vex
