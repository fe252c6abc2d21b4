#include "engine/sampling/virial/cluster_drawer.h"

#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/virial/placed_bodies.h"

namespace vex {

bool chains_factorise(const OrientationLaw& law) {
  return law.kind() == OrientationLaw::Kind::isotropic || law.kind() == OrientationLaw::Kind::aligned;
}

void require_law_of_one_body(const OrientationLaw& law) {
  using Kind = OrientationLaw::Kind;
  const bool is_of_two = law.kind() == Kind::fixed || law.kind() == Kind::angle || law.kind() == Kind::each;
  const Vec3d apart = law.axis_of(0) - law.axis_of(1);
  const bool has_two_axes = law.has_axes() && dot(apart, apart) > 0.0;
  if (!is_of_two && !has_two_axes) return;
  throw UsageError("no virial coefficients for orientations " + law.name() +
                   ": they say how two bodies are turned to each other, not how each of three or more is turned - use "
                   "isotropic, aligned, or a law of one body: cone, onsager, maier-saupe, table");
}

ClusterDrawer::ClusterDrawer(std::span<const ConvexBody> bodies, const OrientationLaw& law,
                             const ClusterWeights& weights, std::span<const KnownExcludedVolume> known,
                             InstructionSet set)
    : bodies_(bodies),
      law_(law),
      n_bodies_(static_cast<std::size_t>(weights.order())),
      n_clusters_of_trees_(kPoses * static_cast<std::size_t>(weights.n_rounds_of_trees())),
      world_from_bodies_(n_clusters(weights.order()) * n_bodies_),
      factors_of_clusters_(n_clusters(weights.order()), 1.0) {
  require_law_of_one_body(law);
  trees_.reserve(n_clusters_of_trees_);
  const bool is_mixture = bodies.size() > 1;
  const std::size_t n_neighbours = n_bodies_ - 1;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const ConvexBody &a = bodies[k], &b = bodies[is_mixture ? k + 1 : 0];
    if (chains_factorise(law)) {
      poses_[k].resize(kPoses);
      alike_.push_back(std::make_unique<OverlappingPairs>(a, b, law, set));
      continue;
    }
    if (!(known[k].value > 0.0)) {
      throw UsageError("no virial coefficients for orientations " + law.name() +
                       " of a body whose mean excluded volume is not known for them - use isotropic or aligned");
    }
    poses_[k].resize(kPoses * (n_clusters_of_trees_ > 0 ? n_neighbours : 1));
    factors_[k].resize(poses_[k].size());
    turned_.push_back(std::make_unique<TurnedNeighbours>(a, b, known[k].value, set));
    // Of a set's volume, relative to it: far more than what its sides' rounding is.
    constexpr double kOfSet = 0x1p-40;
    const std::size_t n_alike = is_mixture ? 1 : n_neighbours;
    relative_rounding_ += (known[k].relative_error + kOfSet) * static_cast<double>(n_alike);
    const double largest = turned_.back()->largest_factor();
    largest_of_neighbour_ = std::fmax(largest_of_neighbour_, largest);
    largest_of_cluster_ *= std::pow(largest, n_alike);
  }
}

void ClusterDrawer::set_chain(std::size_t cluster, const Neighbours& neighbours) {
  double factor = 1.0;
  const std::span<Transformd> world_from_body = world_of(cluster);
  std::size_t pose = neighbours.first;
  for (std::size_t k = 1; k < world_from_body.size(); ++k) {
    const bool is_of_second = k == 2 && !neighbours.second_poses.empty();
    const Transformd& next = is_of_second ? neighbours.second_poses[pose] : neighbours.poses[pose];
    if (!neighbours.factors.empty()) {
      factor *= is_of_second ? neighbours.second_factors[pose] : neighbours.factors[pose];
    }
    world_from_body[k] = k == 1 ? next : composed(world_from_body[k - 1], next);
    pose = (pose + neighbours.step) % kPoses;
  }
  factors_of_clusters_[cluster] = factor;
}

void ClusterDrawer::set_tree(std::size_t cluster, const Neighbours& neighbours) {
  double factor = 1.0;
  const std::span<Transformd> world_from_body = world_of(cluster);
  const std::span<const ClusterTree::Edge> edges = trees_[cluster].edges();
  world_from_body[static_cast<std::size_t>(edges.front().parent)] = {};
  std::size_t pose = neighbours.first;
  for (const ClusterTree::Edge& edge : edges) {
    world_from_body[static_cast<std::size_t>(edge.leaf)] =
        composed(world_from_body[static_cast<std::size_t>(edge.parent)], neighbours.poses[pose]);
    if (!neighbours.factors.empty()) factor *= neighbours.factors[pose];
    pose = (pose + neighbours.step) % neighbours.poses.size();
  }
  factors_of_clusters_[cluster] = factor;
}

