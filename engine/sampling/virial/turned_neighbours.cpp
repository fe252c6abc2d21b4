#include "engine/sampling/virial/turned_neighbours.h"

#include <algorithm>

#include "engine/sampling/points/trial_points.h"

namespace vex {

TurnedNeighbours::TurnedNeighbours(const ConvexBody& a, const ConvexBody& b, double excluded_volume, InstructionSet set)
    : a_(a),
      b_(b),
      excluded_volume_(excluded_volume),
      set_(set),
      fitted_(a, b),
      decider_(a, b, set),
      points_(4 * kStride),
      open_poses_(kPoseColumns * kStride),
      open_(kCandidates),
      places_(kCandidates),
      outcomes_(kCandidates) {}

void TurnedNeighbours::draw(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::span<Transformd> poses,
                            std::span<double> factors, PairQuestions& questions) {
  for (std::size_t from = 0; from < poses.size(); from += kPoses) {
    const std::size_t n = std::min(kPoses, poses.size() - from);
    draw_some(seed, first + from * kPlaces, undecided, poses.subspan(from, n), factors.subspan(from, n), questions);
  }
}

void TurnedNeighbours::draw_some(std::uint64_t seed, std::uint64_t first, Outcome undecided,
                                 std::span<Transformd> poses, std::span<double> factors, PairQuestions& questions) {
  const TrialPoints points(seed, Sequence::random, 3, {}, set_);
  points.many(first, poses.size() * kPlaces, points_.data(), kStride);
  const Vec3d centre_a = a_.centre(), centre_b = b_.centre();
  std::size_t n_open = 0;
  for (std::size_t at = 0; at < poses.size(); ++at) {
    Transformd pose = poses[at];
    const Parallelepiped set = fitted_.at(pose);
    factors[at] = set.volume / excluded_volume_;
    for (std::size_t k = at * kPlaces; k < (at + 1) * kPlaces; ++k) {
      places_[k] = set.position(points_[k], points_[kStride + k], points_[2 * kStride + k]);
      pose.translation = places_[k];
      outcomes_[k] = decider_.by_balls(pose(centre_b) - centre_a);
      if (outcomes_[k] != Outcome::undecided) continue;
      set_pose(open_poses_.data(), kStride, n_open, pose);
      open_[n_open++] = k;
    }
  }
  questions.n_by_balls += poses.size() * kPlaces - n_open;
  const auto outcomes = decider_.search({open_poses_.data(), kStride, n_open}, undecided, questions);
  for (std::size_t row = 0; row < n_open; ++row) outcomes_[open_[row]] = outcomes[row];
  for (std::size_t at = 0; at < poses.size(); ++at) {
    const auto begin = outcomes_.begin() + static_cast<std::ptrdiff_t>(at * kPlaces);
    const auto end = begin + static_cast<std::ptrdiff_t>(kPlaces);
    const auto n_hits = std::count(begin, end, Outcome::overlap);
    factors[at] *= static_cast<double>(n_hits) / static_cast<double>(kPlaces);
    const auto hit = n_hits > 0 ? std::find(begin, end, Outcome::overlap) : begin;
    poses[at].translation = places_[static_cast<std::size_t>(hit - outcomes_.begin())];
  }
}

}  // namespace vex
