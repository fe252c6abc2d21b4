#include "engine/sampling/virial/virial_integrand.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace {

// a_from_b and b_from_c make a_from_c.
Transformd composed(const Transformd& a_from_b, const Transformd& b_from_c) {
  const auto row = [&](const Vec3d& r) { return r.x * b_from_c.row_x + r.y * b_from_c.row_y + r.z * b_from_c.row_z; };
  return {row(a_from_b.row_x), row(a_from_b.row_y), row(a_from_b.row_z), a_from_b(b_from_c.translation)};
}

// a_from_b of two bodies in one world.
Transformd relative(const Transformd& world_from_a, const Transformd& world_from_b) {
  const Transformd &a = world_from_a, &b = world_from_b;
  const auto row = [&](double x, double y, double z) { return x * b.row_x + y * b.row_y + z * b.row_z; };
  return {row(a.row_x.x, a.row_y.x, a.row_z.x), row(a.row_x.y, a.row_y.y, a.row_z.y),
          row(a.row_x.z, a.row_y.z, a.row_z.z), a.direction_to_b(b.translation - a.translation)};
}

// All 52 bits that a coordinate has.
std::uint64_t whole_of(double coordinate) { return static_cast<std::uint64_t>(coordinate * 0x1p52); }

constexpr int kRoomForCandidates = 12;

}  // namespace

// What is known of the pairs of bodies that are no neighbours.
struct VirialIntegrand::Cluster {
  OverlapGraph graph{kMostClusterBodies};  // of a tree; pairs that are not asked yet are taken for overlaps
  std::array<BodyPair, kMostClusterBodies * kMostClusterBodies / 2> pairs;  // of a tree
  std::uint32_t answers = 0;                                                // of a chain
  bool is_tree = false, may_count = true;
};

void require_factorising_law(const OrientationLaw& law) {
  if (law.kind() == OrientationLaw::Kind::isotropic || law.kind() == OrientationLaw::Kind::aligned) return;
  throw UsageError("no virial coefficients for orientations " + law.name() +
                   ": a chain of bodies is no power of B2 then - use isotropic or aligned");
}

VirialIntegrand::VirialIntegrand(std::vector<ConvexBody> bodies, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, InstructionSet set,
                                 std::shared_ptr<const VirialControl> control)
    : bodies_(std::move(bodies)),
      weights_(std::move(weights)),
      control_(std::move(control)),
      n_pairs_(weights_->pairs().size()),
      neighbours_(bodies_.front(), bodies_[bodies_.size() / 2], law, set),
      decider_(bodies_.front(), bodies_.back(), set),
      clusters_(n_clusters(weights_->order())),
      world_from_bodies_(clusters_.size() * static_cast<std::size_t>(weights_->order())),
      centres_(world_from_bodies_.size()),
      asked_(clusters_.size()),
      open_(clusters_.size()),
      outcomes_(clusters_.size()),
      stride_(clusters_.size() + 16),
      verdicts_(clusters_.size()) {
  table_.resize(kPoseColumns * stride_);
  require_factorising_law(law);
  if (bodies_.size() > 1) {
    if (weights_->order() != 3) throw UsageError("a mixture's coefficients of this order are not built - give order 3");
    second_neighbours_ = std::make_unique<OverlappingPairs>(bodies_[1], bodies_[2], law, set);
  }
}

VirialIntegrand::VirialIntegrand(const ConvexBody& body, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, InstructionSet set,
                                 std::shared_ptr<const VirialControl> control)
    : VirialIntegrand(std::vector<ConvexBody>{body}, law, std::move(weights), set, std::move(control)) {}

VirialIntegrand::VirialIntegrand(const std::array<ConvexBody, 3>& bodies, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, InstructionSet set)
    : VirialIntegrand(std::vector<ConvexBody>(bodies.begin(), bodies.end()), law, std::move(weights), set, nullptr) {}

VirialIntegrand::~VirialIntegrand() = default;

