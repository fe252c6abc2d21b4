#include "engine/sampling/virial/virial_integrand.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/virial/placed_bodies.h"

namespace vex {
namespace {

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

VirialIntegrand::VirialIntegrand(std::vector<ConvexBody> bodies, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, InstructionSet set,
                                 std::shared_ptr<const VirialControl> control,
                                 std::span<const KnownExcludedVolume> known)
    : bodies_(std::move(bodies)),
      weights_(std::move(weights)),
      control_(std::move(control)),
      n_pairs_(weights_->pairs().size()),
      drawer_(bodies_, law, *weights_, known, set),
      decider_(bodies_.front(), bodies_.back(), set),
      clusters_(drawer_.n_drawn()),
      centres_(drawer_.world_from_bodies().size()),
      asked_(clusters_.size()),
      open_(clusters_.size()),
      outcomes_(clusters_.size()),
      stride_(clusters_.size() + 16) {
  table_.resize(kPoseColumns * stride_);
  if (bodies_.size() > 1 && weights_->order() != 3) {
    throw UsageError("a mixture's coefficients of this order are not built - give order 3");
  }
  if (!drawer_.has_factors()) return;
  constexpr std::size_t kBunches = 8;
  mean_factor_ = 0.0;
  for (std::size_t k = 0; k < kBunches; ++k) {
    pilot_bunch(k);
    for (std::size_t c = 0; c < clusters_.size(); ++c) mean_factor_ += drawer_.factor(c);
  }
  mean_factor_ /= static_cast<double>(kBunches * clusters_.size());
  counts_ = {};
}

VirialIntegrand::VirialIntegrand(const ConvexBody& body, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, InstructionSet set,
                                 std::shared_ptr<const VirialControl> control, const KnownExcludedVolume& known)
    : VirialIntegrand(std::vector<ConvexBody>{body}, law, std::move(weights), set, std::move(control),
                      std::span(&known, 1)) {}

VirialIntegrand::VirialIntegrand(const std::array<ConvexBody, 3>& bodies, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, InstructionSet set,
                                 const std::array<KnownExcludedVolume, 2>& known)
    : VirialIntegrand(std::vector<ConvexBody>(bodies.begin(), bodies.end()), law, std::move(weights), set, nullptr,
                      known) {}

VirialIntegrand::~VirialIntegrand() = default;

// Where clusters count for a product of factors, a pair is wrong as seldom, but what that costs is more: twice the mean
// product, as some bunches have it, is far more than what it is on average.
double VirialIntegrand::absolute_rounding() const {
  const double of_clusters = weights_->largest_weight() * static_cast<double>(n_pairs_) * 0x1p-40;
  return (drawer_.has_factors() ? 2.0 * mean_factor_ * of_clusters : of_clusters) +
         (control_ ? control_->absolute_rounding() : 0.0);
}

// What no value exceeds.
double VirialIntegrand::largest_value() const {
  double largest = weights_->largest_weight() * drawer_.largest_of_cluster();
  if (control_) {
    const double of_function = drawer_.has_factors() ? 1.0 + drawer_.largest_of_neighbour() : 1.0;
    for (const double factor : control_->factors) largest += of_function * std::fabs(factor);
  }
  return largest;
}

double VirialIntegrand::cost() const {
  constexpr double kOfPose = 100.0, kOfTurned = 350.0, kOfPair = 40.0;
  const auto n_clusters = static_cast<double>(clusters_.size());
  const double of_poses =
      drawer_.has_factors() ? kOfTurned * n_clusters : kOfPose * static_cast<double>(ClusterDrawer::kPoses);
  return of_poses + kOfPair * static_cast<double>(n_pairs_) * n_clusters;
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
      const Transformd* const world = &drawer_.world_from_bodies()[c * n];
      const Transformd &a = world[pair.i], &b = world[pair.j];
      const bool is_in_world = pair.i == 0 && !clusters_[c].is_tree;
      set_pose(table_.data(), stride_, row, is_in_world ? b : relative(a, b));
    }
    questions.n_by_balls += n_asked - n_open;
    const auto outcomes = decider_.search({table_.data(), stride_, n_open}, undecided, questions);
    for (std::size_t row = 0; row < n_open; ++row) outcomes_[open_[row]] = outcomes[row];
    for (std::size_t at = 0; at < n_asked; ++at) take(clusters_[asked_[at]], k, outcomes_[at]);
  }
}