// Of the functions, over the first neighbours that poses_ has now.
void ClusterDrawer::note_neighbours(std::size_t n) {
  if (functions_ == nullptr) return;
  const Vec3d centre = bodies_.front().centre();
  for (std::size_t k = 0; k < n; ++k) {
    functions_->add(poses_[0][k](centre) - centre, means_, has_factors() ? factors_[0][k] : 1.0);
  }
  n_noted_ += n;
}

void ClusterDrawer::draw(std::uint64_t seed, std::uint64_t first, Outcome undecided, const DistanceControl* functions,
                         PairQuestions& questions) {
  functions_ = functions;
  means_ = {};
  n_noted_ = 0;
  trees_.clear();
  for (std::size_t c = 0; c < n_clusters_of_trees_; ++c) {
    std::array<double, kMostClusterBodies> point;
    draw_unit_cube(seed + 1, Stream::virial_trees, first + c, std::span(point).first(n_bodies_ - 2));
    trees_.emplace_back(static_cast<int>(n_bodies_), point);
  }
  if (has_factors()) {
    draw_by_law(seed, first, undecided, questions);
  } else {
    draw_alike(seed, first, undecided, questions);
  }
  if (functions_ == nullptr) return;
  for (double& mean : means_) mean /= static_cast<double>(n_noted_);
}

// All rounds take the same poses.
void ClusterDrawer::draw_alike(std::uint64_t seed, std::uint64_t first, Outcome undecided, PairQuestions& questions) {
  // Another stream for the second pair of a mixture: the seeds of all points are even.
  for (std::size_t k = 0; k < alike_.size(); ++k) alike_[k]->draw(seed + k, first, undecided, poses_[k], questions);
  note_neighbours(kPoses);
  for (std::size_t c = 0; c < n_drawn(); ++c) {
    const Neighbours neighbours{poses_[0], poses_[1], {}, {}, c % kPoses, c / kPoses + 1};
    if (c < n_clusters_of_trees_) {
      set_tree(c, neighbours);
    } else {
      set_chain(c, neighbours);
    }
  }
}

void ClusterDrawer::draw_orientations(std::uint64_t seed, std::uint64_t first) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    orientations_[k].resize(kPoses);
    for (std::size_t j = 0; j < kPoses; ++j) {
      std::array<double, 3> point;
      draw_unit_cube(seed, Stream::virial_orientations, first + k * kPoses + j, point);
      orientations_[k][j] = law_.rotation_of_body(std::span<const double>(point));
    }
  }
}

// The body after the one of orientation j has the orientation j + step, and a neighbour of its own: each serves some
// chains of this step.
void ClusterDrawer::turn_neighbours_of_chains(std::size_t step) {
  for (std::size_t pair = 0; pair < turned_.size(); ++pair) {
    const auto &of_a = orientations_[pair], &of_b = orientations_[bodies_.size() > 1 ? pair + 1 : 0];
    for (std::size_t j = 0; j < kPoses; ++j) poses_[pair][j] = relative(of_a[j], of_b[(j + step) % kPoses]);
  }
}

// As the neighbours of a tree are any two of its bodies, no other tree has the same.
void ClusterDrawer::turn_neighbours_of_trees(std::size_t first_cluster, std::size_t step) {
  std::size_t at = 0;
  for (std::size_t c = 0; c < kPoses; ++c) {
    const auto of_body = [&](int body) -> const Transformd& {
      return orientations_[0][(c + static_cast<std::size_t>(body) * step) % kPoses];
    };
    for (const ClusterTree::Edge& edge : trees_[first_cluster + c].edges()) {
      poses_[0][at++] = relative(of_body(edge.parent), of_body(edge.leaf));
    }
  }
}

void ClusterDrawer::draw_by_law(std::uint64_t seed, std::uint64_t first, Outcome undecided, PairQuestions& questions) {
  draw_orientations(seed, first);
  std::uint64_t trial = first;
  for (std::size_t begin = 0; begin < n_drawn(); begin += kPoses) {
    const std::size_t step = begin / kPoses + 1, n_of_tree = n_bodies_ - 1;
    const bool is_of_trees = begin < n_clusters_of_trees_;
    const std::size_t n = is_of_trees ? kPoses * n_of_tree : kPoses;
    if (is_of_trees) {
      turn_neighbours_of_trees(begin, step);
    } else {
      turn_neighbours_of_chains(step);
    }
    for (std::size_t pair = 0; pair < turned_.size(); ++pair) {
      turned_[pair]->draw(seed, trial, undecided, std::span(poses_[pair]).first(n), std::span(factors_[pair]).first(n),
                          questions);
      trial += n * TurnedNeighbours::kPlaces;
    }
    note_neighbours(n);
    for (std::size_t c = 0; c < kPoses; ++c) {
      if (is_of_trees) {
        const auto of_tree = [&](const auto& all) { return std::span(all).subspan(c * n_of_tree, n_of_tree); };
        set_tree(begin + c, {of_tree(poses_[0]), {}, of_tree(factors_[0]), {}, 0, 1});
      } else {
        set_chain(begin + c, {poses_[0], poses_[1], factors_[0], factors_[1], c, step});
      }
    }
  }
}

}  // namespace vex