double VirialIntegrand::absolute_rounding() const {
  return weights_->largest_weight() * static_cast<double>(n_pairs_) * 0x1p-40 +
         (control_ ? control_->absolute_rounding() : 0.0);
}

double VirialIntegrand::cost() const {
  constexpr double kOfPose = 100.0, kOfPair = 40.0;
  return kOfPose * static_cast<double>(kPoses) + kOfPair * static_cast<double>(n_pairs_ * clusters_.size());
}

void VirialIntegrand::set_chain(std::size_t cluster, std::size_t first, std::size_t step) {
  clusters_[cluster].is_tree = false;
  clusters_[cluster].may_count = true;
  clusters_[cluster].answers = 0;
  const std::span<Transformd> world_from_body = world_of(cluster);
  std::size_t pose = first;
  for (std::size_t k = 1; k < world_from_body.size(); ++k) {
    const bool is_of_second = k == 2 && second_neighbours_ != nullptr;
    const Transformd& next = is_of_second ? second_poses_[pose] : poses_[pose];
    world_from_body[k] = k == 1 ? next : composed(world_from_body[k - 1], next);
    pose = (pose + step) % kPoses;
  }
}

// By Pruefer's code, n - 2 numbers of a body, which each tree has just one of (H. Pruefer, Arch. Math. Phys. 27, 742,
// 1918).
void VirialIntegrand::set_tree(std::size_t number, std::size_t first, std::size_t step, std::span<const double> point) {
  Cluster& cluster = clusters_[number];
  const std::span<Transformd> world_from_body = world_of(number);
  const int n = weights_->order();
  std::array<int, kMostClusterBodies> code{}, n_edges{}, leaf{}, parent{};
  for (int k = 0; k < n; ++k) n_edges[static_cast<std::size_t>(k)] = 1;
  for (int k = 0; k + 2 < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    code[at] = static_cast<int>(point[at] * n);
    ++n_edges[static_cast<std::size_t>(code[at])];
  }
  cluster.is_tree = true;
  cluster.may_count = true;
  cluster.graph = OverlapGraph(n);
  OverlapGraph tree(n);
  int n_done = 0;
  const auto cut = [&](int to) {
    int k = 0;
    while (n_edges[static_cast<std::size_t>(k)] != 1 || k == to) ++k;
    const auto at = static_cast<std::size_t>(n_done++);
    leaf[at] = k;
    parent[at] = to;
    --n_edges[static_cast<std::size_t>(k)];
    --n_edges[static_cast<std::size_t>(to)];
    tree.join(k, to);
  };
  for (int k = 0; k + 2 < n; ++k) cut(code[static_cast<std::size_t>(k)]);
  int last = n - 1;
  while (n_edges[static_cast<std::size_t>(last)] != 1) --last;
  cut(last);
  // Parents before their leaves.
  world_from_body[static_cast<std::size_t>(last)] = {};
  std::size_t pose = first;
  for (int k = n_done - 1; k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    world_from_body[static_cast<std::size_t>(leaf[at])] =
        composed(world_from_body[static_cast<std::size_t>(parent[at])], poses_[pose]);
    pose = (pose + step) % kPoses;
  }
  std::size_t n_pairs = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      cluster.graph.join(i, j);
      if (!tree.overlaps(i, j)) cluster.pairs[n_pairs++] = {i, j};
    }
  }
}

void VirialIntegrand::take(Cluster& cluster, std::size_t k, Outcome outcome) const {
  const bool overlaps = outcome == Outcome::overlap;
  if (!cluster.is_tree) {
    cluster.answers |= (overlaps ? 1u : 0u) << k;
    cluster.may_count = weights_->may_count(static_cast<int>(k) + 1, cluster.answers);
  } else if (!overlaps) {
    const auto [i, j] = cluster.pairs[k];
    cluster.graph.part(i, j);
    // A body with one neighbour at most is told at once; the rest is looked at now and then, as it takes longer.
    const auto has_few = [&cluster](int body) { return std::popcount(cluster.graph.neighbours(body)) < 2; };
    constexpr std::size_t kBetween = 4;
    cluster.may_count = !has_few(i) && !has_few(j) && (k % kBetween != 0 || is_biconnected(cluster.graph));
  }
}