// What is known of the clusters that were drawn: nothing but their neighbours.
void VirialIntegrand::begin_clusters() {
  const auto n = static_cast<std::size_t>(weights_->order());
  for (std::size_t c = 0; c < clusters_.size(); ++c) {
    Cluster& cluster = clusters_[c];
    cluster.answers = 0;
    cluster.is_tree = c < drawer_.n_trees();
    cluster.may_count = drawer_.factor(c) > 0.0;
    if (!cluster.is_tree) continue;
    cluster.graph = OverlapGraph(weights_->order());
    std::size_t n_pairs = 0;
    for (int i = 0; i < weights_->order(); ++i) {
      for (int j = i + 1; j < weights_->order(); ++j) {
        cluster.graph.join(i, j);
        if (!drawer_.tree(c).graph().overlaps(i, j)) cluster.pairs[n_pairs++] = {i, j};
      }
    }
  }
  // Of a mixture only the first and the last body of a chain are asked.
  const Vec3d centre_a = bodies_.front().centre(), centre_b = bodies_.back().centre();
  const std::span<const Transformd> world_from_bodies = drawer_.world_from_bodies();
  for (std::size_t at = 0; at < centres_.size(); at += n) {
    centres_[at] = world_from_bodies[at](centre_a);
    for (std::size_t k = 1; k < n; ++k) centres_[at + k] = world_from_bodies[at + k](centre_b);
  }
}

double VirialIntegrand::weight(std::size_t c) const {
  const Cluster& cluster = clusters_[c];
  if (!cluster.may_count) return 0.0;
  return drawer_.factor(c) *
         (cluster.is_tree ? weights_->weight_by_chain(cluster.graph) : weights_->weight_of_chain(cluster.answers));
}

double VirialIntegrand::bunch(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::uint64_t& n_undecided) {
  PairQuestions of_neighbours, of_pairs;
  drawer_.draw(seed, first, undecided, control_ ? &control_->functions : nullptr, of_neighbours);
  begin_clusters();
  ask(undecided, of_pairs);
  double sum = 0.0;
  for (std::size_t c = 0; c < clusters_.size(); ++c) sum += weight(c);
  n_undecided = of_neighbours.n_undecided + of_pairs.n_undecided;
  counts_.n_all += n_pairs_ * clusters_.size();
  counts_.n_by_balls += of_pairs.n_by_balls;
  counts_.n_searched += of_pairs.n_searched;
  counts_.n_undecided += n_undecided;
  counts_.n_candidates += of_neighbours.n_by_balls + of_neighbours.n_searched;
  double value = sum / static_cast<double>(clusters_.size());
  if (control_) {
    for (std::size_t k = 0; k < DistanceControl::kN; ++k) value -= control_->factors[k] * drawer_.means()[k];
  }
  return value;
}

// One of those that are no part of any run.
double VirialIntegrand::pilot_bunch(std::size_t k) {
  std::array<double, 2> point;
  draw_unit_cube(0, Stream::pilot, 1 + k, point);
  std::uint64_t n_undecided = 0;
  return bunch(whole_of(point[0]) << 1, whole_of(point[1]) << kRoomForCandidates, Outcome::disjoint, n_undecided);
}

std::shared_ptr<const VirialControl> VirialIntegrand::control_of(const ConvexBody& body, const OrientationLaw& law,
                                                                 const std::shared_ptr<const ClusterWeights>& weights,
                                                                 const KnownExcludedVolume& known, InstructionSet set) {
  const DistanceControl functions(body, body, known.value, known.relative_error, !chains_factorise(law));
  if (!functions.is_usable()) return nullptr;
  const auto none = std::make_shared<const VirialControl>(VirialControl{functions});
  // As many that what the factors lack of the best ones makes the variance larger by some hundredth.
  constexpr std::size_t kBunches = 256;
  VirialIntegrand integrand(body, law, weights, set, none, known);
  std::vector<double> values;
  std::vector<DistanceControl::Values> means;
  for (std::size_t bunch = 0; bunch < kBunches; ++bunch) {
    values.push_back(integrand.pilot_bunch(bunch));
    means.push_back(integrand.drawer_.means());
  }
  auto control = std::make_shared<VirialControl>(*none);
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
      values[k] = 0.0;
      doubts.push_back({k, largest_value()});
    }
  }
  return doubts;
}

}  // namespace vex
