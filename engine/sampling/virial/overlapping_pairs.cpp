#include "engine/sampling/virial/overlapping_pairs.h"

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {

double margin_of_balls(const ConvexBody& a, const ConvexBody& b) {
  return std::fmax(0x1p-30 * (a.reach() + b.reach()), 2.0 * (a.support_error() + b.support_error()));
}

PairDecider::PairDecider(const ConvexBody& a, const ConvexBody& b, InstructionSet set)
    : backend_(gjk_backend(set).make(a, b)) {
  const double margin = margin_of_balls(a, b);
  const double outer = a.circumradius() + b.circumradius() + margin;
  const double inner = std::fmax(0.0, a.inradius() + b.inradius() - margin);
  outer_sq_ = outer * outer;
  inner_sq_ = inner * inner;
}

std::span<const Outcome> PairDecider::search(const PoseTable& poses, Outcome undecided, PairQuestions& questions) {
  verdicts_.resize(poses.n);
  outcomes_.resize(poses.n);
  backend_->decide_table(poses, verdicts_);
  questions.n_searched += poses.n;
  for (std::size_t k = 0; k < poses.n; ++k) {
    const Outcome outcome = verdicts_[k].outcome;
    questions.n_undecided += outcome == Outcome::undecided ? 1u : 0u;
    outcomes_[k] = outcome == Outcome::undecided ? undecided : outcome;
  }
  return outcomes_;
}

OverlappingPairs::OverlappingPairs(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law,
                                   InstructionSet set)
    : a_(a),
      b_(b),
      law_(law),
      set_(set),
      decider_(a, b, set),
      recipe_{0, &law_, &domain_, b.centre(), nullptr},
      draw_poses_(pose_kernel(set)),
      points_((kPoseDimension + 2) * kStride),
      columns_(std::make_unique<PoseColumns>()),
      open_poses_(kPoseColumns * kStride),
      open_(kCandidates),
      overlaps_(kCandidates) {
  // A fitted domain's candidates take about so much longer than those of a ball or a box.
  constexpr double kCostOfFitted = 2.5;
  const double of_best = acceptance_of(best_domain(a, b));
  const Domain fitted = fitted_domain(a, b);
  if (!(acceptance_of(fitted) > kCostOfFitted * of_best)) acceptance_of(best_domain(a, b));
}

// Takes the domain, and tells which share of some poses overlaps: the same for every set and machine.
double OverlappingPairs::acceptance_of(const Domain& domain) {
  domain_ = domain;
  fitted_.reset();
  recipe_of_fitted_.reset();
  recipe_.fitted = nullptr;
  if (domain.kind == Domain::Kind::fitted) {
    fitted_.emplace(a_, b_);
    recipe_of_fitted_.emplace(a_, b_, *fitted_);
    recipe_.fitted = &*recipe_of_fitted_;
    // A candidate is kept by its share of the largest set: of rods the domain's own volume would keep one of thousands.
    const std::array<double, OrientationLaw::kMaxDimension> any_point{};
    domain_.volume = law_.dimension() > 0
                         ? fitted_->largest_volume()
                         : fitted_->at(law_.rotation(std::span<const double>(any_point))).volume * (1.0 + 0x1p-20);
  }
  constexpr std::uint64_t kBatches = 32;
  std::size_t n = 0;
  PairQuestions questions;
  for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
    draw_candidates(0, batch * kCandidates);
    decide_candidates(Outcome::disjoint, questions);
    for (const bool overlaps : overlaps_) n += overlaps ? 1 : 0;
  }
  return static_cast<double>(n) / static_cast<double>(kBatches * kCandidates);
}

void OverlappingPairs::draw_candidates(std::uint64_t seed, std::uint64_t first) {
  const int dimension = 3 + law_.dimension();
  const TrialPoints points(seed, Sequence::random, fitted_ ? dimension + 1 : dimension, {}, set_);
  points.many(first, kCandidates, points_.data(), kStride);
  if (draw_poses_ != nullptr) {
    recipe_.seed = seed;
    recipe_.points = points_.data();
    draw_poses_(recipe_, first, kCandidates, *columns_);
    return;
  }
  for (std::size_t k = 0; k < kCandidates; ++k) {
    std::array<double, kPoseDimension> point{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) point[c] = points_[c * kStride + k];
    Transformd pose;
    if (fitted_) {
      pose = law_.rotation(std::span<const double>(point).subspan(3));
      const Parallelepiped set = fitted_->at(pose);
      pose.translation = set.position(point[0], point[1], point[2]);
      columns_->share[k] = set.volume / domain_.volume;
    } else {
      pose = pose_at(point, law_, domain_, b_.centre());
    }
    set_pose(columns_->poses[0], kStride, k, pose);
  }
}

void OverlappingPairs::decide_candidates(Outcome undecided, PairQuestions& questions) {
  const PoseTable poses{columns_->poses[0], kStride, kCandidates};
  const double* const picks = points_.data() + static_cast<std::size_t>(3 + law_.dimension()) * kStride;
  std::size_t n_open = 0;
  for (std::size_t k = 0; k < kCandidates; ++k) {
    overlaps_[k] = false;
    if (fitted_ && !(columns_->share[k] <= 1.0)) {
      throw std::logic_error("a fitted set is larger than the largest one, and poses would not be alike");
    }
    if (fitted_ && !(picks[k] < columns_->share[k])) continue;
    const Transformd pose = poses.pose(k);
    const Outcome outcome = decider_.by_balls(pose(b_.centre()) - a_.centre());
    if (outcome == Outcome::undecided) {
      set_pose(open_poses_.data(), kStride, n_open, pose);
      open_[n_open++] = k;
      continue;
    }
    ++questions.n_by_balls;
    overlaps_[k] = outcome == Outcome::overlap;
  }
  const auto outcomes = decider_.search({open_poses_.data(), kStride, n_open}, undecided, questions);
  for (std::size_t k = 0; k < n_open; ++k) overlaps_[open_[k]] = outcomes[k] == Outcome::overlap;
}

void OverlappingPairs::draw(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::span<Transformd> poses,
                            PairQuestions& questions) {
  constexpr std::uint64_t kMostCandidates = 1u << 22;
  std::size_t n = 0;
  for (std::uint64_t from = 0; n < poses.size(); from += kCandidates) {
    if (from > kMostCandidates) {
      throw InputError("poses at which the bodies overlap are too seldom to be drawn (" + std::to_string(n) + " of " +
                       std::to_string(from) + ") - give bodies that are less thin");
    }
    draw_candidates(seed, first + from);
    decide_candidates(undecided, questions);
    const PoseTable candidates{columns_->poses[0], kStride, kCandidates};
    for (std::size_t k = 0; k < kCandidates && n < poses.size(); ++k) {
      if (overlaps_[k]) poses[n++] = candidates.pose(k);
    }
  }
}

}  // namespace vex