// Pair after pair, of all clusters that may count: step by step, each over all of them, as the answers are for a
// processor to guess in vain. What balls do not tell is searched together.
void VirialIntegrand::ask(Outcome undecided, PairQuestions& questions) {
  const auto n = static_cast<std::size_t>(weights_->order());
  const auto pair_of = [this](std::size_t c, std::size_t k) {
    return clusters_[c].is_tree ? clusters_[c].pairs[k] : weights_->pairs()[k];
  };
  for (std::size_t k = 0; k < n_pairs_; ++k) {
    std::size_t n_asked = 0, n_open = 0;
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      asked_[n_asked] = c;
      n_asked += clusters_[c].may_count ? 1u : 0u;
    }
    for (std::size_t at = 0; at < n_asked; ++at) {
      const BodyPair pair = pair_of(asked_[at], k);
      const Vec3d* const centres = &centres_[asked_[at] * n];
      outcomes_[at] = decider_.by_balls(centres[pair.j] - centres[pair.i]);
      open_[n_open] = at;
      n_open += outcomes_[at] == Outcome::undecided ? 1u : 0u;
    }
    for (std::size_t row = 0; row < n_open; ++row) {
      const std::size_t c = asked_[open_[row]];
      const BodyPair pair = pair_of(c, k);
      const Transformd* const world = &world_from_bodies_[c * n];
      const Transformd &a = world[pair.i], &b = world[pair.j];
      const bool is_in_world = pair.i == 0 && !clusters_[c].is_tree;
      set_pose(table_.data(), stride_, row, is_in_world ? b : relative(a, b));
    }
    decider_.search({table_.data(), stride_, n_open}, std::span(verdicts_).first(n_open));
    questions.n_by_balls += n_asked - n_open;
    questions.n_searched += n_open;
    for (std::size_t row = 0; row < n_open; ++row) {
      Outcome outcome = verdicts_[row].outcome;
      if (outcome == Outcome::undecided) {
        ++questions.n_undecided;
        outcome = undecided;
      }
      outcomes_[open_[row]] = outcome;
    }
    for (std::size_t at = 0; at < n_asked; ++at) take(clusters_[asked_[at]], k, outcomes_[at]);
  }
}

void VirialIntegrand::draw_clusters(std::uint64_t seed, std::uint64_t first) {
  const auto n_trees = kPoses * static_cast<std::size_t>(weights_->n_rounds_of_trees());
  for (std::size_t c = 0; c < clusters_.size(); ++c) {
    const std::size_t step = c / kPoses + 1;
    if (c >= n_trees) {
      set_chain(c, c % kPoses, step);
      continue;
    }
    std::array<double, kMostClusterBodies> point;
    const auto n_numbers = static_cast<std::size_t>(weights_->order() - 2);
    draw_unit_cube(seed + 1, Stream::virial_trees, first + c, std::span(point).first(n_numbers));
    set_tree(c, c % kPoses, step, point);
  }
  // Of a mixture only the first and the last body of a chain are asked.
  const Vec3d centre_a = bodies_.front().centre(), centre_b = bodies_.back().centre();
  const auto n = static_cast<std::size_t>(weights_->order());
  for (std::size_t at = 0; at < centres_.size(); at += n) {
    centres_[at] = world_from_bodies_[at](centre_a);
    for (std::size_t k = 1; k < n; ++k) centres_[at + k] = world_from_bodies_[at + k](centre_b);
  }
}

double VirialIntegrand::weight(const Cluster& cluster) const {
  if (!cluster.may_count) return 0.0;
  return cluster.is_tree ? weights_->weight_by_chain(cluster.graph) : weights_->weight_of_chain(cluster.answers);
}

double VirialIntegrand::bunch(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::uint64_t& n_undecided) {
  PairQuestions of_neighbours, of_pairs;
  neighbours_.draw(seed, first, undecided, poses_, of_neighbours);
  // Another stream for the second pair of a mixture: the seeds of all points are even.
  if (second_neighbours_ != nullptr) second_neighbours_->draw(seed + 1, first, undecided, second_poses_, of_neighbours);
  draw_clusters(seed, first);
  ask(undecided, of_pairs);
  double sum = 0.0;
  for (const Cluster& cluster : clusters_) sum += weight(cluster);
  n_undecided = of_neighbours.n_undecided + of_pairs.n_undecided;
  counts_.n_all += n_pairs_ * clusters_.size();
  counts_.n_by_balls += of_pairs.n_by_balls;
  counts_.n_searched += of_pairs.n_searched;
  counts_.n_undecided += n_undecided;
  counts_.n_candidates += of_neighbours.n_by_balls + of_neighbours.n_searched;
  double value = sum / static_cast<double>(clusters_.size());
  if (control_) {
    const DistanceControl::Values means = means_of(control_->functions);
    for (std::size_t k = 0; k < means.size(); ++k) value -= control_->factors[k] * means[k];
  }
  return value;
}

// Over the poses that the bunch has now.
DistanceControl::Values VirialIntegrand::means_of(const DistanceControl& functions) const {
  DistanceControl::Values sums{};
  const Vec3d centre = bodies_.front().centre();
  for (const Transformd& pose : poses_) functions.add(pose(centre) - centre, sums);
  for (double& sum : sums) sum /= static_cast<double>(kPoses);
  return sums;
}

std::shared_ptr<const VirialControl> VirialIntegrand::control_of(const ConvexBody& body, const OrientationLaw& law,
                                                                 const std::shared_ptr<const ClusterWeights>& weights,
                                                                 double excluded_volume, double relative_error,
                                                                 InstructionSet set) {
  auto control =
      std::make_shared<VirialControl>(VirialControl{DistanceControl(body, body, excluded_volume, relative_error)});
  if (!control->functions.is_usable()) return nullptr;
  // As many that what the factors lack of the best ones makes the variance larger by some hundredth.
  constexpr std::size_t kBunches = 256;
  VirialIntegrand integrand(body, law, weights, set);
  std::vector<double> values;
  std::vector<DistanceControl::Values> means;
  for (std::size_t bunch = 0; bunch < kBunches; ++bunch) {
    std::array<double, 2> point;
    draw_unit_cube(0, Stream::pilot, 1 + bunch, point);
    std::uint64_t n_undecided = 0;
    values.push_back(integrand.bunch(whole_of(point[0]) << 1, whole_of(point[1]) << kRoomForCandidates,
                                     Outcome::disjoint, n_undecided));
    means.push_back(integrand.means_of(control->functions));
  }
  control->fit(std::move(values), means);
  return control;
}

void VirialIntegrand::count(std::span<std::uint64_t> counted) {
  VEX_EXPECT(counted.size() == Tally::kNCounted);
  std::exchange(counts_, {}).add_to(counted);
}

Doubts VirialIntegrand::evaluate(std::span<const double> points, std::span<double> values) {
  VEX_EXPECT(points.size() == 2 * values.size());
  Doubts doubts;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint64_t seed = whole_of(points[k]) << 1, first = whole_of(points[values.size() + k])
                                                                 << kRoomForCandidates;
    std::uint64_t n_undecided = 0, n_undecided_then = 0;
    values[k] = bunch(seed, first, Outcome::disjoint, n_undecided);
    if (n_undecided == 0) continue;
    // Of one undecided pair the two values are what is possible; of more, nothing is known but the largest weight.
    const double other = bunch(seed, first, Outcome::overlap, n_undecided_then);
    if (n_undecided == 1 && n_undecided_then <= 1) {
      doubts.push_back({k, 0.5 * std::fabs(other - values[k])});
      values[k] = 0.5 * (values[k] + other);
    } else {
      double largest = weights_->largest_weight();
      if (control_) {
        for (const double factor : control_->factors) largest += std::fabs(factor);
      }
      values[k] = 0.0;
      doubts.push_back({k, largest});
    }
  }
  return doubts;
}

}  // namespace vex
